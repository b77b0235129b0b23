/* kernel/vec.h: three-vectors, scalar text only: the one form that every language understands. */
#ifndef K_VEC_H
#define K_VEC_H

#include "scalar.h"

K_STRUCT(v3) {
    real x;
    real y;
    real z;
};

K_FN v3 v3_of(real x, real y, real z) {
    v3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

K_FN real v3_dot(v3 a, v3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

K_FN v3 v3_add(v3 a, v3 b) {
    return v3_of(a.x + b.x, a.y + b.y, a.z + b.z);
}

K_FN v3 v3_sub(v3 a, v3 b) {
    return v3_of(a.x - b.x, a.y - b.y, a.z - b.z);
}

K_FN v3 v3_scale(v3 a, real s) {
    return v3_of(a.x * s, a.y * s, a.z * s);
}

/* a s + b t + c u */
K_FN v3 v3_combine(v3 a, real s, v3 b, real t, v3 c, real u) {
    return v3_add(v3_add(v3_scale(a, s), v3_scale(b, t)), v3_scale(c, u));
}

K_FN v3 v3_normalize(v3 a) {
    return v3_scale(a, R(1.0) / k_sqrt(k_max(v3_dot(a, a), K_TINY)));
}

K_FN v3 v3_select(bool condition, v3 yes, v3 no) {
    return v3_of(k_select(condition, yes.x, no.x), k_select(condition, yes.y, no.y),
                 k_select(condition, yes.z, no.z));
}

K_FN bool v3_is_finite(v3 a) {
    return k_and(k_is_finite(a.x), k_and(k_is_finite(a.y), k_is_finite(a.z)));
}

#endif
