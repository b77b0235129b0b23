#include "gltf_accessor.h"

#include <math.h>
#include <meshoptimizer.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"

enum { INT8 = 5120, UINT8, INT16, UINT16, UINT32 = 5125, FLOAT32 };

/* Most bytes that a packed view may have: guards against counts that lie. */
#define UNPACKED_MAX ((size_t)1 << 31)

int lobe_gltf_reader_create(gltf_reader *r, const gltf_model *model, const char *path) {
    *r = (gltf_reader){model, path, calloc(model->view_count + 1, sizeof *r->unpacked)};
    return r->unpacked != NULL;
}

void lobe_gltf_reader_free(gltf_reader *r) {
    for (size_t i = 0; r->unpacked && i < r->model->view_count; i++) free(r->unpacked[i]);
    free(r->unpacked);
}

static lobe_render_result refuse(const gltf_reader *r, const char *noun, int index,
                                 const char *why) {
    return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: %s %d %s; is it damaged?", r->path, noun, index,
                     why);
}

/* ---- Views --------------------------------------------------------------------------------------- */

/* The sizes that the decoders and filters ask for. */
static int is_packing_possible(const gltf_view *v) {
    if (v->count == 0 || v->stride == 0 || v->stride > 256) return 0;
    if (v->count > UNPACKED_MAX / v->stride) return 0;
    if (v->packing != GLTF_ATTRIBUTES)
        return (v->stride == 2 || v->stride == 4) &&
               (v->packing != GLTF_TRIANGLES || v->count % 3 == 0);
    if (v->filter == GLTF_FILTER_OCTAHEDRAL) return v->stride == 4 || v->stride == 8;
    if (v->filter == GLTF_FILTER_QUATERNION) return v->stride == 8;
    return v->stride % 4 == 0 && v->filter != GLTF_FILTER_UNKNOWN;
}

static int unpack(const gltf_view *v, const unsigned char *packed, unsigned char *to) {
    int error;
    if (v->packing == GLTF_TRIANGLES)
        error = meshopt_decodeIndexBuffer(to, v->count, v->stride, packed, v->length);
    else if (v->packing == GLTF_INDICES)
        error = meshopt_decodeIndexSequence(to, v->count, v->stride, packed, v->length);
    else
        error = meshopt_decodeVertexBuffer(to, v->count, v->stride, packed, v->length);
    if (error || v->packing != GLTF_ATTRIBUTES) return !error;
    if (v->filter == GLTF_FILTER_OCTAHEDRAL) meshopt_decodeFilterOct(to, v->count, v->stride);
    if (v->filter == GLTF_FILTER_QUATERNION) meshopt_decodeFilterQuat(to, v->count, v->stride);
    if (v->filter == GLTF_FILTER_EXPONENTIAL) meshopt_decodeFilterExp(to, v->count, v->stride);
    return 1;
}

lobe_render_result lobe_gltf_view_bytes(gltf_reader *r, int index, gltf_bytes *bytes) {
    const gltf_model *m = r->model;
    if (index < 0 || (size_t)index >= m->view_count)
        return refuse(r, "buffer view", index, "does not exist");
    const gltf_view *v = &m->views[index];
    if (v->buffer < 0 || (size_t)v->buffer >= m->buffer_count)
        return refuse(r, "buffer view", index, "lies in no buffer");
    const gltf_bytes *buffer = &m->buffers[v->buffer];
    if (v->offset > buffer->size || v->length > buffer->size - v->offset)
        return refuse(r, "buffer view", index, "reaches beyond its buffer");
    *bytes = (gltf_bytes){buffer->data + v->offset, v->length};
    if (v->packing == GLTF_PLAIN) return LOBE_RENDER_OK;
    if (!is_packing_possible(v))
        return refuse(r, "buffer view", index, "is packed in a way that does not exist");
    if (!r->unpacked[index]) {
        unsigned char *to = calloc(v->count, v->stride);
        if (!to) return lobe_fail_memory(r->path);
        if (!unpack(v, bytes->data, to)) {
            free(to);
            return refuse(r, "buffer view", index, "cannot be unpacked");
        }
        r->unpacked[index] = to;
    }
    *bytes = (gltf_bytes){r->unpacked[index], v->count * v->stride};
    return LOBE_RENDER_OK;
}

/* ---- Elements ------------------------------------------------------------------------------------ */

/* Elements of one layout in a row. */
typedef struct elements {
    const unsigned char *data; /* NULL: all are 0 */
    size_t stride;
    int component, channels, is_normalized;
} elements;

static size_t component_size(int component) {
    switch (component) {
    case INT8:
    case UINT8:
        return 1;
    case INT16:
    case UINT16:
        return 2;
    case UINT32:
    case FLOAT32:
        return 4;
    default:
        return 0;
    }
}

/* `count` elements from `offset` on in a view; a stride of 0: one after the other. */
static lobe_render_result find_elements(gltf_reader *r, int accessor, int view, size_t offset,
                                        size_t count, elements *e) {
    gltf_bytes bytes;
    lobe_render_result result = lobe_gltf_view_bytes(r, view, &bytes);
    if (result != LOBE_RENDER_OK) return result;
    const size_t size = component_size(e->component) * (size_t)e->channels;
    if (e->stride == 0) e->stride = size;
    if (e->stride < size) return refuse(r, "accessor", accessor, "has elements that overlap");
    /* offset + (count - 1) stride + size <= bytes.size, without overflow */
    if (count > 0 && (offset > bytes.size || size > bytes.size - offset ||
                      (bytes.size - offset - size) / e->stride < count - 1))
        return refuse(r, "accessor", accessor, "reaches beyond its buffer view");
    e->data = bytes.data + offset;
    return LOBE_RENDER_OK;
}

/* The elements of an accessor, without those that are sparse. */
static lobe_render_result find_accessor(gltf_reader *r, int index, elements *e) {
    if (index < 0 || (size_t)index >= r->model->accessor_count)
        return refuse(r, "accessor", index, "does not exist");
    const gltf_accessor *a = &r->model->accessors[index];
    *e = (elements){NULL, 0, a->component, a->channels, a->is_normalized};
    if (a->channels == 0 || component_size(a->component) == 0)
        return refuse(r, "accessor", index, "is of a type that cannot be used");
    if (a->view < 0) {
        if (a->count <= GLTF_EMPTY_COUNT_MAX) return LOBE_RENDER_OK;
        return refuse(r, "accessor", index, "has too many elements for one without a buffer view");
    }
    if ((size_t)a->view < r->model->view_count) e->stride = r->model->views[a->view].stride;
    return find_elements(r, index, a->view, a->offset, a->count, e);
}

/* The places and values that replace some elements of an accessor; each place is below its count. */
static lobe_render_result find_sparse(gltf_reader *r, int index, elements *places,
                                      elements *values) {
    const gltf_accessor *a = &r->model->accessors[index];
    *places = (elements){NULL, 0, a->index_component, 1, 0};
    *values = (elements){NULL, 0, a->component, a->channels, a->is_normalized};
    if (a->index_component != UINT8 && a->index_component != UINT16 && a->index_component != UINT32)
        return refuse(r, "accessor", index, "has sparse places of a type that cannot be used");
    if (a->sparse_count > a->count)
        return refuse(r, "accessor", index, "has more sparse elements than elements");
    lobe_render_result result =
        find_elements(r, index, a->index_view, a->index_offset, a->sparse_count, places);
    if (result == LOBE_RENDER_OK)
        result = find_elements(r, index, a->value_view, a->value_offset, a->sparse_count, values);
    return result;
}

static uint32_t integer_at(const elements *e, size_t i) {
    const unsigned char *from = e->data + i * e->stride;
    uint16_t half;
    uint32_t word;
    if (e->component == UINT8) return *from;
    if (e->component == UINT16) {
        memcpy(&half, from, sizeof half);
        return half;
    }
    memcpy(&word, from, sizeof word);
    return word;
}

/* Normalised integers as the specification says (3.11): signed ones from -1. */
static float number_at(const elements *e, size_t i, int channel) {
    const unsigned char *from = e->data + i * e->stride;
    float number;
    int16_t signed_half;
    uint16_t half;
    uint32_t word;
    switch (e->component) {
    case FLOAT32:
        memcpy(&number, from + 4 * channel, sizeof number);
        return number;
    case INT8:
        number = (float)(signed char)from[channel];
        return e->is_normalized ? fmaxf(number / 127.0f, -1.0f) : number;
    case UINT8:
        number = from[channel];
        return e->is_normalized ? number / 255.0f : number;
    case INT16:
        memcpy(&signed_half, from + 2 * channel, sizeof signed_half);
        return e->is_normalized ? fmaxf(signed_half / 32767.0f, -1.0f) : signed_half;
    case UINT16:
        memcpy(&half, from + 2 * channel, sizeof half);
        return e->is_normalized ? half / 65535.0f : half;
    default:
        memcpy(&word, from + 4 * channel, sizeof word);
        return (float)word;
    }
}

static void copy_floats(const elements *e, size_t i, int channels, float *to) {
    for (int c = 0; c < channels; c++)
        to[c] = c < e->channels && e->data ? number_at(e, i, c)
                : c == 3 && channels == 4  ? 1.0f
                                           : 0.0f;
}

lobe_render_result lobe_gltf_read_floats(gltf_reader *r, int accessor, int channels, float **values,
                                         size_t *count) {
    elements e, places, replaced;
    lobe_render_result result = find_accessor(r, accessor, &e);
    if (result != LOBE_RENDER_OK) return result;
    if ((e.channels == GLTF_MATRIX) != (channels == GLTF_MATRIX))
        return refuse(r, "accessor", accessor, "is of a type that cannot be used");
    const gltf_accessor *a = &r->model->accessors[accessor];
    if (a->is_sparse && (result = find_sparse(r, accessor, &places, &replaced)) != LOBE_RENDER_OK)
        return result;
    *count = a->count;
    *values = calloc(a->count + 1, (size_t)channels * sizeof **values);
    if (!*values) return lobe_fail_memory(r->path);
    for (size_t i = 0; i < a->count; i++)
        copy_floats(&e, i, channels, *values + i * (size_t)channels);
    for (size_t i = 0; a->is_sparse && i < a->sparse_count; i++) {
        const uint32_t place = integer_at(&places, i);
        if (place >= a->count)
            return refuse(r, "accessor", accessor, "has a sparse place that does not exist");
        copy_floats(&replaced, i, channels, *values + place * (size_t)channels);
    }
    return LOBE_RENDER_OK;
}

lobe_render_result lobe_gltf_read_indices(gltf_reader *r, int accessor, uint32_t **values,
                                          size_t *count) {
    elements e, places, replaced;
    lobe_render_result result = find_accessor(r, accessor, &e);
    if (result != LOBE_RENDER_OK) return result;
    const gltf_accessor *a = &r->model->accessors[accessor];
    if (e.channels != 1 || (e.component != UINT8 && e.component != UINT16 && e.component != UINT32))
        return refuse(r, "accessor", accessor, "is of a type that no index has");
    if (a->is_sparse && (result = find_sparse(r, accessor, &places, &replaced)) != LOBE_RENDER_OK)
        return result;
    *count = a->count;
    *values = calloc(a->count + 1, sizeof **values);
    if (!*values) return lobe_fail_memory(r->path);
    for (size_t i = 0; e.data && i < a->count; i++) (*values)[i] = integer_at(&e, i);
    for (size_t i = 0; a->is_sparse && i < a->sparse_count; i++) {
        const uint32_t place = integer_at(&places, i);
        if (place >= a->count)
            return refuse(r, "accessor", accessor, "has a sparse place that does not exist");
        (*values)[place] = integer_at(&replaced, i);
    }
    return LOBE_RENDER_OK;
}
