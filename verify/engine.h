/* All tests of one model. */
#ifndef LOBE_VERIFY_ENGINE_H
#define LOBE_VERIFY_ENGINE_H

#include "model.h"
#include "monitor.h"
#include "report.h"

enum { LOBE_FULL_DRAWS = 100000000 };

typedef struct lobe_settings {
    uint64_t draws;
    int grid;   /* bins in each direction, before merging and halving */
    int checks; /* directions for the tests that compare single values */
    uint64_t seed;
    uint64_t stream;
    double p_limit; /* significance of one test */
    int threads;
    lobe_verify_pictures pictures;
} lobe_settings;

/* 16 x 16 bins of 500 draws for quick, 64 x 64 bins of 24,000 for full. */
lobe_settings lobe_level_settings(lobe_verify_level level);

/* Number of p-values that a case gives at most. */
enum { LOBE_P_VALUES_A_CASE = 3 };

typedef struct lobe_picture lobe_picture;

/* `picture` is filled where the settings ask for one; NULL: none. Returns 0 without memory. After a
 * cancellation the report is of no use. */
int lobe_verify_model_run(const lobe_verify_model *model, const lobe_settings *settings,
                          lobe_monitor *monitor, lobe_report *report, lobe_picture *picture);

#endif
