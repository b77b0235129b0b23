/* tests/render/test_instances.c: a mesh that is in memory once and placed often shows what its copies show. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "gltf_square.h"
#include "pictures.h"

#include <unistd.h>

static const char name[] = "render-instances.glb";

/* A wavy sheet that faces the camera: enough triangles that copies of it are not made. */
enum { STEPS = 80, ROW = STEPS + 1, CORNERS = ROW * ROW, TRIANGLES = 2 * STEPS * STEPS, SIZE = 48 };

static struct sheet {
    float positions[CORNERS][3], normals[CORNERS][3], uv[CORNERS][2];
    uint32_t list[TRIANGLES][3];
    float moves[3][3], turns[3][4], scales[3][3]; /* of EXT_mesh_gpu_instancing */
} sheet;

static int make_sheet(void **state) {
    (void)state;
    for (int i = 0; i < CORNERS; ++i) {
        const float u = (float)(i % ROW) / STEPS, v = (float)(i / ROW) / STEPS;
        const float x = 2 * u - 1, y = 2 * v - 1, wave = 0.1f * sinf(9 * x) * cosf(5 * y);
        const float along = 0.9f * cosf(9 * x) * cosf(5 * y),
                    up = -0.5f * sinf(9 * x) * sinf(5 * y);
        const float length = sqrtf(1 + along * along + up * up);
        memcpy(sheet.positions[i], (float[]){x, y, wave}, sizeof sheet.positions[i]);
        memcpy(sheet.normals[i], (float[]){-along / length, -up / length, 1 / length},
               sizeof sheet.normals[i]);
        memcpy(sheet.uv[i], (float[]){u, 1 - v}, sizeof sheet.uv[i]);
    }
    for (uint32_t i = 0; i < TRIANGLES; ++i) {
        const uint32_t a = i / 2 / STEPS * ROW + i / 2 % STEPS;
        const uint32_t corners[2][3] = {{a, a + 1, a + ROW + 1}, {a, a + ROW + 1, a + ROW}};
        memcpy(sheet.list[i], corners[i % 2], sizeof corners[0]);
    }
    /* beside each other; the second a mirror image, the third turned round and flatter */
    const float moves[3][3] = {{-0.5f, 0.25f, 0}, {0.5f, 0.25f, 0}, {0, -0.5f, 0}};
    const float turns[3][4] = {{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 1, 0, 0}};
    const float scales[3][3] = {
        {0.25f, 0.25f, 0.25f}, {-0.25f, 0.25f, 0.25f}, {0.5f, 0.125f, 0.25f}};
    memcpy(sheet.moves, moves, sizeof moves);
    memcpy(sheet.turns, turns, sizeof turns);
    memcpy(sheet.scales, scales, sizeof scales);
    return 0;
}

static const char by_nodes[] =
    "{\"mesh\":1,\"translation\":[-0.5,0.25,0],\"scale\":[0.25,0.25,0.25]},"
    "{\"mesh\":%d,\"translation\":[0.5,0.25,0],\"scale\":[-0.25,0.25,0.25]},"
    "{\"mesh\":%d,\"translation\":[0,-0.5,0],\"rotation\":[0,1,0,0],\"scale\":[0.5,0.125,0.25]}";

#define SHEET                                                                                      \
    "{\"attributes\":{\"POSITION\":12,\"NORMAL\":13,\"TEXCOORD_0\":14},\"indices\":15,"            \
    "\"material\":0}"

/* `primitive`: after that of the sheet. */
static void write_sheet(const char *nodes, const char *children, const char *primitive,
                        const char *materials) {
    const size_t start = sizeof square_arrays;
    char views[1000], accessors[1500], meshes[1000];
#define VIEW(member) start + offsetof(struct sheet, member), sizeof sheet.member
    snprintf(views, sizeof views,
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}"
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}"
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}"
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}"
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}"
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}"
             ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
             VIEW(positions), VIEW(normals), VIEW(uv), VIEW(list), VIEW(moves), VIEW(turns),
             VIEW(scales));
#undef VIEW
    snprintf(accessors, sizeof accessors,
             ",{\"bufferView\":15,\"componentType\":5126,\"type\":\"VEC3\",\"count\":%d}"
             ",{\"bufferView\":16,\"componentType\":5126,\"type\":\"VEC3\",\"count\":%d}"
             ",{\"bufferView\":17,\"componentType\":5126,\"type\":\"VEC2\",\"count\":%d}"
             ",{\"bufferView\":18,\"componentType\":5125,\"type\":\"SCALAR\",\"count\":%d}"
             ",{\"bufferView\":19,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}"
             ",{\"bufferView\":20,\"componentType\":5126,\"type\":\"VEC4\",\"count\":3}"
             ",{\"bufferView\":21,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}",
             CORNERS, CORNERS, CORNERS, 3 * TRIANGLES);
    snprintf(meshes, sizeof meshes,
             ",{\"primitives\":[" SHEET "%s]},{\"primitives\":[" SHEET "]},{\"primitives\":[" SHEET
             "]}",
             primitive);
    write_square_file(name, (square_file){.nodes = nodes,
                                          .children = children,
                                          .material = materials,
                                          .views = views,
                                          .accessors = accessors,
                                          .meshes = meshes,
                                          .binary = &sheet,
                                          .binary_size = sizeof sheet});
}

static const char bumpy[] = "{\"normalTexture\":{\"index\":1},\"pbrMetallicRoughness\":{"
                            "\"baseColorTexture\":{\"index\":0},\"metallicFactor\":0.5,"
                            "\"roughnessFactor\":0.3}}";

/* Three sheets: of mesh 1, and of meshes `second` and `third`. */
static void write_three(int second, int third) {
    char nodes[600];
    snprintf(nodes, sizeof nodes, by_nodes, second, third);
    write_sheet(nodes, "0,1,2,3", "", bumpy);
}

typedef struct sight {
    float color[SIZE][SIZE][3], albedo[SIZE][SIZE][3], normal[SIZE][SIZE][3], depth[SIZE][SIZE];
    lobe_scene_info info;
} sight;

static void look(sight *v, int threads) {
    lobe_scene *scene = load(name);
    lobe_render_options o = small(SIZE, SIZE, 16);
    o.depth = 3;
    o.threads = threads;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_ALBEDO) | LOBE_AOV_BIT(LOBE_AOV_NORMAL) |
             LOBE_AOV_BIT(LOBE_AOV_DEPTH);
    lobe_film *film = render(scene, o, NULL);
    memset(v, 0, sizeof *v);
    assert_true(lobe_film_copy_rgb(film, &v->color[0][0][0]));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_ALBEDO, &v->albedo[0][0][0]));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_NORMAL, &v->normal[0][0][0]));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_DEPTH, &v->depth[0][0]));
    v->info = lobe_scene_get_info(scene);
    lobe_film_free(film);
    lobe_scene_free(scene);
}

/* How many values differ by more than rounding makes them: a ray at an edge may fall to either side. */
static int count_differences(const float *a, const float *b, int count, float tolerance) {
    int differences = 0;
    for (int i = 0; i < count; ++i) differences += !(fabsf(a[i] - b[i]) <= tolerance);
    return differences;
}

static sight copies, instances, again;

/* The same samples of the same geometry: all but a few pixels agree. */
static void instances_look_like_copies(void **state) {
    (void)state;
    write_three(2, 3);
    look(&copies, 0);
    write_three(1, 1);
    look(&instances, 0);
    assert_int_equal(copies.info.instances, 0);
    assert_int_equal(copies.info.triangles, 3 * TRIANGLES);
    assert_int_equal(instances.info.instances, 3);
    assert_int_equal(instances.info.triangles, TRIANGLES);
    assert_int_equal(instances.info.placed_triangles, 3 * TRIANGLES);
    int seen = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) seen += copies.depth[i / SIZE][i % SIZE] > 0;
    assert_true(seen > SIZE * SIZE / 3);
    const int few = SIZE * SIZE / 100;
    assert_true(count_differences(&copies.depth[0][0], &instances.depth[0][0], SIZE * SIZE, 1e-3f) <
                few);
    assert_true(count_differences(&copies.normal[0][0][0], &instances.normal[0][0][0],
                                  3 * SIZE * SIZE, 2e-3f) < few);
    assert_true(count_differences(&copies.albedo[0][0][0], &instances.albedo[0][0][0],
                                  3 * SIZE * SIZE, 2e-3f) < few);
    assert_true(count_differences(&copies.color[0][0][0], &instances.color[0][0][0],
                                  3 * SIZE * SIZE, 0.01f) < 6 * few);
}

static void nodes_and_attributes_agree(void **state) {
    (void)state;
    write_sheet("{\"mesh\":1,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
                "\"TRANSLATION\":16,\"ROTATION\":17,\"SCALE\":18}}}}",
                "0,1", "", bumpy);
    look(&again, 0);
    assert_int_equal(again.info.instances, 3);
    assert_memory_equal(again.color, instances.color, sizeof again.color);
    assert_memory_equal(again.depth, instances.depth, sizeof again.depth);
}

static void threads_do_not_matter(void **state) {
    (void)state;
    write_three(1, 1);
    look(&again, 1);
    assert_memory_equal(again.color, instances.color, sizeof again.color);
    look(&again, 3);
    assert_memory_equal(again.color, instances.color, sizeof again.color);
}

static lobe_scene_info info_of(const char *nodes, const char *children, const char *primitive,
                               const char *materials) {
    write_sheet(nodes, children, primitive, materials);
    lobe_scene *scene = load(name);
    const lobe_scene_info info = lobe_scene_get_info(scene);
    lobe_scene_free(scene);
    return info;
}

/* Lights are drawn in the world: the two triangles that shine are there twice. */
static void lights_are_copied(void **state) {
    (void)state;
    const lobe_scene_info info =
        info_of("{\"mesh\":1},{\"mesh\":1,\"translation\":[0,0,-1]}", "0,1,2",
                ",{\"attributes\":{\"POSITION\":0},\"indices\":8,\"material\":1}",
                "{},{\"emissiveFactor\":[1,1,1]}");
    assert_int_equal(info.instances, 2);
    assert_int_equal(info.emissive_triangles, 4);
    assert_int_equal(info.triangles, TRIANGLES + 4);
    assert_int_equal(info.placed_triangles, 2 * TRIANGLES + 4);
}

/* What is squashed has no inverse: its triangles are made. */
static void flat_places_are_copied(void **state) {
    (void)state;
    const lobe_scene_info info = info_of(
        "{\"mesh\":1},{\"mesh\":1,\"translation\":[0,0,-1],\"scale\":[1,1,0]}", "0,1,2", "", "{}");
    assert_int_equal(info.instances, 1);
    assert_int_equal(info.triangles, 2 * TRIANGLES);
    assert_int_equal(info.dropped_triangles, 0);
}

static lobe_render_result resume_of(const char *nodes, const char *checkpoint, const char *resume) {
    write_sheet(nodes, "0,1,2", "", "{}");
    lobe_scene *scene = load(name);
    lobe_render_options o = small(16, 16, 1);
    lobe_film *film = NULL;
    o.checkpoint = checkpoint;
    o.resume = resume;
    const lobe_render_result result = lobe_render(scene, o, &film, NULL);
    lobe_film_free(film);
    lobe_scene_free(scene);
    return result;
}

static void checkpoints_know_places(void **state) {
    (void)state;
    static const char kept[] = "render-instances.checkpoint";
    static const char nodes[] = "{\"mesh\":1},{\"mesh\":1,\"translation\":[0,0,-1]}",
                      moved[] = "{\"mesh\":1},{\"mesh\":1,\"translation\":[0,0,-2]}";
    assert_int_equal(resume_of(nodes, kept, NULL), LOBE_RENDER_OK);
    assert_int_equal(resume_of(nodes, NULL, kept), LOBE_RENDER_OK);
    assert_int_equal(resume_of(moved, NULL, kept), LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "its instances"));
    unlink(kept);
}

static void counts_have_to_agree(void **state) {
    (void)state;
    lobe_scene *scene = NULL;
    write_sheet("{\"mesh\":1,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
                "\"TRANSLATION\":16,\"ROTATION\":7}}}}",
                "0,1", "", bumpy);
    assert_int_equal(lobe_scene_load(name, lobe_scene_default_options(), &scene),
                     LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "3 and 4 elements"));
}

/* ---- Progress ----------------------------------------------------------------------------------- */

typedef struct story {
    double last;
    int count, is_beyond;
    sig_atomic_t cancel;
} story;

static void hear(void *user, double fraction) {
    story *s = user;
    s->is_beyond |= !(fraction >= 0 && fraction <= 1);
    s->last = fraction;
    s->count++;
}

static void trees_tell_how_far_they_are(void **state) {
    (void)state;
    write_three(1, 1);
    story s = {0};
    lobe_scene *scene = NULL;
    lobe_scene_options o = lobe_scene_default_options();
    o.progress = hear;
    o.progress_user = &s;
    o.cancel = &s.cancel;
    assert_int_equal(lobe_scene_load(name, o, &scene), LOBE_RENDER_OK);
    assert_true(s.count > 0 && s.last == 1 && !s.is_beyond);
    lobe_scene_free(scene);
    s.cancel = 1; /* before the tree is begun */
    assert_int_equal(lobe_scene_load(name, o, &scene), LOBE_RENDER_INTERRUPTED);
    assert_null(scene);
}

static int remove_file(void **state) {
    (void)state;
    unlink(name);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_look_like_copies), cmocka_unit_test(nodes_and_attributes_agree),
        cmocka_unit_test(threads_do_not_matter),      cmocka_unit_test(lights_are_copied),
        cmocka_unit_test(flat_places_are_copied),     cmocka_unit_test(checkpoints_know_places),
        cmocka_unit_test(counts_have_to_agree),       cmocka_unit_test(trees_tell_how_far_they_are),
    };
    return cmocka_run_group_tests(tests, make_sheet, remove_file);
}
