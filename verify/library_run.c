/* The library's own models: cases share out the threads. */
#include <omp.h>
#include <stdlib.h>

#include "library_cases.h"
#include "run.h"

static void run_case(lobe_run *run, size_t position) {
    lobe_library_subject subject;
    lobe_library_subject_make(&subject, run->suite.chosen[position]);
    lobe_settings settings = run->settings;
    settings.stream = lobe_title_stream(lobe_run_title(run, position));
    lobe_outcome *outcome = &run->outcomes[position];
    int wants_picture = settings.pictures != LOBE_VERIFY_PICTURES_NONE;
    if (wants_picture) outcome->picture = calloc(1, sizeof *outcome->picture);
    int is_good = !wants_picture || outcome->picture != NULL;
    is_good = is_good && lobe_verify_model_run(subject.model, &settings, &run->monitor,
                                               &outcome->report, outcome->picture);
#pragma omp critical(lobe_verify_callback)
    {
        if (!is_good) {
            lobe_run_stop(run, LOBE_VERIFY_NO_MEMORY, "out of memory; use fewer threads");
        } else if (!atomic_load(&run->monitor.is_cancelled)) {
            lobe_run_finish_case(run, position);
        }
    }
}

/* What a short list leaves over shares out the draws of a case. */
void lobe_run_library_cases(lobe_run *run) {
    int threads = lobe_run_threads(run);
    size_t count = run->suite.chosen_count;
    int outer = count < (size_t)threads ? (int)count : threads;
    run->settings.threads = threads / outer;
    omp_set_max_active_levels(2);
#pragma omp parallel for schedule(dynamic, 1) num_threads(outer)
    for (size_t i = 0; i < count; ++i) {
        int is_cancelled = atomic_load(&run->monitor.is_cancelled);
        if (!is_cancelled && !run->outcomes[i].is_done) run_case(run, i);
    }
}
