/* ssr/passes/march.h: a ray through the depth buffer, in screen space, one cell of the min-max pyramid a
 * step. The linear march, texel by texel, is the same text with a highest level of 0.
 *
 * Perspective maps lines to lines: with s(t) the screen position (pixels, device depth) of o + t r and w
 * the distance along the axis, s(t) - s(0) = t/(w + t r_w) (S_r - s(0) r_w), S the homogeneous numerators.
 * So the direction on the screen is exact, and the march runs in q = t/(w + t r_w), scaled to pixels.
 *
 * A texel of depth d is solid between its floor d and its base, the depth of z (1 + thickness). The ray
 *   hits  where it meets a slab through the floor, or from a texel where it was in front;
 *   is lost where it meets a slab after it was behind one: what it met there cannot be seen;
 *   goes on in front of slabs and behind them.
 * A cell of the pyramid is passed whole if the ray is in front of its nearest floor or behind its farthest
 * base: rays toward the camera and rays behind objects then cost as little as others. */
#ifndef LOBE_SSR_MARCH_H
#define LOBE_SSR_MARCH_H

#include "camera.h"

#define SSR_MARCH_GOES K_INT(0)
#define SSR_MARCH_HIT K_INT(1)
#define SSR_MARCH_LOST K_INT(2) /* behind something */
#define SSR_MARCH_LEFT K_INT(3) /* the screen or the depth range */

K_FN kint ssr_pick(bool condition, kint yes, kint no) {
    return condition ? yes : no;
}

K_STRUCT(ssr_ray) {
    v3 origin;    /* pixels, device depth */
    v3 direction; /* the greater of |x|, |y| is 1 */
    real inverse_x;
    real inverse_y;
    real end;
    real push;   /* how far beyond a wall the next cell is looked for, in pixels */
    real axis_z; /* of the origin, along the camera's axis */
    real slope;  /* distance in the world is q axis_z/(norm - q slope) */
    real norm;
    kint valid;
};

K_STRUCT(ssr_march) {
    real q;
    kint level;
    kint below;
    kint state;
};

K_FN real ssr_inverse(real x) {
    return k_select(k_abs(x) > R(1e-12), R(1.0) / k_select(x == R(0.0), R(1.0), x), K_HUGE);
}

/* Where the ray leaves [low, high] of one axis. */
K_FN real ssr_leave(real origin, real direction, real low, real high) {
    real to = k_select(direction > R(0.0), high, low) - origin;
    return k_select(k_abs(direction) > R(1e-12), to * ssr_inverse(direction), K_HUGE);
}

/* `push` of all rays of a camera. */
K_FN real ssr_ray_push(ssr_camera c) {
    return k_max(R(0.00048828125), (c.width + c.height) * R(2.0) * K_EPS);
}

/* From pixel position (px, py) at distance z along the axis, in a direction of the world. */
K_FN ssr_ray ssr_ray_of(ssr_camera c, real px, real py, real z, v3 direction) {
    v3 a = ssr_axes_of(c, direction);
    real span = c.far_z - c.near_z;
    real x = R(0.5) * c.width * (a.x / c.tan_x + a.z) - px * a.z;
    real y = R(0.5) * c.height * (a.z - a.y / c.tan_y) - py * a.z;
    real depth = -c.near_z * c.far_z / span * a.z / z;
    real norm = k_max(k_abs(x), k_abs(y));
    /* straight toward the eye or away: no way on the screen */
    bool moves = norm > R(1e-6) * (c.width + c.height);
    real scale = R(1.0) / k_select(moves, norm, R(1.0));
    ssr_ray r;
    r.origin = v3_of(px, py, ssr_depth_of(c, z));
    r.direction = v3_of(x * scale, y * scale, depth * scale);
    r.inverse_x = ssr_inverse(r.direction.x);
    r.inverse_y = ssr_inverse(r.direction.y);
    real end_x = ssr_leave(px, r.direction.x, R(0.5), c.width - R(0.5));
    real end_y = ssr_leave(py, r.direction.y, R(0.5), c.height - R(0.5));
    real end_z = ssr_leave(r.origin.z, r.direction.z, R(0.0), R(1.0));
    r.end = k_min(k_min(end_x, end_y), end_z);
    r.push = ssr_ray_push(c);
    r.axis_z = z;
    r.slope = a.z;
    r.norm = norm;
    r.valid = k_flag(k_and(moves, k_and(r.origin.z > R(0.0), r.origin.z <= R(1.0))));
    return r;
}

K_FN ssr_march ssr_march_start(ssr_ray r) {
    ssr_march m;
    m.q = R(0.5);
    m.level = K_INT(0);
    m.below = K_INT(0);
    m.state = SSR_MARCH_GOES;
    if (k_or(!k_is(r.valid), r.end <= m.q)) m.state = SSR_MARCH_LEFT;
    return m;
}

/* Length of the ray in the world. */
K_FN real ssr_march_length(ssr_ray r, ssr_march m) {
    return m.q * r.axis_z / k_max(r.norm - m.q * r.slope, K_TINY);
}

/* The cell of the march's level. */
K_FN kint ssr_march_cell(real origin, real direction, real q, real push, kint level) {
    real ahead = k_select(direction < R(0.0), -push, push);
    real at = k_max(origin + q * direction + ahead, R(0.0));
    return k_down(k_whole(at), level);
}

K_FN kint ssr_march_x(ssr_ray r, ssr_march m) {
    return ssr_march_cell(r.origin.x, r.direction.x, m.q, r.push, m.level);
}

K_FN kint ssr_march_y(ssr_ray r, ssr_march m) {
    return ssr_march_cell(r.origin.y, r.direction.y, m.q, r.push, m.level);
}

/* How deep a texel is: base = scale d - offset. */
K_STRUCT(ssr_slab) {
    real scale;
    real offset;
};

K_FN ssr_slab ssr_slab_of(ssr_camera c, real thickness) {
    real near_share = c.near_z / (c.far_z - c.near_z);
    ssr_slab s;
    s.scale = R(1.0) / (R(1.0) + thickness);
    s.offset = near_share * thickness * s.scale;
    return s;
}

K_FN real ssr_wall(real origin, real direction, real inverse, kint cell, kint level) {
    real edge = k_up(cell + ssr_pick(direction > R(0.0), K_INT(1), K_INT(0)), level);
    return k_select(inverse < K_HUGE, (edge - origin) * inverse, K_HUGE);
}

/* One step through cell (x, y), whose greatest depth is `nearest` and whose least is `farthest`. */
K_FN ssr_march ssr_march_step(ssr_ray r, ssr_march m, ssr_slab slab, kint x, kint y, real nearest,
                              real farthest, kint highest_level) {
    real wall_x = ssr_wall(r.origin.x, r.direction.x, r.inverse_x, x, m.level);
    real wall_y = ssr_wall(r.origin.y, r.direction.y, r.inverse_y, y, m.level);
    real exit_q = k_max(k_min(k_min(wall_x, wall_y), r.end), m.q);
    real z_in = r.origin.z + m.q * r.direction.z;
    real z_out = r.origin.z + exit_q * r.direction.z;
    bool above = k_min(z_in, z_out) > nearest;
    bool behind = k_max(z_in, z_out) < slab.scale * farthest - slab.offset;
    bool passes = k_or(above, behind);
    bool is_finest = m.level == K_INT(0);
    /* in front of all the cell holds up to where the ray meets its nearest floor */
    bool falls = k_and(!passes, z_in > nearest);
    real floor_q = (nearest - r.origin.z) / k_select(falls, r.direction.z, R(1.0));
    real met = k_select(falls, k_min(k_max(floor_q, m.q), exit_q), m.q);
    bool was_below = k_and(k_is(m.below), !falls);
    ssr_march next;
    next.q = k_select(passes, exit_q, met);
    next.below = ssr_pick(passes, k_flag(behind), k_flag(was_below));
    next.level = ssr_pick(passes, ssr_pick(m.level < highest_level, m.level + K_INT(1), m.level),
                          ssr_pick(is_finest, m.level, m.level - K_INT(1)));
    kint met_state = ssr_pick(was_below, SSR_MARCH_LOST, SSR_MARCH_HIT);
    kint left_state = ssr_pick(exit_q >= r.end, SSR_MARCH_LEFT, SSR_MARCH_GOES);
    next.state = ssr_pick(passes, left_state, ssr_pick(is_finest, met_state, SSR_MARCH_GOES));
    return next;
}

#endif
