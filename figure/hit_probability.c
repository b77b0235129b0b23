/* The probability that a ray from below meets a V-cavity facet that faces it (Tokuyoshi 2021, section
 * 2.2): what the previous density of visible normals integrates to. */
#include <stdio.h>

#include "figures.h"
#include "plot.h"

enum { STEPS = 201, SETS = 3 };

static double hit_probability(lobe_ndf ndf, view v) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = (lobe_model){ndf, LOBE_MASKING_VCAVITY, LOBE_METHOD_VCAVITY};
    options.normalization = LOBE_NORMALIZATION_PREVIOUS;
    const lobe_reflection_f64 model =
        lobe_reflection_prepare_f64(options, v.wi, v.alpha[0], v.alpha[1]);
    return lobe_reflection_vndf_integral_f64(&model);
}

static pen pen_of(const run *r, lobe_ndf ndf, int set) {
    static const hue hues[] = {HUE_BLUE, HUE_ORANGE, HUE_PURPLE};
    return lobe_pen(&r->canvas, hues[set], ndf == LOBE_NDF_GGX ? DASH_SOLID : DASH_LONG);
}

static void draw_curve(run *r, const plot *p, lobe_ndf ndf, int set, view v) {
    double theta[STEPS], hit[STEPS];
    for (int i = 0; i < STEPS; i++) {
        theta[i] = 80 + 0.5 * i;
        v.wi = lobe_direction(theta[i], 0);
        hit[i] = hit_probability(ndf, v);
        const double row[] = {v.alpha[0], v.alpha[1], theta[i], hit[i]};
        lobe_table_row(&r->table, lobe_ndf_name(ndf), 4, row);
    }
    lobe_plot_line(p, pen_of(r, ndf, set), STEPS, theta, hit);
}

lobe_figure_result lobe_figure_hit_probability(run *r) {
    static const double own[SETS] = {0.2, 0.5, 1};
    const int sets = r->options->alpha[0] > 0 ? 1 : SETS;
    lobe_canvas_begin(&r->canvas, COLUMN_WIDTH, 190);
    lobe_table_begin(&r->table, "ndf,alpha_x,alpha_y,theta_deg,hit_probability");
    char names[SETS][32];
    view views[SETS];
    legend_entry entries[SETS];
    for (int k = 0; k < sets; k++) {
        views[k] = lobe_run_view(r, (view){{0, 0, 1}, {own[k], own[k]}});
        snprintf(names[k], sizeof names[k], "α = %.3g", views[k].alpha[0]);
        entries[k] = (legend_entry){names[k], pen_of(r, LOBE_NDF_GGX, k)};
    }
    const double top = lobe_legend(&r->canvas, 11, sets, entries) + 22;
    const plot p = lobe_plot_begin(
        &r->canvas, (box){32, top, 196, 160 - top},
        (axis){"angle θ to the normal (degrees)", 80, 180, SCALE_DEGREES},
        (axis){"hit probability H", 0, 1.02, SCALE_LINEAR}, "GGX solid, Beckmann dashed");
    for (int set = 0; set < sets; set++) {
        draw_curve(r, &p, LOBE_NDF_GGX, set, views[set]);
        draw_curve(r, &p, LOBE_NDF_BECKMANN, set, views[set]);
    }
    return LOBE_FIGURE_OK;
}
