/* tests/render/test_footprint.c: textures averaged over footprints: their levels by brute force, the filters of glTF, a plane to
 * the horizon. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <string.h>
#include <unistd.h>

#include "gltf_square.h"
#include "lobe/random.h"
#include "render/image.h"
#include "render/texture.h"

static texture random_texture(int width, int height, int channels, int is_srgb) {
    const size_t bytes = (size_t)width * (size_t)height * (size_t)channels;
    texture t = {width, height, channels, is_srgb, .texels = malloc(bytes)};
    for (size_t i = 0; i < bytes; i++) t.texels[i] = (unsigned char)lobe_random(1, 2, i).word[0];
    assert_true(lobe_texture_add_levels(&t));
    return t;
}

static double value_of(const texture *t, int x, int y, int c) {
    const unsigned char byte = t->texels[(y * t->width + x) * t->channels + c];
    return t->is_srgb ? (double)lobe_srgb_to_linear(byte / 255.0f) : byte / 255.0;
}

/* Mean of w x h values over the x-th of `across` columns and the y-th of `down` rows. */
static double mean_over(const double *values, int w, int h, int x, int across, int y, int down) {
    const double width = (double)w / across, height = (double)h / down;
    double sum = 0;
    for (int i = 0; i < w * h; i++) {
        const double dx = fmin((x + 1) * width, i % w + 1) - fmax(x * width, i % w);
        const double dy = fmin((y + 1) * height, i / w + 1) - fmax(y * height, i / w);
        if (dx > 0 && dy > 0) sum += dx * dy * values[i];
    }
    return sum / (width * height);
}

/* Every texel of every level, looked up in its middle; of sizes that are no powers of two too. */
static void levels_are_means(void **state) {
    (void)state;
    static const int sizes[][2] = {{16, 8}, {12, 20}, {5, 3}, {7, 1}, {1, 6}, {2, 2}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int is_srgb = 0; is_srgb < 2; is_srgb++) {
            texture t = random_texture(sizes[i][0], sizes[i][1], 3 + is_srgb, is_srgb);
            texture_map map = lobe_texture_map(0);
            map.levels = LEVELS_NEAREST;
            map.is_nearest_small = 1;
            int w = t.width, h = t.height;
            double values[256], larger[256];
            for (int k = 0; k < w * h; k++) values[k] = value_of(&t, k % w, k / w, 1);
            for (int level = 1; level <= t.level_count; level++) {
                const int old_w = w, old_h = h;
                memcpy(larger, values, sizeof values);
                w = w > 1 ? w / 2 : 1;
                h = h > 1 ? h / 2 : 1;
                assert_int_equal(t.levels[level - 1].width, w);
                assert_int_equal(t.levels[level - 1].height, h);
                const double across = exp2(level) / sqrt((double)t.width * t.height);
                for (int k = 0; k < w * h; k++) {
                    values[k] = mean_over(larger, old_w, old_h, k % w, w, k / w, h);
                    const vec3 v =
                        lobe_texture_at(&t, &map, ((float)(k % w) + 0.5f) / (float)w,
                                        ((float)(k / w) + 0.5f) / (float)h, (float)across);
                    /* half a step of 8 bits, which is steepest for sRGB at 1: 2.4 / 1.055 */
                    if (!(fabs((double)v.y - values[k]) < (is_srgb ? 2.3 : 1.0) * 0.5 / 255 + 1e-5))
                        fail_msg("%d x %d, level %d, texel %d: %g, not %g", t.width, t.height,
                                 level, k, (double)v.y, values[k]);
                }
            }
            assert_true(w == 1 && h == 1);
            lobe_texture_free(&t);
        }
}

static void levels_take_a_third(void **state) {
    (void)state;
    texture t = random_texture(64, 32, 4, 1);
    const size_t whole = 64 * 32 * 4;
    assert_true(lobe_texture_bytes(&t) > whole && 3 * lobe_texture_bytes(&t) <= 4 * whole + 12);
    lobe_texture_free(&t);
    t = random_texture(1, 1, 3, 0);
    assert_int_equal(lobe_texture_bytes(&t), 3);
    lobe_texture_free(&t);
}

/* One row of texels, black and white in turn: what each filter makes of footprints of 0.5, 2.6 and 1000 texels in the
 * middle of a white one. */
static void filters_are_what_they_say(void **state) {
    (void)state;
    enum { SIZE = 64 };
    texture t = {SIZE, 1, 3, 0, .texels = malloc(3 * SIZE)};
    for (int i = 0; i < 3 * SIZE; i++) t.texels[i] = i / 3 % 2 ? 255 : 0;
    assert_true(lobe_texture_add_levels(&t));
    static const struct {
        int is_nearest, is_nearest_small;
        texture_levels levels;
        float wanted[3];
    } cases[] = {
        {0, 0, LEVELS_BLENDED, {1.0f, 0.5f, 0.5f}}, {0, 0, LEVELS_NEAREST, {1, 0.5f, 0.5f}},
        {0, 0, LEVELS_NONE, {0.75f, 0.75f, 0.75f}}, {1, 0, LEVELS_NONE, {1, 0.75f, 0.75f}},
        {0, 1, LEVELS_NONE, {0.75f, 1, 1}},         {1, 1, LEVELS_BLENDED, {1, 0.5f, 0.5f}}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        /* a quarter of a texel beside the middle where levels are left out */
        const float place = cases[i].levels == LEVELS_NONE ? 9.75f : 9.5f;
        texture_map map = lobe_texture_map(0);
        map.is_nearest = cases[i].is_nearest;
        map.is_nearest_small = cases[i].is_nearest_small;
        map.levels = cases[i].levels;
        static const float footprints[3] = {0.5f, 2.6f, 1000.0f};
        for (int k = 0; k < 3; k++) {
            /* texels of a row are SIZE times as high as wide: of a square the side is the root */
            const float side = footprints[k] / sqrtf(SIZE);
            const vec3 v = lobe_texture_at(&t, &map, place / SIZE, 0.5f, side);
            if (!(fabsf(v.x - cases[i].wanted[k]) < 3e-3f))
                fail_msg("filter %zu, footprint %d: %g", i, k, (double)v.x);
        }
    }
    /* between levels 0 and 1 in the middle: half of each */
    texture_map map = lobe_texture_map(0);
    const vec3 v = lobe_texture_at(&t, &map, 9.5f / SIZE, 0.5f, sqrtf(2.0f) / sqrtf(SIZE));
    assert_true(fabsf(v.x - 0.75f) < 3e-3f);
    /* a transform that shrinks the picture makes footprints of more texels: four times one each way, level 2 */
    map.u[0] = map.v[1] = 4.0f;
    map.levels = LEVELS_NEAREST;
    const vec3 small = lobe_texture_at(&t, &map, 9.5f / SIZE / 4.0f, 0.5f, 1.0f / sqrtf(SIZE));
    assert_true(fabsf(small.x - 0.5f) < 3e-3f);
    lobe_texture_free(&t);
}

/* Half the texels of a row are white; at the edge, what lies beyond counts as the wrap says, in every level. */
static void levels_wrap(void **state) {
    (void)state;
    texture t = {4, 1, 3, 0, .texels = malloc(12)};
    for (int i = 0; i < 12; i++) t.texels[i] = i < 6 ? 0 : 255;
    assert_true(lobe_texture_add_levels(&t));
    static const float wanted[] = {[WRAP_REPEAT] = 0.5f, [WRAP_MIRROR] = 0.0f, [WRAP_CLAMP] = 0.0f};
    for (int wrap = WRAP_REPEAT; wrap <= WRAP_CLAMP; wrap++) {
        texture_map map = lobe_texture_map(0);
        map.levels = LEVELS_NEAREST;
        map.wrap_u = map.wrap_v = (texture_wrap)wrap;
        const vec3 v = lobe_texture_at(&t, &map, 0.0f, 0.5f, 2.0f / sqrtf(4.0f));
        assert_true(fabsf(v.x - wanted[wrap]) < 1e-6f);
    }
    lobe_texture_free(&t);
}

/* ---- Scenes ----------------------------------------------------------------------------------- */

static char object[64], library[64], picture[64];

static int set_up(void **state) {
    (void)state;
    const long process = (long)getpid();
    snprintf(object, sizeof object, "/tmp/lobe-footprint-%ld.obj", process);
    snprintf(library, sizeof library, "/tmp/lobe-footprint-%ld.mtl", process);
    snprintf(picture, sizeof picture, "/tmp/lobe-footprint-%ld.ppm", process);
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    remove(object);
    remove(library);
    remove(picture);
    return 0;
}

/* A plane at y = 0 with a checkerboard of squares of half a unit. */
static lobe_scene *checkerboard(void) {
    enum { SIZE = 64 };
    FILE *file = fopen(picture, "wb");
    assert_non_null(file);
    fprintf(file, "P6\n%d %d\n255\n", SIZE, SIZE);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int is_white = (i % SIZE / (SIZE / 2) + i / SIZE / (SIZE / 2)) % 2;
        for (int c = 0; c < 3; c++) fputc(is_white ? 255 : 0, file);
    }
    fclose(file);
    file = fopen(library, "w");
    assert_non_null(file);
    fprintf(file, "newmtl a\nKd 1 1 1\nKs 0 0 0\nmap_Kd %s\n", picture + strlen("/tmp/"));
    fclose(file);
    file = fopen(object, "w");
    assert_non_null(file);
    fprintf(file,
            "mtllib %s\nv -2000 0 -2000\nv 2000 0 -2000\nv 2000 0 2000\nv -2000 0 2000\n"
            "vt 0 0\nvt 4000 0\nvt 4000 4000\nvt 0 4000\nusemtl a\nf 1/1 4/4 3/3\nf 1/1 3/3 2/2\n",
            library + strlen("/tmp/"));
    fclose(file);
    return load(object);
}

enum { WIDTH = 96, HEIGHT = 64 };

/* Root of the mean square of base colour - 1/2 over the rows from `top` on. */
static double contrast(const lobe_scene *scene, lobe_render_options o, int top, int rows) {
    static float albedo[3 * WIDTH * HEIGHT];
    double sum = 0;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_ALBEDO);
    lobe_film *film = render(scene, o, NULL);
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_ALBEDO, albedo));
    for (int i = top * WIDTH; i < (top + rows) * WIDTH; i++)
        sum += pow((double)albedo[3 * i] - 0.5, 2) / (rows * WIDTH);
    lobe_film_free(film);
    return sqrt(sum);
}

/* The horizon lies in the middle. Ten rows below it a pixel covers some 20 units in depth and half a one across: 10
 * squares and 3 texels a footprint. */
static void plane_to_the_horizon(void **state) {
    (void)state;
    lobe_scene *scene = checkerboard();
    lobe_view view = {{0, 10, 0}, {0, 10, -1}, {0, 1, 0}, 60};
    lobe_render_options o = small(WIDTH, HEIGHT, 1);
    o.view = &view;
    o.depth = 0;
    const int below = HEIGHT / 2 + 2; /* the filter reaches 1.5 pixels */
    const double far = contrast(scene, o, below, 2);
    if (!(far < 0.02)) fail_msg("contrast %g far away", far);
    o.footprint = 0;
    assert_true(contrast(scene, o, below, 2) > 0.45); /* what it is without */
    /* more samples: less is averaged each time, and the mean is that of texels as they are */
    o.footprint = -1;
    o.samples = 512;
    const double fine = contrast(scene, o, below, 2);
    if (!(fine < 0.03)) fail_msg("contrast %g of many samples", fine);
    /* from near, a texel is larger than a pixel: the same bits */
    view.position = (lobe_vec3_f32){0, 0.4f, 0};
    view.target = (lobe_vec3_f32){0, 0, -0.1f};
    view.vertical_degrees = 10;
    o.samples = 1;
    o.depth = 1;
    float *bits[2];
    for (int i = 0; i < 2; i++) {
        o.footprint = i ? -1 : 0;
        lobe_film *film = render(scene, o, NULL);
        bits[i] = colors(film);
        lobe_film_free(film);
    }
    assert_memory_equal(bits[0], bits[1], 3 * sizeof(float) * WIDTH * HEIGHT);
    free(bits[0]);
    free(bits[1]);
    lobe_scene_free(scene);
}

/* The square of gltf_square.h shows its picture of few texels; from far away its mean, unless the file says otherwise. */
static void filters_of_files(void **state) {
    (void)state;
    static const struct {
        int filter;
        int is_averaged;
    } cases[] = {{9728, 0}, {9729, 0}, {9984, 1}, {9985, 1}, {9986, 1}, {9987, 1}, {0, 1}};
    snprintf(object, sizeof object, "/tmp/lobe-footprint-%ld.glb", (long)getpid());
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char sampler[64];
        snprintf(sampler, sizeof sampler, ",\"minFilter\":%d", cases[i].filter);
        write_square_file(
            object, (square_file){.min_filter = cases[i].filter ? sampler : "",
                                  .material = "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{"
                                              "\"index\":2}},\"extensions\":{"
                                              "\"KHR_materials_unlit\":{}}}"});
        lobe_scene *scene = load(object);
        lobe_render_options o = small(8, 8, 1);
        const lobe_view view = {{0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 20};
        o.view = &view;
        o.footprint = 1000;
        lobe_film *film = render(scene, o, NULL);
        float *rgb = colors(film), lowest = 1, highest = 0;
        for (int k = 0; k < 8 * 8; k++) {
            lowest = fminf(lowest, rgb[3 * k + 1]);
            highest = fmaxf(highest, rgb[3 * k + 1]);
        }
        if ((highest - lowest < 1e-3f) != cases[i].is_averaged)
            fail_msg("filter %d: %g to %g", cases[i].filter, (double)lowest, (double)highest);
        free(rgb);
        lobe_film_free(film);
        lobe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_are_means),
        cmocka_unit_test(levels_take_a_third),
        cmocka_unit_test(filters_are_what_they_say),
        cmocka_unit_test(levels_wrap),
        cmocka_unit_test_setup_teardown(plane_to_the_horizon, set_up, tear_down),
        cmocka_unit_test_setup_teardown(filters_of_files, set_up, tear_down)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
