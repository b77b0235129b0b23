#include "albedo_dielectric.h"

#include <lobe/walk.h>

#include "interrupt.h"

enum { POINTS = 262144 };

const char *const lobe_app_dielectric_columns[] = {"mu",      "r",     "t",     "energy",
                                                   "furnace", "all_r", "all_t", NULL};

static lobe_dielectric_albedo integrate(const lobe_app_dielectric_surface *s, lobe_vec3_f64 wi,
                                        lobe_transport transport, bool compensate) {
    lobe_dielectric_options options = s->options;
    options.transport = transport;
    options.compensate = compensate;
    const lobe_dielectric_f64 d =
        lobe_dielectric_prepare_f64(options, wi, s->alpha[0], s->alpha[1], s->ior);
    return lobe_dielectric_integrate(&d, POINTS);
}

/* Of all scatterings; the sum is below 1 by the walks that were cut. */
static lobe_dielectric_albedo walked(const lobe_app_dielectric_surface *s, lobe_vec3_f64 wi) {
    enum { MOST = 100000 };
    const lobe_microsurface surface = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED,
                                       s->alpha[0], s->alpha[1]};
    uint64_t reflected = 0, transmitted = 0;
    for (uint64_t i = 0; i < s->walks && !lobe_app_interrupted; i++) {
        const lobe_walk w = lobe_walk_dielectric_sample(surface, s->ior, wi, s->seed, i, MOST);
        if (w.bounces == 0) continue;
        if ((w.wo.z < 0) == (wi.z < 0))
            reflected++;
        else
            transmitted++;
    }
    return (lobe_dielectric_albedo){(double)reflected / (double)s->walks,
                                    (double)transmitted / (double)s->walks};
}

static lobe_dielectric_albedo all_of(const lobe_app_dielectric_surface *s, lobe_vec3_f64 wi,
                                     lobe_dielectric_albedo once) {
    if (s->walks > 0) return walked(s, wi);
    return s->options.compensate ? integrate(s, wi, LOBE_TRANSPORT_IMPORTANCE, true) : once;
}

bool lobe_app_write_dielectric(const lobe_app_dielectric_surface *s, const lobe_app_table *table,
                               lobe_vec3_f64 wi) {
    const lobe_dielectric_albedo once = integrate(s, wi, LOBE_TRANSPORT_IMPORTANCE, false);
    const lobe_dielectric_albedo all = all_of(s, wi, once);
    if (lobe_app_interrupted) return false;
    double passed = 1;
    if (s->options.transport == LOBE_TRANSPORT_RADIANCE)
        passed = wi.z < 0 ? s->ior * s->ior : 1 / (s->ior * s->ior);
    const double row[] = {wi.z,
                          once.reflected,
                          once.transmitted * passed,
                          once.reflected + once.transmitted,
                          all.reflected + all.transmitted,
                          all.reflected,
                          all.transmitted * passed};
    return lobe_app_write_row(table, row);
}
