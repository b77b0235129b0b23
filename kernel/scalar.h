/* kernel/scalar.h: what every kernel needs of single numbers. */
#ifndef K_SCALAR_H
#define K_SCALAR_H

#define K_PI R(3.14159265358979323846)
#define K_INV_PI R(0.31830988618379067154)

K_FN real k_square(real x) {
    return x * x;
}

K_FN real k_sign(real x) {
    return k_select(x < R(0.0), R(-1.0), R(1.0));
}

K_FN real k_saturate(real x) {
    return k_min(k_max(x, R(0.0)), R(1.0));
}

/* A random number made safe: [0, 1), NaN becomes 0. */
K_FN real k_unit(real u) {
    return k_select(u > R(0.0), k_min(u, K_BELOW_ONE), R(0.0));
}

/* x where it is a usable density or weight: positive and finite; 0 where it is anything else. */
K_FN real k_usable(real x) {
    return k_select(k_and(x > R(0.0), x < K_HUGE * R(1e8)), x, R(0.0));
}

K_FN bool k_is_finite(real x) {
    return k_abs(x) < K_HUGE * R(1e8);
}

#endif
