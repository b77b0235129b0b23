/* tests/ssr/test_folder.c: frames in a folder: the same bits back, what may be left out, mistakes by name, damaged
 * files. */
#define _POSIX_C_SOURCE 200809L
#include "frames.h"

#include <stdio.h>
#include <unistd.h>

#include "lobe/ssr_folder.h"
#include "lobe/ssr_picture.h"

enum { WIDTH = 23, HEIGHT = 17, COUNT = WIDTH * HEIGHT };

static char folder_path[64], file_path[128];

static const char *file_in_folder(const char *name) {
    snprintf(file_path, sizeof file_path, "%s/%s", folder_path, name);
    return file_path;
}

static int make_folder(void **state) {
    (void)state;
    strcpy(folder_path, "/tmp/lobe-folder-XXXXXX");
    return mkdtemp(folder_path) ? 0 : -1;
}

static int remove_folder(void **state) {
    (void)state;
    static const char *const names[] = {"gbuffer.json", "gbuffer-0000.exr", "gbuffer-0001.exr",
                                        "environment.exr"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) unlink(file_in_folder(names[i]));
    return rmdir(folder_path);
}

static void write_text(const char *name, const char *bytes, size_t size) {
    FILE *file = fopen(file_in_folder(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static char *read_bytes(const char *name, size_t *size) {
    FILE *file = fopen(file_in_folder(name), "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    *size = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*size + 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

/* Numbers of all kinds, the odd ones too. */
static float any_number(uint64_t stream, uint64_t i) {
    static const float odd[] = {NAN, INFINITY, -INFINITY, -0.0f, 3e38f, 1e-42f};
    return unit_random(stream, 2 * i) < 0.1f ? odd[(int)(6.0f * unit_random(stream, 2 * i + 1))]
                                             : 4.0f * unit_random(stream, 2 * i + 1) - 1.0f;
}

static void fill(float *values, size_t count, uint64_t stream) {
    for (size_t i = 0; i < count; i++) values[i] = any_number(stream, i);
}

/* Everything that a frame can have. */
typedef struct full_frame {
    made_frame made;
    float f0[3 * COUNT], tangent[3 * COUNT], anisotropy[COUNT], motion_z[COUNT],
        light[3 * 8 * 4 * 2];
    unsigned char mask[COUNT];
} full_frame;

static void make_full(full_frame *f, uint64_t stream) {
    f->made = make_frame(WIDTH, HEIGHT, 50.0f);
    lobe_ssr_frame *frame = &f->made.frame;
    fill(f->made.z, COUNT, stream);
    fill(f->made.normal, 3 * COUNT, stream + 1);
    fill(f->made.roughness, COUNT, stream + 2);
    fill(f->made.color, 3 * COUNT, stream + 3);
    fill(f->made.motion, 2 * COUNT, stream + 4);
    fill(f->f0, 3 * COUNT, stream + 5);
    fill(f->tangent, 3 * COUNT, stream + 6);
    fill(f->anisotropy, COUNT, stream + 7);
    fill(f->motion_z, COUNT, stream + 10);
    fill(f->light, sizeof f->light / sizeof *f->light, 8);
    for (size_t i = 0; i < COUNT; i++) f->mask[i] = unit_random(stream + 9, i) < 0.9f;
    frame->f0 = f->f0;
    frame->motion_z = f->motion_z;
    frame->tangent = f->tangent;
    frame->anisotropy = f->anisotropy;
    frame->mask = f->mask;
    frame->environment = (lobe_ssr_environment){8, 4, 2, f->light};
    frame->previous_camera.eye.x += 0.1f;
}

static void write_frames(full_frame *frames, int count) {
    lobe_ssr_folder_writer *writer = NULL;
    assert_int_equal(lobe_ssr_folder_begin(folder_path, WIDTH, HEIGHT, &writer), LOBE_SSR_OK);
    for (int i = 0; i < count; i++) {
        make_full(&frames[i], 100 * (uint64_t)(i + 1));
        assert_int_equal(lobe_ssr_folder_add(writer, &frames[i].made.frame), LOBE_SSR_OK);
    }
    assert_int_equal(lobe_ssr_folder_finish(writer), LOBE_SSR_OK);
}

static void same_bits_come_back(void **state) {
    (void)state;
    static full_frame frames[2];
    write_frames(frames, 2);
    lobe_ssr_folder *folder = NULL;
    assert_int_equal(lobe_ssr_folder_open(folder_path, &folder), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_folder_width(folder), WIDTH);
    assert_int_equal(lobe_ssr_folder_height(folder), HEIGHT);
    assert_int_equal(lobe_ssr_folder_count(folder), 2);
    for (int i = 1; i >= 0; i--) { /* in any order */
        const lobe_ssr_frame *a = &frames[i].made.frame;
        lobe_ssr_frame b;
        assert_int_equal(lobe_ssr_folder_get(folder, i, &b), LOBE_SSR_OK);
        assert_memory_equal(a->z, b.z, COUNT * sizeof(float));
        assert_memory_equal(a->normal, b.normal, 3 * COUNT * sizeof(float));
        assert_memory_equal(a->roughness, b.roughness, COUNT * sizeof(float));
        assert_memory_equal(a->f0, b.f0, 3 * COUNT * sizeof(float));
        assert_memory_equal(a->motion, b.motion, 2 * COUNT * sizeof(float));
        assert_memory_equal(a->motion_z, b.motion_z, COUNT * sizeof(float));
        assert_memory_equal(a->previous_color, b.previous_color, 3 * COUNT * sizeof(float));
        assert_memory_equal(a->tangent, b.tangent, 3 * COUNT * sizeof(float));
        assert_memory_equal(a->anisotropy, b.anisotropy, COUNT * sizeof(float));
        assert_memory_equal(a->mask, b.mask, COUNT);
        assert_memory_equal(&a->camera, &b.camera, sizeof a->camera);
        assert_memory_equal(&a->previous_camera, &b.previous_camera, sizeof a->camera);
        assert_memory_equal(a->environment.rgb, b.environment.rgb, sizeof frames->light);
        assert_int_equal(b.environment.levels, 2);
        free_frame(&frames[i].made);
    }
    lobe_ssr_frame none;
    assert_int_equal(lobe_ssr_folder_get(folder, 2, &none), LOBE_SSR_BAD_INPUT);
    lobe_ssr_folder_free(folder);
}

/* ---- What may be left out -------------------------------------------------------------------- */

#define CAMERA(X)                                                                                  \
    "{\"to_world\":[[1,0,0," X "],[0,1,0,0],[0,0,1,0],[0,0,0,1]],\"tan\":[0.5,0.5],"               \
    "\"near\":0.1,\"far\":100}"
#define HEAD "{\"format\":\"lobe-gbuffer\",\"version\":1,\"width\":4,\"height\":4,\"frames\":["
#define FRAME(NAME, X) "{\"file\":\"gbuffer-000" NAME ".exr\",\"camera\":" CAMERA(X) "}"

/* A wall at z = 2, of a colour. */
static void write_wall(const char *name, float color, const char *key, int channels) {
    float z[16], n[16], zero[16] = {0}, light[16];
    for (int i = 0; i < 16; i++) {
        z[i] = 2.0f;
        n[i] = 1.0f;
        light[i] = color;
    }
    const lobe_ssr_channel all[] = {{"Z", z, 1},     {"N.X", zero, 1}, {"N.Y", zero, 1},
                                    {"N.Z", n, 1},   {key, zero, 1},   {"R", light, 1},
                                    {"G", light, 1}, {"B", light, 1}};
    assert_int_equal(lobe_ssr_write_exr(file_in_folder(name), 4, 4, all, channels, NULL),
                     LOBE_SSR_OK);
}

static void colours_and_motion_follow_from_the_rest(void **state) {
    (void)state;
    static const char text[] = HEAD FRAME("0", "0") "," FRAME("1", "0.5") "]}";
    write_text("gbuffer.json", text, sizeof text - 1);
    write_wall("gbuffer-0000.exr", 0.25f, "roughness", 8);
    write_wall("gbuffer-0001.exr", 0.75f, "roughness", 8);
    lobe_ssr_folder *folder = NULL;
    lobe_ssr_frame f;
    assert_int_equal(lobe_ssr_folder_open(folder_path, &folder), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_folder_get(folder, 0, &f), LOBE_SSR_OK);
    assert_true(f.previous_color[0] == 0.25f); /* the first is its own past */
    assert_true(f.motion[0] == 0.0f && f.motion[1] == 0.0f);
    assert_int_equal(lobe_ssr_folder_get(folder, 1, &f), LOBE_SSR_OK);
    assert_true(f.previous_color[0] == 0.25f);
    assert_true(f.previous_camera.eye.x == 0.0f && f.camera.eye.x == 0.5f);
    for (int i = 0; i < 16; i++) {
        /* 0.5 to the right, at a distance where the screen is 2 wide: a quarter of it to the left */
        assert_true(fabsf(f.motion[2 * i] + 0.25f) < 1e-6f);
        assert_true(fabsf(f.motion[2 * i + 1]) < 1e-6f);
    }
    assert_null(f.f0);
    assert_null(f.motion_z);
    assert_null(f.mask);
    assert_null(f.environment.rgb);
    lobe_ssr_folder_free(folder);
}

static void a_panorama_is_filtered(void **state) {
    (void)state;
    static const char text[] =
        HEAD FRAME("0", "0") "],\"environment\":{\"file\":\"environment.exr\",\"width\":4,"
                             "\"height\":4,\"levels\":1}}";
    write_text("gbuffer.json", text, sizeof text - 1);
    write_wall("gbuffer-0000.exr", 0.25f, "roughness", 8);
    write_wall("environment.exr", 0.5f, "roughness", 8);
    lobe_ssr_folder *folder = NULL;
    lobe_ssr_frame f;
    assert_int_equal(lobe_ssr_folder_open(folder_path, &folder), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_folder_get(folder, 0, &f), LOBE_SSR_OK);
    assert_true(f.environment.levels > 1);
    const int texels = f.environment.width * f.environment.height * f.environment.levels;
    for (int i = 0; i < 3 * texels; i++) assert_true(fabsf(f.environment.rgb[i] - 0.5f) < 1e-5f);
    lobe_ssr_folder_free(folder);
}

/* ---- Mistakes -------------------------------------------------------------------------------- */

/* The first call that fails, whose message must hold `part`. */
static void refuse(const char *text, const char *part) {
    lobe_ssr_folder *folder = NULL;
    lobe_ssr_frame f;
    write_text("gbuffer.json", text, strlen(text));
    lobe_ssr_result result = lobe_ssr_folder_open(folder_path, &folder);
    if (result == LOBE_SSR_OK) result = lobe_ssr_folder_get(folder, 0, &f);
    assert_int_equal(result, LOBE_SSR_BAD_INPUT);
    if (!strstr(lobe_ssr_error_message(), part)) fail_msg("%s", lobe_ssr_error_message());
    assert_non_null(strchr(lobe_ssr_error_message(), ';'));
    lobe_ssr_folder_free(folder);
}

#define WITH_CAMERA(TEXT) HEAD "{\"file\":\"gbuffer-0000.exr\",\"camera\":" TEXT "}]}"
#define WITH_MATRIX(TEXT)                                                                          \
    WITH_CAMERA("{\"to_world\":" TEXT ",\"tan\":[0.5,0.5],\"near\":0.1,\"far\":100}")

static void mistakes_are_named(void **state) {
    (void)state;
    static const char good[] = HEAD FRAME("0", "0") "]}";
    lobe_ssr_folder *folder = NULL;
    assert_int_equal(lobe_ssr_folder_open(folder_path, &folder), LOBE_SSR_BAD_INPUT);
    assert_null(folder);
    refuse("", "gbuffer.json:1");
    refuse("[1, 2", "gbuffer.json:1");
    refuse("{\"a\":1,\"a\":2}", "duplicate");
    refuse("{}", "format");
    refuse("{\"format\":\"lobe-gbuffer\",\"version\":2}", "version");
    refuse("{\"format\":\"lobe-gbuffer\",\"version\":1,\"width\":0,\"height\":4}", "width");
    refuse("{\"format\":\"lobe-gbuffer\",\"version\":1,\"width\":4,\"height\":32769}", "width");
    refuse(HEAD "]}", "frames");
    refuse(HEAD "{}]}", "frames[0]");
    refuse(WITH_CAMERA("7"), "frames[0].camera");
    refuse(WITH_MATRIX("[[1,0,0,0],[0,1,0,0],[0,0,1,0]]"), "to_world");
    refuse(WITH_MATRIX("[[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,1]]"), "to_world");
    refuse(WITH_MATRIX("[[1,0,0,0],[0,1,0,0],[0,1,0,0],[0,0,0,1]]"), "to_world");
    refuse(WITH_MATRIX("[[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]"), "to_world");
    refuse(WITH_MATRIX("[[1,0,0,1e60],[0,1,0,0],[0,0,1,0],[0,0,0,1]]"), "to_world");
    refuse(WITH_MATRIX("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]"), "to_world");
    refuse(good, "gbuffer-0000.exr: cannot be read");
    write_text("gbuffer-0000.exr", "no picture", 10);
    refuse(good, "not an OpenEXR picture");
    write_wall("gbuffer-0000.exr", 1.0f, "rough", 8);
    refuse(good, "no channel roughness");
    write_wall("gbuffer-0000.exr", 1.0f, "roughness", 5);
    refuse(good, "no channel R");
    write_wall("gbuffer-0000.exr", 1.0f, "motion.X", 8);
    refuse(good, "no channel roughness");
    write_wall("gbuffer-0000.exr", 1.0f, "roughness", 8);
    refuse("{\"format\":\"lobe-gbuffer\",\"version\":1,\"width\":5,\"height\":4,\"frames\":[" FRAME(
               "0", "0") "]}",
           "5 x 4");
    refuse(HEAD FRAME("0", "0") "],\"environment\":{\"file\":\"environment.exr\",\"width\":4,"
                                "\"height\":4,\"levels\":2}}",
           "environment.exr");
    refuse(HEAD FRAME("0", "0") "],\"environment\":{\"file\":\"e\",\"width\":4}}", "environment");
}

/* ---- Damage ---------------------------------------------------------------------------------- */

static void run_anyway(lobe_ssr_folder *folder) {
    lobe_ssr_frame f;
    lobe_ssr *ssr = NULL;
    lobe_ssr_options o = lobe_ssr_default_options();
    o.fade_start = o.fade_end = 1.0f;
    const int width = lobe_ssr_folder_width(folder), height = lobe_ssr_folder_height(folder);
    if (width * height > 4 * COUNT || lobe_ssr_folder_get(folder, 0, &f) != LOBE_SSR_OK) return;
    assert_int_equal(lobe_ssr_create(width, height, o, &ssr), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_run(ssr, &f, NULL), LOBE_SSR_OK);
    for (int i = 0; i < 3 * width * height; i++)
        assert_true(isfinite(lobe_ssr_composite(ssr)[i]) && isfinite(lobe_ssr_radiance(ssr)[i]));
    lobe_ssr_free(ssr);
}

/* Some bytes are others, or the end is gone. */
static void damage(const char *name, int rounds, uint64_t stream) {
    size_t size;
    char *bytes = read_bytes(name, &size), *bad = malloc(size);
    assert_non_null(bad);
    for (int round = 0; round < rounds; round++) {
        const uint64_t s = stream + (uint64_t)round;
        const size_t kept = round % 4 ? size : (size_t)(unit_random(s, 0) * (float)size);
        /* the head is where it hurts */
        const float reach = round % 2 ? (float)size : fminf((float)size, 800.0f);
        memcpy(bad, bytes, size);
        for (uint64_t k = 1; k <= 1 + s % 3; k++)
            bad[(size_t)(unit_random(s, 2 * k) * reach)] =
                (char)(256.0f * unit_random(s, 2 * k + 1));
        write_text(name, bad, kept);
        lobe_ssr_folder *folder = NULL;
        if (lobe_ssr_folder_open(folder_path, &folder) == LOBE_SSR_OK)
            run_anyway(folder);
        else
            assert_non_null(strchr(lobe_ssr_error_message(), ';'));
        lobe_ssr_folder_free(folder);
    }
    write_text(name, bytes, size);
    free(bytes);
    free(bad);
}

static void damaged_files_do_no_harm(void **state) {
    (void)state;
    static full_frame frames[1];
    write_frames(frames, 1);
    damage("gbuffer.json", 100, 1000);
    damage("gbuffer-0000.exr", 150, 2000);
    damage("environment.exr", 40, 3000);
    free_frame(&frames[0].made);
}

int main(void) {
#define TEST(NAME) cmocka_unit_test_setup_teardown(NAME, make_folder, remove_folder)
    const struct CMUnitTest tests[] = {
        TEST(same_bits_come_back), TEST(colours_and_motion_follow_from_the_rest),
        TEST(a_panorama_is_filtered), TEST(mistakes_are_named), TEST(damaged_files_do_no_harm)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
