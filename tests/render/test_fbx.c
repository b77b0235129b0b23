/* tests/render/test_fbx.c: an FBX file shows what the same scene in glTF shows: axes, units, materials, cameras, lights,
 * animated nodes; what is not read is named, of other files by Assimp as well. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "gltf_square.h"
#include "pictures.h"
#include "told.h"

#include <unistd.h>

static const char fbx[] = "render-fbx.fbx", glb[] = "render-fbx.glb", ply[] = "render-fbx.ply";

static int remove_files(void **state) {
    (void)state;
    unlink(fbx);
    unlink(glb);
    unlink(ply);
    return 0;
}

/* What varies: properties of the material, of the light, more objects and connections. */
typedef struct fbx_file {
    const char *material, *light, *objects, *connections;
    int is_upright; /* Y is up and units are metres; else Z and centimetres */
} fbx_file;

#define P(name, type, value) "P: \"" name "\", \"" type "\", \"\", \"A\"," value "\n"

/* The square of gltf_square.h, its camera, and a light from above and before it. 3 is as bright as 3 of glTF. */
static void write_fbx(fbx_file f) {
    FILE *file = fopen(fbx, "wb");
    assert_non_null(file);
    fprintf(file,
            "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: "
            "7400\n}\n"
            "GlobalSettings: {\nVersion: 1000\nProperties70: {\n%s}\n}\nObjects: {\n",
            f.is_upright
                ? P("UpAxis", "int", "1") P("UpAxisSign", "int", "1") P("FrontAxis", "int", "2")
                      P("FrontAxisSign", "int", "1") P("UnitScaleFactor", "double", "100")
                : P("UpAxis", "int", "2") P("UpAxisSign", "int", "1") P("FrontAxis", "int", "1")
                      P("FrontAxisSign", "int", "-1") P("UnitScaleFactor", "double", "1"));
    fprintf(
        file,
        "Geometry: 100, \"Geometry::square\", \"Mesh\" {\nVertices: *12 {\na: %s\n}\n"
        "PolygonVertexIndex: *6 {\na: 0,1,-3,0,2,-4\n}\nGeometryVersion: 124\n"
        "LayerElementMaterial: 0 {\nVersion: 101\nName: \"\"\nMappingInformationType: \"AllSame\"\n"
        "ReferenceInformationType: \"IndexToDirect\"\nMaterials: *1 {\na: 0\n}\n}\n"
        "Layer: 0 {\nVersion: 100\nLayerElement: {\nType: \"LayerElementMaterial\"\n"
        "TypedIndex: 0\n}\n}\n}\n"
        "Model: 200, \"Model::square\", \"Mesh\" {\nVersion: 232\n}\n",
        f.is_upright ? "-1,-1,0,1,-1,0,1,1,0,-1,1,0"
                     : "-100,0,-100,100,0,-100,100,0,100,-100,0,100");
    fprintf(file,
            "Material: 300, \"Material::m\", \"\" {\nVersion: 102\nShadingModel: \"phong\"\n"
            "Properties70: {\n%s}\n}\n",
            f.material);
    fprintf(file,
            "NodeAttribute: 400, \"NodeAttribute::eye\", \"Camera\" {\nProperties70: {\n%s}\n}\n"
            "Model: 401, \"Model::eye\", \"Camera\" {\nVersion: 232\nProperties70: {\n%s}\n}\n",
            P("AspectWidth", "double", "100") P("AspectHeight", "double", "100")
                P("FieldOfView", "FieldOfView", "22.918312"),
            f.is_upright ? P("Lcl Translation", "Lcl Translation", "0,0,4")
                               P("Lcl Rotation", "Lcl Rotation", "0,90,0")
                         : P("Lcl Translation", "Lcl Translation", "0,-400,0")
                               P("Lcl Rotation", "Lcl Rotation", "90,0,90"));
    fprintf(file,
            "NodeAttribute: 500, \"NodeAttribute::sun\", \"Light\" {\nProperties70: {\n%s}\n}\n"
            "Model: 501, \"Model::sun\", \"Light\" {\nVersion: 232\nProperties70: {\n%s}\n}\n",
            f.light,
            f.is_upright ? P("Lcl Rotation", "Lcl Rotation", "60,0,0")
                         : P("Lcl Rotation", "Lcl Rotation", "150,0,0"));
    fprintf(file,
            "%s}\nConnections: {\nC: \"OO\",200,0\nC: \"OO\",100,200\nC: \"OO\",300,200\nC: "
            "\"OO\",401,0\n"
            "C: \"OO\",400,401\nC: \"OO\",501,0\nC: \"OO\",500,501\n%s}\n",
            f.objects ? f.objects : "", f.connections ? f.connections : "");
    fclose(file);
}

#define SUN P("LightType", "enum", "1") P("Intensity", "Number", "300")
#define LAMP P("LightType", "enum", "0") P("Intensity", "Number", "300")
#define PAINT P("DiffuseColor", "Color", "0.8,0.4,0.2") P("ShininessExponent", "Number", "25")

/* Moves the square by half of a metre in a second. */
#define MOVES                                                                                      \
    "AnimationStack: 600, \"AnimStack::walk\", \"\" {\n}\n"                                        \
    "AnimationLayer: 601, \"AnimLayer::base\", \"\" {\n}\n"                                        \
    "AnimationCurveNode: 602, \"AnimCurveNode::T\", \"\" {\nProperties70: {\n" P(                  \
        "d|X", "Number", "0") P("d|Y", "Number", "0")                                              \
        P("d|Z", "Number",                                                                         \
          "0") "}\n}\n"                                                                            \
               "AnimationCurve: 603, \"AnimCurve::\", \"\" {\nDefault: 0\nKeyVer: 4008\n"          \
               "KeyTime: *2 {\na: 0,46186158000\n}\nKeyValueFloat: *2 {\na: 0,50\n}\n"             \
               "KeyAttrFlags: *1 {\na: 24836\n}\nKeyAttrDataFloat: *4 {\na: 0,0,0,0\n}\n"          \
               "KeyAttrRefCount: *1 {\na: 2\n}\n}\n"
#define MOVED                                                                                      \
    "C: \"OO\",601,600\nC: \"OO\",602,601\nC: \"OP\",602,200, \"Lcl Translation\"\n"               \
    "C: \"OP\",603,602, \"d|X\"\n"

/* The same in glTF. */
static void write_gltf(const char *material, const char *place) {
    char nodes[300];
    snprintf(nodes, sizeof nodes,
             "{\"mesh\":0%s},{\"rotation\":[-0.25881905,0,0,0.96592583],\"extensions\":{"
             "\"KHR_lights_punctual\":{\"light\":0}}}",
             place);
    write_square_file(
        glb, (square_file){.material = material,
                           .nodes = nodes,
                           .children = "0,1,2",
                           .attributes = "\"POSITION\":0",
                           .more = ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{"
                                   "\"type\":\"directional\",\"intensity\":3}]}}"});
}

#define GLTF(color, rest) "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[" color "]," rest
#define GLTF_PAINT GLTF("0.8,0.4,0.2,1", "\"roughnessFactor\":0.5,\"metallicFactor\":0}}")

enum { SIZE = 16 };
typedef struct sight {
    float rgb[SIZE * SIZE * 3], depth[SIZE * SIZE];
} sight;

static lobe_scene_options listening(double time) {
    lobe_scene_options options = lobe_scene_default_options();
    options.frame_time = time;
    options.warning = tell;
    tellings = 0;
    return options;
}

static sight look(const char *path, double time) {
    lobe_scene *scene = NULL;
    if (lobe_scene_load(path, listening(time), &scene) != LOBE_RENDER_OK || tellings)
        fail_msg("%s %s", lobe_render_error_message(), told[0]);
    lobe_render_options o = small(SIZE, SIZE, 16);
    o.depth = 1;
    o.camera = "eye";
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_DEPTH);
    lobe_film *film = render(scene, o, NULL);
    sight s;
    assert_true(lobe_film_copy_rgb(film, s.rgb));
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_DEPTH, s.depth));
    lobe_film_free(film);
    lobe_scene_free(scene);
    return s;
}

static float difference(const float *a, const float *b, int count) {
    float most = 0.0f, greatest = 1e-6f;
    for (int i = 0; i < count; ++i) {
        most = fmaxf(most, fabsf(a[i] - b[i]));
        greatest = fmaxf(greatest, fmaxf(fabsf(a[i]), fabsf(b[i])));
    }
    return most / greatest;
}

/* Edges fall between samples here and there: rounding of a camera's angle moves them. */
static void assert_same(const sight *a, const sight *b, const char *what) {
    const float color = difference(a->rgb, b->rgb, SIZE * SIZE * 3);
    const float depth = difference(a->depth, b->depth, SIZE * SIZE);
    if (!(color < 1e-3f && depth < 1e-3f)) fail_msg("%s is off by %g, %g", what, color, depth);
}

/* Z is up and a unit a centimetre, or Y and a metre: then the light is turned to be the same. */
static void axes_and_units_are_those_of_the_file(void **state) {
    (void)state;
    write_gltf(GLTF_PAINT, "");
    const sight right = look(glb, NAN);
    for (int is_upright = 0; is_upright < 2; ++is_upright) {
        write_fbx((fbx_file){.material = PAINT, .light = SUN, .is_upright = is_upright});
        const sight v = look(fbx, NAN);
        assert_same(&v, &right, is_upright ? "the upright square" : "the lying square");
    }
}

static void materials_are_those_of_the_file(void **state) {
    (void)state;
    static const struct {
        const char *fbx, *gltf;
    } pairs[] = {
        {PAINT P("Maya|metallic", "float", "1") P("Maya|roughness", "float", "0.4"),
         GLTF("0.8,0.4,0.2,1", "\"roughnessFactor\":0.4,\"metallicFactor\":1}}")},
        {PAINT P("Opacity", "double", "0.4"),
         GLTF("0.8,0.4,0.2,0.4", "\"roughnessFactor\":0.5,\"metallicFactor\":0},"
                                 "\"alphaMode\":\"BLEND\"}")},
        {PAINT P("EmissiveColor", "Color", "0.5,0.25,1") P("EmissiveFactor", "Number", "0.5"),
         GLTF("0.8,0.4,0.2,1", "\"roughnessFactor\":0.5,\"metallicFactor\":0},"
                               "\"emissiveFactor\":[0.25,0.125,0.5]}")},
    };
    write_gltf(GLTF_PAINT, "");
    const sight paint = look(glb, NAN);
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; ++i) {
        write_fbx((fbx_file){.material = pairs[i].fbx, .light = SUN});
        write_gltf(pairs[i].gltf, "");
        const sight a = look(fbx, NAN), b = look(glb, NAN);
        assert_same(&a, &b, pairs[i].gltf);
        assert_true(difference(a.rgb, paint.rgb, SIZE * SIZE * 3) > 0.05f);
    }
}

static void nodes_move(void **state) {
    (void)state;
    static const struct {
        double time;
        const char *place;
    } moments[] = {{0.0, ""},
                   {0.5, ",\"translation\":[0.25,0,0]"},
                   {-1.0, ""},
                   {7.0, ",\"translation\":[0.5,0,0]"}};
    for (size_t i = 0; i < sizeof moments / sizeof *moments; ++i) {
        write_fbx(
            (fbx_file){.material = PAINT, .light = SUN, .objects = MOVES, .connections = MOVED});
        const sight a = look(fbx, moments[i].time);
        write_gltf(GLTF_PAINT, moments[i].place);
        const sight b = look(glb, NAN);
        assert_same(&a, &b, "what moves");
    }
    lobe_scene *scene = NULL;
    lobe_scene_options options = listening(0.5);
    options.animation = "run";
    assert_int_equal(lobe_scene_load(fbx, options, &scene), LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "no animation named run"));
}

static void assert_told_once(const char *path, const char *word) {
    lobe_scene *scene = NULL;
    lobe_scene_options options = listening(NAN);
    assert_int_equal(lobe_scene_load(path, options, &scene), LOBE_RENDER_OK);
    if (tellings != 1 || !strstr(told[0], word))
        fail_msg("%s: %d warnings, the first: %s", word, tellings, told[0]);
    lobe_scene_free(scene);
    options.strict = 1;
    assert_int_equal(lobe_scene_load(path, options, &scene), LOBE_RENDER_BAD_INPUT);
}

static void what_is_not_read_is_named(void **state) {
    (void)state;
    write_fbx((fbx_file){.material = PAINT, .light = LAMP});
    assert_told_once(fbx, "not directional, the first one sun");
    write_fbx((fbx_file){.material = PAINT, .light = SUN, .objects = MOVES, .connections = MOVED});
    assert_told_once(fbx, "is animated");
    write_fbx((fbx_file){.material = PAINT P("3dsMax|main|metalness", "float", "1"), .light = SUN});
    assert_told_once(fbx, "parameters of one program");
    write_fbx((fbx_file){
        .material = PAINT,
        .light = SUN,
        .objects =
            "Texture: 700, \"Texture::t\", \"\" {\nType: \"TextureVideoClip\"\nVersion: 202\n"
            "FileName: \"x.png\"\nRelativeFilename: \"x.png\"\n}\n",
        .connections = "C: \"OP\",700,300, \"SpecularColor\"\n"});
    assert_told_once(fbx, "have Specular pictures");
    static const char colored[] =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
        "float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 255 0 0\n1 0 0 255 0 0\n0 1 0 "
        "255 0 0\n"
        "3 0 1 2\n";
    write_bytes(ply, colored, sizeof colored - 1);
    assert_told_once(ply, "colours of vertices");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(axes_and_units_are_those_of_the_file),
        cmocka_unit_test(materials_are_those_of_the_file),
        cmocka_unit_test(nodes_move),
        cmocka_unit_test(what_is_not_read_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, getenv("KEEP") ? NULL : remove_files);
}
