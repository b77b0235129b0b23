/* The maps (u1, u2, i) -> o of the continuous horizon samplers: no folds, no jumps. */
#include "kernel/bind/c_f64.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "horizon_methods.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

static v3 at_angles(double theta, double phi) {
    return v3_of(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}

static v3 cross(v3 a, v3 b) {
    return v3_of(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static double length(v3 a) {
    return sqrt(v3_dot(a, a));
}

static const double alphas[][2] = {{0.3, 0.3}, {1, 1},   {0.1, 1}, {1, 0.2},
                                   {0.5, 0.8}, {2, 0.5}, {3, 3}};
enum { ALPHAS = sizeof alphas / sizeof *alphas };

/* The sign of the Jacobian of (u1, u2) -> o, cell by cell: + where the reflection m -> o keeps the
 * orientation, and it always does for i.m > 0. */
static void no_folds(void **state) {
    (void)state;
    enum { N = 100 };
    for (int k = 0; k < ALPHAS * 5 * 3; ++k) {
        const double *alpha = alphas[k % ALPHAS];
        double theta = (double[]){0, 0.5, 1.2, 1.5, 1.9}[k / ALPHAS % 5];
        horizon_method method = (horizon_method)(UNIFORM + k / ALPHAS / 5);
        horizon_any s = any_prepare(
            method, base_with_floor(at_angles(theta, 0.4 + k), alpha[0], alpha[1], 0.1));
        for (int j = 0; j < N; ++j)
            for (int l = 0; l < N; ++l) {
                double u1 = (l + 0.5) / N, u2 = (j + 0.5) / N, h = 1e-6;
                v3 m = any_draw(&s, u1, u2, 0).m;
                v3 along1 = v3_sub(any_draw(&s, u1 + h, u2, 0).m, m);
                v3 along2 = v3_sub(any_draw(&s, u1, u2 + h * (1 - u2), 0).m, m);
                if (!(v3_dot(m, cross(along1, along2)) < 0))
                    fail_msg("%s alpha %g %g theta %g: folds at u %g %g", method_name[method],
                             alpha[0], alpha[1], theta, u1, u2);
            }
    }
}

/* A path of i over the sphere. */
typedef struct path {
    const char *what;
    v3 from, to; /* the shorter great circle; unit */
} path;

static v3 along(const path *p, double t) {
    return v3_normalize(v3_add(v3_scale(p->from, 1 - t), v3_scale(p->to, t)));
}

static v3 drawn(horizon_method method, v3 wi, const double alpha[2], double u1, double u2) {
    horizon_any s = any_prepare(method, base_with_floor(wi, alpha[0], alpha[1], 0.1));
    return any_draw(&s, u1, u2, 0).wo;
}

/* How far o still jumps when the step from t0 to t1 is halved again and again, always the half that
 * moves o more. */
static double jump_within(horizon_method method, const path *p, const double alpha[2], double t0,
                          double t1, double u1, double u2) {
    v3 o0 = drawn(method, along(p, t0), alpha, u1, u2);
    v3 o1 = drawn(method, along(p, t1), alpha, u1, u2);
    for (int k = 0; k < 24; ++k) {
        double t = 0.5 * (t0 + t1);
        v3 o = drawn(method, along(p, t), alpha, u1, u2);
        if (length(v3_sub(o, o0)) > length(v3_sub(o1, o))) {
            t1 = t;
            o1 = o;
        } else {
            t0 = t;
            o0 = o;
        }
    }
    return length(v3_sub(o1, o0));
}

typedef struct motion {
    double fastest; /* |do|/|di| */
    double jump;
} motion;

/* Moves i along a path and follows o at sixty-four points of the square. */
static motion follow(horizon_method method, const path *p, const double alpha[2], int steps) {
    motion worst = {0, 0};
    for (int k = 0; k < 64; ++k) {
        double u1 = (k % 8 + 0.37) / 8, u2 = (k / 8 + 0.5) / 8;
        v3 before = drawn(method, along(p, 0), alpha, u1, u2);
        double at = 0, largest = 0;
        for (int j = 1; j <= steps; ++j) {
            double t = (double)j / steps, t0 = (double)(j - 1) / steps;
            v3 o = drawn(method, along(p, t), alpha, u1, u2);
            double moved = length(v3_sub(o, before));
            double speed = moved / length(v3_sub(along(p, t), along(p, t0)));
            worst.fastest = fmax(worst.fastest, speed);
            if (moved > largest) {
                largest = moved;
                at = t0;
            }
            before = o;
        }
        worst.jump = fmax(worst.jump, jump_within(method, p, alpha, at, at + 1.0 / steps, u1, u2));
    }
    return worst;
}

static const path paths[] = {
    {"across the normal along x", {-0.6, 0, 0.8}, {0.6, 0, 0.8}},
    {"across the normal, aslant", {-0.36, -0.48, 0.8}, {0.36, 0.48, 0.8}},
    {"past the normal", {-0.6, 1e-3, 0.8}, {0.6, 1e-3, 0.8}},
    {"across x = 0", {-0.28, 0.6, 0.75}, {0.28, 0.6, 0.75}},
    {"across y = 0", {0.6, -0.28, 0.75}, {0.6, 0.28, 0.75}},
    {"down to the back along x", {0.6, 0, 0.8}, {0.9, 0, -0.3}},
    {"down to the back, aslant", {0.3, 0.5, 0.8}, {0.6, 0.7, -0.3}},
    {"round at 60 degrees", {0.8, 0.1, 0.5}, {-0.2, 0.8, 0.5}},
};
enum { PATHS = sizeof paths / sizeof *paths };

static path unit_path(int k) {
    path p = paths[k];
    p.from = v3_normalize(p.from);
    p.to = v3_normalize(p.to);
    return p;
}

static void no_jumps(void **state) {
    (void)state;
    motion worst = {0, 0};
    for (int k = 0; k < PATHS * ALPHAS; ++k)
        for (int method = UNIFORM; method < METHOD_COUNT; ++method) {
            path p = unit_path(k % PATHS);
            const double *alpha = alphas[k / PATHS];
            motion m = follow((horizon_method)method, &p, alpha, 200);
            worst.fastest = fmax(worst.fastest, m.fastest);
            worst.jump = fmax(worst.jump, m.jump);
        }
    print_message(
        "o moves at most %.3g times as far as i; the largest step left after halving: %.2g\n",
        worst.fastest, worst.jump);
    assert_true(worst.fastest < 60);
    assert_true(worst.jump < 1e-7);
}

/* The two directions in the plane of the narrower axis where l1 = l2: the ellipse is a circle, and its
 * axes lie differently on every way to it. tan^2 of the stretched angle = (ay^2 - ax^2)(1 + ay^2); ax < ay. */
static double angle_of_the_circle(double ax, double ay) {
    return atan(sqrt((ay * ay - ax * ax) * (1 + ay * ay)) / ax);
}

static double difference_of_axes(v3 wi, double ax, double ay) {
    ggx_horizon_frame f = ggx_horizon_frame_of(ggx_useful_of(base_with_floor(wi, ax, ay, 1)));
    return f.g1 - f.g2;
}

/* There the axes are equal, and nowhere else, not from behind either: the eigenvectors, and with them
 * o, are continuous in i at every other direction. */
static void the_ellipse_is_a_circle_in_two_directions_only(void **state) {
    (void)state;
    static const double pairs[][2] = {{0.5, 1}, {0.2, 1}, {0.1, 1}, {0.5, 2}, {0.3, 0.9}, {0.8, 1}};
    enum { STEPS = 400 };
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; ++k) {
        double ax = pairs[k][0], ay = pairs[k][1], theta = angle_of_the_circle(ax, ay), least = 1;
        v3 circle = at_angles(theta, 0);
        assert_true(difference_of_axes(circle, ax, ay) < 1e-7);
        assert_true(difference_of_axes(at_angles(theta, pi), ax, ay) < 1e-7);
        for (int j = 0; j < STEPS; ++j)
            for (int l = 0; l <= STEPS; ++l) { /* a quarter of the azimuth, by symmetry */
                v3 wi = at_angles(0.97 * pi * (j + 0.5) / STEPS, 0.5 * pi * l / STEPS);
                double distance = length(v3_sub(wi, circle));
                least = fmin(least, difference_of_axes(wi, ax, ay) / fmin(distance, 0.1));
            }
        print_message("alpha %g %g: axes differ by at least %.2g of the distance\n", ax, ay, least);
        assert_true(least > 0.01);
    }
}

/* How far apart the limits of o are, over all ways to one of the two. */
static double spread_of_limits(horizon_method method, double ax, double ay) {
    const double alpha[2] = {ax, ay};
    double theta = angle_of_the_circle(ax, ay), near = 1e-7, spread = 0;
    for (int k = 0; k < 64; ++k) {
        double u1 = (k % 8 + 0.37) / 8, u2 = (k / 8 + 0.5) / 8;
        v3 first = drawn(method, at_angles(theta + near, 0), alpha, u1, u2);
        for (int j = 1; j < 32; ++j) {
            double turn = 2 * pi * j / 32;
            v3 wi = at_angles(theta + near * cos(turn), near * sin(turn) / sin(theta));
            spread = fmax(spread, length(v3_sub(drawn(method, wi, alpha, u1, u2), first)));
        }
    }
    return spread;
}

/* Following shadowing along the axes, `horizon` cannot be continuous where the axes are not; the others
 * do not see them. */
static void limits_where_the_ellipse_is_a_circle(void **state) {
    (void)state;
    static const double pairs[][2] = {{0.5, 1}, {0.2, 1}, {0.1, 1}, {0.5, 2}, {0.3, 0.9}};
    for (size_t k = 0; k < sizeof pairs / sizeof *pairs; ++k) {
        double uniform = spread_of_limits(UNIFORM, pairs[k][0], pairs[k][1]);
        double exact = spread_of_limits(EXACT, pairs[k][0], pairs[k][1]);
        double shadowed = spread_of_limits(SHADOWED, pairs[k][0], pairs[k][1]);
        print_message("alpha %g %g: limits apart by %.2g (uniform), %.2g (exact), %.2g (horizon)\n",
                      pairs[k][0], pairs[k][1], uniform, exact, shadowed);
        assert_true(uniform < 1e-5);
        assert_true(exact < 1e-5);
        assert_true(shadowed > 0.01 && shadowed < 0.9);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_folds), cmocka_unit_test(no_jumps),
        cmocka_unit_test(the_ellipse_is_a_circle_in_two_directions_only),
        cmocka_unit_test(limits_where_the_ellipse_is_a_circle)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
