/* Accumulate: the reflection of the frame before, found again where the surface was, held to the range of
 * the present neighbourhood, and blended.
 * Agrees with the processor to 2e-4, for the same history. */
#include "common.glsl"
#include "motion.glsl"
#include "z.glsl"

layout(std430, binding = 9) readonly buffer met_block {
    ssr_met met[];
};
layout(std430, binding = 13) readonly buffer resolved_block {
    ssr_reflected resolved[];
};
layout(std430, binding = 14) readonly buffer history_block {
    ssr_reflected history[];
};
layout(std430, binding = 15) writeonly buffer reflection_block {
    ssr_reflected reflection[];
};
layout(std430, binding = 16) readonly buffer last_z_block {
    real last_z[];
};
layout(std430, binding = 22) readonly buffer motion_z_block {
    real motion_z[];
};

/* `at` in pixels. */
ssr_reflected history_at(ssr_place at) {
    ssr_between b = ssr_between_of(at.x, at.y);
    ssr_reflected sum = ssr_no_reflected();
    for (kint k = 0; k < 4; ++k) {
        kint x = ssr_inside(ssr_corner_x(b, k), p.width);
        kint y = ssr_inside(ssr_corner_y(b, k), p.height);
        sum = ssr_add_reflected(sum, history[pixel_at(x, y)], ssr_share(b, k));
    }
    return sum;
}

ssr_range range_around() {
    ssr_range range = ssr_no_range();
    for (kint y = own_y() - 1; y <= own_y() + 1; ++y)
        for (kint x = own_x() - 1; x <= own_x() + 1; ++x)
            if (x >= 0 && y >= 0 && x < p.width && y < p.height)
                range = ssr_widen(range, resolved[pixel_at(x, y)]);
    return range;
}

real speed_at(kint pixel) {
    ssr_place m = motion_at(pixel);
    return ssr_speed(m.x, m.y, float(p.width), float(p.height));
}

/* Where the surface was, in pixels; `seen` tells whether it was seen there. */
ssr_place place_before(kint pixel, out bool seen) {
    real x = float(own_x()) + 0.5;
    real y = float(own_y()) + 0.5;
    real z = z_at(pixel);
    ssr_place m = motion_at(pixel);
    ssr_place at = ssr_pixel_before(x, y, p.now, m.x, m.y);
    seen = k_is(p.has_history) && z > 0.0 && ssr_on_screen(p.last, at.x, at.y);
    if (!seen) return at;
    real expected = ssr_expected_z(p.now, p.last, x, y, z);
    if (k_is(p.has_motion_z)) expected = ssr_moved_z(z, motion_z[pixel]);
    real there = last_z[pixel_at(k_to_int(k_floor(at.x)), k_to_int(k_floor(at.y)))];
    seen = expected > 0.0 && ssr_is_same_surface(expected, there);
    return at;
}

void main() {
    if (is_outside(p.width, p.height)) return;
    kint pixel = pixel_at(own_x(), own_y());
    ssr_met m = met[pixel];
    ssr_reflected fresh = resolved[pixel];
    reflection[pixel] = fresh;
    if (ssr_met_state(m) == SSR_NO_RAY) return;
    bool seen;
    ssr_place at = place_before(pixel, seen);
    if (!seen) return;
    ssr_reflected old = ssr_held(history_at(at), range_around());
    real reflected = 0.0;
    if (ssr_met_something(m)) reflected = speed_at(pixel_at(ssr_met_x(m), ssr_met_y(m)));
    real share = ssr_new_share(p.accumulation, speed_at(pixel), reflected, p.rejection);
    reflection[pixel] = ssr_blend(old, fresh, share);
}
