/* lobe/figure.h: the figures of the papers, drawn by the library's own numbers. liblobe_figure.
 *
 *     lobe_figure_options options = lobe_figure_default_options();
 *     options.name = "bound";
 *     options.picture = "bound.svg";
 *     if (lobe_figure_make(&options) != LOBE_FIGURE_OK)
 *         fprintf(stderr, "lobe: %s\n", lobe_figure_error_message());
 */
#ifndef LOBE_FIGURE_H
#define LOBE_FIGURE_H

#include <signal.h>

#include "types.h"

LOBE_BEGIN_C

/* Parameters that a figure may read. */
enum {
    LOBE_FIGURE_READS_ALPHA = 1,
    LOBE_FIGURE_READS_WI = 2,
    LOBE_FIGURE_READS_OPTIMAL = 4,
    LOBE_FIGURE_READS_SAMPLES = 8,
    LOBE_FIGURE_READS_SPP = 16,
    LOBE_FIGURE_READS_SEED = 32
};

typedef struct lobe_figure_info {
    const char *name;
    const char *about;  /* what it shows */
    const char *source; /* whose figure it is */
    uint32_t reads;     /* LOBE_FIGURE_READS_… */
} lobe_figure_info;

LOBE_API int lobe_figure_count(void);
/* An index out of range: a name of NULL. */
LOBE_API lobe_figure_info lobe_figure_at(int index);

typedef enum lobe_figure_theme { LOBE_FIGURE_LIGHT, LOBE_FIGURE_DARK } lobe_figure_theme;

typedef struct lobe_figure_options {
    const char *name;
    const char *picture; /* .svg, .pdf or .png (any case); NULL: none */
    const char *table;   /* the plotted numbers as CSV; NULL: none */
    lobe_figure_theme theme;
    double dpi; /* of a .png, 36 to 1200; default 216 */
    /* Of a figure that reads them; 0: its own. */
    double alpha[2];                     /* roughness, [LOBE_ALPHA_MIN, 10] */
    lobe_vec3_f64 wi;                    /* unit, above the surface */
    uint64_t samples;                    /* draws or walks, 1 to 10^8 */
    uint32_t spp;                        /* camera paths a pixel, 1 to 65536 */
    uint64_t seed;                       /* default 1 */
    int optimal;                         /* also show the optimal cap */
    const volatile sig_atomic_t *cancel; /* not NULL: ends soon after *cancel != 0 */
    void (*progress)(void *user, double share);
    void *user;
} lobe_figure_options;

LOBE_API lobe_figure_options lobe_figure_default_options(void);

typedef enum lobe_figure_result {
    LOBE_FIGURE_OK,
    LOBE_FIGURE_INTERRUPTED, /* by `cancel`; nothing was written */
    LOBE_FIGURE_BAD_INPUT,   /* name, ending or parameter */
    LOBE_FIGURE_FAILED       /* memory, output file */
} lobe_figure_result;

/* Draws in memory, then writes: each file appears whole or not at all. */
LOBE_API lobe_figure_result lobe_figure_make(const lobe_figure_options *options);

/* 1 if a picture can be written under such a name. */
LOBE_API int lobe_figure_can_write(const char *path);

/* "WHERE: WHAT; HINT" of the last call of this thread that was not LOBE_FIGURE_OK or _INTERRUPTED. */
LOBE_API const char *lobe_figure_error_message(void);

LOBE_END_C

#endif
