/* tests/ssr/test_moving.c: frames of a scene in motion: how far each place has moved, against projections in double,
 * and what reflections gain by knowing it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <unistd.h>

#include "lobe/ssr_frames.h"
#include "tests/render/gltf_square.h"

static const char name[] = "ssr-moving.glb";

enum { WIDTH = 160, HEIGHT = 90, PIXELS = WIDTH * HEIGHT, FRAMES = 3 };

static const double turn = 1.5707963267948966; /* about +Y, of the second key */
static const double seconds = 0.125;           /* from frame to frame */

/* ---- A square in motion ---------------------------------------------------------------------- */

/* The numbers of the file: its accessors, from FIRST_ACCESSOR on. */
typedef struct numbers {
    float times[2], shift[6], rotation[8], scale[6], weights[2], growth[6], bind[16];
    float delta[12];                  /* of a morph target */
    float share[16];                  /* of the one joint at each vertex */
    float places[3 * 1001], wide[27]; /* of instances; a mesh of 9 vertices and 16 triangles */
    uint16_t joint[16], corners[48];
} numbers;

enum {
    TIMES = ACCESSORS,
    SHIFT,
    ROTATION,
    SCALE,
    WEIGHTS,
    GROWTH,
    BIND,
    DELTA,
    SHARE,
    PLACES,
    WIDE,
    JOINT,
    CORNERS,
    ACCESSORS_END
};

static const struct {
    size_t offset;
    const char *type;
    int form, count;
} accessors[] = {
    [TIMES] = {offsetof(numbers, times), "SCALAR", 5126, 2},
    [SHIFT] = {offsetof(numbers, shift), "VEC3", 5126, 2},
    [ROTATION] = {offsetof(numbers, rotation), "VEC4", 5126, 2},
    [SCALE] = {offsetof(numbers, scale), "VEC3", 5126, 2},
    [WEIGHTS] = {offsetof(numbers, weights), "SCALAR", 5126, 2},
    [GROWTH] = {offsetof(numbers, growth), "VEC3", 5126, 2},
    [BIND] = {offsetof(numbers, bind), "MAT4", 5126, 1},
    [DELTA] = {offsetof(numbers, delta), "VEC3", 5126, 4},
    [SHARE] = {offsetof(numbers, share), "VEC4", 5126, 4},
    [PLACES] = {offsetof(numbers, places), "VEC3", 5126, 1001},
    [WIDE] = {offsetof(numbers, wide), "VEC3", 5126, 9},
    [JOINT] = {offsetof(numbers, joint), "VEC4", 5123, 4},
    [CORNERS] = {offsetof(numbers, corners), "SCALAR", 5123, 48},
};

static void fill_numbers(numbers *n) {
    *n = (numbers){.times = {0, 1},
                   .shift = {0.1f, -0.2f, -0.3f, -0.5f, 0.3f, 0.7f},
                   .rotation = {0, 0, 0, 1, 0, (float)sin(turn / 2), 0, (float)cos(turn / 2)},
                   .scale = {1, 1, 1, 0.5f, 1.5f, 1},
                   .weights = {0.25f, 1.25f},
                   .growth = {0, 0, 0, 1, 1, 1},
                   .bind = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}};
    for (int i = 0; i < 4; i++) { /* a shear: (x, y, 0) goes by (y/2, 0, x/4) */
        n->delta[3 * i] = 0.5f * square_arrays.positions[3 * i + 1];
        n->delta[3 * i + 2] = 0.25f * square_arrays.positions[3 * i];
    }
    for (int i = 0; i < 4; i++) n->share[4 * i] = 1.0f;
    for (int i = 3; i < 3 * 1001; i++) n->places[i] = 1000.0f;
    for (int i = 0; i < 9; i++) {
        n->wide[3 * i] = (float)(i % 3 - 1);
        n->wide[3 * i + 1] = (float)(i / 3 - 1);
    }
    for (int k = 0; k < 8; k++) {
        const int a = k / 2 % 2 + k / 4 * 3, quad[6] = {a, a + 1, a + 4, a, a + 4, a + 3};
        for (int i = 0; i < 6; i++) n->corners[6 * k + i] = (uint16_t)quad[i]; /* twice each */
    }
}

/* The way that the square is moved: node 1 by its mesh, by a joint, by a morph target, or as one of many. */
typedef enum way { BY_NODE, BY_JOINT, BY_TARGET, AS_INSTANCE, WAYS } way;

/* Text after text. */
static void add(char *to, size_t room, const char *format, ...) {
    const size_t length = strlen(to);
    va_list values;
    va_start(values, format);
    const int added = vsnprintf(to + length, room - length, format, values);
    va_end(values);
    assert_true(added >= 0 && (size_t)added < room - length);
}

static void print_accessors(char *text, size_t room) {
    for (int i = TIMES; i < ACCESSORS_END; i++)
        add(text, room,
            ",{\"bufferView\":%d,\"byteOffset\":%zu,\"componentType\":%d,\"type\":\"%s\","
            "\"count\":%d}",
            VIEWS, accessors[i].offset, accessors[i].form, accessors[i].type, accessors[i].count);
}

/* Mesh 1. */
static void print_mesh(char *text, size_t room, way w) {
    if (w == BY_JOINT)
        add(text, room,
            ",{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":%d,\"WEIGHTS_0\":%d},"
            "\"indices\":8,\"material\":0}]}",
            JOINT, SHARE);
    if (w == BY_TARGET)
        add(text, room,
            ",{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":8,\"material\":0,"
            "\"targets\":[{\"POSITION\":%d}]}]}",
            DELTA);
    if (w == AS_INSTANCE)
        add(text, room,
            ",{\"primitives\":[{\"attributes\":{\"POSITION\":%d},\"indices\":%d,\"material\":0}]}",
            WIDE, CORNERS);
}

/* Node 1 moves. Behind the camera stands what grows out of nothing: at the start it has no triangles. What has a
 * skin goes with its joints. */
static void print_nodes(char *text, size_t room, way w) {
    if (w == BY_NODE) add(text, room, "{\"mesh\":0}");
    if (w == BY_JOINT) add(text, room, "{\"name\":\"joint\"}");
    if (w == BY_TARGET) add(text, room, "{\"mesh\":1}");
    if (w == AS_INSTANCE)
        add(text, room,
            "{\"mesh\":1,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{"
            "\"TRANSLATION\":%d}}}}",
            PLACES);
    add(text, room, ",{\"mesh\":0,\"translation\":[0,0,20]}");
    if (w == BY_JOINT) add(text, room, ",{\"mesh\":1,\"skin\":0}");
}

static void print_motion(char *text, size_t room, way w) {
    if (w == BY_JOINT)
        add(text, room, ",\"skins\":[{\"joints\":[1],\"inverseBindMatrices\":%d}]", BIND);
    add(text, room,
        ",\"animations\":[{\"channels\":["
        "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}},"
        "{\"sampler\":1,\"target\":{\"node\":1,\"path\":\"rotation\"}},"
        "{\"sampler\":2,\"target\":{\"node\":1,\"path\":\"scale\"}},"
        "{\"sampler\":4,\"target\":{\"node\":2,\"path\":\"scale\"}}%s],\"samplers\":[",
        w == BY_TARGET ? ",{\"sampler\":3,\"target\":{\"node\":1,\"path\":\"weights\"}}" : "");
    for (int i = SHIFT; i <= GROWTH; i++)
        add(text, room, "%s{\"input\":%d,\"output\":%d}", i > SHIFT ? "," : "", TIMES, i);
    add(text, room, "]}]");
}

static void write_moving(way w) {
    static numbers n;
    char views[200], text[2000] = "", more[2000] = "", mesh[400] = "", nodes[400] = "";
    fill_numbers(&n);
    snprintf(views, sizeof views, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
             sizeof square_arrays, sizeof n);
    print_accessors(text, sizeof text);
    print_mesh(mesh, sizeof mesh, w);
    print_nodes(nodes, sizeof nodes, w);
    print_motion(more, sizeof more, w);
    write_square_file(name, (square_file){.nodes = nodes,
                                          .children = w == BY_JOINT ? "2,3,0,1" : "2,0,1",
                                          .meshes = mesh,
                                          .views = views,
                                          .accessors = text,
                                          .more = more,
                                          .binary = &n,
                                          .binary_size = sizeof n});
}

/* ---- Projections in double ------------------------------------------------------------------- */

typedef struct vector {
    double x, y, z;
} vector;

static vector sum(vector a, vector b, double t) {
    return (vector){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

static double dot(vector a, vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vector cross(vector a, vector b) {
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static vector in_double(lobe_vec3_f32 a) {
    return (vector){(double)a.x, (double)a.y, (double)a.z};
}

/* (x, y) of the square lies at middle + x right + y up. */
typedef struct square {
    vector middle, right, up;
} square;

static vector placed(vector v, double t) {
    const double c = cos(turn * t), s = sin(turn * t);
    v.x *= 1 - 0.5 * t;
    v.y *= 1 + 0.5 * t;
    return (vector){c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

static square square_at(way w, double t) {
    const double bent = w == BY_TARGET ? 0.25 + t : 0;
    square q = {{0.1 - 0.6 * t, -0.2 + 0.5 * t, -0.3 + t}, {1, 0, 0.25 * bent}, {0.5 * bent, 1, 0}};
    q.right = placed(q.right, t);
    q.up = placed(q.up, t);
    return q;
}

/* In pixels; z: along the axis. */
static vector project(const lobe_ssr_camera *c, vector place) {
    const vector to = sum(place, in_double(c->eye), -1);
    const double z = dot(to, in_double(c->forward));
    const double x = dot(to, in_double(c->right)) / (z * (double)c->tan_x);
    const double y = dot(to, in_double(c->up)) / (z * (double)c->tan_y);
    return (vector){(0.5 + 0.5 * x) * WIDTH, (0.5 - 0.5 * y) * HEIGHT, z};
}

/* Where a pixel's ray meets the square's plane: its (x, y), and the distance along the axis as z. */
static vector meet(const lobe_ssr_camera *c, const square *q, int pixel) {
    const double x = (2 * (pixel % WIDTH + 0.5) / WIDTH - 1) * (double)c->tan_x;
    const double y = (1 - 2 * (pixel / WIDTH + 0.5) / HEIGHT) * (double)c->tan_y;
    const vector d = sum(sum(in_double(c->forward), in_double(c->right), x), in_double(c->up), y);
    const vector from = sum(in_double(c->eye), q->middle, -1), n = cross(q->right, q->up);
    const double t = -dot(from, n) / dot(d, n), bottom = dot(n, n);
    const vector at = sum(from, d, t);
    return (vector){dot(cross(at, q->up), n) / bottom, dot(cross(q->right, at), n) / bottom, t};
}

static lobe_ssr_frames *open_moving(lobe_ssr_path path, const char *camera, int count) {
    lobe_ssr_scene_options o = lobe_ssr_scene_default_options();
    lobe_scene_options so = lobe_scene_default_options();
    lobe_ssr_frames *frames = NULL;
    o.width = WIDTH;
    o.height = HEIGHT;
    o.count = count;
    o.samples = 2;
    o.path = path;
    o.camera = camera;
    so.frame_time = 0;
    if (lobe_ssr_frames_of_animation(name, so, seconds, o, &frames) != LOBE_SSR_OK)
        fail_msg("%s", lobe_ssr_error_message());
    return frames;
}

/* Pixels that show the square; each has moved as it did. */
static int compare(const lobe_ssr_frame *f, way w, int index, double *farthest) {
    const int last = index > 0 ? index - 1 : 0;
    const square now = square_at(w, index * seconds), before = square_at(w, last * seconds);
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        const vector at = meet(&f->camera, &now, i);
        if (!(fabs(at.x) < 0.995 && fabs(at.y) < 0.995 && at.z > 0)) continue;
        const vector was = project(&f->previous_camera,
                                   sum(sum(before.middle, before.right, at.x), before.up, at.y));
        const double right = i % WIDTH + 0.5 - was.x, down = i / WIDTH + 0.5 - was.y;
        const double off = hypot((double)f->motion[2 * i] * WIDTH - right,
                                 (double)f->motion[2 * i + 1] * HEIGHT - down);
        if (!(off < 1e-3 && fabs((double)f->z[i] - at.z) < 1e-4 &&
              fabs((double)f->motion_z[i] - (at.z - was.z)) < 1e-4))
            fail_msg("way %d, frame %d, pixel %d: motion (%g, %g) is off by %g pixels; z %g, not "
                     "%g, by %g, not %g",
                     w, index, i, right, down, off, (double)f->z[i], at.z, (double)f->motion_z[i],
                     at.z - was.z);
        *farthest = fmax(*farthest, hypot(right, down));
        count++;
    }
    return count;
}

static void motion_is_that_of_the_places(void **state) {
    (void)state;
    static const int order[] = {0, 1, 2, 0, 2, 1}; /* any */
    for (way w = 0; w < WAYS; w++) {
        write_moving(w);
        lobe_ssr_frames *frames = open_moving(LOBE_SSR_PATH_ORBIT, NULL, FRAMES);
        double farthest = 0;
        for (size_t k = 0; k < sizeof order / sizeof *order; k++) {
            lobe_ssr_frame f;
            assert_int_equal(lobe_ssr_frames_get(frames, order[k], &f), LOBE_SSR_OK);
            assert_non_null(f.motion_z);
            const int count = compare(&f, w, order[k], &farthest);
            if (count < PIXELS / 4) fail_msg("way %d, frame %d: %d pixels", w, order[k], count);
        }
        if (!(farthest > 5)) fail_msg("way %d: %g pixels at most", w, farthest);
        lobe_ssr_frames_free(frames);
    }
    unlink(name);
}

static lobe_rays *rays_of(lobe_scene **scene, way w) {
    lobe_rays *rays = NULL;
    write_moving(w);
    assert_int_equal(lobe_scene_load(name, lobe_scene_default_options(), scene), LOBE_RENDER_OK);
    assert_int_equal(lobe_scene_get_info(*scene).instances, w == AS_INSTANCE ? 1001 : 0);
    assert_int_equal(lobe_rays_create(*scene, &rays), LOBE_RENDER_OK);
    return rays;
}

/* Numbers of one file say nothing of another. */
static void places_of_other_parts_are_not_found(void **state) {
    (void)state;
    lobe_scene *scenes[2];
    lobe_rays *single = rays_of(&scenes[0], BY_NODE), *many = rays_of(&scenes[1], AS_INSTANCE);
    const lobe_vec3_f32 eye = {0.1f, 0.1f, 4}, ahead = {0, 0, -1};
    lobe_ray_surface met;
    lobe_vec3_f32 place;
    assert_true(lobe_rays_meet(many, eye, ahead, &met));
    assert_true(lobe_rays_find(many, many, &met.place, &place));
    assert_memory_equal(&place, &met.position, sizeof place);
    assert_false(lobe_rays_find(single, many, &met.place, &place));
    assert_true(lobe_rays_meet(single, eye, ahead, &met));
    assert_false(lobe_rays_find(many, single, &met.place, &place));
    for (int i = 0; i < 2; i++) {
        lobe_rays_free(i ? many : single);
        lobe_scene_free(scenes[i]);
    }
    unlink(name);
}

static void moments_are_checked(void **state) {
    (void)state;
    const lobe_ssr_scene_options o = lobe_ssr_scene_default_options();
    lobe_scene_options so = lobe_scene_default_options();
    lobe_ssr_frames *frames = NULL;
    write_moving(BY_NODE);
    assert_int_equal(lobe_ssr_frames_of_animation(name, so, 1, o, &frames), LOBE_SSR_BAD_INPUT);
    assert_non_null(strstr(lobe_ssr_error_message(), "ssr-moving.glb: the moment"));
    so.frame_time = 0;
    assert_int_equal(lobe_ssr_frames_of_animation(name, so, (double)NAN, o, &frames),
                     LOBE_SSR_BAD_INPUT);
    unlink(name);
    assert_int_equal(lobe_ssr_frames_of_animation(name, so, 1, o, &frames), LOBE_SSR_BAD_INPUT);
    /* the file goes away while frames are made: what there is stays usable */
    write_moving(BY_NODE);
    frames = open_moving(LOBE_SSR_PATH_STILL, NULL, FRAMES);
    lobe_ssr_frame f;
    static float rgb[3 * PIXELS], screen[PIXELS];
    assert_int_equal(lobe_ssr_frames_get(frames, 0, &f), LOBE_SSR_OK);
    unlink(name);
    assert_int_equal(lobe_ssr_frames_get(frames, 1, &f), LOBE_SSR_BAD_INPUT);
    assert_int_equal(lobe_ssr_frames_get(frames, 2, &f), LOBE_SSR_BAD_INPUT);
    assert_int_equal(lobe_ssr_truth(frames, LOBE_SSR_MIRROR, 1, rgb, screen), LOBE_SSR_OK);
    write_moving(BY_NODE);
    assert_int_equal(lobe_ssr_frames_get(frames, 1, &f), LOBE_SSR_OK);
    lobe_ssr_frames_free(frames);
    unlink(name);
}

/* A scene loaded once and one loaded moment by moment are the same if nothing moves, and so is a file without
 * animation. */
static void what_rests_has_the_same_bits(void **state) {
    (void)state;
    lobe_scene *scene = NULL;
    lobe_ssr_frames *plain = NULL;
    write_square_file(name, (square_file){0});
    assert_int_equal(lobe_scene_load(name, lobe_scene_default_options(), &scene), LOBE_RENDER_OK);
    lobe_ssr_scene_options o = lobe_ssr_scene_default_options();
    o.width = WIDTH;
    o.height = HEIGHT;
    o.samples = 1;
    assert_int_equal(lobe_ssr_frames_of_scene(scene, o, &plain), LOBE_SSR_OK);
    lobe_scene_options so = lobe_scene_default_options();
    lobe_ssr_frames *timed = NULL;
    so.frame_time = 3;
    assert_int_equal(lobe_ssr_frames_of_animation(name, so, 1, o, &timed), LOBE_SSR_OK);
    lobe_ssr_frame a, b;
    assert_int_equal(lobe_ssr_frames_get(plain, 2, &a), LOBE_SSR_OK);
    assert_int_equal(lobe_ssr_frames_get(timed, 2, &b), LOBE_SSR_OK);
    assert_null(b.motion_z);
    assert_memory_equal(a.motion, b.motion, 2 * PIXELS * sizeof(float));
    assert_memory_equal(a.previous_color, b.previous_color, 3 * PIXELS * sizeof(float));
    lobe_ssr_frames_free(plain);
    lobe_ssr_frames_free(timed);
    lobe_scene_free(scene);
    unlink(name);
}

/* ---- A chequered square before a mirror floor ------------------------------------------------- */

static const float sideways[] = {-1.2f, 0, -2, 4, 0, -2};

static void write_room(void) {
    float numbers[2 + 6] = {0, 1};
    char views[200], text[400];
    memcpy(numbers + 2, sideways, sizeof sideways);
    snprintf(views, sizeof views, ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
             sizeof square_arrays, sizeof numbers);
    snprintf(text, sizeof text,
             ",{\"bufferView\":%d,\"componentType\":5126,\"type\":\"SCALAR\",\"count\":2},"
             "{\"bufferView\":%d,\"byteOffset\":8,\"componentType\":5126,\"type\":\"VEC3\","
             "\"count\":2}",
             VIEWS, VIEWS);
    write_square_file(
        name,
        (square_file){
            .material = "{\"extensions\":{\"KHR_materials_unlit\":{}},\"pbrMetallicRoughness\":{"
                        "\"baseColorTexture\":{\"index\":1,\"extensions\":{"
                        "\"KHR_texture_transform\":{\"scale\":[4,4]}}}}},"
                        "{\"pbrMetallicRoughness\":{\"metallicFactor\":1,\"roughnessFactor\":0.1}}",
            .meshes = ",{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":8,"
                      "\"material\":1}]}",
            /* the square, the floor, and a camera above it that looks down by 0.2 */
            .nodes = "{\"mesh\":0},{\"mesh\":1,\"translation\":[0,-1,0],\"scale\":[8,8,8],"
                     "\"rotation\":[-0.70710678,0,0,0.70710678]},{\"camera\":0,\"name\":\"high\","
                     "\"translation\":[0,1.5,6],\"rotation\":[-0.0998334,0,0,0.9950042]}",
            .children = "0,1,2,3",
            .views = views,
            .accessors = text,
            .more = ",\"animations\":[{\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,"
                    "\"path\":\"translation\"}}],\"samplers\":[{\"input\":12,\"output\":13}]}]",
            .binary = numbers,
            .binary_size = sizeof numbers});
}

/* What is reflected, the last frame's too, and sums of errors. */
typedef struct judged {
    lobe_ssr *ssr;
    float *last;
    double error, change;
} judged;

static void open_judged(judged *j) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.fade_start = o.fade_end = 0.5f; /* the floor alone */
    o.bias = 0;
    *j = (judged){.last = calloc(3 * PIXELS, sizeof(float))};
    assert_non_null(j->last);
    assert_int_equal(lobe_ssr_create(WIDTH, HEIGHT, o, &j->ssr), LOBE_SSR_OK);
}

static void judge(judged *j, const lobe_ssr_frame *f, const lobe_ssr_frames *frames,
                  const float *truth, const float *truth_last, const float *screen) {
    assert_int_equal(lobe_ssr_run(j->ssr, f, NULL), LOBE_SSR_OK);
    const float *seen = lobe_ssr_radiance(j->ssr);
    if (truth_last) {
        j->error += lobe_ssr_judge(frames, j->ssr, truth, screen).relmse_onscreen;
        for (int i = 0; i < 3 * PIXELS; i++) {
            const double change = (double)seen[i] - (double)j->last[i];
            const double right = (double)truth[i] - (double)truth_last[i];
            const double scale = (double)truth[i] * (double)truth[i] + 0.01;
            const int is_traced = lobe_ssr_rays(j->ssr)[i / 3].state != LOBE_SSR_NO_RAY;
            if (is_traced && screen[i / 3] >= 0.5f && truth_last[i] > 0)
                j->change += (change - right) * (change - right) / scale / PIXELS;
        }
    }
    memcpy(j->last, seen, 3 * PIXELS * sizeof *seen);
}

/* Camera alone: as if the square stood still, what is met has the colour that lies beside it, and the floor keeps what it
 * showed before. */
static void reflections_follow_what_moves(void **state) {
    (void)state;
    enum { COUNT = 5 };
    write_room();
    lobe_ssr_frames *frames = open_moving(LOBE_SSR_PATH_STILL, "high", COUNT);
    float *truth[2], *screen = malloc(PIXELS * sizeof *screen);
    float *still = calloc(2 * PIXELS, sizeof *still);
    for (int k = 0; k < 2; k++) truth[k] = malloc(3 * PIXELS * sizeof *truth[k]);
    assert_true(screen && still && truth[0] && truth[1]);
    judged whole, camera;
    open_judged(&whole);
    open_judged(&camera);
    for (int i = 0; i < COUNT; i++) {
        lobe_ssr_frame f;
        assert_int_equal(lobe_ssr_frames_get(frames, i, &f), LOBE_SSR_OK);
        assert_int_equal(lobe_ssr_truth(frames, LOBE_SSR_VNDF, 16, truth[i % 2], screen),
                         LOBE_SSR_OK);
        const float *last = i > 0 ? truth[(i + 1) % 2] : NULL;
        judge(&whole, &f, frames, truth[i % 2], last, screen);
        f.motion = still;
        f.motion_z = NULL;
        judge(&camera, &f, frames, truth[i % 2], last, screen);
    }
    print_message("error %.4f, by the camera alone %.4f; of changes %.4f and %.4f\n",
                  whole.error / (COUNT - 1), camera.error / (COUNT - 1), whole.change / (COUNT - 1),
                  camera.change / (COUNT - 1));
    assert_true(whole.error < 0.5 * camera.error && whole.change < 0.7 * camera.change);
    lobe_ssr_free(whole.ssr);
    lobe_ssr_free(camera.ssr);
    free(whole.last);
    free(camera.last);
    free(truth[0]);
    free(truth[1]);
    free(screen);
    free(still);
    lobe_ssr_frames_free(frames);
    unlink(name);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motion_is_that_of_the_places),
        cmocka_unit_test(moments_are_checked),
        cmocka_unit_test(places_of_other_parts_are_not_found),
        cmocka_unit_test(what_rests_has_the_same_bits),
        cmocka_unit_test(reflections_follow_what_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
