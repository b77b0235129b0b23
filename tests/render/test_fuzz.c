/* tests/render/test_fuzz.c: damaged .glb files are refused in one line or shown; nothing else. More
 * rounds, other seeds: render.fuzz ROUNDS SEED. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "gltf_square.h"
#include "pictures.h"

#include <lobe/random.h>
#include <meshoptimizer.h>
#include <unistd.h>

static const char name[] = "render-fuzz.glb";

static unsigned long rounds = 300, seed = 1;

/* A stream of words. */
typedef struct stream {
    uint64_t index;
} stream;

static uint32_t draw(stream *s, uint32_t below) {
    return (uint32_t)(((uint64_t)lobe_random(seed, 77, s->index++).word[0] * below) >> 32);
}

/* Numbers, words and punctuation that turn one valid file into another or into nonsense. */
static const char *const pieces[] = {"-1",
                                     "0",
                                     "1",
                                     "99",
                                     "4294967295",
                                     "4294967296",
                                     "1e30",
                                     "2.5",
                                     "null",
                                     "[]",
                                     "{}",
                                     "\"\"",
                                     "true",
                                     "5120",
                                     "5121",
                                     "5126",
                                     "\"VEC3\"",
                                     "\"SCALAR\"",
                                     "\"uri\"",
                                     ",",
                                     "]",
                                     "}",
                                     "18446744073709551615",
                                     "9223372036854775807"};

/* Replace the number or word at a place by a piece of the same or another length. */
static size_t replace(stream *s, char *text, size_t size, size_t room) {
    size_t at = draw(s, (uint32_t)size), end;
    while (at > 0 && !strchr(",:[{", text[at - 1])) --at;
    for (end = at; end < size && !strchr(",:]}", text[end]);) ++end;
    const char *piece = pieces[draw(s, sizeof pieces / sizeof *pieces)];
    const size_t length = strlen(piece);
    if (size - (end - at) + length > room) return size;
    memmove(text + at + length, text + end, size - end);
    memcpy(text + at, piece, length);
    return size - (end - at) + length;
}

/* The JSON with some values replaced, in a file whose header is right again. */
static unsigned char *damage_json(stream *s, const unsigned char *glb, size_t *size) {
    size_t json = glb[12] | (size_t)glb[13] << 8;
    const size_t binary = *size - 20 - json, room = json + 200;
    unsigned char *bad = calloc(1, 24 + room + binary);
    memcpy(bad, glb, 20 + json);
    for (uint32_t n = 1 + draw(s, 3); n > 0; --n) json = replace(s, (char *)bad + 20, json, room);
    while (json % 4) bad[20 + json++] = ' ';
    put_word(bad + 12, json);
    memcpy(bad + 20 + json, glb + *size - binary, binary);
    *size = 20 + json + binary;
    put_word(bad + 8, *size);
    return bad;
}

/* Some bytes replaced, most of them in the arrays; or the end cut off. */
static unsigned char *damage_bytes(stream *s, const unsigned char *glb, size_t *size) {
    const size_t start = 20 + (glb[12] | (size_t)glb[13] << 8);
    unsigned char *bad = malloc(*size);
    memcpy(bad, glb, *size);
    for (uint32_t n = 1 + draw(s, 12); n > 0; --n) {
        const size_t first = draw(s, 8) ? start : 0;
        bad[first + draw(s, (uint32_t)(*size - first))] = (unsigned char)draw(s, 256);
    }
    if (draw(s, 8) == 0) *size = draw(s, (uint32_t)*size);
    return bad;
}

/* Times from 0 to 1, joints 0 and 1, weights, matrices: all at once. */
static const float moving[32] = {0, 1, 1, 0, 1, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1,
                                 1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 1, 0, 1};

/* One file for each way in which arrays are stored, and one for all that moves. */
static unsigned char *make_seed(uint32_t which, size_t *size) {
    static const char material[] =
        "{\"alphaMode\":\"BLEND\",\"normalTexture\":{\"index\":1},\"emissiveFactor\":[1,1,1],"
        "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2,\"texCoord\":1,\"extensions\":"
        "{"
        "\"KHR_texture_transform\":{\"offset\":[0.5,0.5],\"rotation\":0.1,\"scale\":[2,2]}}},"
        "\"baseColorFactor\":[1,0.5,1,0.5],\"metallicFactor\":0.5,\"roughnessFactor\":0.5},"
        "\"extensions\":{\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0.5,"
        "\"anisotropyTexture\":{\"index\":1}},\"KHR_materials_transmission\":{"
        "\"transmissionFactor\":0.5,\"transmissionTexture\":{\"index\":2}},"
        "\"KHR_materials_ior\":{\"ior\":1.3},\"KHR_materials_volume\":{\"thicknessFactor\":1,"
        "\"attenuationDistance\":0.5,\"attenuationColor\":[0.5,1,0.1]}}}";
    static const char nodes[] =
        "{\"mesh\":0,\"children\":[2,3],\"scale\":[1,-1,1]},{\"mesh\":0,\"rotation\":[0,1,0,0],"
        "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},{\"mesh\":0}";
    static const char lights[] =
        ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"spot\",\"intensity\":4,"
        "\"spot\":{\"outerConeAngle\":0.5}}]}}";
    unsigned char packed[512];
    char views[600];
    square_file f = {.material = material, .nodes = nodes, .more = lights};
    if (which == 1)
        f.attributes =
            "\"POSITION\":4,\"NORMAL\":6,\"TEXCOORD_0\":5,\"TEXCOORD_1\":3,\"COLOR_0\":7";
    if (which == 2) {
        f.attributes = "\"POSITION\":11,\"TEXCOORD_1\":2";
        f.primitive = ",\"mode\":5,\"indices\":10},{\"mode\":6,\"attributes\":{\"POSITION\":0}";
    }
    if (which == 3)
        f.primitive = ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":14,"
                      "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2}}}";
    if (which == 4) {
        const unsigned list[] = {0, 1, 2, 0, 2, 3};
        const size_t first = sizeof square_arrays;
        const size_t n =
            meshopt_encodeVertexBuffer(packed, sizeof packed, square_arrays.short_positions, 4, 8);
        f.binary = packed;
        f.binary_size = n + meshopt_encodeIndexBuffer(packed + n, sizeof packed - n, list, 6);
        snprintf(
            views, sizeof views,
            ",{\"buffer\":1,\"byteLength\":32,\"byteStride\":8,\"extensions\":{"
            "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,"
            "\"byteStride\":8,\"count\":4,\"mode\":\"ATTRIBUTES\",\"filter\":\"OCTAHEDRAL\"}}},"
            "{\"buffer\":1,\"byteOffset\":32,\"byteLength\":12,\"extensions\":{"
            "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,"
            "\"byteStride\":2,\"count\":6,\"mode\":\"TRIANGLES\"}}}",
            first, n, first + n, f.binary_size - n);
        f.attributes = "\"POSITION\":12";
        f.primitive = ",\"indices\":13";
        f.views = views;
        f.accessors = ",{\"bufferView\":15,\"componentType\":5122,\"type\":\"VEC3\",\"count\":4},"
                      "{\"bufferView\":16,\"componentType\":5123,\"type\":\"SCALAR\",\"count\":6}";
        f.buffers = ",{\"byteLength\":44,\"extensions\":{\"EXT_meshopt_compression\":{"
                    "\"fallback\":true}}}";
    }
    if (which == 5) {
        memcpy(packed, moving, sizeof moving);
        f.binary = packed;
        f.binary_size = sizeof moving;
        snprintf(views, sizeof views, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
                 sizeof square_arrays, sizeof moving);
        f.views = views;
        f.accessors = ",{\"bufferView\":15,\"componentType\":5126,\"type\":\"SCALAR\",\"count\":2},"
                      "{\"bufferView\":15,\"componentType\":5126,\"type\":\"VEC3\",\"count\":2},"
                      "{\"bufferView\":15,\"componentType\":5126,\"type\":\"VEC4\",\"count\":6},"
                      "{\"bufferView\":15,\"componentType\":5126,\"type\":\"MAT4\",\"count\":2},"
                      "{\"bufferView\":15,\"componentType\":5126,\"type\":\"VEC4\",\"count\":4}";
        f.attributes = "\"POSITION\":0,\"NORMAL\":1,\"JOINTS_0\":16,\"WEIGHTS_0\":16";
        f.primitive = ",\"indices\":8,\"targets\":[{\"POSITION\":1,\"NORMAL\":0}]";
        f.nodes =
            "{\"mesh\":0,\"skin\":0},{\"mesh\":0,\"weights\":[0.5]},{\"mesh\":0,\"extensions\":"
            "{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":13}}}}";
        f.children = "0,1,2,3";
        f.more = ",\"skins\":[{\"joints\":[2,1],\"inverseBindMatrices\":15}],\"animations\":[{"
                 "\"channels\":[{\"sampler\":0,\"target\":{\"node\":2,\"path\":\"scale\"}},"
                 "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"rotation\"}},"
                 "{\"sampler\":2,\"target\":{\"node\":2,\"path\":\"weights\"}}],\"samplers\":["
                 "{\"input\":12,\"output\":13},{\"input\":12,\"output\":14,\"interpolation\":"
                 "\"CUBICSPLINE\"},{\"input\":12,\"output\":12,\"interpolation\":\"STEP\"}]}]";
    }
    return make_square(&f, size);
}

enum { SEEDS_OF_FILES = 6 };

/* Nonzero if the file is shown. */
static int try_file(unsigned long round) {
    lobe_scene *scene = NULL;
    lobe_scene_options so = lobe_scene_default_options();
    so.frame_time = 0.25;
    const lobe_render_result result = lobe_scene_load(name, so, &scene);
    if (result != LOBE_RENDER_OK) {
        const char *message = lobe_render_error_message();
        if (scene || result != LOBE_RENDER_BAD_INPUT || strlen(message) < 10 ||
            strchr(message, '\n') || !strstr(message, ": "))
            fail_msg("round %lu: result %d, \"%s\"", round, (int)result, message);
        return 0;
    }
    lobe_render_options o = small(4, 4, 1);
    o.threads = 1;
    lobe_film_free(render(scene, o, NULL));
    lobe_scene_free(scene);
    return 1;
}

static void damaged_files_do_no_damage(void **state) {
    (void)state;
    unsigned long shown = 0;
    stream s = {0};
    for (unsigned long round = 0; round < rounds; ++round) {
        size_t size;
        unsigned char *good = make_seed(draw(&s, SEEDS_OF_FILES), &size);
        unsigned char *bad =
            draw(&s, 2) ? damage_json(&s, good, &size) : damage_bytes(&s, good, &size);
        write_bytes(name, bad, size);
        free(good);
        free(bad);
        shown += (unsigned long)try_file(round);
    }
    print_message("%lu files, %lu of them shown\n", rounds, shown);
    assert_true(shown > rounds / 20 && shown < rounds);
}

static void good_files_are_shown(void **state) {
    (void)state;
    for (uint32_t k = 0; k < SEEDS_OF_FILES; ++k) {
        size_t size;
        unsigned char *good = make_seed(k, &size);
        write_bytes(name, good, size);
        free(good);
        if (!try_file(k)) fail_msg("%u: %s", k, lobe_render_error_message());
    }
}

static int remove_file(void **state) {
    (void)state;
    unlink(name);
    return 0;
}

int main(int count, char **arguments) {
    if (count > 1) rounds = strtoul(arguments[1], NULL, 10);
    if (count > 2) seed = strtoul(arguments[2], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_files_are_shown),
        cmocka_unit_test(damaged_files_do_no_damage),
    };
    return cmocka_run_group_tests(tests, NULL, remove_file);
}
