/* kernel/rounding.h: what a sum and a product lose to rounding, exactly (Knuth; Dekker 1971). It is 0 under a
 * compiler that reorders sums: then results lose their last digits, and nothing else. */
#ifndef K_ROUNDING_H
#define K_ROUNDING_H

#include "scalar.h"

/* high + low: low is what rounding has taken from high. */
K_STRUCT(k_pair) {
    real high;
    real low;
};

/* x without the lower half of its digits: its square, and its product with another such, is exact. */
K_FN real k_upper_half(real x) {
#if K_IS_F64
    return k_from_bits(k_bits(x) & K_INT(-134217728)); /* all but 27 bits */
#else
    return k_from_bits(k_bits(x) & K_INT(-4096)); /* all but 12 bits */
#endif
}

/* What the sum a + b loses to rounding, sum = fl(a + b). */
K_FN real k_sum_lost(real a, real b, real sum) {
    real from_b = sum - a;
    return (a - (sum - from_b)) + (b - from_b);
}

/* a + b as a pair, |b| not above |a|. */
K_FN k_pair k_pair_of(real a, real b) {
    k_pair r;
    r.high = a + b;
    r.low = (a - r.high) + b;
    return r;
}

/* What the product a b loses to rounding, from halves that multiply exactly. */
K_FN real k_product_lost(real a, real b, real product) {
    real a_high = k_upper_half(a);
    real b_high = k_upper_half(b);
    real a_low = a - a_high;
    real b_low = b - b_high;
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
}

#endif
