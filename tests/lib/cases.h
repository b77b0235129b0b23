/* tests/lib/cases.h: directions, roughnesses and random numbers for the tests of the library. */
#ifndef TESTS_LIB_CASES_H
#define TESTS_LIB_CASES_H

#include <lobe/lobe.h>

#include <math.h>

#define CASES_PI 3.14159265358979323846

static inline lobe_vec3_f64 case_direction(double degrees, double azimuth) {
    double t = degrees * (CASES_PI / 180);
    double p = azimuth * (CASES_PI / 180);
    lobe_vec3_f64 d = {sin(t) * cos(p), sin(t) * sin(p), cos(t)};
    return d;
}

/* The same direction in both precisions: the double one is the rounded float one, made unit again. */
static inline lobe_vec3_f32 case_to_f32(lobe_vec3_f64 d) {
    lobe_vec3_f32 f = {(float)d.x, (float)d.y, (float)d.z};
    return f;
}

static inline lobe_vec3_f64 case_to_f64(lobe_vec3_f32 d) {
    lobe_vec3_f64 f = {d.x, d.y, d.z};
    return f;
}

static inline lobe_model smith_ggx(lobe_method method) {
    return (lobe_model){LOBE_NDF_GGX, LOBE_MASKING_SMITH, method};
}

static inline lobe_reflection_f64 case_model(lobe_model row, lobe_vec3_f64 wi, double ax,
                                             double ay) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = row;
    return lobe_reflection_prepare_f64(options, wi, ax, ay);
}

/* Number `index` of a stream of uniform pairs. */
static inline void case_random(uint64_t stream, uint64_t index, double *u1, double *u2) {
    lobe_random4 r = lobe_random(20261124, stream, index);
    *u1 = lobe_random_unit_f64(r.word[0], r.word[1]);
    *u2 = lobe_random_unit_f64(r.word[2], r.word[3]);
}

#endif
