#include "albedo_dielectric.h"

enum { POINTS = 262144 };

const char *const lobe_app_dielectric_columns[] = {"mu", "r", "t", "energy", "furnace", NULL};

static lobe_dielectric_albedo integrate(const lobe_app_dielectric_surface *s, lobe_vec3_f64 wi,
                                        lobe_transport transport, bool compensate) {
    lobe_dielectric_options options = s->options;
    options.transport = transport;
    options.compensate = compensate;
    const lobe_dielectric_f64 d =
        lobe_dielectric_prepare_f64(options, wi, s->alpha[0], s->alpha[1], s->ior);
    return lobe_dielectric_integrate(&d, POINTS);
}

bool lobe_app_write_dielectric(const lobe_app_dielectric_surface *s, const lobe_app_table *table,
                               lobe_vec3_f64 wi) {
    const lobe_dielectric_albedo once = integrate(s, wi, LOBE_TRANSPORT_IMPORTANCE, false);
    const lobe_dielectric_albedo all =
        s->options.compensate ? integrate(s, wi, LOBE_TRANSPORT_IMPORTANCE, true) : once;
    double passed = once.transmitted;
    if (s->options.transport == LOBE_TRANSPORT_RADIANCE)
        passed *= wi.z < 0 ? s->ior * s->ior : 1 / (s->ior * s->ior);
    const double row[] = {wi.z, once.reflected, passed, once.reflected + once.transmitted,
                          all.reflected + all.transmitted};
    return lobe_app_write_row(table, row);
}
