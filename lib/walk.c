/* lib/walk.c: the random walk on a Smith microsurface.
 *
 * Heitz et al. 2016 draw heights; a height matters only through the share c of the surface below it,
 * and c only through the depth l = -ln c: along a direction w the ray meets a facet at
 *   l' = l - e/Lambda(w),   e exponential,
 * and has left where l' < 0. Lambda(w) = (t - w_z)/(2 w_z) is negative for a ray that descends, and
 * its depth grows. The facet is drawn from the normals visible from where the ray comes. */
#include "../kernel/bind/c_f64.h"

#include "lobe/random.h"
#include "lobe/walk.h"

#include "../kernel/ggx_caps.h"
#include "../kernel/log.h"

#include <stddef.h>

/* l' of a ray from depth l. Level rays do not move: their next facet is where they are. */
static double next_depth(v3 w, double ax, double ay, double depth, double u) {
    const double x = ax * w.x, y = ay * w.y, plane = x * x + y * y;
    const double t = k_sqrt(plane + w.z * w.z);
    /* 1/Lambda: t - w_z without cancellation for a steep ascent */
    const double minus = w.z > 0.0 ? plane / (t + w.z) : t - w.z;
    const double exponential = -k_log(1.0 - u);
    return depth - 2.0 * w.z * exponential / k_max(minus, K_TINY);
}

static void clear(double *weights, int count) {
    for (int k = 0; k < count; ++k) weights[k] = 0.0;
}

lobe_walk lobe_walk_sample(lobe_microsurface s, const lobe_reflectance *f, int count,
                           lobe_vec3_f64 wi, uint64_t seed, uint64_t index, int most,
                           double *weights) {
    const lobe_walk cut = {{0.0, 0.0, 1.0}, 0};
    const facet_options options = facet_options_of(false, false);
    const bool known = s.ndf == LOBE_NDF_GGX && s.masking == LOBE_MASKING_SMITH;
    ggx_base base = ggx_base_of(v3_of(wi.x, wi.y, wi.z), s.alpha_x, s.alpha_y, options);
    clear(weights, count);
    if (!known || !base.valid || !(wi.z > 0.0)) return cut;
    for (int k = 0; k < count; ++k) weights[k] = 1.0;
    double depth = 0.0;
    v3 w = v3_scale(base.wi, -1.0); /* of the ray */
    for (int bounce = 0; bounce <= most; ++bounce) {
        const lobe_random4 r = lobe_random(seed, index, (uint64_t)bounce);
        depth = next_depth(w, base.ax, base.ay, depth, k_unit((r.word[0] + 0.5) * 0x1p-32));
        if (depth < 0.0) return (lobe_walk){{w.x, w.y, w.z}, bounce};
        base = ggx_base_of(v3_scale(w, -1.0), s.alpha_x, s.alpha_y, options);
        const facet_draw draw = ggx_caps_draw(ggx_caps_prepare(base), (r.word[1] + 0.5) * 0x1p-32,
                                              (r.word[2] + 0.5) * 0x1p-32, 0.0);
        w = v3_normalize(draw.wo);
        for (int k = 0; k < count; ++k) weights[k] *= lobe_reflectance_at(f[k], draw.cos_im);
    }
    clear(weights, count);
    return cut;
}
