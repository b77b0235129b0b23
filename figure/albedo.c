/* What one scattering reflects of a white surface, and how far the table and the closed form are off. */
#include <math.h>

#include <lobe/albedo.h>

#include "figures.h"
#include "plot.h"

enum { SIDE = 56 };

typedef struct maps {
    double albedo[SIDE * SIDE], table[SIDE * SIDE], fit[SIDE * SIDE];
} maps;

static void measure(run *r, maps *m, int i, double mu, double alpha) {
    const lobe_microsurface s = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, alpha,
                                 alpha};
    const vec3 wi = {sqrt(1 - mu * mu), 0, mu};
    const lobe_albedo_f32 prepared = lobe_albedo_prepare_f32(
        LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, (float)alpha, (float)alpha);
    const lobe_vec3_f32 wi32 = {(float)wi.x, 0, (float)wi.z};
    const double exact = lobe_albedo(s, lobe_reflectance_one(), wi, LOBE_EFFORT_FINE),
                 table = 1 - (double)lobe_albedo_missing_f32(&prepared, wi32),
                 fit = 1 - lobe_albedo_fit_missing_f64(LOBE_NDF_GGX, LOBE_G2_CORRELATED, alpha, mu);
    m->albedo[i] = exact;
    m->table[i] = 1e4 * (table - exact);
    m->fit[i] = 1e4 * (fit - exact);
    const double row[] = {mu, alpha, exact, table - exact, fit - exact};
    lobe_table_row(&r->table, NULL, 5, row);
}

static void draw_map(run *r, int k, const char *title, const double *values, colour_map *map,
                     axis bar) {
    const axis x = {"cosine of incidence μ", 0, 1, SCALE_LINEAR};
    const axis y = {k ? NULL : "roughness α", 0, 1, SCALE_LINEAR};
    const box b = {32 + 160 * k, 18, 136, 136};
    const plot p = lobe_plot_begin(&r->canvas, b, x, y, title);
    lobe_plot_grid(&p, (grid){SIDE, SIDE, values, bar.low, bar.high, map});
    lobe_colour_bar(&r->canvas, (box){b.x, 188, b.width, 7}, map, bar);
}

lobe_figure_result lobe_figure_albedo(run *r) {
    static maps m;
    const axis unit = {NULL, 0, 1, SCALE_LINEAR};
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 222);
    lobe_table_begin(&r->table, "mu,alpha,albedo,table_error,fit_error");
    for (int i = 0; i < SIDE * SIDE; i++) {
        measure(r, &m, i, lobe_axis_middle(unit, i % SIDE, SIDE),
                lobe_axis_middle(unit, i / SIDE, SIDE));
        if (i % SIDE == 0 && !lobe_run_goes_on(r, (double)i / (SIDE * SIDE)))
            return LOBE_FIGURE_INTERRUPTED;
    }
    draw_map(r, 0, "albedo E of Smith–GGX", m.albedo, lobe_map_sequential,
             (axis){"E", 0.3, 1, SCALE_LINEAR});
    draw_map(r, 1, "table", m.table, lobe_map_diverging,
             (axis){"error (10^{-4})", -1, 1, SCALE_LINEAR});
    draw_map(r, 2, "closed form", m.fit, lobe_map_diverging,
             (axis){"error (10^{-4})", -10, 10, SCALE_LINEAR});
    return LOBE_FIGURE_OK;
}
