/* kernel/albedo_table.h: where a direction and a roughness fall in the tables of albedos, and cubic
 * interpolation there. The values are passed in: every language keeps its tables in its own way.
 *
 * r = sqrt(alpha), t = sqrt(mu). Near (0, 0) the albedo depends on t/r alone (a scaled surface seen at
 * a scaled angle), elsewhere it is smooth:
 *   row     sqrt(r), from alpha = 1e-4 to 2
 *   column  t (1 + r)/(t + r), from mu = 0 to 1
 * Both are even numbers from 0 to 1 on their axis. */
#ifndef K_ALBEDO_TABLE_H
#define K_ALBEDO_TABLE_H

#include "scalar.h"

/* (sqrt(r) - 1/10)/(2^(1/4) - 1/10) */
K_FN real albedo_row(real r) {
    return k_saturate((k_sqrt(r) - R(0.1)) * R(0.91810142083163741));
}

/* r */
K_FN real albedo_row_inverse(real row) {
    return k_square(R(0.1) + R(1.0892071150027210667) * row);
}

/* From mu = 0 to 1 at any r. */
K_FN real albedo_column(real mu, real r) {
    real t = k_sqrt(k_saturate(mu));
    return k_min(t * (R(1.0) + r) / (t + r), R(1.0));
}

/* mu */
K_FN real albedo_column_inverse(real column, real r) {
    return k_square(column * r / (R(1.0) + r - column));
}

/* Four neighbouring nodes of an axis, the first of them and the weight of each: Lagrange's cubic. */
K_STRUCT(albedo_stencil) {
    real first;
    real w0;
    real w1;
    real w2;
    real w3;
};

/* `position` from 0 to 1 on an axis of `count` >= 4 even nodes. */
K_FN albedo_stencil albedo_stencil_of(real position, real count) {
    real x = position * (count - R(1.0));
    albedo_stencil s;
    s.first = k_min(k_max(k_floor(x) - R(1.0), R(0.0)), count - R(4.0));
    real y = x - s.first;
    real y1 = y - R(1.0);
    real y2 = y - R(2.0);
    real y3 = y - R(3.0);
    s.w0 = R(-0.16666666666666666667) * y1 * y2 * y3;
    s.w1 = R(0.5) * y * y2 * y3;
    s.w2 = R(-0.5) * y * y1 * y3;
    s.w3 = R(0.16666666666666666667) * y * y1 * y2;
    return s;
}

K_FN real albedo_mix(albedo_stencil s, real a, real b, real c, real d) {
    return s.w0 * a + s.w1 * b + s.w2 * c + s.w3 * d;
}

#endif
