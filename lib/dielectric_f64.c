/* lib/dielectric_f64.c: rough dielectrics in double precision. */
#include "../kernel/bind/c_f64.h"

#define LOBE_NAME(stem) lobe_##stem##_f64

#include "dielectric_template.h"

/* Steps of the golden section in u1 over even steps in u2: also where reflection or transmission ceases at
 * one u2, as at normal incidence, no row of points falls together. */
lobe_dielectric_albedo lobe_dielectric_integrate(const lobe_dielectric_f64 *dielectric,
                                                 int32_t points) {
    ggx_dielectric s = state_of(dielectric);
    lobe_dielectric_albedo sum = {0, 0};
    for (int i = 0; i < points; ++i) {
        double turn = 0.61803398874989484820 * i;
        dielectric_facet f = ggx_dielectric_drawn(s, turn - k_floor(turn), (i + 0.5) / points);
        sum.reflected += f.reflects ? dielectric_ratio_r(s.side, f) : 0;
        sum.transmitted += f.passes ? dielectric_ratio_t(s.side, f) : 0;
    }
    return (lobe_dielectric_albedo){sum.reflected / points, sum.transmitted / points};
}
