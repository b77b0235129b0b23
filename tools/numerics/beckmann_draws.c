/* tools/numerics/beckmann_draws.c: the Beckmann samplers in the precision BITS, behind functions of doubles:
 * one half of tools/numerics/beckmann_error.c, compiled once for each precision. */
#if BITS == 32
#include "kernel/bind/c_f32.h"
#define NAME(stem) stem##_f32
#else
#include "kernel/bind/c_f64.h"
#define NAME(stem) stem##_f64
#endif

#include "kernel/beckmann_horizon.h"
#include "kernel/beckmann_ndf.h"
#include "kernel/beckmann_newton.h"
#include "kernel/beckmann_newton_published.h"
#include "kernel/beckmann_slope.h"

#include "beckmann_error.h"

static beckmann_base base_of(const shading *at) {
    v3 wi = v3_of((real)at->wi[0], (real)at->wi[1], (real)at->wi[2]);
    return beckmann_base_of(wi, (real)at->alpha_x, (real)at->alpha_y,
                            facet_options_of(false, false));
}

drawn NAME(draw)(int sampler, const shading *at, double u1, double u2) {
    beckmann_base g = base_of(at);
    facet_draw d;
    switch (sampler) {
#define CASE(index, name)                                                                          \
    case index:                                                                                    \
        d = beckmann_##name##_draw(beckmann_##name##_prepare(g), (real)u1, (real)u2, R(0.0));      \
        break;
        BECKMANN_SAMPLERS(CASE)
#undef CASE
    default:
        memset(&d, 0, sizeof d);
    }
    drawn r = {{d.m.x, d.m.y, d.m.z}, {d.wo.x, d.wo.y, d.wo.z}, d.pdf, g.c};
    return r;
}

double NAME(density)(int sampler, const shading *at, const double m[3]) {
    beckmann_base g = base_of(at);
    facet_pair pair = beckmann_pair_of_m(g, v3_of((real)m[0], (real)m[1], (real)m[2]));
    switch (sampler) {
#define CASE(index, name)                                                                          \
    case index:                                                                                    \
        return beckmann_##name##_pdf(beckmann_##name##_prepare(g), pair);
        BECKMANN_SAMPLERS(CASE)
#undef CASE
    default:
        return 0;
    }
}
