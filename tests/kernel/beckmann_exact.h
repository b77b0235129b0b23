/* tests/kernel/beckmann_exact.h: the distribution of visible Gaussian slopes in long double, the oracle of
 * the Beckmann tests, and their random numbers. */
#include "lobe/random.h"

#include <math.h>

static const long double root_pi = 1.7724538509055160272981674833411L;

static double uniform(uint64_t k, int word) {
    return lobe_random_unit_f32(lobe_random(31, 0, k).word[word]);
}

/* 1 - sqrt(pi) x exp(x^2) erfc(x): by definition, far out by the continued fraction of the repeated integrals */
static long double defect(long double x) {
    if (x < 3) return 1 - root_pi * x * expl(x * x) * erfcl(x);
    long double ratio = 0;
    for (int n = 150; n >= 1; --n) ratio = 1 / (2 * x + 2 * (n + 1) * ratio);
    return ratio / (x + ratio);
}

static long double scaled_erfc(long double x) {
    return x < 20 ? expl(x * x) * erfcl(x) : (1 - defect(x)) / (root_pi * x);
}

/* Share of the visible slopes deeper than t, and its complement, in long double. */
typedef struct shares {
    long double deep, shallow;
} shares;

static shares exact_shares(long double c, long double t) {
    shares r;
    long double k = c >= 0 ? 2 * root_pi * c + expl(-c * c) * defect(c) : defect(-c);
    if (t >= 0) {
        long double y = t - c;
        r.deep = expl(c < 0 ? -t * (t - 2 * c) : -t * t) / k *
                 (c < 0 ? (t - c * defect(y)) / y : 1 + root_pi * c * scaled_erfc(t));
        r.shallow = 1 - r.deep;
    } else {
        r.shallow =
            (expl(-t * t) * (root_pi * c * scaled_erfc(-t) - 1) + expl(-c * c) * defect(c)) / k;
        r.deep = 1 - r.shallow;
    }
    return r;
}
