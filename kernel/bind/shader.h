/* kernel/bind/shader.h: what the shader bindings share, single precision. Before including:
 * K_FLOAT_BITS(x) and K_BITS_FLOAT(bits), the language's words for the bits of a float. */
#ifndef K_BIND_SHADER_H
#define K_BIND_SHADER_H

#define real float
#define kint int

#define R(x) (x)
#define K_INT(x) (x)
#define K_IS_F64 0
#define K_MANTISSA_BITS 23
#define K_EPS R(1.1920929e-7)
#define K_BELOW_ONE R(0.99999994)
#define K_TINY R(1e-30)
#define K_HUGE R(1e30)
#define K_SIGN_BIT 31

#define K_FN
#define K_UNROLL
#define K_STRUCT(name) struct name

K_FN real k_select(bool condition, real yes, real no) {
    return condition ? yes : no;
}

/* Not the operators: they stop at the first answer, and what may be skipped is a branch. */
K_FN bool k_and(bool a, bool b) {
    return a && b;
}

K_FN bool k_or(bool a, bool b) {
    return a || b;
}

/* A condition that is kept in a structure: as a number as wide as `real`, which a loop over many rows
 * can hold in a lane. */
K_FN kint k_flag(bool condition) {
    return condition ? K_INT(1) : K_INT(0);
}

K_FN bool k_is(kint flag) {
    return flag != K_INT(0);
}

K_FN real k_min(real a, real b) {
    return min(a, b);
}

K_FN real k_max(real a, real b) {
    return max(a, b);
}

K_FN real k_abs(real x) {
    return abs(x);
}

K_FN real k_floor(real x) {
    return floor(x);
}

K_FN real k_round(real x) {
    return floor(x + R(0.5));
}

K_FN kint k_to_int(real x) {
    return kint(k_round(x));
}

K_FN real k_sqrt(real x) {
    return sqrt(x);
}

K_FN kint k_bits(real x) {
    return K_FLOAT_BITS(x);
}

K_FN real k_from_bits(kint bits) {
    return K_BITS_FLOAT(bits);
}

K_FN real k_from_int(kint n) {
    return float(n);
}

/* bits >= 0 */
K_FN kint k_shift_down(kint bits, kint count) {
    return bits >> count;
}

K_FN kint k_shift_up(kint bits, kint count) {
    return bits << count;
}

#endif
