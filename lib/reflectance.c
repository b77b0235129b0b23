/* lib/reflectance.c: the Fresnel laws behind one type. */
#include "lobe/albedo.h"
#include "lobe/fresnel.h"

lobe_reflectance lobe_reflectance_one(void) {
    lobe_reflectance one = {LOBE_REFLECTANCE_ONE, 0.0, 0.0};
    return one;
}

double lobe_reflectance_at(lobe_reflectance f, double cos_i) {
    switch (f.law) {
    case LOBE_REFLECTANCE_ONE:
        return 1.0;
    case LOBE_REFLECTANCE_SCHLICK:
        return lobe_fresnel_schlick_f64(f.a, cos_i);
    case LOBE_REFLECTANCE_F82:
        return lobe_fresnel_f82_f64(f.a, f.b, cos_i);
    case LOBE_REFLECTANCE_DIELECTRIC:
        return lobe_fresnel_dielectric_f64(f.a, cos_i);
    case LOBE_REFLECTANCE_CONDUCTOR:
        return lobe_fresnel_conductor_f64(f.a, f.b, cos_i);
    }
    return 0.0;
}

/* 2 * integral of F mu dmu, mu = t^4: for a small n F turns within mu = n. Composite Simpson. */
static double average_by_quadrature(lobe_reflectance f) {
    enum { STEPS = 512 };
    double sum = 0.0;
    for (int i = 1; i <= STEPS; ++i) {
        const double t = (double)i / STEPS, t3 = t * t * t;
        const double weight = i == STEPS ? 1.0 : i % 2 ? 4.0 : 2.0;
        sum += weight * lobe_reflectance_at(f, t3 * t) * 8.0 * t3 * t3 * t;
    }
    return sum / (3.0 * STEPS);
}

double lobe_reflectance_average(lobe_reflectance f) {
    switch (f.law) {
    case LOBE_REFLECTANCE_ONE:
        return 1.0;
    case LOBE_REFLECTANCE_SCHLICK:
        return lobe_fresnel_schlick_average_f64(f.a);
    case LOBE_REFLECTANCE_F82:
        return lobe_fresnel_f82_average_f64(f.a, f.b);
    case LOBE_REFLECTANCE_DIELECTRIC:
        return lobe_fresnel_dielectric_average_f64(f.a);
    case LOBE_REFLECTANCE_CONDUCTOR:
        return average_by_quadrature(f);
    }
    return 0.0;
}
