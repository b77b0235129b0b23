/* The stretched space, in which the GGX microsurface is a hemisphere (Heitz 2018): where the draws lie there,
 * the horizon, and the caps that are sampled from (Eto & Tokuyoshi 2023, and docs/optimal-caps.md). Of the
 * two methods' scenes the first one's is taken: both look at the same surface. */
#include "host.h"
#include "page.h"

#include <math.h>

enum { STEPS = 361 };

typedef lobe_vec3_f32 vec3;

vec3 page_unit(vec3 v) {
    return page_scaled(v, 1 / sqrtf(page_dot(v, v)));
}

vec3 page_reflected(vec3 i, vec3 m) {
    const float s = 2 * page_dot(i, m);
    return (vec3){s * m.x - i.x, s * m.y - i.y, s * m.z - i.z};
}

static float length_of(float x, float y) {
    return sqrtf(x * x + y * y);
}

static vec3 stretched_wi(void) {
    const scene *s = &page_scene[0];
    return page_unit((vec3){s->alpha[0] * s->wi.x, s->alpha[1] * s->wi.y, s->wi.z});
}

/* The stretched reflection of a microfacet normal. */
static vec3 stretched_wo(vec3 m) {
    const scene *s = &page_scene[0];
    const vec3 h = page_unit((vec3){m.x / s->alpha[0], m.y / s->alpha[1], m.z});
    return page_reflected(stretched_wi(), h);
}

static void put(int at, vec3 v) {
    page_curve[0][at] = v.x;
    page_curve[1][at] = v.y;
    page_curve[2][at] = v.z;
}

EXPORT(stretch_wi) void page_stretch_wi(void);
/* page_result: the stretched direction. */
void page_stretch_wi(void) {
    const vec3 i = stretched_wi();
    page_result[0] = (double)i.x;
    page_result[1] = (double)i.y;
    page_result[2] = (double)i.z;
}

EXPORT(stretch_draws) void page_stretch_draws(int method, int count);
/* page_query: the stretched reflections of the draws. */
void page_stretch_draws(int method, int count) {
    const rows *r = &page_rows[method];
    for (int k = 0; k < count; ++k) {
        const vec3 o = stretched_wo((vec3){r->m[0][k], r->m[1][k], r->m[2][k]});
        page_query[0][k] = o.x;
        page_query[1][k] = o.y;
        page_query[2][k] = o.z;
    }
}

static vec3 across(vec3 axis) {
    const float length = length_of(axis.x, axis.y);
    return length > 1e-6f ? (vec3){-axis.y / length, axis.x / length, 0} : (vec3){1, 0, 0};
}

static vec3 cross(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static vec3 on_circle(vec3 x, vec3 y, int degree) {
    const double phi = degree * 0.017453292519943295;
    const float c = (float)host_cos(phi), s = (float)host_sin(phi);
    return (vec3){c * x.x + s * y.x, c * x.y + s * y.y, c * x.z + s * y.z};
}

EXPORT(horizon) int page_horizon(float x, float y, float z);
/* The stretched reflections of the directions that graze the plane with this normal, each degree. */
int page_horizon(float x, float y, float z) {
    const vec3 plane = {x, y, z}, b = x == 0 && y == 0 ? (vec3){1, 0, 0} : across(plane);
    const vec3 c = x == 0 && y == 0 ? (vec3){0, 1, 0} : cross(plane, b), i = page_scene[0].wi;
    for (int k = 0; k < STEPS; ++k) {
        const vec3 o = on_circle(b, c, k);
        put(k, stretched_wo(page_unit((vec3){i.x + o.x, i.y + o.y, i.z + o.z})));
    }
    return STEPS;
}

/* Where the stretched reflections of a method lie: axis . o >= height. */
typedef struct cap {
    vec3 axis;
    float height;
} cap;

/* A cap is drawn from evenly: the mean of a regular grid of draws points along its axis, and the density
 * D/(2 L (1 - height)) at a draw tells the height. The draw with the largest density tells it best. */
static cap cap_of(lobe_method method) {
    enum { SIDE = 24 };
    const scene *s = &page_scene[0];
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = method;
    const lobe_reflection_f32 model =
        lobe_reflection_prepare_f32(options, s->wi, s->alpha[0], s->alpha[1]);
    const vec3 a = {s->alpha[0] * s->wi.x, s->alpha[1] * s->wi.y, s->wi.z};
    const float length = sqrtf(page_dot(a, a));
    double sum[3] = {0, 0, 0};
    float height = 0, best = 0;
    for (int k = 0; k < SIDE * SIDE; ++k) {
        const float u1 = ((float)(k % SIDE) + 0.5f) / SIDE, u2 = ((float)(k / SIDE) + 0.5f) / SIDE;
        const lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(&model, u1, u2, 0);
        const vec3 o = stretched_wo(d.m);
        sum[0] += (double)o.x;
        sum[1] += (double)o.y;
        sum[2] += (double)o.z;
        if (d.pdf > best) {
            best = d.pdf;
            height = 1 - lobe_reflection_eval_m_f32(&model, d.m).d / (2 * length * d.pdf);
        }
    }
    const vec3 axis = {(float)sum[0], (float)sum[1], (float)sum[2]};
    return (cap){page_unit(axis), height};
}

EXPORT(cap_rim) int page_cap_rim(int method);
/* The rim of the cap of `caps`, `bounded` or `optimal`; page_result[0]: its height. */
int page_cap_rim(int method) {
    const cap k = cap_of((lobe_method)method);
    const vec3 b = across(k.axis), c = cross(k.axis, b);
    const float height = page_min(page_max(k.height, -1), 1), radius = sqrtf(1 - height * height);
    for (int i = 0; i < STEPS; ++i) {
        const vec3 e = on_circle(b, c, i);
        put(i, (vec3){height * k.axis.x + radius * e.x, height * k.axis.y + radius * e.y,
                      height * k.axis.z + radius * e.z});
    }
    page_result[0] = (double)k.height;
    return STEPS;
}

/* The lowest z of a cap at the azimuth of `o`: its rim there, where it does not hold the whole arc. */
static float rim_below(cap k, vec3 o) {
    const float length = page_max(length_of(o.x, o.y), 1e-30f);
    const float along = (k.axis.x * o.x + k.axis.y * o.y) / length;
    const float reach = length_of(along, k.axis.z), tilt = host_atan2f(along, k.axis.z);
    if (reach <= fabsf(k.height)) return k.height < 0 ? -1 : NAN;
    const float theta = tilt + host_acosf(k.height / reach);
    return theta >= 3.14159265f ? -1 : (float)host_cos((double)theta);
}

EXPORT(bounds) int page_bounds(void);
/* Over the azimuth of the reflection, each degree: the z down to which reflections above the surface reach, and
 * what the previous, the bounded and the optimal cap assume. */
int page_bounds(void) {
    const cap caps = cap_of(LOBE_METHOD_CAPS), bounded = cap_of(LOBE_METHOD_BOUNDED),
              optimal = cap_of(LOBE_METHOD_OPTIMAL);
    const vec3 i = page_scene[0].wi;
    for (int k = 0; k < STEPS; ++k) {
        const vec3 g = on_circle((vec3){1, 0, 0}, (vec3){0, 1, 0}, k);
        const vec3 o = stretched_wo(page_unit((vec3){i.x + g.x, i.y + g.y, i.z + g.z}));
        page_curve[0][k] = o.z;
        page_curve[1][k] = caps.height;
        page_curve[2][k] = bounded.height;
        page_curve[3][k] = rim_below(optimal, o);
    }
    return STEPS;
}

EXPORT(region) void page_region(int rings, int sectors);
/* Where the reflections lie that leave the surface: page_query: those of (rings + 1) x (sectors + 1) directions
 * from the normal to the horizon, around it. */
void page_region(int rings, int sectors) {
    const vec3 i = page_scene[0].wi;
    for (int j = 0; j <= rings; ++j) {
        const double theta = 1.5707963267948966 * j / rings;
        for (int k = 0; k <= sectors; ++k) {
            const double phi = 6.283185307179586 * k / sectors, s = host_sin(theta);
            const vec3 o = {(float)(s * host_cos(phi)), (float)(s * host_sin(phi)),
                            (float)host_cos(theta)};
            const vec3 h = {i.x + o.x, i.y + o.y, i.z + o.z};
            const vec3 r = stretched_wo(page_unit(page_dot(h, h) > 1e-12f ? h : (vec3){0, 0, 1}));
            const int at = j * (sectors + 1) + k;
            page_query[0][at] = r.x;
            page_query[1][at] = r.y;
            page_query[2][at] = r.z;
        }
    }
}
