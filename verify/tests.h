/* The tests, by what they need. Each adds its rows to the report. */
#ifndef LOBE_VERIFY_TESTS_H
#define LOBE_VERIFY_TESTS_H

#include "bins.h"
#include "engine.h"
#include "tally.h"

/* chi2, rejected, furnace, sound: draws against integrals. */
void lobe_test_draws(const lobe_verify_model *model, const lobe_settings *settings,
                     const lobe_bins *bins, const lobe_tally *tally, lobe_report *report);

/* normalization, share, uniform, coverage, albedo: integrals against closed forms. */
void lobe_test_integrals(const lobe_verify_model *model, const lobe_settings *settings,
                         const lobe_bins *bins, lobe_report *report);

/* density, weight, bound, reciprocity, precision, length, support: values at single directions. */
void lobe_test_directions(const lobe_verify_model *model, const lobe_settings *settings,
                          lobe_report *report);

void lobe_test_mirror(const lobe_verify_model *model, const lobe_settings *settings,
                      lobe_report *report);
void lobe_test_extreme(const lobe_verify_model *model, lobe_report *report);

/* The larger one; a NaN is the worst there is. */
double lobe_worse(double worst, double error);

/* Uniform over the upper hemisphere, in the precision of the model. */
void lobe_hemisphere_direction(const lobe_verify_model *model, const lobe_settings *settings,
                               uint64_t index, double wo[3]);

#endif
