#include "visible_slopes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lobe/batch.h>

#include "plot.h"

enum { SIDE = 48, ANGLES = 4, FINE = 400 };

static const double angles[ANGLES] = {0, 45, 75, 88};

typedef struct slopes {
    double density[SIDE * SIDE], drawn[SIDE * SIDE]; /* per unit of slope squared */
    double at[SIDE];
    double marginal[2][SIDE], marginal_drawn[2][SIDE]; /* of the slopes x and y */
} slopes;

static const axis x_slope = {"slope x", -5, 5, SCALE_LINEAR};
static const axis y_slope = {"slope y", -5, 5, SCALE_LINEAR};

/* A facet of slopes (x, y) covers m_z^3 steradians for each unit of slope squared. */
static double slope_density(const lobe_reflection_f64 *model, double x, double y) {
    const vec3 m = lobe_unit3((vec3){-x, -y, 1});
    return lobe_reflection_eval_m_f64(model, m).pdf_m * m.z * m.z * m.z;
}

/* Over all of the other slope, which is tan t. */
static double marginal_density(const lobe_reflection_f64 *model, int which, double slope) {
    double sum = 0;
    for (int i = 0; i < FINE; i++) {
        const double t = FIGURE_PI * ((i + 0.5) / FINE - 0.5), other = tan(t);
        sum += (which ? slope_density(model, other, slope) : slope_density(model, slope, other)) *
               (1 + other * other);
    }
    return sum * FIGURE_PI / FINE;
}

static void count_draw(slopes *s, const double slope[2], double unit) {
    const double width = (x_slope.high - x_slope.low) / SIDE;
    int cell[2];
    for (int k = 0; k < 2; k++) {
        const double at = floor((slope[k] - x_slope.low) / width);
        cell[k] = at >= 0 && at < SIDE ? (int)at : -1;
        if (cell[k] >= 0) s->marginal_drawn[k][cell[k]] += unit / width;
    }
    if (cell[0] >= 0 && cell[1] >= 0) s->drawn[cell[1] * SIDE + cell[0]] += unit / (width * width);
}

static void measure(const run *r, const lobe_reflection_f64 *model, slopes *s) {
    memset(s, 0, sizeof *s);
    for (int i = 0; i < SIDE; i++) {
        s->at[i] = lobe_axis_middle(x_slope, i, SIDE);
        for (int k = 0; k < 2; k++) s->marginal[k][i] = marginal_density(model, k, s->at[i]);
    }
    for (int i = 0; i < SIDE * SIDE; i++)
        s->density[i] = slope_density(model, s->at[i % SIDE], s->at[i / SIDE]);
    const uint64_t count = lobe_run_samples(r, 100000);
    for (uint64_t k = 0; k < count && !lobe_run_is_over(r, k); k++) {
        double u[3];
        lobe_draw_numbers_f64(r->options->seed, k, u);
        const vec3 m = lobe_reflection_sample_f64(model, u[0], u[1], u[2]).m;
        if (m.z > 0) count_draw(s, (double[2]){-m.x / m.z, -m.y / m.z}, 1 / (double)count);
    }
}

static void keep_rows(run *r, double theta, const slopes *s) {
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < SIDE; i++) {
            const double row[] = {theta, s->at[i], s->marginal[k][i], s->marginal_drawn[k][i]};
            lobe_table_row(&r->table, k ? "y" : "x", 4, row);
        }
}

static void draw_marginal(run *r, const slopes *s, int k, box b, axis x, const char *label) {
    const plot p = lobe_plot_begin(&r->canvas, b, x, (axis){label, 0, 0.65, SCALE_LINEAR}, NULL);
    lobe_plot_line(&p, lobe_pen(&r->canvas, HUE_BLUE, DASH_SOLID), SIDE, s->at, s->marginal[k]);
    lobe_plot_dots(&p, r->canvas.theme->hues[HUE_ORANGE], 1.1, SIDE, s->at, s->marginal_drawn[k]);
}

static void draw_column(run *r, int index, const slopes *s) {
    char title[32];
    const double left = 34 + 118 * index, side = 104;
    double most = 0;
    for (int i = 0; i < SIDE * SIDE; i++) most = fmax(most, s->density[i]);
    snprintf(title, sizeof title, "θ = %.3g°", angles[index]);
    axis x = x_slope, y = y_slope;
    y.label = index ? NULL : "density: slope y";
    x.label = NULL;
    plot p = lobe_plot_begin(&r->canvas, (box){left, 18, side, side}, x, y, title);
    lobe_plot_grid(&p, (grid){SIDE, SIDE, s->density, 0, most, lobe_map_sequential});
    if (!index) y.label = "draws: slope y";
    p = lobe_plot_begin(&r->canvas, (box){left, 18 + side + 8, side, side}, x, y, NULL);
    lobe_plot_grid(&p, (grid){SIDE, SIDE, s->drawn, 0, most, lobe_map_sequential});
    const double top = 18 + 2 * (side + 8);
    draw_marginal(r, s, 0, (box){left, top, side, 62}, x_slope, index ? NULL : "density of x");
    draw_marginal(r, s, 1, (box){left, top + 92, side, 62}, y_slope, index ? NULL : "density of y");
}

lobe_figure_result lobe_figure_visible_slopes(run *r, lobe_ndf ndf) {
    static slopes s;
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = (lobe_model){ndf, LOBE_MASKING_SMITH, LOBE_METHOD_SLOPE};
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 434);
    lobe_table_begin(&r->table, "axis,theta_deg,slope,density,drawn");
    for (int k = 0; k < ANGLES; k++) {
        const view v = lobe_run_view(r, (view){lobe_direction(angles[k], 45), {2, 1}});
        const lobe_reflection_f64 model =
            lobe_reflection_prepare_f64(options, v.wi, v.alpha[0], v.alpha[1]);
        measure(r, &model, &s);
        keep_rows(r, angles[k], &s);
        draw_column(r, k, &s);
        if (!lobe_run_goes_on(r, (k + 1.0) / ANGLES)) return LOBE_FIGURE_INTERRUPTED;
    }
    const canvas *c = &r->canvas;
    const legend_entry entries[] = {
        {"density", lobe_pen(c, HUE_BLUE, DASH_SOLID)},
        {"draws", {c->theme->hues[HUE_ORANGE], DASH_DOTS, 1.8}},
    };
    lobe_legend(&r->canvas, 429, 2, entries);
    return LOBE_FIGURE_OK;
}
