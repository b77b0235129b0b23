#include "geometry.h"

#include <math.h>

double lobe_dot3(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

vec3 lobe_cross3(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

vec3 lobe_mix3(double s, vec3 a, double t, vec3 b) {
    return (vec3){s * a.x + t * b.x, s * a.y + t * b.y, s * a.z + t * b.z};
}

vec3 lobe_unit3(vec3 a) {
    return lobe_mix3(1 / sqrt(lobe_dot3(a, a)), a, 0, a);
}

vec3 lobe_direction(double theta, double phi) {
    const double t = theta * FIGURE_PI / 180, p = phi * FIGURE_PI / 180;
    return (vec3){sin(t) * cos(p), sin(t) * sin(p), cos(t)};
}

vec3 lobe_stretched_wi(view v) {
    return lobe_unit3((vec3){v.alpha[0] * v.wi.x, v.alpha[1] * v.wi.y, v.wi.z});
}

vec3 lobe_stretched_m(view v, vec3 m) {
    return lobe_unit3((vec3){m.x / v.alpha[0], m.y / v.alpha[1], m.z});
}

static vec3 reflected(vec3 i, vec3 m) {
    return lobe_mix3(2 * lobe_dot3(i, m), m, -1, i);
}

vec3 lobe_stretched_wo(view v, vec3 m) {
    return reflected(lobe_stretched_wi(v), lobe_stretched_m(v, m));
}

vec3 lobe_half(vec3 wi, vec3 wo) {
    return lobe_unit3(lobe_mix3(1, wi, 1, wo));
}

vec3 lobe_grazing_wo(view v, double phi) {
    return lobe_stretched_wo(v, lobe_half(v.wi, lobe_direction(90, phi)));
}

void lobe_frame_across(vec3 axis, vec3 *t1, vec3 *t2) {
    const double across = hypot(axis.x, axis.y);
    *t1 = across > 1e-9 ? (vec3){-axis.y / across, axis.x / across, 0} : (vec3){1, 0, 0};
    *t2 = lobe_cross3(axis, *t1);
}

lobe_reflection_f64 lobe_ggx_model(view v, lobe_method method) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = method;
    return lobe_reflection_prepare_f64(options, v.wi, v.alpha[0], v.alpha[1]);
}

/* A cap is drawn from evenly: the mean over a regular grid of numbers points along its axis. Its
 * density D/(2 L (1 - height)) at a draw tells the height (docs/optimal-caps.md). */
cap lobe_cap_of(view v, lobe_method method) {
    enum { SIDE = 32 };
    const lobe_reflection_f64 model = lobe_ggx_model(v, method);
    const double length =
        sqrt(pow(v.alpha[0] * v.wi.x, 2) + pow(v.alpha[1] * v.wi.y, 2) + v.wi.z * v.wi.z);
    vec3 sum = {0, 0, 0};
    double height = 0;
    for (int k = 0; k < SIDE * SIDE; k++) {
        const lobe_reflection_draw_f64 d =
            lobe_reflection_sample_f64(&model, (k % SIDE + 0.5) / SIDE, (k / SIDE + 0.5) / SIDE, 0);
        sum = lobe_mix3(1, sum, 1, lobe_stretched_wo(v, d.m));
        if (d.pdf > 0)
            height = 1 - lobe_reflection_eval_m_f64(&model, d.m).d / (2 * length * d.pdf);
    }
    return (cap){lobe_unit3(sum), height};
}

vec3 lobe_cap_rim(cap k, double phi) {
    vec3 t1, t2;
    lobe_frame_across(k.axis, &t1, &t2);
    const vec3 d = lobe_direction(acos(fmin(fmax(k.height, -1), 1)) * 180 / FIGURE_PI, phi);
    return lobe_mix3(1, lobe_mix3(d.x, t1, d.y, t2), d.z, k.axis);
}
