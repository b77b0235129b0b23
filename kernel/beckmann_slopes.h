/* kernel/beckmann_slopes.h: visible slopes along i of a Gaussian of unit roughness, whole or between two
 * limits: distribution function, density and its inverse. In the stretched frame of Heitz & d'Eon 2014, with
 * c = cot(theta) of either sign, a slope x < c is seen with the density
 *     p(x) = 2 (c - x) exp(s^2 - x^2)/K,   s = max(-c, 0),   K = sqrt(pi) exp(s^2) int_{-c}^inf erfc.
 * The unknown is the depth t = -x - s: below the horizon x sticks to c and only its distance t from
 * it keeps its digits; above, t is minus the slope. With c+ = max(c, 0) the share of slopes deeper than t is
 *     t >= 0:  exp(-t (t + 2s)) k(t)/K,  k = 1 + sqrt(pi) c erfcx(t)  or  (t + s defect(s + t))/(s + t),
 *     t < 0:   1 - (exp(-t^2)(sqrt(pi) c erfcx(-t) - 1) + exp(-c^2) defect(c))/K.
 * Near c, where the share above cancels, it is a series in the gap c - x, and so is its inverse.
 *
 * The inverse (Jakob 2014 and Tokuyoshi 2021 take Newton steps from a start that is exact for one c) starts from
 * a polynomial in c and in the Gaussian slope with the same share below it, never nearer to c than can be, and
 * takes one step (double: two): the series of the depth in the share, to the fourth order, from a rounded depth,
 * whose few digits make products exact, so that the share is known to twice its last digit. */
#ifndef K_BECKMANN_SLOPES_H
#define K_BECKMANN_SLOPES_H

#include "erf.h"
#include "log.h"

#define K_SQRT_PI R(1.77245385090551602730)
#if K_IS_F64
#define K_SQRT_PI_LOW R(-7.66658649982579883e-17)
#else
#define K_SQRT_PI_LOW R(-5.32464004766e-8)
#endif

/* The slopes between two depths, and what depends on c only. */
K_STRUCT(beckmann_slopes) {
    real c_plus;
    real s;
    k_pair k;       /* K */
    k_pair end;     /* exp(-c^2) defect(c), for c >= 0 */
    k_pair bias;    /* sqrt(pi) c, for c >= 0; s */
    real near;      /* exp(-c+^2)/K */
    real near_root; /* about c, gap = near_root sqrt(share above) */
    real start_0;   /* the polynomial of the start, by powers of a Gaussian slope */
    real start_1;
    real start_2;
    real start_3;
    real start_4;
    real start_5;
    real scale;         /* of its square for c < 2, of itself beyond */
    real t_least;       /* the range: depth of its greatest slope */
    real t_most;        /* and of its smallest */
    real deep_most;     /* share of all visible slopes deeper than t_most */
    real deep_least;    /* deeper than t_least */
    real shallow_most;  /* 1 - deep_most */
    real shallow_least; /* 1 - deep_least */
};

/* What a depth divides the visible slopes into. */
K_STRUCT(beckmann_shares) {
    real deep;
    real shallow;
};

/* A share, and what is not in it: the smaller of the two has all digits. */
K_STRUCT(beckmann_target) {
    k_pair tail; /* at most 1/2 */
    kint deep;   /* the share below the depth that is wanted; else above it */
    real w;      /* the Gaussian slope, counted downwards, with that share below it: a start */
};

/* Beyond this depth lies nothing that a random number can reach: a share of K_EPS^2. */
K_FN real beckmann_slopes_bottom(real s, real k) {
    real exponent = k_max(-k_log(k_min(k, R(1.0))), R(0.0)) - R(2.0) * k_log(K_EPS);
    return exponent / (s + k_sqrt(s * s + exponent));
}

#define BECKMANN_START_SWITCH R(2.0)

/* a + x (b + x (c + x d)) of two polynomials, of which one is wanted */
K_FN real beckmann_start_of(bool first, real x, real a0, real a1, real a2, real a3, real b0,
                            real b1, real b2, real b3) {
    real high = k_select(first, a2, b2) + x * k_select(first, a3, b3);
    return k_select(first, a0, b0) + x * (k_select(first, a1, b1) + x * high);
}

/* Coefficients: tools/numerics/beckmann_start.py */
K_FN beckmann_slopes beckmann_slopes_started(beckmann_slopes slopes, real c) {
    beckmann_slopes r = slopes;
    real cut = k_min(k_max(c, R(-1e8)), R(1e8));
    real root = k_sqrt(R(12.0) + cut * cut);
    bool first = c < BECKMANN_START_SWITCH;
    real less = k_max(root - cut, R(1.0));
    real inv = R(1.0) / (root * less);
    real inv_root = inv * less;
    real x = k_select(first, cut * inv_root, inv_root);
    r.scale = k_select(first, inv * root, inv_root);
    r.start_0 =
        beckmann_start_of(first, x, R(1.70796113), R(0.691723775), R(0.262282271), R(-0.014035625),
                          R(0.214137724), R(2.67746983), R(-12.9891618), R(62.0098419));
    r.start_1 = beckmann_start_of(first, x, R(0.684290777), R(-0.240446679), R(-0.386367821),
                                  R(-0.141764393), R(0.444898212), R(-12.3661282), R(85.3048753),
                                  R(-187.64395));
    r.start_2 = beckmann_start_of(first, x, R(-0.034869691), R(-0.0807448327), R(0.112439155),
                                  R(0.0622979305), R(-0.298086257), R(8.43659751), R(-62.5678184),
                                  R(134.758096));
    r.start_3 = beckmann_start_of(first, x, R(-0.0034180582), R(0.0195820997), R(-0.00403401497),
                                  R(-0.00222663428), R(-0.0281153339), R(0.52148124),
                                  R(-0.942417665), R(-3.9632676));
    r.start_4 = beckmann_start_of(first, x, R(0.00109278172), R(-0.00141551952), R(-0.00209924191),
                                  R(-0.00320586375), R(0.00953831359), R(-0.227855445),
                                  R(1.2012407), R(-0.776007363));
    r.start_5 = beckmann_start_of(first, x, R(-7.51737223e-05), R(1.86364797e-05), R(0.00021064531),
                                  R(0.000330690176), R(0.00108498413), R(-0.0289590516),
                                  R(0.204025522), R(-0.564594846));
    return r;
}

/* Everything that is visible. */
K_FN beckmann_slopes beckmann_slopes_of(real c) {
    real a = k_abs(c);
    k_pair defect = k_erfcx_defect_pair(a);
    bool above = c >= R(0.0);
    beckmann_slopes r;
    r.c_plus = k_select(above, a, R(0.0));
    r.s = k_select(above, R(0.0), a);
    real rise = K_SQRT_PI * a;
    real rise_low = k_product_lost(K_SQRT_PI, a, rise) + K_SQRT_PI_LOW * a;
    k_exp_parts e = k_exp_split_square(a, R(-1.0));
    real peak_tail = k_scale_by_power(e.tail, e.n);
    real peak_whole = k_scale_by_power(R(1.0), e.n);
    real end = peak_whole * defect.high;
    k_pair end_pair = k_pair_of(end, peak_tail * defect.high);
    end_pair.low = end_pair.low + (peak_whole + peak_tail) * defect.low;
    real sum = R(2.0) * rise + end_pair.high;
    real sum_low =
        k_sum_lost(R(2.0) * rise, end_pair.high, sum) + (end_pair.low + R(2.0) * rise_low);
    r.end.high = k_select(above, end_pair.high, R(0.0));
    r.end.low = k_select(above, end_pair.low, R(0.0));
    r.k.high = k_select(above, sum, defect.high);
    r.k.low = k_select(above, sum_low, defect.low);
    r.bias.high = k_select(above, rise, a);
    r.bias.low = k_select(above, rise_low, R(0.0));
    r.near = k_select(above, peak_whole + peak_tail, R(1.0)) / r.k.high;
    r.near_root = k_sqrt(R(1.0) / k_max(r.near, K_TINY));
    r.t_least = -r.c_plus;
    r.t_most = beckmann_slopes_bottom(r.s, r.k.high);
    r.deep_most = R(0.0);
    r.deep_least = R(1.0);
    r.shallow_most = R(1.0);
    r.shallow_least = R(0.0);
    return beckmann_slopes_started(r, c);
}

/* A depth of few digits, and what the distribution is made of there:
 *     t >= 0:  deep    = exp(-arg) (up d + bias (1 + rest))/(m d K),
 *     t < 0:   shallow = exp(-arg) (up d + bias (1 + rest))/(m d K) + end/K. */
K_STRUCT(beckmann_node) {
    real t;
    kint deep; /* t >= 0 */
    k_pair arg;
    k_pair m;
    real up;
    real d;
    real d_low;
    real rest;
    real gap;
    real x; /* minus the slope */
};

/* (1 + 2a) exp(a^2) erfc(a) - 1, or (1 + 7/4 a + 2a^2) defect(a) - 1, as in kernel/erf.h */
K_FN real beckmann_node_rest(real a, bool defect) {
    real t1 = k_half_line(a);
    real both = t1 * (R(2.0) - t1);
    real erfcx = t1 * R(0.06418958354775628695) + both * k_erfcx_bend(t1 - R(1.0));
    return k_select(defect, both * k_defect_bend(t1 - R(1.0)), erfcx);
}

/* The node beside t. */
K_FN beckmann_node beckmann_node_of(beckmann_slopes r, real t) {
#if K_IS_F64
    real grid = R(8388608.0);
#else
    real grid = R(512.0);
#endif
    bool below = r.s > R(0.0);
    beckmann_node n;
    real coarse = k_round(k_min(k_max(t, R(-8.0)), R(8.0)) * grid) / grid;
    n.t = k_select(below, k_upper_half(t), coarse);
    real a = k_abs(n.t);
    real y = r.s + a;
    bool deep = n.t >= R(0.0);
    n.deep = k_flag(deep);
    n.rest = beckmann_node_rest(y, below);
    n.m.high = k_select(below, y, R(1.0));
    n.m.low = k_select(below, k_sum_lost(r.s, a, y), R(0.0));
    real w = R(1.75) + R(2.0) * y;
    real by = k_select(below, w, R(2.0));
    real product = y * by;
    n.d = R(1.0) + product;
    real product_low = k_product_lost(y, by, product) + y * k_sum_lost(R(1.75), R(2.0) * y, w) +
                       (w + R(2.0) * y) * n.m.low;
    n.d_low = k_select(below, k_sum_lost(R(1.0), product, n.d) + product_low, R(0.0));
    n.up = k_select(below, a, k_select(deep, R(1.0), R(-1.0)));
    real s_high = k_upper_half(r.s);
    real square = a * a;
    real cross = R(2.0) * a * s_high;
    n.arg.high = square + cross;
    real arg_low = k_sum_lost(square, cross, n.arg.high) + R(2.0) * a * (r.s - s_high);
    n.arg.low = k_min(k_max(arg_low, R(-1.0)), R(1.0)); /* where high is in use it is less */
    n.gap = k_max(r.c_plus + n.t, R(1e-6) * K_EPS);
    n.x = n.t + r.s;
    return n;
}

/* The share between t and t + d is that of a constant density times 1 + d (b2 + d (b3 + d b4)). */
K_STRUCT(beckmann_bends) {
    real b2;
    real b3;
    real b4;
};

K_FN beckmann_bends beckmann_bends_of(beckmann_node n, real h) {
    real y = n.x;
    real e2 = R(2.0) * y * y - R(1.0);
    beckmann_bends b;
    b.b2 = R(0.5) * h - y;
    b.b3 = R(0.33333333333333333333) * (e2 - R(2.0) * y * h);
    b.b4 = R(0.25) * (e2 * h - y * (R(1.33333333333333333333) * y * y - R(2.0)));
    return b;
}

/* S of the share above depth c+ + gap: near gap^2 S; p = 2c gap, q = gap^2 */
K_FN real beckmann_near_series(real p, real q) {
    real n4 = R(12.0) * q * q + p * p * (p * p - R(12.0) * q);
    real n5 = p * (R(60.0) * q * q + p * p * (p * p - R(20.0) * q));
    real sum = R(0.66666666666666666667) * p + R(0.25) * (p * p - R(2.0) * q);
    sum = sum + R(0.066666666666666666667) * p * (p * p - R(6.0) * q);
    sum = sum + R(0.013888888888888888889) * n4;
    return R(1.0) + (sum + R(0.0023809523809523809524) * n5);
}

/* gap/root of root^2 = gap^2 S; p = 2c root, q = root^2 (tools/numerics/beckmann_start.py) */
K_FN real beckmann_near_inverse(real p, real q) {
    real p2 = p * p;
    real even = p2 * (R(11.0) / R(72.0) + p2 * (R(769.0) / R(17280.0)) + R(131.0) / R(480.0) * q);
    even = even + q * (R(0.25) + R(13.0) / R(96.0) * q);
    real odd = R(1.0) / R(3.0) + p2 * (R(43.0) / R(540.0) + R(221.0) / R(8505.0) * p2);
    odd = odd + q * (R(0.3) + R(212.0) / R(945.0) * p2 + R(89.0) / R(315.0) * q);
    return R(1.0) + (even - p * odd);
}

/* The shares on both sides of depth t. */
K_FN beckmann_shares beckmann_slopes_shares(beckmann_slopes r, real t) {
    beckmann_node n = beckmann_node_of(r, t);
    k_exp_parts e = k_exp_split(-n.arg.high, -n.arg.low);
    real scale = k_scale_by_power(R(1.0), e.n);
    real top = n.up * n.d + r.bias.high;
    real top_low = k_sum_lost(n.up * n.d, r.bias.high, top) + r.bias.high * n.rest + r.bias.low;
    k_pair value = k_pair_of(top, top_low);
    real more = value.high * e.tail;
    k_pair part = k_pair_of(value.high, more);
    part.low = part.low + value.low * (R(1.0) + e.tail) + k_product_lost(value.high, e.tail, more);
    real md = n.m.high * n.d;
    real bottom = md * r.k.high;
    real bottom_low = k_product_lost(md, r.k.high, bottom) + md * r.k.low +
                      (k_product_lost(n.m.high, n.d, md) + n.m.low * n.d) * r.k.high;
    bool deep = k_is(n.deep);
    k_pair share = k_quotient_pair(part.high * scale, part.low * scale, bottom, bottom_low);
    real end = k_select(deep, R(0.0), r.end.high / r.k.high);
    real off = t - n.t;
    beckmann_bends b = beckmann_bends_of(n, R(1.0) / n.gap);
    real density = R(2.0) * n.gap * (scale * (R(1.0) + e.tail)) / r.k.high;
    real moved = density * off * (R(1.0) + off * (b.b2 + off * b.b3));
    real sum = share.high + end;
    real low = k_sum_lost(share.high, end, sum) + share.low + k_select(deep, -moved, moved);
    k_pair result = k_pair_of(k_max(sum, K_TINY), low);
    real other = (R(1.0) - result.high) - result.low;
    real gap = k_max(r.c_plus + t, R(0.0));
    real p = R(2.0) * (r.c_plus - r.s) * gap;
#if K_IS_F64
    bool near = k_and(k_abs(p) < R(0.01), gap < R(0.01));
#else
    bool near = k_and(k_abs(p) < R(0.3), gap < R(0.15));
#endif
    real above = r.near * gap * gap * beckmann_near_series(p, gap * gap);
    beckmann_shares shares;
    shares.shallow = k_select(near, above, k_max(k_select(deep, other, result.high), R(0.0)));
    shares.deep = k_select(near, R(1.0) - above, k_max(k_select(deep, result.high, other), R(0.0)));
    return shares;
}

/* Only the slopes with depths from t_least to t_most, within what is visible. */
K_FN beckmann_slopes beckmann_slopes_between(beckmann_slopes all, real t_least, real t_most) {
    beckmann_slopes r = all;
    r.t_least = k_min(k_max(t_least, all.t_least), all.t_most);
    r.t_most = k_min(k_max(t_most, r.t_least), all.t_most);
    beckmann_shares least = beckmann_slopes_shares(all, r.t_least);
    beckmann_shares most = beckmann_slopes_shares(all, r.t_most);
    r.deep_least = least.deep;
    r.shallow_least = least.shallow;
    r.deep_most = most.deep;
    r.shallow_most = most.shallow;
    return r;
}

/* Share of the visible slopes that lies in the range, from the smaller of the two tails. */
K_FN real beckmann_slopes_mass(beckmann_slopes r) {
    real by_deep = r.deep_least - r.deep_most;
    real by_shallow = r.shallow_most - r.shallow_least;
    return k_max(k_select(r.deep_least < R(0.5), by_deep, by_shallow), R(0.0));
}

/* One step from t: the depth that leaves the share of the target. */
K_FN real beckmann_slopes_step(beckmann_slopes r, beckmann_target target, real t) {
    beckmann_node n = beckmann_node_of(r, t);
    k_exp_parts e = k_exp_split(n.arg.high, n.arg.low);
    real scale = k_scale_by_power(R(1.0), e.n);
    bool deep = k_is(n.deep);

    /* the share on the side of t */
    real other = R(1.0) - target.tail.high;
    real other_low = ((R(1.0) - other) - target.tail.high) - target.tail.low;
    bool same = n.deep == target.deep;
    real share = k_select(same, target.tail.high, other);
    real share_low = k_select(same, target.tail.low, other_low);

    /* times K: what is left of it without the end */
    real whole = share * r.k.high;
    real whole_low =
        k_product_lost(share, r.k.high, whole) + share * r.k.low + share_low * r.k.high;
    real end = k_select(deep, R(0.0), r.end.high);
    real left = whole - end;
    real left_low = k_sum_lost(whole, -end, left) + whole_low - k_select(deep, R(0.0), r.end.low);

    /* times exp(arg) m d, less what it should be */
    real more = left * e.tail;
    real grown = left + more;
    real grown_low = ((left - grown) + more) + left_low * (R(1.0) + e.tail);
    grown = grown * scale;
    grown_low = grown_low * scale;
    real by_m = grown * n.m.high;
    real by_m_low = k_product_lost(grown, n.m.high, by_m) + grown * n.m.low + grown_low * n.m.high;
    real over = by_m - n.up;
    real over_low = k_sum_lost(by_m, -n.up, over) + by_m_low;
    real over_high = k_upper_half(over);
    real d_high = k_upper_half(n.d);
    real excess = (d_high * over_high - r.bias.high) +
                  (((n.d - d_high) + n.d_low) * over_high +
                   (n.d * ((over - over_high) + over_low) - (r.bias.high * n.rest + r.bias.low)));

    real inv = R(1.0) / (R(2.0) * n.gap * n.m.high * n.d);
    real h = R(2.0) * n.m.high * (n.d * inv);
    real v = k_select(deep, -excess, excess) * inv;
    beckmann_bends b = beckmann_bends_of(n, h);
    real a3 = R(2.0) * b.b2 * b.b2 - b.b3;
    real a4 = b.b2 * (R(5.0) * (b.b2 * b.b2 - b.b3)) + b.b4;
    real move = v - v * v * (b.b2 - v * (a3 - v * a4));
    return n.t + move;
}

/* A Gaussian slope counted downwards, with the share `deep` below it, to 5e-4 (Abramowitz & Stegun 26.2.23). */
K_FN real beckmann_start_slope(real tail, bool deep) {
    real l = k_sqrt(R(-2.0) * k_log(k_min(tail, R(0.5))));
    real top = R(2.515517) + l * (R(0.802853) + l * R(0.010328));
    real bottom = R(1.0) + l * (R(1.432788) + l * (R(0.189269) + l * R(0.001308)));
    real w = R(0.70710678118654752440) * (l - top / bottom);
    return k_select(deep, w, -w);
}

/* The depth of a share. Residual: at the foot. */
K_FN real beckmann_slopes_at(beckmann_slopes r, beckmann_target target) {
    real w = k_min(k_max(target.w, R(-5.5)), R(5.5));
    real cubic = r.start_2 + w * (r.start_3 + w * (r.start_4 + w * r.start_5));
    real start = r.start_0 + w * (r.start_1 + w * cubic);
    real c = r.c_plus - r.s;
    bool first = c < BECKMANN_START_SWITCH;
    /* beyond what is fitted it grows about as a power of w */
    real power = start * (R(1.0) + R(0.09) * k_max(target.w - w, R(0.0)));
    start = k_select(first, power * power, start) * r.scale + k_select(first, -r.c_plus, target.w);

    real shallow = k_select(k_is(target.deep), R(1.0) - target.tail.high, target.tail.high);
    real root = r.near_root * k_sqrt(shallow);
    real p = R(2.0) * c * root;
    /* the gap is at least this: S is below exp(2c gap) */
    real least_gap = root / (R(1.0) + k_max(r.c_plus * root, R(0.0)));
    start = k_max(start, least_gap - r.c_plus);
    real near_gap = root * beckmann_near_inverse(p, root * root);
    bool use = k_and(k_abs(p) < R(0.7), root < R(0.35));
    real t = k_select(use, near_gap - r.c_plus, start);
#if K_IS_F64
    bool near = k_and(k_abs(p) < R(0.004), root < R(0.004));
    t = k_min(k_max(beckmann_slopes_step(r, target, t), r.t_least), r.t_most);
#else
    bool near = k_and(k_abs(p) < R(0.11), root < R(0.08));
#endif
    real found = beckmann_slopes_step(r, target, t);
    return k_min(k_max(k_select(near, near_gap - r.c_plus, found), r.t_least), r.t_most);
}

/* u a + (1 - u) b of shares */
K_FN k_pair beckmann_mixed_share(real u, real a, real b) {
    real v = R(1.0) - u;
    real from_a = u * a;
    real from_b = v * b;
    real v_low = (R(1.0) - v) - u;
    k_pair r;
    r.high = from_a + from_b;
    r.low = k_sum_lost(from_a, from_b, r.high) + v_low * b +
            (k_product_lost(u, a, from_a) + k_product_lost(v, b, from_b));
    return r;
}

/* The depth that leaves the share u of the range below it. */
K_FN real beckmann_slopes_inverse(beckmann_slopes r, real u) {
    k_pair deep = beckmann_mixed_share(u, r.deep_least, r.deep_most);
    k_pair shallow = beckmann_mixed_share(u, r.shallow_least, r.shallow_most);
    bool is_deep = deep.high < shallow.high;
    beckmann_target target;
    target.deep = k_flag(is_deep);
    target.tail.high = k_max(k_select(is_deep, deep.high, shallow.high), K_EPS * K_EPS);
    target.tail.low = k_select(is_deep, deep.low, shallow.low);
    target.w = beckmann_start_slope(target.tail.high, is_deep);
    return beckmann_slopes_at(r, target);
}

/* Residual of the inverse, the share of all visible slopes that the depth misses, against long double
 * (tests/kernel/beckmann_slopes_template.h: c over all magnitudes of both signs; 2000000 places each, its argument): below 1e-7
 * in float, at worst 6.9e-8 of all slopes (c = -0.927116394, u = 0.910636544), 9.9e-8 between two limits (c =
 * -0.207575798, u = 1.46165602e-09); the depth nearest to the exact root would leave up to 4.4e-8. In double 1.1e-16
 * and 4e-16. Of the smaller share itself it misses in float at most 1e-3 down to 1e-8, where the depth tells slopes
 * apart (near c > 0 it does not: there it is -c and a gap below its last digit). */

#endif
