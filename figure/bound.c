/* The reflection bound over longitude (Eto & Tokuyoshi 2023, supplement, Fig. 1): how far below the
 * horizon of the stretched space reflections that leave the surface reach, and what two caps assume. */
#include <math.h>
#include <stdio.h>

#include "figures.h"
#include "plot.h"

enum { STEPS = 361, CURVES = 4 };

/* The sets of the paper. */
static const double sets[][4] = {
    {0.7, 0.4, 0.3, 0}, {0.7, 0.8, 0.3, 0.6}, {1.5, 0.2, -0.2, 0.8}, {1.6, 1.3, -0.2, 0.3}};

static view set_view(int k) {
    const double *s = sets[k];
    return (view){{s[2], s[3], sqrt(1 - s[2] * s[2] - s[3] * s[3])}, {s[0], s[1]}};
}

/* The lowest z of a cap at the azimuth of `o`: its rim there, where it does not hold the whole arc. */
static double rim_below(cap k, vec3 o) {
    const double across = hypot(o.x, o.y);
    const double along = (k.axis.x * o.x + k.axis.y * o.y) / fmax(across, 1e-300);
    const double reach = hypot(along, k.axis.z), tilt = atan2(along, k.axis.z);
    if (reach <= fabs(k.height)) return k.height < 0 ? -1 : NAN;
    const double theta = tilt + acos(k.height / reach);
    return theta >= FIGURE_PI ? -1 : cos(theta);
}

typedef struct curves {
    double phi[STEPS], z[CURVES][STEPS]; /* projected, previous, bounded, optimal */
} curves;

static void find_curves(view v, curves *c) {
    const cap caps = lobe_cap_of(v, LOBE_METHOD_CAPS),
              bounded = lobe_cap_of(v, LOBE_METHOD_BOUNDED),
              optimal = lobe_cap_of(v, LOBE_METHOD_OPTIMAL);
    for (int i = 0; i < STEPS; i++) {
        const vec3 o = lobe_grazing_wo(v, i);
        c->phi[i] = i;
        c->z[0][i] = o.z;
        c->z[1][i] = caps.height;
        c->z[2][i] = bounded.height;
        c->z[3][i] = rim_below(optimal, o);
    }
}

static pen pen_of(const run *r, int curve) {
    static const hue hues[] = {HUE_ORANGE, HUE_GREEN, HUE_RED, HUE_BLUE};
    static const dash dashes[] = {DASH_SOLID, DASH_LONG, DASH_SOLID, DASH_MIXED};
    return lobe_pen(&r->canvas, hues[curve], dashes[curve]);
}

static void draw_panel(run *r, int index, int is_sheet, view v, box b) {
    char title[128], letter[8] = "";
    if (is_sheet) snprintf(letter, sizeof letter, "(%c)  ", 'a' + index);
    snprintf(title, sizeof title, "%sα = %.3g, %.3g    i_x, i_y = %.3g, %.3g", letter, v.alpha[0],
             v.alpha[1], v.wi.x, v.wi.y);
    curves c;
    find_curves(v, &c);
    const plot p = lobe_plot_begin(
        &r->canvas, b, (axis){"longitude φ of the reflection (degrees)", 0, 360, SCALE_DEGREES},
        (axis){"cap height ô_z", -1, 1, SCALE_LINEAR}, title);
    const int curves_shown = r->options->optimal ? CURVES : CURVES - 1;
    for (int k = curves_shown - 1; k >= 0; k--)
        lobe_plot_line(&p, pen_of(r, k), STEPS, c.phi, c.z[k]);
    for (int i = 0; i < STEPS; i++) {
        const double row[] = {v.alpha[0], v.alpha[1], v.wi.x,    v.wi.y,   c.phi[i],
                              c.z[0][i],  c.z[1][i],  c.z[2][i], c.z[3][i]};
        lobe_table_row(&r->table, NULL, 9, row);
    }
}

lobe_figure_result lobe_figure_bound(run *r) {
    const int is_sheet = r->options->alpha[0] == 0 && r->options->wi.z == 0;
    const int panels = is_sheet ? 4 : 1;
    const double width = is_sheet ? PAGE_WIDTH : COLUMN_WIDTH;
    lobe_canvas_begin(&r->canvas, width, is_sheet ? 318 : 180);
    lobe_table_begin(&r->table, "alpha_x,alpha_y,ix,iy,phi_deg,projected,previous,bounded,optimal");
    static const char *const names[] = {"projected bound", "previous cap", "bounded cap",
                                        "optimal cap"};
    legend_entry entries[CURVES];
    for (int k = 0; k < CURVES; k++) entries[k] = (legend_entry){names[k], pen_of(r, k)};
    const double top =
        lobe_legend(&r->canvas, 11, r->options->optimal ? CURVES : CURVES - 1, entries) + 19;
    for (int k = 0; k < panels; k++)
        draw_panel(r, k, is_sheet, lobe_run_view(r, set_view(k)),
                   (box){34 + 252 * (k % 2), top + 150 * (k / 2), COLUMN_WIDTH - 44, 112});
    return LOBE_FIGURE_OK;
}
