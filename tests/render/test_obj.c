/* tests/render/test_obj.c: a material of an OBJ file shows what the same material of glTF shows; what is not read is
 * named; damaged libraries do no harm. More rounds of damage, other seeds: render.obj ROUNDS SEED. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "gltf_square.h"
#include "pictures.h"
#include "told.h"

#include <lobe/random.h>
#include <sys/stat.h>
#include <unistd.h>

static const char obj[] = "render-obj.obj", mtl[] = "render-obj.mtl", glb[] = "render-obj.glb";

static unsigned long rounds = 100, seed = 1;

/* ---- Files --------------------------------------------------------------------------------------- */

static void write_text(const char *path, const char *text) {
    write_bytes(path, text, strlen(text));
}

static void write_obj(const char *material_library) {
    char text[400];
    snprintf(
        text, sizeof text,
        "%s\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
        "usemtl m\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n",
        material_library);
    write_text(obj, text);
}

/* 4 x 2 texels: a channel is 255 - 20 (how far in reading order) here and a constant there. */
static void write_picture(const char *path, const int steps[3]) {
    unsigned char texels[8][3];
    for (int i = 0; i < 8; ++i)
        for (int c = 0; c < 3; ++c) texels[i][c] = (unsigned char)(255 - steps[c] * i);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fprintf(file, "P6 4 2 255\n");
    fwrite(texels, sizeof texels, 1, file);
    fclose(file);
}

/* A TGA of 4 x 2 texels, rows from the top, blue first: white, its alpha as the green of `steps`. */
static void write_alpha(const char *path, int step) {
    unsigned char tga[18 + 32] = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 2, 0, 32, 0x28};
    for (int i = 0; i < 8; ++i) {
        memset(tga + 18 + 4 * i, 255, 3);
        tga[18 + 4 * i + 3] = (unsigned char)(255 - step * i);
    }
    write_bytes(path, tga, sizeof tga);
}

static const char *const pictures[] = {"render-obj-color.ppm",  "render-obj-rough.ppm",
                                       "render-obj-metal.ppm",  "render-obj-packed.ppm",
                                       "render-obj-normal.ppm", "render-obj-alpha.tga",
                                       "render-obj-green.ppm"};

static int write_files(void **state) {
    (void)state;
    write_picture(pictures[0], (const int[3]){30, 10, 20});
    write_picture(pictures[1], (const int[3]){25, 25, 25});
    write_picture(pictures[2], (const int[3]){31, 31, 31});
    write_picture(pictures[3], (const int[3]){0, 25, 31});
    write_picture(pictures[4], (const int[3]){16, 20, 1});
    write_alpha(pictures[5], 25);
    write_picture(pictures[6], (const int[3]){9, 25, 0});
    return 0;
}

static int remove_files(void **state) {
    (void)state;
    for (int i = 0; i < 7; ++i) unlink(pictures[i]);
    unlink(obj);
    unlink(mtl);
    unlink(glb);
    return 0;
}

/* ---- Pictures ------------------------------------------------------------------------------------ */

enum { SIZE = 16 };
typedef struct sight {
    float rgb[SIZE * SIZE * 3];
} sight;

static void fail_by(void *user, const char *message) {
    (void)user;
    fail_msg("%s", message);
}

static sight look(const char *path) {
    lobe_scene *scene = NULL;
    lobe_scene_options options = lobe_scene_default_options();
    options.warning = fail_by;
    if (lobe_scene_load(path, options, &scene) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    lobe_render_options o = small(SIZE, SIZE, 8);
    const lobe_view view = {{1.1f, 0.7f, 2.9f}, {0, 0, 0}, {0, 1, 0}, 36.0f};
    o.view = &view;
    o.depth = 3;
    lobe_film *film = render(scene, o, NULL);
    sight s;
    assert_true(lobe_film_copy_rgb(film, s.rgb));
    lobe_film_free(film);
    lobe_scene_free(scene);
    return s;
}

static sight look_obj(const char *lines) {
    char text[1000];
    snprintf(text, sizeof text, "newmtl m\n%s\n", lines);
    write_obj("mtllib render-obj.mtl");
    write_text(mtl, text);
    return look(obj);
}

/* Texture k + 3 is picture k. */
static sight look_gltf(const char *material) {
    square_file f = {.material = material};
    f.images = ",{\"uri\":\"render-obj-color.ppm\"},{\"uri\":\"render-obj-rough.ppm\"},"
               "{\"uri\":\"render-obj-metal.ppm\"},{\"uri\":\"render-obj-packed.ppm\"},"
               "{\"uri\":\"render-obj-normal.ppm\"},{\"uri\":\"render-obj-alpha.tga\"},"
               "{\"uri\":\"render-obj-green.ppm\"}";
    f.textures = ",{\"source\":2},{\"source\":3},{\"source\":4},{\"source\":5},{\"source\":6},"
                 "{\"source\":7},{\"source\":2,\"sampler\":2},{\"source\":8}";
    write_square_file(glb, f);
    return look(glb);
}

/* Greatest difference of a channel, relative to the brightest. */
static float difference(const sight *a, const sight *b) {
    float most = 0.0f, brightest = 1e-6f;
    for (int i = 0; i < SIZE * SIZE * 3; ++i) {
        most = fmaxf(most, fabsf(a->rgb[i] - b->rgb[i]));
        brightest = fmaxf(brightest, fmaxf(a->rgb[i], b->rgb[i]));
    }
    return most / brightest;
}

/* A material, the same in glTF, and one that lacks what it is about. */
typedef struct pair {
    const char *mtl, *gltf, *without;
} pair;

#define PBR "{\"pbrMetallicRoughness\":{"
#define METAL "Kd 0.8 0.4 0.2\nPm 1\nPr 0.3\n"
#define GLTF_METAL                                                                                 \
    PBR "\"baseColorFactor\":[0.8,0.4,0.2,1],\"roughnessFactor\":0.3,\"metallicFactor\":1}"
#define PAINT "Kd 0.8 0.4 0.2\nPm 0\nPr 0.3\n"
#define GLTF_PAINT                                                                                 \
    PBR "\"baseColorFactor\":[0.8,0.4,0.2,1],\"roughnessFactor\":0.3,\"metallicFactor\":0}"
#define TEXTURE(i) "{\"index\":" #i "}"

static const pair pairs[] = {
    {METAL, GLTF_METAL "}", PAINT},
    {"kd 0.8 0.4 0.2\nPM 1\r\n  pr\t0.3  # rough", GLTF_METAL "}", PAINT},
    {PAINT, GLTF_PAINT "}", "Kd 0.8 0.4 0.2\nPm 0\nPr 0.6"},
    {"Kd 0.5\nPr 1\nmap_Kd render-obj-color.ppm",
     PBR "\"baseColorFactor\":[0.5,0.5,0.5,1],\"metallicFactor\":0,\"baseColorTexture\":" TEXTURE(
         3) "}}",
     "Kd 0.5\nPr 1"},
    {"Pr 1\nmap_Kd -clamp on -o 0.25 0.125 -s 0.75 1.5 1 render-obj-color.ppm",
     PBR "\"metallicFactor\":0,\"baseColorTexture\":{\"index\":9,\"extensions\":{"
         "\"KHR_texture_transform\":{\"offset\":[0.25,-0.625],\"scale\":[0.75,1.5]}}}}}",
     "Pr 1\nmap_Kd -o 0.25 0.125 -s 0.75 1.5 1 render-obj-color.ppm"},
    {"Pr 1\nmap_Kd -o 0.25 0.125 -s 0.75 1.5 render-obj-color.ppm",
     PBR "\"metallicFactor\":0,\"baseColorTexture\":{\"index\":3,\"extensions\":{"
         "\"KHR_texture_transform\":{\"offset\":[0.25,-0.625],\"scale\":[0.75,1.5]}}}}}",
     "Pr 1\nmap_Kd render-obj-color.ppm"},
    {"Kd 0.8 0.4 0.2\nPm 1\nmap_Pr render-obj-rough.ppm",
     PBR "\"baseColorFactor\":[0.8,0.4,0.2,1],\"metallicFactor\":1,\"metallicRoughnessTexture\":"
         "{\"index\":10}}}",
     "Kd 0.8 0.4 0.2\nPm 1\nPr 1"},
    {"Kd 0.8 0.4 0.2\nPm 0\nmap_Pm render-obj-metal.ppm\nmap_Pr render-obj-rough.ppm",
     PBR "\"baseColorFactor\":[0.8,0.4,0.2,1],\"metallicRoughnessTexture\":" TEXTURE(6) "}}",
     "Kd 0.8 0.4 0.2\nPm 1\nmap_Pr render-obj-rough.ppm"},
    {PAINT "Pc 0.8\nPcr 0.2",
     GLTF_PAINT ",\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.8,"
                "\"clearcoatRoughnessFactor\":0.2}}}",
     PAINT "Pc 0.8\nPcr 0.5"},
    {PAINT "map_Pc render-obj-metal.ppm\nmap_Pcr render-obj-rough.ppm\nPcr 0.5",
     GLTF_PAINT ",\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":1,"
                "\"clearcoatRoughnessFactor\":0.5,\"clearcoatTexture\":{\"index\":5},"
                "\"clearcoatRoughnessTexture\":{\"index\":4}}}}",
     PAINT "Pc 1\nmap_Pcr render-obj-rough.ppm\nPcr 0.5"},
    {METAL "aniso 0.7",
     GLTF_METAL ",\"extensions\":{\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0.7}}}",
     METAL},
    {METAL "aniso 0.7\nanisor 0.1",
     GLTF_METAL ",\"extensions\":{\"KHR_materials_anisotropy\":{\"anisotropyStrength\":0.7,"
                "\"anisotropyRotation\":0.62831853}}}",
     METAL "aniso 0.7"},
    {METAL "norm -bm 0.5 render-obj-normal.ppm",
     GLTF_METAL ",\"normalTexture\":{\"index\":7,\"scale\":0.5}}",
     METAL "norm render-obj-normal.ppm"},
    {PAINT "Ke 3 2 1",
     GLTF_PAINT ",\"emissiveFactor\":[1,0.66666667,0.33333333],\"extensions\":{"
                "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":3}}}",
     PAINT},
    {PAINT "Ke 0 0 0\nmap_Ke render-obj-color.ppm",
     GLTF_PAINT ",\"emissiveFactor\":[1,1,1],\"emissiveTexture\":" TEXTURE(3) "}", PAINT},
    {"Pr 0.5\nKd 1 1 1\nd 0.4",
     PBR "\"baseColorFactor\":[1,1,1,0.4],\"roughnessFactor\":0.5,\"metallicFactor\":0},"
         "\"alphaMode\":\"BLEND\"}",
     "Pr 0.5\nKd 1 1 1"},
    {"Pr 0.5\nKd 1 1 1\nTr 0.6",
     PBR "\"baseColorFactor\":[1,1,1,0.4],\"roughnessFactor\":0.5,\"metallicFactor\":0},"
         "\"alphaMode\":\"BLEND\"}",
     "Pr 0.5\nKd 1 1 1"},
    {"Pr 0.5\nKd 1 1 1\nmap_d render-obj-alpha.tga",
     PBR "\"roughnessFactor\":0.5,\"metallicFactor\":0,\"baseColorTexture\":" TEXTURE(
         8) "},\"alphaMode\":\"BLEND\"}",
     "Pr 0.5\nKd 1 1 1"},
    {"Pr 0.5\nmap_Kd render-obj-alpha.tga\nmap_d render-obj-alpha.tga",
     PBR "\"roughnessFactor\":0.5,\"metallicFactor\":0,\"baseColorTexture\":" TEXTURE(
         8) "},\"alphaMode\":\"BLEND\"}",
     "Pr 0.5\nmap_Kd render-obj-alpha.tga"},
    {"Pr 0.5\nKd 1 1 1\nmap_d render-obj-rough.ppm",
     PBR "\"roughnessFactor\":0.5,\"metallicFactor\":0,\"baseColorTexture\":" TEXTURE(
         8) "},\"alphaMode\":\"BLEND\"}",
     "Pr 0.5\nKd 1 1 1"},
    {PAINT "Ni 2.4", GLTF_PAINT ",\"extensions\":{\"KHR_materials_ior\":{\"ior\":2.4}}}", PAINT},
    {PAINT "illum 0", GLTF_PAINT ",\"extensions\":{\"KHR_materials_unlit\":{}}}", PAINT},
    {"Kd 0.8 0.4 0.2\nKs 0.5\nNs 100\nillum 1",
     GLTF_PAINT ",\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0}}}",
     "Kd 0.8 0.4 0.2\nillum 2"},
    {"Kd 0.1\nTf 0.9 0.5 0.2\nillum 7\nNi 1.4\nPr 0.2",
     PBR "\"baseColorFactor\":[0.9,0.5,0.2,1],\"roughnessFactor\":0.2,\"metallicFactor\":0},"
         "\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.4},\"KHR_materials_transmission\":{"
         "\"transmissionFactor\":1},\"KHR_materials_volume\":{\"thicknessFactor\":1}}}",
     "Kd 0.1\nTf 0.9 0.5 0.2\nillum 2\nNi 1.4\nPr 0.2"},
    {"Kd 0.1 0.2 0.3\nd 0.25\nillum 6\nNi 1.4\nPr 0.2",
     PBR "\"baseColorFactor\":[0.1,0.2,0.3,1],\"roughnessFactor\":0.2,\"metallicFactor\":0},"
         "\"extensions\":{\"KHR_materials_ior\":{\"ior\":1.4},\"KHR_materials_transmission\":{"
         "\"transmissionFactor\":0.75},\"KHR_materials_volume\":{\"thicknessFactor\":1}}}",
     "Kd 0.1 0.2 0.3\nd 0.5\nillum 6\nNi 1.4\nPr 0.2"},
};

/* The same numbers are drawn for both: what differs is rounding of colours and tangents. */
static void materials_are_those_of_gltf(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        const sight a = look_obj(pairs[i].mtl), b = look_gltf(pairs[i].gltf),
                    other = look_obj(pairs[i].without);
        if (!(difference(&a, &b) < 1e-4f))
            fail_msg("%s is not as glTF has it: %g", pairs[i].mtl, difference(&a, &b));
        if (!(difference(&a, &other) > 0.01f))
            fail_msg("%s shows nothing: %g", pairs[i].mtl, difference(&a, &other));
    }
}

/* ---- What is named ------------------------------------------------------------------------------- */

static void load_and_listen(void) {
    lobe_scene *scene = NULL;
    lobe_scene_options o = lobe_scene_default_options();
    o.warning = tell;
    tellings = 0;
    assert_int_equal(lobe_scene_load(obj, o, &scene), LOBE_RENDER_OK);
    lobe_scene_free(scene);
    o.strict = 1;
    assert_int_equal(lobe_scene_load(obj, o, &scene), LOBE_RENDER_BAD_INPUT);
    assert_null(scene);
}

static void assert_told_once(const char *word) {
    load_and_listen();
    if (tellings != 1 || !strstr(told[0], word))
        fail_msg("%s: %d warnings, the first: %s", word, tellings, told[0]);
}

static void what_is_not_read_is_named(void **state) {
    (void)state;
    static const struct {
        const char *lines, *word;
    } cases[] = {
        {"Ps 0.5", "have Ps; it"},
        {"map_Ps x.png", "have map_Ps; it"},
        {"disp x.png", "have disp; it"},
        {"map_Bump x.png", "have map_Bump; it"},
        {"Ks 0.5 0.5 0.5", "have Ks; it"},
        {"Pr 1\nd 0.5\nTf 0 1 0", "have Tf"},
        {"Pr rough", "Pr that is not a number"},
        {"Pr nan", "Pr that is not a number"},
        {"Pr 1e99", "Pr that is not a number"},
        {"Kd 0.5 0.5", "Kd that is not one number or three"},
        {"Kd spectral x.rfl", "Kd that is not one number or three"},
        {"map_Kd", "map_Kd without a picture"},
        {"map_Kd -s 1 1", "map_Kd without a picture"},
        {"map_Kd -imfchan r render-obj-color.ppm", "map_Kd -imfchan"},
        {"d -halo 0.5", "d -halo"},
        {"illum 10", "illum beyond"},
        {"newmtl", "newmtl without a name"},
        {"map_Kd absent.png", "absent.png"},
    };
    write_obj("mtllib render-obj.mtl");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[300];
        snprintf(text, sizeof text, "newmtl m\n%s\nnewmtl other\n%s\n", cases[i].lines,
                 cases[i].lines);
        write_text(mtl, text);
        assert_told_once(cases[i].word);
    }
    write_text(mtl, "Pr 0.5\nnewmtl m\nPr 0.5");
    assert_told_once("Pr before the first newmtl");
    write_text(mtl, "newmtl other\n");
    assert_told_once("usemtl of a name");
    unlink(mtl);
    write_obj("");
    assert_told_once("usemtl of a name");
    write_obj("mtllib render-absent.mtl");
    load_and_listen();
    assert_non_null(strstr(told[0], "render-absent.mtl cannot be read"));
}

/* ---- Harm ------------------------------------------------------------------------------------------ */

/* Shown or refused, whatever it is. */
static void load_anything(void) {
    lobe_scene *scene = NULL;
    if (lobe_scene_load(obj, lobe_scene_default_options(), &scene) != LOBE_RENDER_OK)
        assert_true(lobe_render_error_message()[0] != 0);
    lobe_scene_free(scene);
}

static void strange_libraries_do_no_harm(void **state) {
    (void)state;
    enum { LONG = 100000 };
    static char text[2 * LONG];
    static const char *const starts[] = {"newmtl ", "newmtl m\nmap_Kd ", "newmtl m\nKd ", "",
                                         "newmtl m\nmap_Kd -o "};
    write_obj("mtllib render-obj.mtl");
    for (int i = 0; i < 5; ++i) {
        const size_t start = strlen(starts[i]);
        memcpy(text, starts[i], start);
        memset(text + start, '7', LONG);
        write_bytes(mtl, text, start + LONG);
        load_anything();
    }
    for (size_t i = 0; i < LONG; ++i) text[i] = "newmtl\n"[i % 7];
    write_bytes(mtl, text, LONG);
    load_anything();
    write_bytes(mtl, "\0newmtl m\0Kd 1 1 1\0", 19);
    load_anything();
    write_bytes(mtl, "", 0);
    load_anything();
    unlink(mtl);
    assert_int_equal(mkdir(mtl, 0700), 0);
    load_anything();
    rmdir(mtl);
    write_obj("mtllib render-obj.obj\nmap_Kd x.png\naniso 1"); /* itself */
    load_anything();
    assert_int_equal(mkfifo(mtl, 0600), 0);
    write_obj("mtllib render-obj.mtl");
    load_anything();
    unlink(mtl);
}

static uint32_t draw(uint64_t *index, uint32_t below) {
    return (uint32_t)(((uint64_t)lobe_random(seed, 78, (*index)++).word[0] * below) >> 32);
}

static void damage_does_no_harm(void **state) {
    (void)state;
    static const char whole[] =
        "newmtl m\nKd 0.8 0.4 0.2\nmap_Kd -o 0 0.5 -s 1 1 1 -clamp on render-obj-color.ppm\nPr "
        "0.5\n"
        "map_Pr render-obj-rough.ppm\naniso 0.5\nanisor 0.1\nd 0.5\nillum 7\nPc 1\nmap_d "
        "render-obj-alpha.tga\nnorm -bm 0.5 render-obj-normal.ppm\nNi 1.5\nTf 1 1 1\nKe 0 0 0\n";
    static const char bytes[] = "\n\n\r\0 \t-#.0e9nm\f\xff";
    write_obj("mtllib render-obj.mtl");
    for (unsigned long round = 0; round < rounds; ++round) {
        uint64_t index = 1000 * round;
        char bad[sizeof whole];
        memcpy(bad, whole, sizeof whole);
        for (uint32_t n = 1 + draw(&index, 8); n > 0; --n)
            bad[draw(&index, sizeof whole - 1)] = bytes[draw(&index, sizeof bytes - 1)];
        write_bytes(mtl, bad, draw(&index, 4) ? sizeof whole - 1 : draw(&index, sizeof whole));
        load_anything();
    }
}

int main(int argc, char **argv) {
    if (argc > 1) rounds = strtoul(argv[1], NULL, 10);
    if (argc > 2) seed = strtoul(argv[2], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(materials_are_those_of_gltf),
        cmocka_unit_test(what_is_not_read_is_named),
        cmocka_unit_test(strange_libraries_do_no_harm),
        cmocka_unit_test(damage_does_no_harm),
    };
    return cmocka_run_group_tests(tests, write_files, remove_files);
}
