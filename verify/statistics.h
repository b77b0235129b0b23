/* Distributions of test statistics. */
#ifndef LOBE_VERIFY_STATISTICS_H
#define LOBE_VERIFY_STATISTICS_H

#include <stddef.h>
#include <stdint.h>

/* Regularised incomplete gamma functions P + Q = 1, a > 0, x >= 0. The smaller one is accurate to
 * about 1e-13 relative for a up to 1e6. */
double lobe_gamma_p(double a, double x);
double lobe_gamma_q(double a, double x);

/* P(chi^2 with dof degrees of freedom >= x). */
double lobe_chi_square_survival(double x, double dof);

/* P(|standard normal| >= |z|). */
double lobe_normal_two_sided(double z);

/* Twice the smaller tail of a Poisson distribution at `count`, at most 1. */
double lobe_poisson_two_sided(double mean, uint64_t count);

/* Significance of one of `tests` independent tests such that all together reach `family`. */
double lobe_sidak(double family, size_t tests);

#endif
