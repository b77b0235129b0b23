/* lib/dielectric.c: the options of rough dielectrics to start from. */
#include "lobe/dielectric.h"

lobe_dielectric_options lobe_dielectric_default_options(void) {
    lobe_dielectric_options options = {LOBE_G2_CORRELATED, LOBE_TRANSPORT_RADIANCE, 0, 0};
    return options;
}
