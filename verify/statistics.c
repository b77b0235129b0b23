#include "statistics.h"

#include <float.h>
#include <math.h>

/* x^a e^-x / Gamma(a). Near x = a, and only there large powers meet, by Stirling's series: the
 * logarithms would cancel. */
static double gamma_factor(double a, double x) {
    if (a < 20) return exp(a * log(x) - x - lgamma(a));
    double relative = (x - a) / a;
    double exponent = a * (log1p(relative) - relative);
    double correction = 1 / (12 * a) - 1 / (360 * a * a * a) + 1 / (1260 * pow(a, 5));
    return sqrt(a / 6.283185307179586477) * exp(exponent - correction);
}

static double lower_series(double a, double x) {
    double term = 1 / a;
    double sum = term;
    for (double n = a + 1; term > sum * DBL_EPSILON / 4; ++n) {
        term *= x / n;
        sum += term;
    }
    return sum * gamma_factor(a, x);
}

/* Continued fraction of the upper function, by Lentz's rule. */
static double upper_fraction(double a, double x) {
    double b = x + 1 - a;
    double c = 1 / DBL_MIN;
    double d = 1 / b;
    double product = d;
    double change = 0;
    for (int n = 1; n < 1000000 && fabs(change - 1) > DBL_EPSILON; ++n) {
        double factor = n * (a - n);
        b += 2;
        d = 1 / (b + factor * d);
        c = b + factor / c;
        change = c * d;
        product *= change;
    }
    return product * gamma_factor(a, x);
}

double lobe_gamma_p(double a, double x) {
    if (!(x > 0)) return 0;
    return x < a + 1 ? lower_series(a, x) : 1 - upper_fraction(a, x);
}

double lobe_gamma_q(double a, double x) {
    if (!(x > 0)) return 1;
    return x < a + 1 ? 1 - lower_series(a, x) : upper_fraction(a, x);
}

double lobe_chi_square_survival(double x, double dof) {
    return isfinite(x) ? lobe_gamma_q(dof / 2, x / 2) : 0;
}

double lobe_normal_two_sided(double z) {
    return isfinite(z) ? erfc(fabs(z) * 0.70710678118654752440) : 0;
}

double lobe_poisson_two_sided(double mean, uint64_t count) {
    if (!isfinite(mean)) return 0;
    double k = (double)count;
    double at_most = lobe_gamma_q(k + 1, mean);
    double at_least = count > 0 ? lobe_gamma_p(k, mean) : 1;
    return fmin(1, 2 * fmin(at_most, at_least));
}

double lobe_sidak(double family, size_t tests) {
    return -expm1(log1p(-family) / (double)tests);
}
