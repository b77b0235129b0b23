/* Prefiltered light from everywhere, interpolated over directions and roughness. */
#include "environment.h"

v3 lobe_ssr_environment_at(const lobe_ssr_environment *e, v3 direction, float roughness) {
    return e->rgb ? ssr_environment_light(e, direction, roughness) : v3_of(0.0f, 0.0f, 0.0f);
}
