/* What the maps make of Sobol points: how evenly light is met, set by set, against `caps` and `bounded`. */
#include "kernel/bind/c_f64.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "horizon_methods.h"
#include "kernel/ggx_bounded.h"
#include "kernel/ggx_caps.h"
#include "lobe/random.h"

#include <math.h>

/* --- points: Sobol, the first three dimensions (Joe & Kuo 2008), moved by one exclusive-or ------------- */

typedef struct point {
    uint32_t bits[3];
} point;

static uint32_t product(const uint32_t *columns, uint32_t index) {
    uint32_t sum = 0;
    for (int k = 0; index >> k; ++k)
        if (index >> k & 1) sum ^= columns[k];
    return sum;
}

static point sobol(uint32_t index, lobe_random4 moved) {
    static uint32_t columns[3][32];
    if (!columns[0][0]) {
        for (int k = 0; k < 32; ++k) columns[0][k] = 1u << (31 - k);
        columns[1][0] = columns[2][0] = 1u << 31;
        columns[2][1] = 3u << 30;
        for (int k = 1; k < 32; ++k) columns[1][k] = columns[1][k - 1] ^ columns[1][k - 1] >> 1;
        for (int k = 2; k < 32; ++k)
            columns[2][k] = columns[2][k - 1] ^ columns[2][k - 2] ^ columns[2][k - 2] >> 2;
    }
    point p;
    for (int k = 0; k < 3; ++k) p.bits[k] = product(columns[k], index) ^ moved.word[k];
    return p;
}

/* Every 2^m points fall into different cells of any 2^a x 2^(m - a) grid of the first two dimensions. */
static void points_are_stratified(void **state) {
    (void)state;
    for (int a = 0; a <= 10; ++a) {
        uint8_t taken[1024] = {0};
        for (uint32_t k = 0; k < 1024; ++k) {
            point p = sobol(k, lobe_random(3, 0, 0));
            uint64_t x = (uint64_t)p.bits[0] >> (32 - a), y = (uint64_t)p.bits[1] >> (22 + a);
            assert_false(taken[x << (10 - a) | y]++);
        }
    }
}

/* --- discrepancy --------------------------------------------------------------------------------- */

/* The light of a white furnace in the boxes [0, z) x [0, phi) of the hemisphere. */
enum { SIDE = 16, MOVES = 16, CASES = 8 };

typedef struct boxes {
    double light[SIDE][SIDE];
} boxes;

typedef struct sampler {
    int is_horizon;
    horizon_any horizon;
    int is_bounded;
    ggx_bounded bounded;
    ggx_caps caps;
} sampler;

static facet_draw drawn(const sampler *s, point p) {
    double u[3];
    for (int k = 0; k < 3; ++k) u[k] = (p.bits[k] + 0.5) * 0x1p-32;
    if (s->is_horizon) return any_draw(&s->horizon, u[0], u[1], u[2]);
    return s->is_bounded ? ggx_bounded_draw(s->bounded, u[0], u[1], u[2])
                         : ggx_caps_draw(s->caps, u[0], u[1], u[2]);
}

static int cell(double x) {
    int k = (int)(x * SIDE);
    return k < 0 ? 0 : k < SIDE ? k : SIDE - 1;
}

static boxes light_by(const sampler *s, uint32_t count, lobe_random4 moved) {
    boxes b = {{{0}}};
    for (uint32_t k = 0; k < count; ++k) {
        facet_draw d = drawn(s, sobol(k, moved));
        if (!(d.weight > 0)) continue;
        double turn = atan2(d.wo.y, d.wo.x) / 6.283185307179586 + 0.5;
        b.light[cell(d.wo.z)][cell(turn)] += d.weight / count;
    }
    for (int j = 0; j < SIDE; ++j)
        for (int k = 1; k < SIDE; ++k) b.light[j][k] += b.light[j][k - 1];
    for (int j = 1; j < SIDE; ++j)
        for (int k = 0; k < SIDE; ++k) b.light[j][k] += b.light[j - 1][k];
    return b;
}

static ggx_base base_at(int c, double floor_share) {
    static const struct {
        double alpha[2], theta, phi;
    } cases[CASES] = {{{0.2, 0.8}, 40, 45}, {{0.1, 1}, 60, 45},  {{0.5, 1}, 40, 45},
                      {{0.3, 0.3}, 60, 20}, {{0.7, 0.7}, 5, 10}, {{1, 1}, 80, 30},
                      {{0.7, 0.7}, 70, 60}, {{0.4, 0.9}, 97, 20}};
    double t = cases[c].theta * 0.017453292519943295, f = cases[c].phi * 0.017453292519943295;
    return base_with_floor(v3_of(sin(t) * cos(f), sin(t) * sin(f), cos(t)), cases[c].alpha[0],
                           cases[c].alpha[1], floor_share);
}

typedef struct method {
    const char *name;
    int is_horizon, is_bounded;
    horizon_method method;
    double floor_share;
} method;

static const method METHODS[] = {{"caps", 0, 0, MIRROR, 1},
                                 {"bounded", 0, 1, MIRROR, 1},
                                 {"horizon-mirror", 1, 0, MIRROR, 1},
                                 {"horizon-exact", 1, 0, EXACT, 1},
                                 {"horizon-uniform", 1, 0, UNIFORM, 1},
                                 {"horizon 0.25", 1, 0, SHADOWED, 0.25},
                                 {"horizon 0.1", 1, 0, SHADOWED, 0.1}};
enum { METHODS_HERE = sizeof METHODS / sizeof *METHODS, CAPS = 0, FIRST_HORIZON = 2 };

static sampler sampler_of(const method *m, ggx_base g) {
    sampler s = {.is_horizon = m->is_horizon, .is_bounded = m->is_bounded};
    if (m->is_horizon) s.horizon = any_prepare(m->method, g);
    s.bounded = ggx_bounded_prepare(g);
    s.caps = ggx_caps_prepare(g);
    return s;
}

/* The root mean square, over boxes and moved point sets, of the error relative to all light. */
static double discrepancy(const sampler *s, uint32_t count, const boxes *exact) {
    double sum = 0, all = exact->light[SIDE - 1][SIDE - 1];
    for (uint64_t move = 0; move < MOVES; ++move) {
        boxes b = light_by(s, count, lobe_random(17, 1, move));
        for (int j = 0; j < SIDE; ++j)
            for (int k = 0; k < SIDE; ++k) {
                double error = (b.light[j][k] - exact->light[j][k]) / all;
                sum += error * error;
            }
    }
    return sqrt(sum / (MOVES * SIDE * SIDE));
}

static void discrepancy_against_caps(void **state) {
    (void)state;
    static const uint32_t counts[] = {64, 256, 1024, 4096};
    boxes exact[CASES];
    for (int c = 0; c < CASES; ++c) {
        ggx_base g = base_at(c, 0);
        sampler s = sampler_of(&METHODS[METHODS_HERE - 1], g);
        exact[c] = light_by(&s, 1u << 20, lobe_random(17, 2, 0));
    }
    for (size_t n = 0; n < sizeof counts / sizeof *counts; ++n) {
        double mean[METHODS_HERE];
        for (int m = 0; m < METHODS_HERE; ++m) {
            double logs = 0;
            for (int c = 0; c < CASES; ++c) {
                sampler s = sampler_of(&METHODS[m], base_at(c, METHODS[m].floor_share));
                logs += log(discrepancy(&s, counts[n], &exact[c]));
            }
            mean[m] = exp(logs / CASES);
            print_message("%4u points, %-15s: %.5f, caps / this %.2f\n", (unsigned)counts[n],
                          METHODS[m].name, mean[m], mean[CAPS] / mean[m]);
        }
        /* what a continuous map keeps, the choice between y and -y loses */
        for (int m = FIRST_HORIZON; m < METHODS_HERE; ++m)
            if (METHODS[m].method == MIRROR)
                assert_true(mean[m] > mean[CAPS]);
            else
                assert_true(mean[m] < 0.9 * mean[CAPS]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_are_stratified),
                                       cmocka_unit_test(discrepancy_against_caps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
