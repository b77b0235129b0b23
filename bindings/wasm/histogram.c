/* Draws against their density: counts in bins, what is expected there, and chi^2.
 *
 * Directions are binned by their half vector in the stretched hemisphere (Heitz 2018), by height and azimuth:
 * there every lobe is broad, however smooth the surface is. The density of the library at a direction, times
 * the Jacobians of reflection and stretching, is summed over 2^17 Sobol points: 256 in each bin. */
#include "host.h"
#include "page.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265f

enum {
    RINGS = 16,
    SECTORS = 32,
    BINS = RINGS * SECTORS,
    THETAS = 45, /* bins of the angle from the normal, 2 degrees each */
    PHIS = 36,   /* and around it, 10 degrees each */
    POINTS = 1 << 17
};

typedef lobe_vec3_f32 vec3;

/* Shares of all draws: in the bins of chi^2, and by angle. */
typedef struct shares {
    float bin[BINS], theta[THETAS], phi[PHIS];
} shares;

static shares expected[METHODS], observed[METHODS];

EXPORT(expected_at) float *page_expected_at(int method);
/* BINS, then THETAS, then PHIS numbers. */
float *page_expected_at(int method) {
    return expected[method].bin;
}

EXPORT(observed_at) float *page_observed_at(int method);
float *page_observed_at(int method) {
    return observed[method].bin;
}

static int clamped(float x, int count) {
    const int k = (int)x;
    return k < 0 ? 0 : k < count ? k : count - 1;
}

/* Adds a share at a direction, whose stretched half vector is h. */
static void deposit(shares *s, vec3 h, vec3 wo, float share) {
    const float azimuth = host_atan2f(h.y, h.x), phi = host_atan2f(wo.y, wo.x);
    const float theta = host_acosf(page_min(page_max(wo.z, -1), 1));
    const int sector = clamped((azimuth + PI) * (SECTORS / (2 * PI)), SECTORS);
    s->bin[clamped(h.z * RINGS, RINGS) * SECTORS + sector] += share;
    s->theta[clamped(theta * (2 * THETAS / PI), THETAS)] += share;
    s->phi[clamped((phi + PI) * (PHIS / (2 * PI)), PHIS)] += share;
}

EXPORT(expect) double page_expect(int method);
/* Fills `expected`; returns the integral of the density. */
double page_expect(int method) {
    const scene *s = &page_scene[method];
    const lobe_reflection_f32 *model = &page_model[method];
    const float ax = model->alpha_x, ay = model->alpha_y;
    uint32_t x[3] = {0, 0, 0};
    double sum = 0;
    memset(&expected[method], 0, sizeof expected[method]);
    for (uint32_t i = 0; i < POINTS; ++i) {
        const float z = lobe_random_unit_f32(x[0]) + 0.5f / POINTS;
        const float azimuth = 2 * PI * lobe_random_unit_f32(x[1]) - PI, r = sqrtf(1 - z * z);
        page_sobol_next(x, i);
        const vec3 h = {r * (float)host_cos((double)azimuth), r * (float)host_sin((double)azimuth),
                        z};
        const vec3 a = {ax * h.x, ay * h.y, h.z};
        const float length = sqrtf(page_dot(a, a));
        const vec3 m = page_scaled(a, 1 / length), wo = page_reflected(s->wi, m);
        const float cosine = page_dot(s->wi, m);
        if (!(cosine > 0) || !(wo.z > 0)) continue;
        const float share = lobe_reflection_pdf_f32(model, wo) * 4 * cosine * ax * ay /
                            (length * length * length) * (2 * PI / POINTS);
        deposit(&expected[method], h, wo, share);
        sum += (double)share;
    }
    return sum;
}

EXPORT(observe) void page_observe(int method, int count);
/* Fills `observed` with the shares of the first `count` draws. */
void page_observe(int method, int count) {
    const rows *r = &page_rows[method];
    const float ax = page_model[method].alpha_x, ay = page_model[method].alpha_y;
    memset(&observed[method], 0, sizeof observed[method]);
    for (int i = 0; i < count; ++i) {
        if (!(r->pdf[i] > 0)) continue;
        const vec3 h = page_unit((vec3){r->m[0][i] / ax, r->m[1][i] / ay, r->m[2][i]});
        deposit(&observed[method], h, (vec3){r->wo[0][i], r->wo[1][i], r->wo[2][i]},
                1.0f / (float)count);
    }
}

static double larger(double a, double b) {
    return a > b ? a : b;
}

/* Stirling's series, after as many steps upward as it needs. */
static double log_gamma(double a) {
    double product = 1;
    while (a < 10) product *= a++;
    const double b = 1 / (a * a);
    return (a - 0.5) * host_log(a) - a + 0.91893853320467274 +
           (1.0 / 12 - b * (1.0 / 360 - b * (1.0 / 1260 - b / 1680))) / a - host_log(product);
}

/* Q(a, x) = Gamma(a, x)/Gamma(a): by its series below a + 1, by its continued fraction above. */
static double upper_gamma(double a, double x) {
    const double scale = host_exp(a * host_log(x) - x - log_gamma(a));
    if (x < a + 1) {
        double term = 1 / a, sum = term;
        for (int n = 1; n < 5000 && term > sum * 1e-14; ++n) sum += term *= x / (a + n);
        return 1 - sum * scale;
    }
    double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
    for (int n = 1; n < 5000; ++n) {
        const double an = -n * (n - a);
        b += 2;
        d = an * d + b;
        d = 1 / (fabs(d) < 1e-300 ? 1e-300 : d);
        c = b + an / c;
        c = fabs(c) < 1e-300 ? 1e-300 : c;
        h *= d * c;
        if (fabs(d * c - 1) < 1e-14) break;
    }
    return scale * h;
}

/* Of bins with at least five expected draws, and of those of the others taken together in their order. */
EXPORT(chi_square) void page_chi_square(int method, int count);
/* page_result: chi^2, degrees of freedom, p. The rejected draws are a bin too. */
void page_chi_square(int method, int count) {
    const shares *e = &expected[method], *o = &observed[method];
    double chi2 = 0, rest_e = 1, rest_o = 1, pool_e = 0, pool_o = 0;
    int bins = 0;
    for (int k = 0; k <= BINS; ++k) {
        const int is_rest = k == BINS;
        pool_e += is_rest ? larger(rest_e, 0) : (double)e->bin[k];
        pool_o += is_rest ? larger(rest_o, 0) : (double)o->bin[k];
        if (!is_rest) {
            rest_e -= (double)e->bin[k];
            rest_o -= (double)o->bin[k];
        }
        if (pool_e * count < 5) continue;
        const double d = (pool_o - pool_e) * count;
        chi2 += d * d / (pool_e * count);
        pool_e = pool_o = 0;
        ++bins;
    }
    page_result[0] = chi2;
    page_result[1] = bins - 1;
    page_result[2] = bins > 1 ? upper_gamma(0.5 * (bins - 1), larger(0.5 * chi2, 1e-300)) : NAN;
}
