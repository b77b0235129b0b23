/* lib/fresnel_template.h: the public Fresnel functions over the kernels, once for each precision.
 * Before including: the binding of the precision and LOBE_NAME(stem), as for reflection_template.h. */
#include "lobe/fresnel.h"

#include "../kernel/fresnel.h"

real LOBE_NAME(fresnel_schlick)(real f0, real cos_i) {
    return fresnel_schlick(f0, cos_i);
}

real LOBE_NAME(fresnel_schlick_average)(real f0) {
    return fresnel_schlick_average(f0);
}

real LOBE_NAME(fresnel_f82)(real f0, real tint, real cos_i) {
    return fresnel_f82(f0, tint, cos_i);
}

real LOBE_NAME(fresnel_f82_average)(real f0, real tint) {
    return fresnel_f82_average(f0, tint);
}

real LOBE_NAME(fresnel_dielectric)(real ior, real cos_i) {
    return fresnel_dielectric(ior, cos_i);
}

real LOBE_NAME(fresnel_dielectric_average)(real ior) {
    return fresnel_dielectric_average(ior);
}

real LOBE_NAME(fresnel_conductor)(real n, real k, real cos_i) {
    return fresnel_conductor(n, k, cos_i);
}

real LOBE_NAME(fresnel_conductor_average)(real n, real k) {
    return fresnel_conductor_average(n, k);
}
