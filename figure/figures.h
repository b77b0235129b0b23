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

/* Whether the index-th of many steps should be the last: looks now and then. */
int lobe_run_is_over(const run *r, uint64_t index);

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
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_WI | LOBE_FIGURE_READS_OPTIMAL)                  \
    X(stretched, "stretched", "stretched space: useful region, caps and horizon draws",            \
      "after Eto & Tokuyoshi 2023, Fig. 3",                                                        \
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_WI | LOBE_FIGURE_READS_SAMPLES |                 \
          LOBE_FIGURE_READS_SEED)                                                                  \
    X(visible_slopes_ggx, "visible-slopes-ggx", "density and draws of visible GGX slopes",         \
      "Heitz & d'Eon 2014, supplement 1, Fig. 3",                                                  \
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_SAMPLES | LOBE_FIGURE_READS_SEED)                \
    X(visible_slopes_beckmann, "visible-slopes-beckmann",                                          \
      "density and draws of visible Beckmann slopes", "Heitz & d'Eon 2014, supplement 1, Fig. 1",  \
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_SAMPLES | LOBE_FIGURE_READS_SEED)                \
    X(cz_fit, "cz-fit", "the rational fit of the conditional slope, the exact inverse, the error", \
      "Heitz & d'Eon 2014, supplement 1, Fig. 2", 0)                                               \
    X(newton, "newton", "residual of the Beckmann slope over angle and random number",             \
      "after Jakob 2014", 0)                                                                       \
    X(ellipsoid, "ellipsoid", "the GGX ellipsoid, its hemisphere, and random numbers on it",       \
      "Heitz 2018, Figs. 2-5", LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_WI)                     \
    X(caps, "caps", "a mirror fills a cap; draws that leave the surface, and bounded caps",        \
      "Dupuy & Benyoub 2023, Figs. 4, 5; Eto & Tokuyoshi 2023, Fig. 3",                            \
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_WI | LOBE_FIGURE_READS_SAMPLES |                 \
          LOBE_FIGURE_READS_SEED)                                                                  \
    X(masking, "masking", "the five ways in which a V-cavity is seen",                             \
      "Tokuyoshi 2021, supplement, Fig. 1", 0)                                                     \
    X(hit_probability, "hit-probability", "H of V-cavities below the shading plane",               \
      "Tokuyoshi 2021, supplement, section 2.2", LOBE_FIGURE_READS_ALPHA)                          \
    X(rejections, "rejections", "share of rejected draws over roughness and angle",                \
      "after Eto & Tokuyoshi 2023",                                                                \
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_WI | LOBE_FIGURE_READS_SAMPLES)                  \
    X(variance, "variance", "variance of a draw in a white furnace over roughness and angle",      \
      "after Eto & Tokuyoshi 2023",                                                                \
      LOBE_FIGURE_READS_ALPHA | LOBE_FIGURE_READS_WI | LOBE_FIGURE_READS_SAMPLES)                  \
    X(furnace, "furnace", "the white furnace without and with compensations",                      \
      "after Tokuyoshi & Eto 2024, supplement, section 2", 0)                                      \
    X(albedo, "albedo", "albedo over angle and roughness, errors of the table and closed form",    \
      "after Kulla & Conty 2017", 0)                                                               \
    X(multiscatter, "multiscatter", "all scatterings on a metal: approximations and random walks", \
      "after Turquin 2019", LOBE_FIGURE_READS_SAMPLES | LOBE_FIGURE_READS_SEED)                    \
    X(normal_mapped, "normal-mapped", "shading normals that face away: bias of the normalisation", \
      "Tokuyoshi 2021, supplement, Fig. 2", LOBE_FIGURE_READS_SPP | LOBE_FIGURE_READS_SEED)        \
    X(ssr_passes, "ssr-passes", "screen-space reflections, pass by pass, and real rays",           \
      "after the notes on HDRP, Fig. 1", LOBE_FIGURE_READS_SPP | LOBE_FIGURE_READS_SEED)

typedef lobe_figure_result figure_function(run *r);

#define LOBE_FIGURE_DECLARATION(ID, name, about, source, reads) figure_function lobe_figure_##ID;
LOBE_FIGURES(LOBE_FIGURE_DECLARATION)
#undef LOBE_FIGURE_DECLARATION

#endif
