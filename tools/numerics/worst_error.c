/* tools/numerics/worst_error.c: the worst error of each elementary kernel in single precision, by
 * trying every float of its domain, with the input that causes it.
 *
 *     cc -O2 -ffp-contract=off -fopenmp -I. tools/numerics/worst_error.c -lm -o worst_error
 *     ./worst_error
 *
 * The figures stand at the foot of the kernel files. */
#include "kernel/bind/c_f32.h"

#include "kernel/arc.h"
#include "kernel/kepler.h"
#include "kernel/log.h"

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
    float f = fabsf((float)x);
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
    printf("%-8s on [%g, %g]: %.3g %s at %a (%.9g)\n", name, (double)low, (double)high, worst, unit,
           (double)at, (double)at);
}

int main(void) {
    search("sin", "absolute", sine_error, 1e-6f, 1.0f);
    search("cos", "absolute", cosine_error, 1e-6f, 1.0f);
    search("log", "ulp", log_error, 1.17549435e-38f, 3.4028235e38f);
    search("angle", "ulp", angle_error, 1e-6f, 1e6f);
    search("asinh", "ulp", asinh_error, 1e-6f, 1e6f);
    search("kepler", "ulp", kepler_error, 1e-6f, 3.14159274f);
    return 0;
}
