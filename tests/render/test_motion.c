/* tests/render/test_motion.c: how far a place has moved in the picture, against projections in double. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { WIDTH = 48, HEIGHT = 32 };

static const double pi = 3.14159265358979323846;

typedef struct vector {
    double x, y, z;
} vector;

static double dot(vector a, vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vector sum(vector a, vector b, double t) {
    return (vector){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}

static vector cross(vector a, vector b) {
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static vector unit(vector a) {
    return sum((vector){0, 0, 0}, a, 1 / sqrt(dot(a, a)));
}

static vector in_double(lobe_vec3_f32 a) {
    return (vector){(double)a.x, (double)a.y, (double)a.z};
}

/* A camera in double; slopes of half its angles of view. */
typedef struct eye {
    vector place, right, up, forward;
    double across, above;
} eye;

static eye eye_of(const lobe_view *v) {
    eye e = {.place = in_double(v->position)};
    e.forward = unit(sum(in_double(v->target), e.place, -1));
    e.right = unit(cross(e.forward, in_double(v->up)));
    e.up = cross(e.right, e.forward);
    e.above = tan((double)v->vertical_degrees * pi / 360);
    e.across = e.above * WIDTH / HEIGHT;
    return e;
}

/* Widths from the left and heights from the top; 0: behind. */
static int project(const eye *e, vector to, double place[2]) {
    const double along = dot(to, e->forward);
    place[0] = 0.5 + 0.5 * dot(to, e->right) / (along * e->across);
    place[1] = 0.5 - 0.5 * dot(to, e->up) / (along * e->above);
    return along > 0;
}

/* ---- A wall at z = 0 before an empty sky ----------------------------------------------------- */

static const double wall_half = 2;

static lobe_scene *wall(void) {
    static const char name[] = "render-motion.obj";
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fprintf(file, "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3 4\n");
    fclose(file);
    lobe_scene *scene = load(name);
    unlink(name);
    return scene;
}

/* What is seen at a place of the picture: on the wall 1, and what leads there from the camera before. */
static int see(const eye *now, double x, double y, const eye *before, vector *to) {
    const vector d = sum(sum(now->forward, now->right, (2 * x / WIDTH - 1) * now->across), now->up,
                         (1 - 2 * y / HEIGHT) * now->above);
    const double t = -now->place.z / d.z;
    const vector place = sum(now->place, d, t);
    const int is_wall = t > 0 && fabs(place.x) < wall_half && fabs(place.y) < wall_half;
    *to = is_wall ? sum(place, before->place, -1) : d;
    return is_wall;
}

/* The filter reaches 1.5 pixels. */
static int is_near_edge(const eye *now, double x, double y) {
    vector to;
    int walls = 0;
    for (int k = 0; k < 9; ++k)
        walls += see(now, x + 1.6 * (k % 3 - 1), y + 1.6 * (k / 3 - 1), now, &to);
    return walls != 0 && walls != 9;
}

static float *motion_of(const lobe_scene *scene, const lobe_view *now, const lobe_view *before,
                        float aperture) {
    lobe_render_options o = small(WIDTH, HEIGHT, 256);
    o.view = now;
    o.previous_view = before;
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_MOTION);
    o.aperture = aperture;
    o.depth = 0;
    lobe_film *film = render(scene, o, NULL);
    float *motion = malloc(2 * sizeof *motion * WIDTH * HEIGHT);
    assert_true(lobe_film_copy_aov(film, LOBE_AOV_MOTION, motion));
    lobe_film_free(film);
    return motion;
}

/* How many pixels of each kind were compared, and how far the farthest moved, in pixels. */
typedef struct tally {
    int walls, skies;
    double farthest;
} tally;

/* A pixel is the mean around its middle: `room` in pixels. */
static tally compare(const lobe_view *view, const lobe_view *previous, const float *motion,
                     double room) {
    const eye now = eye_of(view), before = eye_of(previous);
    tally t = {0, 0, 0};
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        const double x = i % WIDTH + 0.5, y = i / WIDTH + 0.5;
        vector to;
        double old[2];
        if (is_near_edge(&now, x, y)) continue;
        const int is_wall = see(&now, x, y, &before, &to);
        assert_true(project(&before, to, old));
        const double right = x - old[0] * WIDTH, down = y - old[1] * HEIGHT;
        const double off =
            hypot((double)motion[2 * i] * WIDTH - right, (double)motion[2 * i + 1] * HEIGHT - down);
        if (!(off < room))
            fail_msg("pixel %d: (%g, %g), not (%g, %g)", i, (double)motion[2 * i] * WIDTH,
                     (double)motion[2 * i + 1] * HEIGHT, right, down);
        t.farthest = fmax(t.farthest, hypot(right, down));
        t.walls += is_wall;
        t.skies += !is_wall;
    }
    return t;
}

static const lobe_view first = {{1, 0.5f, 6}, {0.2f, 0.1f, 0}, {0, 1, 0}, 50},
                       second = {{1.3f, 0.4f, 5.5f}, {0.1f, 0.2f, 0}, {0.1f, 1, 0}, 48};

/* Moved, turned, tilted and zoomed. */
static void motion_is_that_of_the_places(void **state) {
    (void)state;
    lobe_scene *scene = wall();
    float *motion = motion_of(scene, &second, &first, 0);
    const tally t = compare(&second, &first, motion, 0.02);
    if (!(t.walls > 400 && t.skies > 200 && t.farthest > 3))
        fail_msg("%d, %d, %g", t.walls, t.skies, t.farthest);
    free(motion);
    lobe_scene_free(scene);
}

/* Along the wall: everywhere on it by the same, to the digits of float. */
static void a_step_aside_moves_a_wall_evenly(void **state) {
    (void)state;
    const lobe_view now = {{0.25f, -0.125f, 2}, {0.25f, -0.125f, 0}, {0, 1, 0}, 40},
                    before = {{0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 40};
    lobe_scene *scene = wall();
    float *motion = motion_of(scene, &now, &before, 0);
    const double above = tan(40 * pi / 360), across = above * WIDTH / HEIGHT;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        const double right = (double)motion[2 * i] + 0.25 / (2 * 2 * across);
        const double down = (double)motion[2 * i + 1] + 0.125 / (2 * 2 * above);
        if (!(fabs(right) < 2e-6 && fabs(down) < 2e-6))
            fail_msg("pixel %d is off by (%g, %g)", i, right, down);
    }
    free(motion);
    lobe_scene_free(scene);
}

/* A lens blurs it, and does not move it. */
static void a_lens_does_not_move_anything(void **state) {
    (void)state;
    lobe_scene *scene = wall();
    const lobe_view view = {{0.25f, -0.125f, 2}, {0, 0, 0}, {0, 1, 0}, 40},
                    before = {{0, 0, 2.2f}, {0, 0, 0}, {0, 1, 0}, 40};
    float *motion = motion_of(scene, &view, &before, 0.05f);
    const tally t = compare(&view, &before, motion, 0.02);
    assert_true(t.walls == WIDTH * HEIGHT && t.farthest > 1);
    free(motion);
    motion = motion_of(scene, &view, &view, 0.05f); /* nor does a place on it, sample by sample */
    for (int i = 0; i < 2 * WIDTH * HEIGHT; ++i) assert_true(motion[i] == 0);
    free(motion);
    lobe_scene_free(scene);
}

static void what_was_not_seen(void **state) {
    (void)state;
    lobe_scene *scene = wall();
    lobe_view away = first;
    away.target = (lobe_vec3_f32){2, 1, 12};
    float *motion = motion_of(scene, &first, &away, 0);
    for (int i = 0; i < WIDTH * HEIGHT; ++i)
        assert_true(motion[2 * i] == 2 && motion[2 * i + 1] == 0);
    free(motion);
    motion = motion_of(scene, &first, NULL, 0); /* the frame before is the same */
    for (int i = 0; i < 2 * WIDTH * HEIGHT; ++i) assert_true(motion[i] == 0);
    free(motion);
    away.vertical_degrees = 0;
    lobe_render_options o = small(8, 8, 1);
    o.previous_view = &away;
    lobe_film *film = NULL;
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(motion_is_that_of_the_places),
        cmocka_unit_test(a_step_aside_moves_a_wall_evenly),
        cmocka_unit_test(a_lens_does_not_move_anything),
        cmocka_unit_test(what_was_not_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
