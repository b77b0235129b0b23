/* Integrals against closed forms. */
#include <math.h>

#include "tests.h"

/* Cubature ends at about 1e-9 in double; in single precision the density's own rounding is what
 * it integrates. */
static double integral_limit(const lobe_verify_model *model) {
    return (model->has_jumps ? 4e-6 : 1e-7) + 64 * model->rounding;
}

static void test_normalization(const lobe_verify_model *model, lobe_report *report) {
    if (isnan(model->accepted)) return;
    double integral = lobe_density_integral(model);
    lobe_report_error(report, "normalization", fabs(integral - model->accepted),
                      integral_limit(model), "%.9f, closed form %.9f", integral, model->accepted);
}

static void test_share(const lobe_verify_model *model, lobe_report *report) {
    if (isnan(model->accepted) || isnan(model->accepted_oracle)) return;
    lobe_report_error(report, "share", fabs(model->accepted - model->accepted_oracle),
                      1e-9 + 64 * model->rounding, "%.9f, independently %.9f", model->accepted,
                      model->accepted_oracle);
}

static void test_uniform(const lobe_verify_model *model, const lobe_settings *settings,
                         lobe_report *report) {
    if (isnan(model->density_oracle)) return;
    lobe_verify_state state;
    model->prepare(model->self, model->wi, &state);
    double worst = 0;
    for (int i = 0; i < settings->checks; ++i) {
        double wo[3];
        lobe_hemisphere_direction(model, settings, (uint64_t)i, wo);
        double error = fabs(model->density(&state, wo) / model->density_oracle - 1);
        worst = lobe_worse(worst, error);
    }
    lobe_report_error(report, "uniform", worst, 64 * model->rounding, "of %.9f, %d directions",
                      model->density_oracle, settings->checks);
}

/* What is never drawn is missing from every estimate: rounding may lose a millionth, no more. */
static void test_coverage(const lobe_bins *bins, lobe_report *report) {
    double share = bins->value > 0 ? bins->uncovered / bins->value : bins->uncovered;
    lobe_report_error(report, "coverage", share, 1e-6, "of %.6f is where no draw goes",
                      bins->value);
}

static void test_albedo(const lobe_verify_model *model, const lobe_bins *bins,
                        lobe_report *report) {
    if (isnan(model->albedo_oracle)) return;
    /* of a kink all around the normal, whose errors add up */
    double limit = model->has_jumps ? 2e-5 : 1e-7;
    lobe_report_error(report, "albedo", fabs(bins->value - model->albedo_oracle),
                      limit + 64 * model->rounding, "%.9f, closed form %.9f", bins->value,
                      model->albedo_oracle);
}

void lobe_test_integrals(const lobe_verify_model *model, const lobe_settings *settings,
                         const lobe_bins *bins, lobe_report *report) {
    test_normalization(model, report);
    test_share(model, report);
    test_uniform(model, settings, report);
    test_coverage(bins, report);
    test_albedo(model, bins, report);
}
