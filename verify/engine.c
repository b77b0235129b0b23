#include "engine.h"

#include <math.h>

#include "picture.h"
#include "tests.h"

lobe_settings lobe_level_settings(lobe_verify_level level) {
    lobe_settings quick = {.draws = 131072, .grid = 16, .checks = 256, .seed = 1, .threads = 1};
    lobe_settings full = {
        .draws = LOBE_FULL_DRAWS, .grid = 64, .checks = 65536, .seed = 1, .threads = 1};
    return level == LOBE_VERIFY_FULL ? full : quick;
}

lobe_verify_model lobe_verify_plain_model(void) {
    return (lobe_verify_model){.rounding = 2.220446049250313e-16,
                               .random_bits = 53,
                               .chart = lobe_hemisphere_chart(),
                               .weight_bound = INFINITY,
                               .accepted = NAN,
                               .accepted_oracle = NAN,
                               .density_oracle = NAN,
                               .albedo_oracle = NAN};
}

int lobe_verify_is_sphere(const lobe_verify_model *model) {
    return model->below.direction != NULL;
}

const lobe_verify_chart *lobe_verify_chart_of(const lobe_verify_model *model, const double wo[3]) {
    return lobe_verify_is_sphere(model) && wo[2] < 0 ? &model->below : &model->chart;
}

double lobe_worse(double worst, double error) {
    if (isnan(error)) return INFINITY;
    return error > worst ? error : worst;
}

/* Cutting the weights keeps the variance of a heavy tail finite and known. Where a bound is
 * promised the cut only bites on a broken promise. */
static double weight_cut(const lobe_verify_model *model) {
    return isfinite(model->weight_bound) ? 2 * model->weight_bound : 16;
}

static void test_all(const lobe_verify_model *model, const lobe_settings *settings,
                     const lobe_bins *bins, const lobe_tally *tally, lobe_report *report) {
    lobe_report_begin(report, "integrals");
    lobe_test_draws(model, settings, bins, tally, report);
    lobe_test_integrals(model, settings, bins, report);
    lobe_report_begin(report, "directions");
    lobe_test_directions(model, settings, report);
    lobe_report_begin(report, "special numbers");
    lobe_test_extreme(model, report);
}

static int is_picture_wanted(const lobe_settings *settings, const lobe_report *report) {
    if (settings->pictures == LOBE_VERIFY_PICTURES_ALL) return 1;
    int failures = 0;
    for (int i = 0; i < report->count; ++i) failures += !lobe_report_row_passed(&report->rows[i]);
    return settings->pictures == LOBE_VERIFY_PICTURES_FAILED && failures > 0;
}

static int test_draws_and_values(const lobe_verify_model *model, const lobe_settings *settings,
                                 lobe_monitor *monitor, lobe_report *report,
                                 lobe_picture *picture) {
    lobe_bins bins;
    lobe_report_begin(report, "cubature");
    if (!lobe_bins_make(&bins, model, settings->grid, weight_cut(model))) return 0;
    lobe_tally tally;
    lobe_report_begin(report, "draws");
    int is_good = lobe_tally_make(&tally, model, &bins, settings, monitor);
    if (is_good) {
        test_all(model, settings, &bins, &tally, report);
        if (is_picture_wanted(settings, report) && picture != NULL) {
            lobe_report_begin(report, "picture");
            is_good = lobe_picture_make(picture, model, settings, &bins, &tally);
        }
        lobe_tally_free(&tally);
    }
    lobe_bins_free(&bins);
    return is_good;
}

int lobe_verify_model_run(const lobe_verify_model *model, const lobe_settings *settings,
                          lobe_monitor *monitor, lobe_report *report, lobe_picture *picture) {
    report->count = 0;
    if (model->is_mirror) {
        lobe_test_mirror(model, settings, report);
        lobe_test_extreme(model, report);
    } else if (!test_draws_and_values(model, settings, monitor, report, picture)) {
        return 0;
    }
    if (model->known_bias != NULL) {
        int is_due = model->is_bias_due && settings->draws >= LOBE_FULL_DRAWS;
        lobe_report_mark_known(report, model->known_bias, is_due);
    }
    lobe_report_begin(report, "");
    return 1;
}
