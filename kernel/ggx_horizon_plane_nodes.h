/* kernel/ggx_horizon_plane_nodes.h: how a density is laid over the rays of two planes.
 *
 * Azimuth: the diamond angle x in [0, 4), (c, s) ~ (1 - x, x) on the first quarter and so on round, with
 * a density linear between N nodes; no arc tangent on the way back. Radius: a rational quadratic in
 * t = 1 - v with the end values q1 (t = 0), q0 (t = 1),
 *     D = P v^2 + (q0 + P q1) v t + t^2,   q = (P^2 q1 v^2 + 2 P v t + q0 t^2)/D^2,
 * which integrates to one whatever its three numbers are, so these are linear between the nodes as well.
 * Any numbers give an unbiased density. Those of a node follow what is wanted there: the visible normals
 * times (1 - delta) G + delta G(n), G = G2/G1(i), delta = g.floor_share. */
#ifndef K_GGX_HORIZON_PLANE_NODES_H
#define K_GGX_HORIZON_PLANE_NODES_H

#include "ggx_horizon_plane_ray.h"

/* A multiple of 4. */
#ifndef GGX_HORIZON_PLANE_NODES
#define GGX_HORIZON_PLANE_NODES 8
#endif

/* The least density of the azimuth, in means, and the limits of the three numbers. */
#define GGX_HORIZON_PLANE_LEAST R(0.02)
#define GGX_HORIZON_PLANE_END_MAX R(20.0)
#define GGX_HORIZON_PLANE_P_MAX R(50.0)
/* the pole of the visible normals' density, (m.i)/z at z = 0, is not followed to its end */
#define GGX_HORIZON_PLANE_Z_MIN R(0.02)

/* The unit vector of the diamond angle x in [0, 4]; dphi = (|c| + |s|)^2 dx. */
K_FN ggx_horizon_angle ggx_horizon_plane_azimuth(real x) {
    real c = k_abs(x - R(2.0)) - R(1.0);
    real s = k_max(R(1.0) - k_abs(x - R(1.0)), x - R(4.0));
    real inv = R(1.0) / k_sqrt(c * c + s * s);
    ggx_horizon_angle e;
    e.c = c * inv;
    e.s = s * inv;
    return e;
}

K_FN real ggx_horizon_plane_diamond(real c, real s) {
    real part = k_abs(s) / k_max(k_abs(c) + k_abs(s), K_TINY);
    real right = k_select(s < R(0.0), R(4.0) - part, part);
    real left = k_select(s < R(0.0), R(2.0) + part, R(2.0) - part);
    return k_select(c < R(0.0), left, right);
}

/* The numbers of one azimuth. */
K_STRUCT(ggx_horizon_plane_node) {
    real w; /* density of x; mean 1 over the nodes */
    real p;
    real q0;
    real q1;
};

K_STRUCT(ggx_horizon_plane_nodes) {
    real w[GGX_HORIZON_PLANE_NODES + 1]; /* the last node is the first */
    real p[GGX_HORIZON_PLANE_NODES + 1];
    real q0[GGX_HORIZON_PLANE_NODES + 1];
    real q1[GGX_HORIZON_PLANE_NODES + 1];
};

/* --- making them --------------------------------------------------------------------------------- */

/* X of G = V (1 + c)/(V + c X), V = m^T Q m of the shading plane, c = max(i_z, 0) */
K_FN real ggx_horizon_plane_shade(ggx_base g, v3 m, real im) {
    v3 aam = ggx_stretch(ggx_stretch(m, g.ax, g.ay), g.ax, g.ay);
    v3 w = v3_sub(v3_scale(aam, R(2.0) * im), v3_scale(g.i_std, v3_dot(m, aam)));
    return k_sqrt(v3_dot(w, w));
}

/* What a node looks along. */
K_STRUCT(ggx_horizon_plane_probe) {
    ggx_horizon_plane_ray ray;
    v3 x;
    real ix;     /* i.x */
    real follow; /* wanted: (m.i)/z (follow V/(V + c X) + level) */
    real level;
};

/* What is wanted at v of a ray, in ds dphi. */
K_FN real ggx_horizon_plane_wanted(ggx_horizon_plane_disk d, ggx_horizon_plane_probe probe,
                                   real v) {
    ggx_horizon_plane_point y = ggx_horizon_plane_point_of(probe.ray, v, R(1.0) - v);
    v3 m = v3_add(v3_scale(probe.x, y.r), v3_scale(d.f.n, y.z));
    real im = k_max(d.f.nu * y.z + probe.ix * y.r, R(0.0));
    real value = ggx_horizon_plane_value(probe.ray, probe.ray.shading, y, v);
    value = k_max(value, K_EPS * K_EPS);
    real shaded = value + d.set.c * ggx_horizon_plane_shade(d.set.g, m, im);
    real z = k_max(y.z, GGX_HORIZON_PLANE_Z_MIN);
    return (probe.follow * value + probe.level * shaded) * im / (shaded * z);
}

K_FN real ggx_horizon_plane_clamp(real x, real low, real high) {
    return k_min(k_max(x, low), high);
}

/* From what is wanted at v = 1, 1/2, 1/8, 0: the masses of both halves, then P such that they have them. The
 * outer one by Simpson's rule in sqrt(v), since shadowing sets in suddenly where the surface is smooth; the
 * inner one by the trapezium. w is the whole mass. */
K_FN ggx_horizon_plane_node ggx_horizon_plane_fit(real f0, real f1, real f2, real f3) {
    real outer = (f1 + R(2.0) * f2) * R(0.16666666666666666667);
    ggx_horizon_plane_node node;
    node.w = outer + R(0.25) * (f0 + f1);
    real inv = R(1.0) / k_max(node.w, K_TINY);
    real low = GGX_HORIZON_PLANE_LEAST;
    node.q0 = ggx_horizon_plane_clamp(f3 * inv, low, GGX_HORIZON_PLANE_END_MAX);
    node.q1 = ggx_horizon_plane_clamp(f0 * inv, low, GGX_HORIZON_PLANE_END_MAX);
    real share = outer * inv;
    real top = share * (R(1.0) + node.q0) - node.q0;
    real bottom = k_max(R(1.0) - share * (R(1.0) + node.q1), R(1e-3));
    node.p = ggx_horizon_plane_clamp(top / bottom, low, GGX_HORIZON_PLANE_P_MAX);
    return node;
}

/* At the diamond angle x; centre: G at n. */
K_FN ggx_horizon_plane_node ggx_horizon_plane_node_of(ggx_horizon_plane_disk d, real x,
                                                      real centre) {
    ggx_horizon_angle e = ggx_horizon_plane_azimuth(x);
    real delta = d.set.g.floor_share;
    ggx_horizon_plane_probe probe;
    probe.ray = ggx_horizon_plane_ray_of(d, e.c, e.s);
    probe.x = v3_add(v3_scale(d.f1, e.c), v3_scale(d.f2, e.s));
    probe.ix = d.i1 * e.c + d.i2 * e.s;
    probe.follow = (R(1.0) - delta) * (R(1.0) + d.set.c);
    probe.level = delta * centre;
    real f1 = R(0.0);
    real f2 = R(0.0);
    real f3 = R(0.0);
    K_UNROLL
    for (int k = 0; k < 3; ++k) {
        real x = R(1.0) - R(0.5) * k_from_int(k);
        f1 = f2;
        f2 = f3;
        f3 = ggx_horizon_plane_wanted(d, probe, R(0.5) * x * x);
    }
    ggx_horizon_plane_node node = ggx_horizon_plane_fit(centre * d.f.nu, f1, f2, f3);
    node.w = node.w * probe.ray.reach * k_square(k_abs(e.c) + k_abs(e.s));
    return node;
}

K_FN real ggx_horizon_plane_centre(ggx_horizon_plane_disk d) {
    real value = k_max(d.shading.a0, K_EPS * K_EPS);
    real shade = d.set.c * ggx_horizon_plane_shade(d.set.g, d.f.n, d.f.nu);
    return value * (R(1.0) + d.set.c) / (value + shade);
}

K_FN ggx_horizon_plane_nodes ggx_horizon_plane_nodes_of(ggx_horizon_plane_disk d) {
    real count = k_from_int(GGX_HORIZON_PLANE_NODES);
    real centre = ggx_horizon_plane_centre(d);
    real sum = R(0.0);
    ggx_horizon_plane_nodes t;
    K_UNROLL
    for (int j = 0; j < GGX_HORIZON_PLANE_NODES; ++j) {
        real x = R(4.0) * k_from_int(j) / count;
        ggx_horizon_plane_node node = ggx_horizon_plane_node_of(d, x, centre);
        t.w[j] = node.w;
        t.p[j] = node.p;
        t.q0[j] = node.q0;
        t.q1[j] = node.q1;
        sum = sum + node.w;
    }
    real scale = (R(1.0) - GGX_HORIZON_PLANE_LEAST) * count / k_max(sum, K_TINY);
    real total = R(0.0);
    K_UNROLL
    for (int k = 0; k < GGX_HORIZON_PLANE_NODES; ++k) {
        t.w[k] = GGX_HORIZON_PLANE_LEAST + scale * t.w[k];
        total = total + t.w[k];
    }
    /* nothing wanted anywhere: even */
    bool spread = k_and(total > R(0.5) * count, total < R(2.0) * count);
    K_UNROLL
    for (int l = 0; l < GGX_HORIZON_PLANE_NODES; ++l) t.w[l] = k_select(spread, t.w[l], R(1.0));
    t.w[GGX_HORIZON_PLANE_NODES] = t.w[0];
    t.p[GGX_HORIZON_PLANE_NODES] = t.p[0];
    t.q0[GGX_HORIZON_PLANE_NODES] = t.q0[0];
    t.q1[GGX_HORIZON_PLANE_NODES] = t.q1[0];
    return t;
}

/* --- using them ---------------------------------------------------------------------------------- */

/* The numbers at a place x N/4: the hats about the nodes add up to one everywhere. */
K_FN ggx_horizon_plane_node ggx_horizon_plane_at(ggx_horizon_plane_nodes t, real place) {
    ggx_horizon_plane_node node;
    node.w = R(0.0);
    node.p = R(0.0);
    node.q0 = R(0.0);
    node.q1 = R(0.0);
    K_UNROLL
    for (int j = 0; j < GGX_HORIZON_PLANE_NODES + 1; ++j) {
        real hat = k_max(R(1.0) - k_abs(place - k_from_int(j)), R(0.0));
        node.w = node.w + hat * t.w[j];
        node.p = node.p + hat * t.p[j];
        node.q0 = node.q0 + hat * t.q0[j];
        node.q1 = node.q1 + hat * t.q1[j];
    }
    return node;
}

/* The place below which the share u of the azimuth lies. */
K_FN real ggx_horizon_plane_place(ggx_horizon_plane_nodes t, real u) {
    real want = u * k_from_int(GGX_HORIZON_PLANE_NODES);
    real below = R(0.0);
    real start = R(0.0);
    real node = R(0.0);
    real w0 = t.w[0];
    real w1 = t.w[1];
    K_UNROLL
    for (int j = 1; j < GGX_HORIZON_PLANE_NODES; ++j) {
        below = below + R(0.5) * (t.w[j - 1] + t.w[j]);
        bool past = want >= below;
        start = k_select(past, below, start);
        node = k_select(past, k_from_int(j), node);
        w0 = k_select(past, t.w[j], w0);
        w1 = k_select(past, t.w[j + 1], w1);
    }
    real rest = want - start;
    real root = k_sqrt(k_max(w0 * w0 + R(2.0) * (w1 - w0) * rest, R(0.0)));
    return node + k_min(R(2.0) * rest / (w0 + root), R(1.0));
}

/* p_y z/(m.i), p_y in dy/pi: dy = ds dphi/2, ds = S dt, dphi = (|c| + |s|)^2 dx, and x goes round in 4 */
K_FN real ggx_horizon_plane_spread(ggx_horizon_plane_node node, ggx_horizon_plane_ray ray, real c,
                                   real s, real v, real t, real z, real im) {
    real top = (node.p * node.p * node.q1 * v + R(2.0) * node.p * t) * v + node.q0 * t * t;
    real bottom = (node.p * v + (node.q0 + node.p * node.q1) * t) * v + t * t;
    real area = ray.reach * k_square((k_abs(c) + k_abs(s)) * bottom);
    return ggx_horizon_spread(R(0.5) * K_PI * node.w * top / area, z, im);
}

#endif
