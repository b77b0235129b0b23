#include "sweep.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <lobe/batch.h>

#include "ticks.h"

enum { METHODS = 5, SIDE = 40, ANGLES = 59 };

static const lobe_method methods[METHODS] = {LOBE_METHOD_NDF, LOBE_METHOD_CAPS, LOBE_METHOD_BOUNDED,
                                             LOBE_METHOD_OPTIMAL, LOBE_METHOD_HORIZON};

void lobe_sweep_numbers(uint64_t index, uint64_t samples, double u[3]) {
    const uint64_t side = (uint64_t)ceil(sqrt((double)samples) - 1e-9);
    lobe_draw_numbers_f64(1, index, u);
    u[0] = ((double)(index % side) + 0.5) / (double)side;
    u[1] = ((double)(index / side % side) + 0.5) / (double)side;
}

static double measure(run *r, const sweep *s, view v, lobe_method method, uint64_t samples) {
    const lobe_reflection_f64 model = lobe_ggx_model(v, method);
    const double number = s->measure(r, &model, lobe_run_samples(r, samples));
    char label[64];
    snprintf(label, sizeof label, "%s", lobe_method_name(method));
    const double row[] = {acos(v.wi.z) * 180 / FIGURE_PI, atan2(v.wi.y, v.wi.x) * 180 / FIGURE_PI,
                          v.alpha[0], v.alpha[1], number};
    lobe_table_row(&r->table, label, 5, row);
    return number;
}

/* Colours follow the axis: logarithms where it is logarithmic. */
static int draw_map(run *r, const sweep *s, vec3 wi, int k, box b) {
    static double shares[SIDE * SIDE];
    const axis x = {"α_x", 0, 1, SCALE_LINEAR};
    axis y = x;
    y.label = k == 0 ? "α_y" : NULL;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const view v = {wi,
                        {lobe_axis_middle(x, i % SIDE, SIDE), lobe_axis_middle(x, i / SIDE, SIDE)}};
        shares[i] = lobe_axis_share(s->axis, measure(r, s, v, methods[k], s->samples));
        if (i % SIDE == 0 && !lobe_run_goes_on(r, 0.8 * (k + (double)i / (SIDE * SIDE)) / s->maps))
            return 0;
    }
    const plot p = lobe_plot_begin(&r->canvas, b, x, y, lobe_method_name(methods[k]));
    lobe_plot_grid(&p, (grid){SIDE, SIDE, shares, 0, 1, lobe_map_sequential});
    return 1;
}

static pen pen_of(const run *r, int method) {
    static const hue hues[METHODS] = {HUE_PURPLE, HUE_GREEN, HUE_RED, HUE_BLUE, HUE_ORANGE};
    static const dash dashes[METHODS] = {DASH_DOTS, DASH_LONG, DASH_SOLID, DASH_MIXED, DASH_SOLID};
    return lobe_pen(&r->canvas, hues[method], dashes[method]);
}

static int draw_curves(run *r, const sweep *s, view v, box b) {
    char title[96];
    const double phi = atan2(v.wi.y, v.wi.x) * 180 / FIGURE_PI;
    snprintf(title, sizeof title, "α = %.3g, %.3g    φ = %.3g°", v.alpha[0], v.alpha[1], phi);
    axis y = s->axis;
    y.label = s->label;
    const plot p = lobe_plot_begin(
        &r->canvas, b, (axis){"angle of incidence θ (degrees)", 0, 90, SCALE_DEGREES}, y, title);
    for (int k = 0; k < METHODS; k++) {
        double theta[ANGLES], number[ANGLES];
        for (int i = 0; i < ANGLES; i++) {
            theta[i] = fmax(0.5, 1.5 * i);
            v.wi = lobe_direction(theta[i], phi);
            number[i] = measure(r, s, v, methods[k], 9 * s->samples);
        }
        lobe_plot_line(&p, pen_of(r, k), ANGLES, theta, number);
        if (!lobe_run_goes_on(r, 0.8 + 0.04 * k)) return 0;
    }
    return 1;
}

lobe_figure_result lobe_figure_sweep(run *r, sweep s) {
    const vec3 wi = lobe_run_view(r, (view){lobe_direction(40, 45), {1, 1}}).wi;
    char columns[96], title[96];
    snprintf(columns, sizeof columns, "method,theta_deg,phi_deg,alpha_x,alpha_y,%s", s.column);
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 312);
    lobe_table_begin(&r->table, columns);

    const double pitch = 430.0 / s.maps, side = pitch - 18;
    snprintf(title, sizeof title, "%s    θ = %.3g°, φ = %.3g°", s.label,
             acos(wi.z) * 180 / FIGURE_PI, atan2(wi.y, wi.x) * 180 / FIGURE_PI);
    lobe_text(&r->canvas, r->canvas.theme->ink, TEXT_SIZE, ALIGN_LEFT, 32, 11, title);
    for (int k = 0; k < s.maps; k++)
        if (!draw_map(r, &s, wi, k, (box){32 + pitch * k, 28, side, side}))
            return LOBE_FIGURE_INTERRUPTED;
    axis bar = s.axis;
    bar.label = ""; /* the heading names it */
    lobe_colour_bar(&r->canvas, (box){32 + 430, 28, 8, side}, lobe_map_sequential, bar);

    legend_entry entries[METHODS];
    for (int k = 0; k < METHODS; k++)
        entries[k] = (legend_entry){lobe_method_name(methods[k]), pen_of(r, k)};
    const double top = lobe_legend(&r->canvas, 28 + side + 40, METHODS, entries) + 20;
    static const double own[2][2] = {{0.7, 0.7}, {0.2, 0.8}};
    const int panels = r->options->alpha[0] > 0 ? 1 : 2;
    for (int k = 0; k < panels; k++) {
        const view v = lobe_run_view(r, (view){wi, {own[k][0], own[k][1]}});
        if (!draw_curves(r, &s, v, (box){32 + 250 * k, top, 206, 312 - 24 - top}))
            return LOBE_FIGURE_INTERRUPTED;
    }
    return LOBE_FIGURE_OK;
}
