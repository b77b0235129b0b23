/* Draws against integrals of the density and of the value. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "statistics.h"
#include "tests.h"

/* Below this the chi^2 distribution is a poor description of a bin. */
static const double LEAST_EXPECTED = 10;

/* Pearson's sum over bins merged, in the order of the grid, until enough is expected of each. */
typedef struct pearson {
    double expected, observed;           /* of the bin under way */
    double last_expected, last_observed; /* of the one before */
    double sum;
    int bins;
} pearson;

static double pearson_term(double expected, double observed) {
    return (observed - expected) * (observed - expected) / expected;
}

static void add_bin(pearson *p, double expected, double observed) {
    p->expected += expected;
    p->observed += observed;
    if (p->expected < LEAST_EXPECTED) return;
    p->sum += pearson_term(p->expected, p->observed);
    p->bins += 1;
    p->last_expected = p->expected;
    p->last_observed = p->observed;
    p->expected = 0;
    p->observed = 0;
}

/* What is left over joins the last bin. */
static void finish_bins(pearson *p) {
    if (p->bins == 0) return;
    p->sum -= pearson_term(p->last_expected, p->last_observed);
    p->sum += pearson_term(p->last_expected + p->expected, p->last_observed + p->observed);
}

static void test_chi_square(const lobe_settings *settings, const lobe_bins *bins,
                            const lobe_tally *tally, lobe_report *report) {
    double n = (double)tally->draws;
    pearson p = {0};
    add_bin(&p, n * fmax(1 - bins->density, 0), (double)tally->counts[bins->count]);
    for (size_t i = 0; i < bins->count; ++i) {
        add_bin(&p, n * bins->share[i], (double)tally->counts[i]);
    }
    finish_bins(&p);
    double dof = p.bins - 1;
    double value = p.bins > 1 ? lobe_chi_square_survival(p.sum, dof) : 0;
    lobe_report_p_value(report, "chi2", p.sum, value, settings->p_limit, "%d bins, %.3g draws",
                        p.bins, n);
}

/* Few events by Poisson's distribution, many by the normal one. `slack` is by how much the mean is
 * unknown to either side: a closed bound is met to rounding only. */
static double count_p_value(double mean, double slack, double n, uint64_t count, double *z) {
    double variance = mean * (1 - mean / n);
    double off = (double)count - mean;
    off = off > 0 ? fmax(off - slack, 0) : fmin(off + slack, 0);
    *z = off / sqrt(fmax(variance, 1));
    if (mean > 1000) return lobe_normal_two_sided(*z);
    return lobe_poisson_two_sided((double)count - off, count);
}

static void test_rejected(const lobe_verify_model *model, const lobe_settings *settings,
                          const lobe_bins *bins, const lobe_tally *tally, lobe_report *report) {
    double n = (double)tally->draws;
    uint64_t rejected = tally->counts[bins->count];
    double share = fmax(1 - bins->density, 0);
    /* Jumps in the density leave that much uncertain of its integral. */
    double slack = n * (8 * model->rounding + (model->has_jumps ? 4e-6 : 1e-8));
    double z;
    double p = share <= 0.5
                   ? count_p_value(n * share, slack, n, rejected, &z)
                   : count_p_value(n * bins->density, slack, n, tally->draws - rejected, &z);
    lobe_report_p_value(report, "rejected", z, isfinite(bins->density) ? p : 0, settings->p_limit,
                        "%.6f, expected %.6f", (double)rejected / n, 1 - bins->density);
}

static void test_furnace(const lobe_verify_model *model, const lobe_settings *settings,
                         const lobe_bins *bins, const lobe_tally *tally, lobe_report *report) {
    double n = (double)tally->draws;
    double mean = tally->weight_sum / n;
    double expected = bins->cut_mean;
    double variance = fmax(bins->cut_square - expected * expected, 0) / n;
    /* A constant weight has no variance but its rounding and that of the cubature. */
    double cubature = model->has_jumps ? 4e-6 : 1e-7;
    double rounding = (16 * model->rounding + cubature) * fabs(expected);
    /* A black surface has no deviation at all. */
    double deviation = fmax(sqrt(variance + rounding * rounding), DBL_MIN);
    double z = (mean - expected) / deviation;
    lobe_report_p_value(report, "furnace", z, lobe_normal_two_sided(z), settings->p_limit,
                        "%.6f, expected %.6f", mean, expected);
}

static void test_soundness(const lobe_tally *tally, lobe_report *report) {
    lobe_report_error(report, "sound", (double)tally->unsound, 0,
                      "draws that are NaN, infinite or negative, of %.3g", (double)tally->draws);
}

void lobe_test_draws(const lobe_verify_model *model, const lobe_settings *settings,
                     const lobe_bins *bins, const lobe_tally *tally, lobe_report *report) {
    test_chi_square(settings, bins, tally, report);
    test_rejected(model, settings, bins, tally, report);
    test_furnace(model, settings, bins, tally, report);
    test_soundness(tally, report);
}
