/* tools/numerics/worst_error.c: the worst error of each elementary kernel in single precision, by
 * trying every float of its domain, with the input that causes it.
 *
 *     cc -O2 -ffp-contract=off -fopenmp -I. tools/numerics/worst_error.c -lm -o worst_error
 *     ./worst_error
 *
 * The figures stand at the foot of the kernel files. */
#include "kernel/bind/c_f32.h"

#include "kernel/arc.h"
#include "kernel/erf.h"
#include "kernel/erfinv.h"
#include "kernel/kepler.h"

#include <math.h>
#include <stdio.h>

typedef double (*error_function)(float x);

static double sine_error(float u) {
    return fabs((double)k_sincos_2pi(u).s - sin(6.283185307179586476925 * (double)u));
}

static double cosine_error(float u) {
    return fabs((double)k_sincos_2pi(u).c - cos(6.283185307179586476925 * (double)u));
}

static double spacing(double x) {
    float f = fmaxf(fabsf((float)x), 1.17549435e-38f);
    return (double)nextafterf(f, INFINITY) - (double)f;
}

static double log_error(float x) {
    double exact = log((double)x);
    return x == 1.0f ? fabs((double)k_log(x)) : fabs((double)k_log(x) - exact) / spacing(exact);
}

static double angle_error(float y) {
    double exact = atan((double)y);
    return fabs((double)k_angle(y, 1.0f) - exact) / spacing(exact);
}

static double asinh_error(float x) {
    double exact = asinh((double)x);
    return fabs((double)k_asinh(x) - exact) / spacing(exact);
}

static double kepler_error(float t) {
    double e = k_kepler(t), root = e;
    for (int step = 0; step < 3; ++step)
        root -= (root - sin(root) - (double)t) / (2 * sin(root / 2) * sin(root / 2));
    return fabs(e - root) / spacing(root);
}

static double ulps(double got, double exact) {
    return fabs(got - exact) / spacing(exact);
}

static double exp_error(float x) {
    return ulps(k_exp(x), exp((double)x));
}

static double exp_of_minus_error(float x) {
    return ulps(k_exp(-x), exp(-(double)x));
}

static double erf_error(float x) {
    return ulps(k_erf(x), erf((double)x));
}

static double erfc_error(float x) {
    return ulps(k_erfc(x), erfc((double)x));
}

static double erfc_of_minus_error(float x) {
    return ulps(k_erfc(-x), erfc(-(double)x));
}

/* exp(x^2) erfc(x) and 1 - sqrt(pi) x exp(x^2) erfc(x); from 30 on by their series */
static const double root_pi = 1.7724538509055160273;

static double series(double x) {
    double y = 1 / (2 * x * x);
    return y * (1 - 3 * y * (1 - 5 * y * (1 - 7 * y * (1 - 9 * y * (1 - 11 * y)))));
}

static double scaled_erfc(double x) {
    return x < 20 ? exp(x * x) * erfc(x) : (1 - series(x)) / (x * root_pi);
}

/* Below 6 by the definition, above by the continued fraction of the repeated integrals. */
static double scaled_defect(double x) {
    if (x > 30) return series(x);
    if (x < 6) return 1 - root_pi * x * scaled_erfc(x);
    double ratio = 0;
    for (int n = 200; n >= 1; --n) ratio = 1 / (2 * x + 2 * (n + 1) * ratio);
    return root_pi * ratio * scaled_erfc(x);
}

static double erfcx_error(float x) {
    return ulps(k_erfcx(x), scaled_erfc(x));
}

static double erfcx_of_minus_error(float x) {
    return ulps(k_erfcx(-x), scaled_erfc(-(double)x));
}

static double defect_error(float x) {
    return ulps(k_erfcx_defect(x), scaled_defect(x));
}

static double erfinv_error(float x) {
    double z = k_erfinv(x), root = z;
    for (int step = 0; step < 3; ++step)
        root -= (erf(root) - (double)x) * (root_pi / 2) * exp(root * root);
    return ulps(z, root);
}

static double erfcinv_error(float y) {
    double z = k_erfcinv(y), root = z;
    for (int step = 0; step < 3; ++step)
        root += (erfc(root) - (double)y) * (root_pi / 2) * exp(root * root);
    return ulps(z, root);
}

/* Every float from low to high, both positive. */
static void search(const char *name, const char *unit, error_function error, float low,
                   float high) {
    double worst = 0;
    float at = low;
    uint32_t first = (uint32_t)k_bits(low), last = (uint32_t)k_bits(high);
#pragma omp parallel
    {
        double my_worst = 0;
        float my_at = low;
#pragma omp for schedule(static)
        for (uint32_t bits = first; bits <= last; ++bits) {
            float x = k_from_bits((kint)bits);
            double e = error(x);
            if (e > my_worst) {
                my_worst = e;
                my_at = x;
            }
        }
#pragma omp critical
        if (my_worst > worst) {
            worst = my_worst;
            at = my_at;
        }
    }
    printf("%-9s on [%g, %g]: %.3g %s at %a (%.9g)\n", name, (double)low, (double)high, worst, unit,
           (double)at, (double)at);
    fflush(stdout);
}

int main(void) {
    search("sin", "absolute", sine_error, 1e-6f, 1.0f);
    search("cos", "absolute", cosine_error, 1e-6f, 1.0f);
    search("log", "ulp", log_error, 1.17549435e-38f, 3.4028235e38f);
    search("angle", "ulp", angle_error, 1e-6f, 1e6f);
    search("asinh", "ulp", asinh_error, 1e-6f, 1e6f);
    search("kepler", "ulp", kepler_error, 1e-6f, 3.14159274f);
    /* below these ranges the values are 1 or follow x, above them they are 0, 1 or follow 1/x or 1/x^2 */
    search("exp", "ulp", exp_error, 1e-8f, 88.7228317f);
    search("exp(-x)", "ulp", exp_of_minus_error, 1e-8f, 104.0f);
    search("erf", "ulp", erf_error, 1e-4f, 4.0f);
    search("erfc", "ulp", erfc_error, 1e-8f, 10.1f);
    search("erfc(-x)", "ulp", erfc_of_minus_error, 1e-8f, 4.0f);
    search("erfcx", "ulp", erfcx_error, 1e-8f, 1e4f);
    search("erfcx(-x)", "ulp", erfcx_of_minus_error, 1e-8f, 9.38241386f);
    search("defect", "ulp", defect_error, 1e-8f, 1e4f);
    search("erfinv", "ulp", erfinv_error, 1e-4f, 0.99999994f);
    search("erfcinv", "ulp", erfcinv_error, 4.5e-18f, 1.99999988f);
    return 0;
}
