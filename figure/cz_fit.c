/* The rational fit of the conditional slope, and what it costs (Heitz & d'Eon 2014, supplement 1, Fig. 2):
 * both curves are draws of the library. */
#include <math.h>

#include "figures.h"
#include "plot.h"

enum { STEPS = 400 };

/* The slope across i of the number u of the positive half, divided by sqrt(1 + x^2). */
static double slope_of(const lobe_reflection_f64 *model, double u) {
    const vec3 m = lobe_reflection_sample_f64(model, 0.5, 0.5 + 0.5 * u, 0.5).m;
    return fabs(m.y) / hypot(m.x, m.z);
}

/* The number at which the exact slope is z: the CDF of the positive half. */
static double number_of(const lobe_reflection_f64 *exact, double z) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (slope_of(exact, middle) < z)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

lobe_figure_result lobe_figure_cz_fit(run *r) {
    const view v = {lobe_direction(45, 0), {1, 1}};
    const lobe_reflection_f64 fit = lobe_ggx_model(v, LOBE_METHOD_SLOPE_PUBLISHED),
                              exact = lobe_ggx_model(v, LOBE_METHOD_SLOPE);
    double u[STEPS], z_fit[STEPS], z_exact[STEPS], error[STEPS];
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 172);
    lobe_table_begin(&r->table, "u,z_fit,z_exact,cdf_error");
    for (int i = 0; i < STEPS; i++) {
        /* closer together toward 1, where the fit is worst */
        u[i] = 1 - pow(1 - (i + 0.5) / STEPS, 3);
        z_fit[i] = slope_of(&fit, u[i]);
        z_exact[i] = slope_of(&exact, u[i]);
        error[i] = 1000 * (number_of(&exact, z_fit[i]) - u[i]);
        const double row[] = {u[i], z_fit[i], z_exact[i], 1e-3 * error[i]};
        lobe_table_row(&r->table, NULL, 4, row);
    }
    const pen fitted = lobe_pen(&r->canvas, HUE_RED, DASH_LONG),
              inverse = lobe_pen(&r->canvas, HUE_BLUE, DASH_SOLID);
    const legend_entry entries[] = {{"exact inverse", inverse}, {"published fit", fitted}};
    lobe_legend(&r->canvas, 11, 2, entries);
    const axis x = {"random number U (positive half)", 0, 1, SCALE_LINEAR};
    const plot left = lobe_plot_begin(&r->canvas, (box){32, 24, 200, 120}, x,
                                      (axis){"z = y / √(1 + x^2)", 0, 5, SCALE_LINEAR}, NULL);
    lobe_plot_line(&left, inverse, STEPS, u, z_exact);
    lobe_plot_line(&left, fitted, STEPS, u, z_fit);
    const plot right =
        lobe_plot_begin(&r->canvas, (box){290, 24, 200, 120}, x,
                        (axis){"error of C_z (10^{-3})", -1.2, 1.2, SCALE_LINEAR}, NULL);
    lobe_plot_line(&right, fitted, STEPS, u, error);
    return LOBE_FIGURE_OK;
}
