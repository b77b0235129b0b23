/* tests/render/test_orbit.c: views of a turntable lie on a circle around the middle of the scene, in order, and hold all
 * of a scene that is framed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static lobe_view orbit(const lobe_scene *scene, int index, int count) {
    lobe_view v;
    if (lobe_scene_orbit(scene, NULL, 1, index, count, &v) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    return v;
}

/* Counter-clockwise from above: from +Z to +X. */
static void assert_turned(lobe_vec3_f32 p, lobe_vec3_f32 first, const double centre[3],
                          double angle) {
    const double x = (double)first.x - centre[0], z = (double)first.z - centre[2];
    const double expected[3] = {centre[0] + cos(angle) * x + sin(angle) * z, (double)first.y,
                                centre[2] - sin(angle) * x + cos(angle) * z};
    const double found[3] = {(double)p.x, (double)p.y, (double)p.z};
    for (int i = 0; i < 3; ++i)
        if (!(fabs(found[i] - expected[i]) < 2e-6 * (1 + fabs(expected[i]))))
            fail_msg("at %g: %g, not %g", angle, found[i], expected[i]);
}

static void views_lie_on_a_circle(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    const lobe_scene_info info = lobe_scene_get_info(scene);
    const double centre[3] = {0.5 * ((double)info.low.x + (double)info.high.x), 0,
                              0.5 * ((double)info.low.z + (double)info.high.z)};
    const double origin[3] = {0, 0, 0};
    lobe_view first, zero = orbit(scene, 0, 7);
    assert_int_equal(lobe_scene_view(scene, NULL, 0.5f, &first), LOBE_RENDER_OK);
    assert_memory_equal(&zero, &first, sizeof first);
    for (int k = 0; k < 7; ++k) {
        const lobe_view v = orbit(scene, k, 7), same = orbit(scene, 3 * k, 21);
        const double angle = 2 * 3.14159265358979323846 * k / 7;
        assert_turned(v.position, first.position, centre, angle);
        assert_turned(v.target, first.target, centre, angle);
        assert_turned(v.up, first.up, origin, angle);
        assert_true(v.vertical_degrees == first.vertical_degrees);
        assert_memory_equal(&v, &same, sizeof v);
    }
    lobe_scene_free(scene);
}

/* The corner of the box farthest from the middle of a square picture, in halves of its side. */
static double farthest_corner(const lobe_view *v, const double half[3]) {
    const double e[3] = {(double)v->position.x, (double)v->position.y, (double)v->position.z};
    const double length = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    const double flat = hypot(e[0], e[2]);
    const double right[3] = {e[2] / flat, 0, -e[0] / flat};
    const double back[3] = {e[0] / length, e[1] / length, e[2] / length};
    const double up[3] = {back[1] * right[2] - back[2] * right[1],
                          back[2] * right[0] - back[0] * right[2],
                          back[0] * right[1] - back[1] * right[0]};
    const double slope = tan((double)v->vertical_degrees * 3.14159265358979323846 / 360);
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double x = 0, y = 0, z = length;
        for (int i = 0; i < 3; ++i) {
            const double p = corner >> i & 1 ? half[i] : -half[i];
            x += p * right[i];
            y += p * up[i];
            z -= p * back[i];
        }
        assert_true(z > 0);
        farthest = fmax(farthest, fmax(fabs(x), fabs(y)) / (z * slope));
    }
    return farthest;
}

/* A plank: from the side it is twenty times as wide as from the end. */
static void a_scene_without_camera_is_held_from_every_side(void **state) {
    (void)state;
    static const char name[] = "render-orbit.obj";
    const double half[3] = {0.5, 0.25, 10};
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    for (int corner = 0; corner < 8; ++corner)
        fprintf(file, "v %g %g %g\n", corner & 1 ? half[0] : -half[0],
                corner & 2 ? half[1] : -half[1], corner & 4 ? half[2] : -half[2]);
    fprintf(file, "f 1 2 4 3\nf 5 6 8 7\n");
    fclose(file);
    lobe_scene *scene = load(name);
    unlink(name);
    double farthest = 0;
    for (int k = 0; k < 90; ++k) {
        const lobe_view v = orbit(scene, k, 90);
        farthest = fmax(farthest, farthest_corner(&v, half));
    }
    if (!(farthest < 1 && farthest > 0.85)) fail_msg("the picture is filled to %g", farthest);
    /* upright pictures: the same in a square of their width; wide ones: of their height */
    for (int k = 0; k < 5; ++k) {
        const float aspects[5] = {1, 2, 100, 0.5f, 0.01f}, width = fminf(aspects[k], 1);
        lobe_view square, v;
        assert_int_equal(lobe_scene_view(scene, NULL, 1, &square), LOBE_RENDER_OK);
        assert_int_equal(lobe_scene_view(scene, NULL, aspects[k], &v), LOBE_RENDER_OK);
        const double fit =
            (double)width * farthest_corner(&square, half) / farthest_corner(&v, half);
        if (!(fabs(fit - 1) < 1e-3)) fail_msg("aspect %g: %g of a square", aspects[k], fit);
        assert_memory_equal(&square, &v, offsetof(lobe_view, vertical_degrees));
        assert_true(k > 2 || v.vertical_degrees == square.vertical_degrees);
    }
    lobe_scene_free(scene);
}

static void what_is_no_view_is_refused(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_view v;
    static const int bad[][2] = {{0, 0}, {-1, 4}, {4, 4}, {0, -1}};
    for (int k = 0; k < 4; ++k)
        assert_int_equal(lobe_scene_orbit(scene, NULL, 1, bad[k][0], bad[k][1], &v),
                         LOBE_RENDER_BAD_INPUT);
    assert_int_equal(lobe_scene_orbit(scene, "nobody", 1, 0, 4, &v), LOBE_RENDER_BAD_INPUT);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(views_lie_on_a_circle),
        cmocka_unit_test(a_scene_without_camera_is_held_from_every_side),
        cmocka_unit_test(what_is_no_view_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
