/* kernel/ggx_horizon_plane_table.h: `horizon` where the geometric plane is not the shading
 * plane: reflections that leave both (kernel/ggx_horizon_plane_ray.h), none other, more of them
 * where shadowing lets more light through (kernel/ggx_horizon_plane_nodes.h). First the azimuth by the
 * nodes, then the radius. Valid for wi on the front of the geometric plane, above or below the shading
 * plane. docs/horizon-planes.md has the derivation and what was measured. */
#ifndef K_GGX_HORIZON_PLANE_TABLE_H
#define K_GGX_HORIZON_PLANE_TABLE_H

#include "ggx_horizon_plane_nodes.h"

K_STRUCT(ggx_horizon_plane_table) {
    ggx_horizon_plane_disk disk;
    ggx_horizon_plane_nodes nodes;
};

K_FN ggx_horizon_plane_table ggx_horizon_plane_table_prepare(ggx_base g) {
    ggx_horizon_plane_table t;
    t.disk = ggx_horizon_plane_disk_of(g);
    t.nodes = ggx_horizon_plane_nodes_of(t.disk);
    return t;
}

K_FN facet_draw ggx_horizon_plane_table_draw(ggx_horizon_plane_table t, real u1, real u2, real u3) {
    ggx_horizon_plane_disk d = t.disk;
    ggx_horizon_frame f = d.f;
    real place = ggx_horizon_plane_place(t.nodes, u1);
    ggx_horizon_angle e =
        ggx_horizon_plane_azimuth(R(4.0) * place / k_from_int(GGX_HORIZON_PLANE_NODES));
    ggx_horizon_plane_node node = ggx_horizon_plane_at(t.nodes, place);
    /* the share of the ray beyond the point is u */
    real u = R(1.0) - u2;
    real b = node.q0 - u * (node.q0 + node.p * node.q1);
    real root = k_sqrt(b * b + R(4.0) * node.p * u2 * u);
    real outer = k_select(b < R(0.0), root - b, R(2.0) * u);
    real inner = k_select(b < R(0.0), R(2.0) * node.p * u2, b + root);
    real inv_both = R(1.0) / (outer + inner);
    real v = outer * inv_both;
    real rest = inner * inv_both;

    ggx_horizon_plane_ray ray = ggx_horizon_plane_ray_of(d, e.c, e.s);
    ggx_horizon_plane_point y = ggx_horizon_plane_point_of(ray, v, rest);
    v3 m = v3_combine(d.f1, y.r * e.c, d.f2, y.r * e.s, f.n, y.z);
    real im = f.nu * y.z + (d.i1 * e.c + d.i2 * e.s) * y.r;
    real value = ggx_horizon_plane_value(ray, ray.shading, y, v);
    ggx_horizon_arrival to = ggx_horizon_plane_arrive(d, m, im, value);
    real spread = ggx_horizon_plane_spread(node, ray, e.c, e.s, v, rest, y.z, to.im);
    return ggx_horizon_draw_of(d.set, to.pair, spread);
}

/* Where a pair comes from, and whether it can be drawn. */
K_STRUCT(ggx_horizon_plane_origin) {
    ggx_horizon_plane_ray ray;
    real y1; /* r (c, s) */
    real y2;
    real c;
    real s;
    real v;
    real im;
    bool inside;
};

/* v by what is left above each plane, which wo knows; from behind, of the shading plane, m does */
K_FN ggx_horizon_plane_origin ggx_horizon_plane_origin_of(ggx_horizon_plane_disk d,
                                                          facet_pair pair) {
    ggx_base g = d.set.g;
    v3 w = v3_of(pair.m.x * g.inv_ax, pair.m.y * g.inv_ay, pair.m.z);
    real am2 = R(1.0) / k_max(v3_dot(w, w), K_TINY);
    real am = k_sqrt(am2);
    v3 m = v3_scale(w, am);
    ggx_horizon_plane_origin at;
    at.im = pair.cos_im * am / g.t_i;
    at.y1 = v3_dot(m, d.d1);
    at.y2 = v3_dot(m, d.d2);
    ggx_horizon_plane_point y;
    real r2 = at.y1 * at.y1 + at.y2 * at.y2;
    y.r = k_sqrt(r2);
    y.z = v3_dot(m, d.f.n);
    real inv_r = R(1.0) / k_max(y.r, K_TINY);
    bool off_centre = y.r > K_TINY;
    at.c = k_select(off_centre, at.y1 * inv_r, R(1.0));
    at.s = k_select(off_centre, at.y2 * inv_r, R(0.0));
    at.ray = ggx_horizon_plane_ray_of(d, at.c, at.s);
    real height = am2 / g.t_i;
    real from_wo = pair.wo.z * height;
    real shading = k_select(k_is(d.set.front), from_wo, R(2.0) * at.im * m.z);
    real geometric = v3_dot(pair.wo, g.plane) * height;
    real room = k_min(ggx_horizon_plane_room(at.ray.shading, y, shading),
                      ggx_horizon_plane_room(at.ray.geometric, y, geometric));
    at.v = k_min(k_select(k_is(d.cuts), room, R(1.0) - r2), R(1.0));
    at.inside =
        k_and(k_and(at.v > R(0.0), y.z > R(0.0)), k_and(pair.m.z > R(0.0), pair.cos_im > R(0.0)));
    at.v = k_max(at.v, K_EPS * K_EPS);
    return at;
}

K_FN real ggx_horizon_plane_table_pdf(ggx_horizon_plane_table t, facet_pair pair) {
    ggx_horizon_plane_disk d = t.disk;
    ggx_horizon_plane_origin at = ggx_horizon_plane_origin_of(d, pair);
    real rest = R(1.0) - at.v;
    real place =
        ggx_horizon_plane_diamond(at.y1, at.y2) * (R(0.25) * k_from_int(GGX_HORIZON_PLANE_NODES));
    real z = ggx_horizon_plane_point_of(at.ray, at.v, rest).z;
    real spread = ggx_horizon_plane_spread(ggx_horizon_plane_at(t.nodes, place), at.ray, at.c, at.s,
                                           at.v, rest, z, at.im);
    return k_select(at.inside, d.set.pdf_scale * pair.d * spread, R(0.0));
}

K_FN real ggx_horizon_plane_table_pdf_m(ggx_horizon_plane_table t, facet_pair pair) {
    return ggx_horizon_density_m(pair, ggx_horizon_plane_table_pdf(t, pair));
}

/* Every draw leaves; but for the rare cases whose axis is not inside both cones. */
K_FN real ggx_horizon_plane_table_acceptance(ggx_horizon_plane_table t) {
    return k_select(k_is(t.disk.cuts), R(1.0), R(-1.0));
}

/* Worst errors of a draw in float, 2 10^6 random inputs (tools/numerics/plane_error.c: roughness 0.05 to
 * 2, wi to 120 degrees, tilts to 60, u2 up to 0.98). That of pdf, met with other random inputs of the
 * same kind, lies near the axis of the rays, where the rounding of m turns the azimuth.
 * wo:  3.2e-05 at wi (-0x1.db5a8cp-1, 0x1.797116p-2, -0x1.7d16fp-5),
 *      plane (-0x1.059e3ap-1, 0x1.44038ap-1, 0x1.29d9c8p-1), alpha (0x1.d7a2c6p-5, 0x1.84afc8p+0),
 *      u (0x1.69befep-1, 0x1.d9418ep-1), floor_share 0.375; one in 1000 above 1.9e-06
 * pdf: 1.7e-04 relative at wi (0x1.d7fecap-1, 0x1.001d66p-4, -0x1.879c1cp-2),
 *      plane (0x1.80dae2p-2, -0x1.04742ap-1, 0x1.8c95b4p-1), alpha (0x1.1f69f6p-4, 0x1.a226f4p-2),
 *      u (0x1.22fcd4p-2, 0x1.1d883ep-10), floor_share 0.75; one in 1000 above 2.1e-06 */

#endif
