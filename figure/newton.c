/* How well the slope of a Beckmann surface solves its equation: three unguarded Newton steps (Jakob 2014)
 * and the bracketed inversion. */
#include <math.h>

#include "figures.h"
#include "plot.h"
#include "ticks.h"

enum { SIDE = 72 };

/* CDF of the visible slopes up to x, roughness 1 (the equation that the methods solve). */
static double slope_cdf(double theta, double x) {
    const double c = 1 / tan(theta), k = tan(theta) / sqrt(FIGURE_PI);
    return (erfc(-x) + k * exp(-x * x)) / (erfc(-c) + k * exp(-c * c));
}

static double residual(lobe_method method, double degrees, double u) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = (lobe_model){LOBE_NDF_BECKMANN, LOBE_MASKING_SMITH, method};
    const lobe_reflection_f64 model =
        lobe_reflection_prepare_f64(options, lobe_direction(degrees, 0), 1, 1);
    const vec3 m = lobe_reflection_sample_f64(&model, u, 0.5, 0.5).m;
    return fabs(slope_cdf(degrees * FIGURE_PI / 180, -m.x / m.z) - u);
}

lobe_figure_result lobe_figure_newton(run *r) {
    static double shares[2][SIDE * SIDE];
    const axis x = {"angle of incidence θ (degrees)", 0, 90, SCALE_DEGREES},
               y = {"random number u", 2e-6, 1 - 2e-6, SCALE_CHANCE},
               error = {"residual of the CDF", 1e-16, 1e-4, SCALE_LOG};
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 210);
    lobe_table_begin(&r->table, "theta_deg,u,published,ours");
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double theta = lobe_axis_middle(x, i % SIDE, SIDE),
                     u = lobe_axis_middle(y, i / SIDE, SIDE);
        const double published = residual(LOBE_METHOD_NEWTON_PUBLISHED, theta, u),
                     ours = residual(LOBE_METHOD_NEWTON, theta, u);
        shares[0][i] = lobe_axis_share(error, fmax(published, 1e-17));
        shares[1][i] = lobe_axis_share(error, fmax(ours, 1e-17));
        const double row[] = {theta, u, published, ours};
        lobe_table_row(&r->table, NULL, 4, row);
    }
    static const char *const titles[] = {"three Newton steps (published)", "newton (lobe)"};
    for (int k = 0; k < 2; k++) {
        axis side = y;
        if (k) side.label = NULL;
        const plot p =
            lobe_plot_begin(&r->canvas, (box){48 + 206 * k, 18, 188, 164}, x, side, titles[k]);
        lobe_plot_grid(&p, (grid){SIDE, SIDE, shares[k], 0, 1, lobe_map_sequential});
    }
    lobe_colour_bar(&r->canvas, (box){450, 18, 8, 164}, lobe_map_sequential, error);
    return LOBE_FIGURE_OK;
}
