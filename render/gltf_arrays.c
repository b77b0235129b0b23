#include "gltf_arrays.h"

#include <stdlib.h>

#include "gltf_accessor.h"
#include "gltf_draco.h"
#include "message.h"

const int lobe_gltf_channels[GLTF_SEMANTICS] = {3, 3, 4, 4, 2, 2, 2, 2, 2, 2, 2, 2, 4, 4, 4, 4};

static int is_wanted(const int wanted[GLTF_SEMANTICS], int semantic) {
    return semantic == GLTF_POSITION || wanted[semantic];
}

static lobe_render_result read_accessors(gltf_reader *r, const gltf_primitive *p,
                                         const int wanted[GLTF_SEMANTICS], gltf_arrays *arrays) {
    lobe_render_result result = LOBE_RENDER_OK;
    for (int s = 0; s < GLTF_SEMANTICS && result == LOBE_RENDER_OK; s++) {
        size_t count = 0;
        if (p->accessors[s] < 0 || !is_wanted(wanted, s)) continue;
        result = lobe_gltf_read_floats(r, p->accessors[s], lobe_gltf_channels[s],
                                       &arrays->values[s], &count);
        if (s == GLTF_POSITION) arrays->vertex_count = count;
        if (result == LOBE_RENDER_OK && count != arrays->vertex_count)
            return lobe_fail(LOBE_RENDER_BAD_INPUT,
                             "%s: accessor %d has %zu elements for %zu positions; is it damaged?",
                             r->path, p->accessors[s], count, arrays->vertex_count);
    }
    if (result == LOBE_RENDER_OK && p->indices >= 0)
        result = lobe_gltf_read_indices(r, p->indices, &arrays->indices, &arrays->index_count);
    return result;
}

static lobe_render_result read_draco(gltf_reader *r, const gltf_primitive *p,
                                     const int wanted[GLTF_SEMANTICS], gltf_arrays *arrays) {
    gltf_bytes packed;
    lobe_render_result result = lobe_gltf_view_bytes(r, p->draco_view, &packed);
    if (result != LOBE_RENDER_OK) return result;
    int ids[GLTF_SEMANTICS];
    for (int s = 0; s < GLTF_SEMANTICS; s++) ids[s] = is_wanted(wanted, s) ? p->draco_ids[s] : -1;
    if (lobe_gltf_draco_decode(packed, ids, arrays)) return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: buffer view %d cannot be unpacked by Draco; is it damaged?", r->path,
                     p->draco_view);
}

static lobe_render_result check_indices(const gltf_reader *r, const gltf_arrays *arrays) {
    for (size_t i = 0; i < arrays->index_count; i++)
        if (arrays->indices[i] >= arrays->vertex_count)
            return lobe_fail(LOBE_RENDER_BAD_INPUT,
                             "%s: an index of %u among %zu vertices; is it damaged?", r->path,
                             arrays->indices[i], arrays->vertex_count);
    return LOBE_RENDER_OK;
}

lobe_render_result lobe_gltf_arrays_read(gltf_reader *r, const gltf_primitive *p,
                                         const int wanted[GLTF_SEMANTICS], gltf_arrays *arrays) {
    *arrays = (gltf_arrays){0};
    if (p->accessors[GLTF_POSITION] < 0 && p->draco_view < 0) return LOBE_RENDER_OK;
    lobe_render_result result = p->draco_view >= 0 ? read_draco(r, p, wanted, arrays)
                                                   : read_accessors(r, p, wanted, arrays);
    if (result == LOBE_RENDER_OK) result = check_indices(r, arrays);
    if (!arrays->values[GLTF_POSITION]) arrays->vertex_count = arrays->index_count = 0;
    if (!arrays->indices) arrays->index_count = arrays->vertex_count;
    return result;
}

void lobe_gltf_arrays_free(gltf_arrays *arrays) {
    for (int s = 0; s < GLTF_SEMANTICS; s++) free(arrays->values[s]);
    free(arrays->indices);
    *arrays = (gltf_arrays){0};
}
