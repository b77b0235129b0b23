/* One function a figure, each in the file of its name. */
#ifndef LOBE_FIGURE_FIGURES_H
#define LOBE_FIGURE_FIGURES_H

#include "canvas.h"
#include "geometry.h"
#include "table.h"

typedef struct run {
    const lobe_figure_options *options;
    canvas canvas;
    bytes table;
} run;

/* Tells the share that is done; 0: stop. */
int lobe_run_goes_on(const run *r, double share);

/* The roughness and direction of the options, or the figure's own. */
view lobe_run_view(const run *r, view own);
uint64_t lobe_run_samples(const run *r, uint64_t own);

/* Keeps the message. */
lobe_figure_result lobe_figure_fail(lobe_figure_result result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
lobe_figure_result lobe_figure_fail_memory(void);

/* X(identifier, "name", "what it shows", "source", parameters): adding a figure adds a row here. */
#define LOBE_FIGURES(X)                                                                            \
    X(bound, "bound", "projected reflection bound, previous cap and bounded cap over longitude",   \
      "Eto & Tokuyoshi 2023, supplement, Fig. 1",                                                  \
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_WI | LOBE_FIGURE_READS_OPTIMAL)

typedef lobe_figure_result figure_function(run *r);

#define LOBE_FIGURE_DECLARATION(ID, name, about, source, reads) figure_function lobe_figure_##ID;
LOBE_FIGURES(LOBE_FIGURE_DECLARATION)
#undef LOBE_FIGURE_DECLARATION

#endif
