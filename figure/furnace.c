/* The white furnace: what a surface of F = 1 reflects of a light of 1 from everywhere, without and with
 * the compensations; the fourth way, random walks, loses nothing by construction. */
#include <math.h>
#include <stdio.h>

#include <lobe/albedo.h>

#include "figures.h"
#include "plot.h"

enum { STEPS = 60, KINDS = 4, SETS = 3 };

static const char *const kinds[KINDS] = {"one scattering", "Kulla–Conty, table", "Turquin, table",
                                         "Kulla–Conty, closed form"};

typedef struct sums {
    double theta[STEPS], sum[KINDS][STEPS], error[KINDS][STEPS]; /* error: in 10^-4 */
} sums;

static void measure(run *r, double alpha, sums *s) {
    const lobe_microsurface surface = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, alpha,
                                       alpha};
    const lobe_albedo_f32 table = lobe_albedo_prepare_f32(
        LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, (float)alpha, (float)alpha);
    const double table_average = (double)table.missing_average,
                 fit_average =
                     lobe_albedo_fit_missing_average_f64(LOBE_NDF_GGX, LOBE_G2_CORRELATED, alpha);
    for (int i = 0; i < STEPS; i++) {
        s->theta[i] = 1.5 * i;
        const vec3 wi = lobe_direction(s->theta[i], 0);
        const lobe_vec3_f32 wi32 = {(float)wi.x, 0, (float)wi.z};
        const double e = lobe_albedo(surface, lobe_reflectance_one(), wi, LOBE_EFFORT_FINE),
                     missing = (double)lobe_albedo_missing_f32(&table, wi32),
                     fit =
                         lobe_albedo_fit_missing_f64(LOBE_NDF_GGX, LOBE_G2_CORRELATED, alpha, wi.z);
        s->sum[0][i] = e;
        s->sum[1][i] = e + lobe_multiscatter_fms_f64(1, table_average) * missing;
        s->sum[2][i] = e * lobe_multiscatter_turquin_f64(1, missing);
        s->sum[3][i] = e + lobe_multiscatter_fms_f64(1, fit_average) * fit;
        double row[3 + KINDS] = {alpha, s->theta[i]};
        for (int k = 0; k < KINDS; k++) {
            s->error[k][i] = 1e4 * (s->sum[k][i] - 1);
            row[2 + k] = s->sum[k][i];
        }
        lobe_table_row(&r->table, NULL, 2 + KINDS, row);
    }
}

static pen pen_of(const run *r, int kind) {
    static const hue hues[KINDS] = {HUE_BLUE, HUE_RED, HUE_GREEN, HUE_ORANGE};
    static const dash dashes[KINDS] = {DASH_SOLID, DASH_SOLID, DASH_LONG, DASH_DOTS};
    return lobe_pen(&r->canvas, hues[kind], dashes[kind]);
}

lobe_figure_result lobe_figure_furnace(run *r) {
    static const double own[SETS] = {0.2, 0.5, 1};
    const axis x = {"incidence θ (degrees)", 0, 90, SCALE_DEGREES};
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 282);
    lobe_table_begin(&r->table, "alpha,theta_deg,none,kulla_conty,turquin,kulla_conty_closed_form");
    legend_entry entries[KINDS];
    for (int k = 0; k < KINDS; k++) entries[k] = (legend_entry){kinds[k], pen_of(r, k)};
    lobe_legend(&r->canvas, 11, KINDS, entries);
    for (int set = 0; set < SETS; set++) {
        sums s;
        char title[32];
        measure(r, own[set], &s);
        snprintf(title, sizeof title, "α = %.3g", own[set]);
        const double left = 36 + 160 * set;
        const plot top = lobe_plot_begin(
            &r->canvas, (box){left, 34, 140, 92}, (axis){NULL, 0, 90, SCALE_DEGREES},
            (axis){set ? NULL : "furnace sum", 0, 1.1, SCALE_LINEAR}, title);
        const plot below =
            lobe_plot_begin(&r->canvas, (box){left, 138, 140, 118}, x,
                            (axis){set ? NULL : "sum − 1 (10^{-4})", -12, 12, SCALE_LINEAR}, NULL);
        for (int k = 0; k < KINDS; k++) {
            lobe_plot_line(&top, pen_of(r, k), STEPS, s.theta, s.sum[k]);
            if (k) lobe_plot_line(&below, pen_of(r, k), STEPS, s.theta, s.error[k]);
        }
        if (!lobe_run_goes_on(r, (set + 1.0) / SETS)) return LOBE_FIGURE_INTERRUPTED;
    }
    return LOBE_FIGURE_OK;
}
