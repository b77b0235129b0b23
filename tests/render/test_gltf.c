/* tests/render/test_gltf.c: every way in which glTF can say a thing shows the same picture, its
 * extensions show what they say, and files that point beyond themselves are refused. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "gltf_square.h"
#include "pictures.h"

#include <meshoptimizer.h>
#include <unistd.h>

static const char name[] = "render-gltf.glb";

enum { SIZE = 16, MIDDLE = SIZE / 2 };

typedef struct sight {
    float color[SIZE][SIZE][3], albedo[SIZE][SIZE][3], normal[SIZE][SIZE][3], depth[SIZE][SIZE];
    lobe_scene_info info;
} sight;

static sight look_deep(square_file f, uint32_t samples, int depth) {
    write_square_file(name, f);
    sight v;
    lobe_scene *scene = load(name);
    lobe_render_options o = small(SIZE, SIZE, samples);
    o.depth = depth;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_ALBEDO) | LOBE_AOV_BIT(LOBE_AOV_NORMAL) |
             LOBE_AOV_BIT(LOBE_AOV_DEPTH);
    lobe_film *film = render(scene, o, NULL);
    assert_true(lobe_film_copy_rgb(film, &v.color[0][0][0]));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_ALBEDO, &v.albedo[0][0][0]));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_NORMAL, &v.normal[0][0][0]));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_DEPTH, &v.depth[0][0]));
    v.info = lobe_scene_get_info(scene);
    lobe_film_free(film);
    lobe_scene_free(scene);
    return v;
}

static sight look(square_file f) {
    return look_deep(f, 4, 1);
}

static void assert_near(const float value[3], float r, float g, float b, float tolerance) {
    if (!(fabsf(value[0] - r) < tolerance && fabsf(value[1] - g) < tolerance &&
          fabsf(value[2] - b) < tolerance))
        fail_msg("(%g, %g, %g) is not (%g, %g, %g)", value[0], value[1], value[2], r, g, b);
}

/* The four texels: red, green above blue, white. */
static void assert_picture(const sight *v) {
    assert_near(v->albedo[3][3], 1, 0, 0, 0.01f);
    assert_near(v->albedo[3][12], 0, 1, 0, 0.01f);
    assert_near(v->albedo[12][3], 0, 0, 1, 0.01f);
    assert_near(v->albedo[12][12], 1, 1, 1, 0.01f);
}

static const char textured[] = "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}";

/* ---- Geometry ----------------------------------------------------------------------------------- */

static void assert_square(square_file f) {
    f.material = textured;
    const sight v = look(f);
    assert_int_equal(v.info.triangles, 2);
    assert_picture(&v);
    assert_near(v.normal[5][6], 0, 0, 1, 0.02f);
    assert_true(fabsf(v.depth[MIDDLE][MIDDLE] - 4) < 0.05f && v.depth[0][0] > 0);
}

static void accessors_of_every_form_agree(void **state) {
    (void)state;
    assert_square((square_file){0});
    assert_square((square_file){.attributes = "\"POSITION\":4,\"NORMAL\":6,\"TEXCOORD_0\":5",
                                .more = ",\"extensionsUsed\":[\"KHR_mesh_quantization\"],"
                                        "\"extensionsRequired\":[\"KHR_mesh_quantization\"]"});
    assert_square((square_file){.attributes = "\"POSITION\":11,\"NORMAL\":1,\"TEXCOORD_0\":2"});
    assert_square((square_file){.primitive = ",\"mode\":5,\"indices\":10"});
    assert_square((square_file){.primitive = ",\"mode\":6,\"indices\":9"});
    assert_square((square_file){.primitive = ",\"mode\":6"});
    assert_square((square_file){.attributes = "\"POSITION\":0,\"TEXCOORD_0\":2"});
}

static void sets_of_coordinates_are_chosen(void **state) {
    (void)state;
    assert_square((square_file){.attributes = "\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2"});
    const sight v = look((square_file){
        .attributes = "\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,\"TEXCOORD_5\":3",
        .material =
            "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,\"texCoord\":5}}}"});
    assert_near(v.albedo[3][3], 0, 0, 1, 0.01f);
    assert_near(v.albedo[12][12], 0, 1, 0, 0.01f);
}

static void draco_is_read(void **state) {
    (void)state;
    assert_square((square_file){
        .primitive =
            ",\"indices\":8,\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":14,"
            "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2}}}",
        .more = ",\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]"});
}

static void meshopt_is_read(void **state) {
    (void)state;
    unsigned char packed[512];
    const unsigned list[] = {0, 1, 2, 0, 2, 3};
    size_t ends[3];
    ends[0] =
        meshopt_encodeVertexBuffer(packed, sizeof packed, square_arrays.short_positions, 4, 8);
    ends[1] =
        ends[0] + meshopt_encodeIndexBuffer(packed + ends[0], sizeof packed - ends[0], list, 6);
    ends[2] =
        ends[1] + meshopt_encodeIndexSequence(packed + ends[1], sizeof packed - ends[1], list, 6);
    for (int sequence = 0; sequence < 2; ++sequence) {
        char views[1000];
        const size_t first = sizeof square_arrays, at = sequence ? ends[1] : ends[0];
        snprintf(views, sizeof views,
                 ",{\"buffer\":1,\"byteLength\":32,\"byteStride\":8,\"extensions\":{"
                 "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,"
                 "\"byteStride\":8,\"count\":4,\"mode\":\"ATTRIBUTES\"}}},"
                 "{\"buffer\":1,\"byteOffset\":32,\"byteLength\":12,\"extensions\":{"
                 "\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,"
                 "\"byteStride\":2,\"count\":6,\"mode\":\"%s\"}}}",
                 first, ends[0], first + at, ends[sequence + 1] - at,
                 sequence ? "INDICES" : "TRIANGLES");
        assert_square((square_file){
            .attributes = "\"POSITION\":12,\"NORMAL\":1,\"TEXCOORD_0\":2",
            .primitive = ",\"indices\":13",
            .views = views,
            .accessors =
                ",{\"bufferView\":15,\"componentType\":5122,\"normalized\":true,\"type\":\"VEC3\","
                "\"count\":4},"
                "{\"bufferView\":16,\"componentType\":5123,\"type\":\"SCALAR\",\"count\":6}",
            .buffers = ",{\"byteLength\":44,\"extensions\":{\"EXT_meshopt_compression\":{"
                       "\"fallback\":true}}}",
            .more =
                ",\"extensionsRequired\":[\"EXT_meshopt_compression\",\"KHR_mesh_quantization\"]",
            .binary = packed,
            .binary_size = ends[2]});
    }
}

/* One mesh twice, the second a mirror image: it shows its front, and its picture is turned round; the
 * tilt of its normal map to the right and up points left and up. */
static void instances_are_mirrored(void **state) {
    (void)state;
    const sight v = look((square_file){
        .children = "0,1",
        .nodes = "{\"children\":[2,3],\"matrix\":[0.4,0,0,0,0,0.4,0,0,0,0,0.4,0,0,0,0,1]},"
                 "{\"mesh\":0,\"translation\":[1,0,0]},"
                 "{\"mesh\":0,\"translation\":[-1,0,0],\"scale\":[-1,1,1]}",
        .material = "{\"normalTexture\":{\"index\":1},\"pbrMetallicRoughness\":{"
                    "\"baseColorTexture\":{\"index\":0}}}"});
    assert_int_equal(v.info.triangles, 4);
    assert_near(v.normal[MIDDLE - 1][11], 0.577f, 0.577f, 0.577f, 0.02f);
    assert_near(v.normal[MIDDLE - 1][4], -0.577f, 0.577f, 0.577f, 0.02f);
    assert_near(v.albedo[6][9], 1, 0, 0, 0.01f);
    assert_near(v.albedo[6][6], 1, 0, 0, 0.01f);
    assert_near(v.albedo[6][14], 0, 1, 0, 0.01f);
    assert_near(v.albedo[6][1], 0, 1, 0, 0.01f);
}

static void triangles_that_are_none_are_dropped(void **state) {
    (void)state;
    float positions[12];
    memcpy(positions, square_arrays.positions, sizeof positions);
    positions[10] = NAN;
    char views[200];
    snprintf(views, sizeof views, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":48}",
             sizeof square_arrays);
    const sight v = look((square_file){
        .attributes = "\"POSITION\":12",
        .views = views,
        .accessors = ",{\"bufferView\":15,\"componentType\":5126,\"type\":\"VEC3\",\"count\":4}",
        .binary = positions,
        .binary_size = sizeof positions});
    assert_int_equal(v.info.triangles, 1);
    assert_int_equal(v.info.dropped_triangles, 1);
}

/* ---- Textures ----------------------------------------------------------------------------------- */

static sight look_at_texture(const char *use) {
    char material[400];
    snprintf(material, sizeof material, "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{%s}}}",
             use);
    return look((square_file){.material = material});
}

static void textures_are_transformed(void **state) {
    (void)state;
    sight v = look_at_texture(
        "\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0,0.5]}}");
    assert_near(v.albedo[3][3], 0, 0, 1, 0.01f);
    assert_near(v.albedo[12][3], 1, 0, 0, 0.01f);
    /* a quarter turn about the upper left corner: (u, v) -> (v, -u), and the texture repeats */
    v = look_at_texture("\"index\":0,\"extensions\":{\"KHR_texture_transform\":{"
                        "\"rotation\":1.57079633}}");
    assert_near(v.albedo[3][3], 0, 0, 1, 0.01f);
    assert_near(v.albedo[3][12], 1, 0, 0, 0.01f);
    assert_near(v.albedo[12][3], 1, 1, 1, 0.01f);
    assert_near(v.albedo[12][12], 0, 1, 0, 0.01f);
}

/* Twice as large an area: the right half lies beyond the edge, and so does the lower one. */
static void edges_are_as_the_sampler_says(void **state) {
    (void)state;
    sight v = look_at_texture("\"index\":2,\"extensions\":{\"KHR_texture_transform\":{"
                              "\"scale\":[2,2]}}");
    assert_near(v.albedo[2][12], 0, 1, 0, 0.01f);  /* clamped */
    assert_near(v.albedo[9][12], 1, 1, 1, 0.01f);  /* mirrored: first the lower row again */
    assert_near(v.albedo[14][12], 0, 1, 0, 0.01f); /* then the upper one */
    v = look_at_texture("\"index\":0,\"extensions\":{\"KHR_texture_transform\":{\"scale\":[2,2]}}");
    assert_near(v.albedo[2][9], 1, 0, 0, 0.01f);
    assert_near(v.albedo[9][9], 1, 0, 0, 0.01f);
}

static void colors_of_vertices_multiply(void **state) {
    (void)state;
    const sight v = look((square_file){
        .attributes = "\"POSITION\":0,\"COLOR_0\":7",
        .material = "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.5,0.5,0.5,1]}}"});
    assert_near(v.albedo[MIDDLE][MIDDLE], 0.5f, 0.1f, 0, 0.001f);
}

/* ---- Light -------------------------------------------------------------------------------------- */

static void emission_has_its_strength(void **state) {
    (void)state;
    sight v =
        look((square_file){.material = "{\"emissiveFactor\":[0.5,0.25,0],"
                                       "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1]},"
                                       "\"extensions\":{\"KHR_materials_emissive_strength\":{"
                                       "\"emissiveStrength\":6}}}"});
    assert_int_equal(v.info.emissive_triangles, 2);
    v = look_deep((square_file){.material = "{\"emissiveFactor\":[0.5,0.25,0],\"extensions\":{"
                                            "\"KHR_materials_emissive_strength\":{"
                                            "\"emissiveStrength\":6}}}"},
                  4, 0);
    assert_near(v.color[MIDDLE][MIDDLE], 3, 1.5f, 0, 0.001f);
}

static void unlit_surfaces_show_their_color(void **state) {
    (void)state;
    const sight v = look(
        (square_file){.material = "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[0.25,0.5,1,1]},"
                                  "\"extensions\":{\"KHR_materials_unlit\":{}}}"});
    assert_near(v.color[MIDDLE][MIDDLE], 0.25f, 0.5f, 1, 0.0001f);
}

static const char second_mesh[] =
    ",{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":8,\"material\":1}]}";

/* In front of a red square at z = -1. */
static sight look_through(const char *alpha) {
    char material[600];
    snprintf(material, sizeof material,
             "{\"extensions\":{\"KHR_materials_unlit\":{}},%s},"
             "{\"extensions\":{\"KHR_materials_unlit\":{}},"
             "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0,1]}}",
             alpha);
    return look_deep((square_file){.material = material,
                                   .children = "0,1,2",
                                   .nodes = "{\"mesh\":0},{\"mesh\":1,\"translation\":[0,0,-1],"
                                            "\"scale\":[2,2,1]}",
                                   .meshes = second_mesh},
                     64, 1);
}

/* The red of the texture lets light through: all of it at the red and the white texel, none at the others. */
static void transmission_has_its_texture(void **state) {
    (void)state;
    const char material[] =
        "{\"pbrMetallicRoughness\":{\"roughnessFactor\":0,\"metallicFactor\":0},\"extensions\":{"
        "\"KHR_materials_transmission\":{\"transmissionFactor\":1,\"transmissionTexture\":{"
        "\"index\":0}},\"KHR_materials_ior\":{\"ior\":1}}},"
        "{\"extensions\":{\"KHR_materials_unlit\":{}},"
        "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0,1]}}";
    const sight v =
        look_deep((square_file){.material = material,
                                .children = "0,1,2",
                                .nodes = "{\"mesh\":0},{\"mesh\":1,\"translation\":[0,0,-1],"
                                         "\"scale\":[2,2,1]}",
                                .meshes = second_mesh},
                  16, 1);
    assert_near(v.color[3][3], 1, 0, 0, 0.001f);
    assert_near(v.color[12][12], 1, 0, 0, 0.001f);
    assert_true(v.color[3][12][1] > 0.05f && v.color[12][3][1] > 0.05f);
}

static void masks_cut_out(void **state) {
    (void)state;
    const sight v = look_through("\"alphaMode\":\"MASK\",\"pbrMetallicRoughness\":{"
                                 "\"baseColorTexture\":{\"index\":0}}");
    assert_near(v.color[3][3], 1, 0, 0, 0.001f);
    assert_true(fabsf(v.depth[8][3] - 5) < 0.1f && fabsf(v.depth[8][12] - 4) < 0.1f);
    assert_near(v.color[3][12], 0, 1, 0, 0.001f);
    assert_near(v.color[12][12], 1, 1, 1, 0.001f);
}

/* 64 samples a pixel, 256 pixels: the standard error of a share of 0.25 is 0.0034; 5 of them. */
static void blending_lets_a_share_through(void **state) {
    (void)state;
    const sight v = look_through("\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
                                 "\"baseColorFactor\":[1,1,1,0.25]}");
    double sum[3] = {0};
    for (int i = 0; i < SIZE * SIZE; ++i)
        for (int c = 0; c < 3; ++c) sum[c] += v.color[i / SIZE][i % SIZE][c] / (SIZE * SIZE);
    assert_true(fabs(sum[0] - 1) < 1e-6 && fabs(sum[1] - 0.25) < 0.017 && sum[1] == sum[2]);
}

/* A matte square in light from behind the camera; node 1 turns, node 2 is what stands in between. */
static sight look_in_light(const char *light, const char *nodes, const char *children,
                           const char *material) {
    char more[600];
    snprintf(more, sizeof more,
             ",\"extensionsUsed\":[\"KHR_lights_punctual\"],"
             "\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[%s]}}",
             light);
    return look_deep(
        (square_file){.nodes = nodes, .children = children, .more = more, .material = material}, 16,
        1);
}

static const char matte[] = "{\"pbrMetallicRoughness\":{\"metallicFactor\":0}}";

static void lamps_shine_as_they_say(void **state) {
    (void)state;
    const char *children = "0,1,2";
    const char near_by[] = "{\"mesh\":0},{\"translation\":[0,0,2],"
                           "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}";
    const char far_off[] = "{\"mesh\":0},{\"translation\":[0,0,20],"
                           "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}}";
    const char point[] = "{\"type\":\"point\",\"intensity\":4,\"color\":[1,0.5,0]}";
    const sight near = look_in_light(point, near_by, children, matte);
    const sight far = look_in_light(point, far_off, children, matte);
    const float *a = near.color[MIDDLE][MIDDLE], *b = far.color[MIDDLE][MIDDLE];
    assert_true(a[0] > 0.2f && a[0] < 0.4f && fabsf(a[1] / a[0] - 0.5f) < 1e-4f && a[2] == 0);
    assert_true(fabsf(a[0] / b[0] - 100) < 1.0f);
    /* the same irradiance of 1 from afar: a white dielectric reflects about 1/pi of it */
    const sight sun =
        look_in_light("{\"type\":\"directional\",\"intensity\":1}", far_off, children, matte);
    assert_true(fabsf(sun.color[MIDDLE][MIDDLE][0] / (100 * b[0]) - 1) < 0.01f);
    const sight spot = look_in_light("{\"type\":\"spot\",\"intensity\":4,\"spot\":{"
                                     "\"outerConeAngle\":0.2,\"innerConeAngle\":0.15}}",
                                     near_by, children, matte);
    assert_true(fabsf(spot.color[MIDDLE][MIDDLE][0] / a[0] - 1) < 0.01f);
    assert_near(spot.color[1][1], 0, 0, 0, 1e-6f);
    const sight range = look_in_light("{\"type\":\"point\",\"intensity\":4,\"range\":1.9}", near_by,
                                      children, matte);
    assert_near(range.color[MIDDLE][MIDDLE], 0, 0, 0, 1e-6f);
}

/* What lies between lets three quarters pass, at any number of samples. */
static void shadows_are_as_deep_as_the_opacity(void **state) {
    (void)state;
    const char nodes[] = "{\"mesh\":0},{\"rotation\":[-0.38268343,0,0,0.92387953],"
                         "\"extensions\":{\"KHR_lights_punctual\":{\"light\":0}}},"
                         "{\"mesh\":1,\"translation\":[0,8,8],\"scale\":[4,4,1]}";
    const char more[] = ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
                        "{\"type\":\"directional\",\"intensity\":1}]}}";
    char material[400];
    snprintf(material, sizeof material,
             "%s,{\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
             "\"baseColorFactor\":[1,1,1,0.25]}}",
             matte);
    square_file f = {.nodes = nodes,
                     .children = "0,1,2",
                     .material = material,
                     .meshes = second_mesh,
                     .more = more};
    const sight bright = look(f);
    f.children = "0,1,2,3";
    const sight dim = look(f);
    const float ratio = dim.color[MIDDLE][MIDDLE][0] / bright.color[MIDDLE][MIDDLE][0];
    assert_true(bright.color[MIDDLE][MIDDLE][0] > 0.1f && fabsf(ratio - 0.75f) < 1e-3f);
}

/* A metal that is rough along x reflects a lamp beside the camera in a streak along x; a quarter turn
 * in the tangent plane makes it one along y. */
static void anisotropy_stretches_the_highlight(void **state) {
    (void)state;
    static const char *const anisotropies[] = {
        "\"anisotropyStrength\":0.8",
        "\"anisotropyStrength\":0.8,\"anisotropyRotation\":1.57079633",
        "\"anisotropyStrength\":1,\"anisotropyTexture\":{\"index\":0}"};
    float ratio[3];
    for (int k = 0; k < 3; ++k) {
        char material[400];
        snprintf(material, sizeof material,
                 "{\"pbrMetallicRoughness\":{\"roughnessFactor\":0.3},\"extensions\":{"
                 "\"KHR_materials_anisotropy\":{%s}}}",
                 anisotropies[k]);
        const sight v = look_in_light("{\"type\":\"point\",\"intensity\":4}",
                                      "{\"mesh\":0},{\"translation\":[0,0,4],\"extensions\":{"
                                      "\"KHR_lights_punctual\":{\"light\":0}}}",
                                      "0,1,2", material);
        ratio[k] = v.color[MIDDLE][SIZE - 1][0] / v.color[0][MIDDLE][0];
    }
    assert_true(ratio[0] > 2 && fabsf(ratio[0] * ratio[1] - 1) < 0.1f);
}

/* ---- What is not read --------------------------------------------------------------------------- */

static void assert_refused_with(square_file f, const char *word) {
    write_square_file(name, f);
    lobe_scene *scene = NULL;
    if (lobe_scene_load(name, lobe_scene_default_options(), &scene) != LOBE_RENDER_BAD_INPUT)
        fail_msg("is not refused: %s", word);
    assert_null(scene);
    if (!strstr(lobe_render_error_message(), word))
        fail_msg("\"%s\" does not say %s", lobe_render_error_message(), word);
}

#define WITH_ACCESSOR(json) .attributes = "\"POSITION\":12", .accessors = "," json

static void what_reaches_beyond_is_refused(void **state) {
    (void)state;
    assert_refused_with((square_file){.attributes = "\"POSITION\":99"}, "accessor 99");
    assert_refused_with((square_file){.attributes = "\"POSITION\":0,\"NORMAL\":8"}, "6 elements");
    assert_refused_with((square_file){.nodes = "{\"mesh\":7}"}, "mesh 7");
    assert_refused_with((square_file){.children = "0,1,9"}, "node 9");
    assert_refused_with(
        (square_file){WITH_ACCESSOR(
            "{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":5}")},
        "beyond its buffer view");
    assert_refused_with(
        (square_file){WITH_ACCESSOR("{\"bufferView\":0,\"componentType\":5126,"
                                    "\"type\":\"VEC3\",\"count\":4,\"byteOffset\":4}")},
        "beyond its buffer view");
    /* count * stride overflows to 0 */
    assert_refused_with(
        (square_file){WITH_ACCESSOR("{\"bufferView\":4,\"componentType\":5122,\"type\":\"VEC3\","
                                    "\"count\":2305843009213693952}")},
        "beyond its buffer view");
    assert_refused_with((square_file){WITH_ACCESSOR("{\"componentType\":5126,\"type\":\"VEC3\","
                                                    "\"count\":4000000000}")},
                        "too many elements");
    assert_refused_with((square_file){WITH_ACCESSOR("{\"bufferView\":0,\"componentType\":5126,"
                                                    "\"type\":\"MAT2\",\"count\":1}")},
                        "of a type");
    assert_refused_with((square_file){WITH_ACCESSOR("{\"componentType\":5126,\"type\":\"MAT4\","
                                                    "\"count\":4}")},
                        "of a type");
    assert_refused_with((square_file){.primitive = ",\"indices\":12",
                                      .accessors = ",{\"bufferView\":9,\"byteOffset\":2,"
                                                   "\"componentType\":5121,\"type\":\"SCALAR\","
                                                   "\"count\":6}",
                                      .attributes = "\"POSITION\":13,\"NORMAL\":14",
                                      .views = ""},
                        "accessor 13");
    assert_refused_with((square_file){.primitive = ",\"mode\":5,\"indices\":12",
                                      .accessors = ",{\"bufferView\":14,\"componentType\":5121,"
                                                   "\"type\":\"SCALAR\",\"count\":9}"},
                        "an index of 68 among 4");
    assert_refused_with((square_file){WITH_ACCESSOR(
                            "{\"componentType\":5126,\"type\":\"VEC3\",\"count\":3,\"sparse\":{"
                            "\"count\":3,\"indices\":{\"bufferView\":9,\"byteOffset\":2,"
                            "\"componentType\":5123},\"values\":{\"bufferView\":0}}}")},
                        "sparse place");
    assert_refused_with(
        (square_file){.primitive = ",\"indices\":13",
                      .views = ",{\"buffer\":0,\"byteLength\":40,\"byteOffset\":9999}",
                      .accessors = ",{},{\"bufferView\":15,\"componentType\":5123,"
                                   "\"type\":\"SCALAR\",\"count\":6}"},
        ": ");
    assert_refused_with(
        (square_file){.attributes = "\"POSITION\":12",
                      .views = ",{\"buffer\":0,\"byteLength\":48,\"byteOffset\":9999}",
                      .accessors = ",{\"bufferView\":15,\"componentType\":5126,"
                                   "\"type\":\"VEC3\",\"count\":4}"},
        "beyond its buffer");
}

static void damaged_packing_is_refused(void **state) {
    (void)state;
    assert_refused_with((square_file){.primitive =
                                          ",\"extensions\":{\"KHR_draco_mesh_compression\":{"
                                          "\"bufferView\":0,\"attributes\":{"
                                          "\"POSITION\":0}}}"},
                        "Draco");
    assert_refused_with((square_file){.primitive =
                                          ",\"extensions\":{\"KHR_draco_mesh_compression\":{"
                                          "\"bufferView\":14,\"attributes\":{"
                                          "\"POSITION\":9}}}"},
                        "Draco");
    static const char *const packings[] = {
        "\"byteStride\":8,\"count\":4,\"mode\":\"ATTRIBUTES\"",
        "\"byteStride\":6,\"count\":4,\"mode\":\"ATTRIBUTES\"",
        "\"byteStride\":2,\"count\":5,\"mode\":\"TRIANGLES\"",
        "\"byteStride\":4,\"count\":4,\"mode\":\"ATTRIBUTES\",\"filter\":\"QUATERNION\"",
        "\"byteStride\":256,\"count\":99999999,\"mode\":\"ATTRIBUTES\""};
    for (size_t i = 0; i < sizeof packings / sizeof *packings; ++i) {
        char views[300];
        snprintf(views, sizeof views,
                 ",{\"buffer\":0,\"byteLength\":48,\"extensions\":{\"EXT_meshopt_compression\":{"
                 "\"buffer\":0,\"byteLength\":100,%s}}}",
                 packings[i]);
        assert_refused_with((square_file){.attributes = "\"POSITION\":12",
                                          .views = views,
                                          .accessors = ",{\"bufferView\":15,\"componentType\":5126,"
                                                       "\"type\":\"VEC3\",\"count\":4}"},
                            "packed");
    }
}

static void truncated_files_are_refused(void **state) {
    (void)state;
    const square_file f = {0};
    size_t size;
    unsigned char *glb = make_square(&f, &size);
    for (size_t end = 0; end < size; end += 97) {
        write_bytes(name, glb, end);
        lobe_scene *scene = NULL;
        assert_int_equal(lobe_scene_load(name, lobe_scene_default_options(), &scene),
                         LOBE_RENDER_BAD_INPUT);
    }
    free(glb);
    assert_refused_with((square_file){.more = ",\"extensionsRequired\":[\"KHR_materials_sheen\"]"},
                        "KHR_materials_sheen");
}

static void count_warning(void *user, const char *message) {
    (void)message;
    ++*(int *)user;
}

/* What is ignored is named once, and fails a strict reading. */
static void ignored_features_are_named(void **state) {
    (void)state;
    static const square_file files[] = {
        {.more = ",\"extensionsUsed\":[\"KHR_materials_sheen\",\"KHR_materials_unlit\"]"},
        {.more = ",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":"
                 "\"scale\"}}],\"samplers\":[{\"input\":0,\"output\":0}]}]"},
        {.attributes = "\"POSITION\":0,\"COLOR_1\":7"},
        {.primitive = ",\"indices\":8,\"targets\":[{\"TEXCOORD_0\":2}]"},
        {.primitive = ",\"indices\":8},{\"mode\":1,\"attributes\":{\"POSITION\":0}"},
        {.children = "0,1,1"},
        {.material = "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":7}}}"},
        {.material = "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":3}}}",
         .textures = ",{\"source\":2}",
         .images = ",{\"uri\":\"no+such%20picture.png\"}"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i) {
        int warnings = 0;
        lobe_scene *scene = NULL;
        lobe_scene_options o = lobe_scene_default_options();
        o.warning = count_warning;
        o.warning_user = &warnings;
        write_square_file(name, files[i]);
        if (lobe_scene_load(name, o, &scene) != LOBE_RENDER_OK)
            fail_msg("%zu: %s", i, lobe_render_error_message());
        assert_int_equal(warnings, 1);
        lobe_scene_free(scene);
        o.strict = 1;
        assert_int_equal(lobe_scene_load(name, o, &scene), LOBE_RENDER_BAD_INPUT);
    }
}

static int remove_file(void **state) {
    (void)state;
    unlink(name);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(accessors_of_every_form_agree),
        cmocka_unit_test(sets_of_coordinates_are_chosen),
        cmocka_unit_test(draco_is_read),
        cmocka_unit_test(meshopt_is_read),
        cmocka_unit_test(instances_are_mirrored),
        cmocka_unit_test(triangles_that_are_none_are_dropped),
        cmocka_unit_test(textures_are_transformed),
        cmocka_unit_test(edges_are_as_the_sampler_says),
        cmocka_unit_test(colors_of_vertices_multiply),
        cmocka_unit_test(emission_has_its_strength),
        cmocka_unit_test(unlit_surfaces_show_their_color),
        cmocka_unit_test(transmission_has_its_texture),
        cmocka_unit_test(masks_cut_out),
        cmocka_unit_test(blending_lets_a_share_through),
        cmocka_unit_test(lamps_shine_as_they_say),
        cmocka_unit_test(shadows_are_as_deep_as_the_opacity),
        cmocka_unit_test(anisotropy_stretches_the_highlight),
        cmocka_unit_test(what_reaches_beyond_is_refused),
        cmocka_unit_test(damaged_packing_is_refused),
        cmocka_unit_test(truncated_files_are_refused),
        cmocka_unit_test(ignored_features_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, remove_file);
}
