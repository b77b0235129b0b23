/* The stretched space (after Dupuy & Benyoub 2023, and Eto & Tokuyoshi 2023, Fig. 3): where stretched
 * reflections lie that leave the surface, what each cap adds, and the draws of horizon sampling; once on
 * the sphere of reflections, once as normals seen along the stretched direction. */
#include <math.h>
#include <stdio.h>

#include <lobe/batch.h>

#include "figures.h"
#include "globe.h"
#include "plot.h"

enum { STEPS = 721, CURVES = 4, DOTS = 20000 };

static const char *const names[CURVES] = {"horizon", "previous cap", "bounded cap", "optimal cap"};

typedef struct rims {
    vec3 o[CURVES][STEPS];
} rims;

static void find_rims(view v, rims *c) {
    const cap caps[] = {lobe_cap_of(v, LOBE_METHOD_CAPS), lobe_cap_of(v, LOBE_METHOD_BOUNDED),
                        lobe_cap_of(v, LOBE_METHOD_OPTIMAL)};
    for (int i = 0; i < STEPS; i++) {
        c->o[0][i] = lobe_grazing_wo(v, 0.5 * i);
        for (int k = 1; k < CURVES; k++) c->o[k][i] = lobe_cap_rim(caps[k - 1], 0.5 * i);
    }
}

static pen pen_of(const run *r, int curve) {
    static const hue hues[] = {HUE_ORANGE, HUE_GREEN, HUE_RED, HUE_BLUE};
    static const dash dashes[] = {DASH_SOLID, DASH_LONG, DASH_SOLID, DASH_MIXED};
    return lobe_pen(&r->canvas, hues[curve], dashes[curve]);
}

/* The stretched normal of a reflection, seen along the stretched direction. */
static void on_disk(view v, vec3 o, double at[2]) {
    const vec3 i = lobe_stretched_wi(v), m = lobe_half(i, o);
    vec3 t1, t2;
    lobe_frame_across(i, &t1, &t2);
    at[0] = lobe_dot3(m, t1);
    at[1] = lobe_dot3(m, t2);
}

/* The stretched reflection of the k-th draw. */
static vec3 horizon_draw(const run *r, view v, uint64_t k) {
    const lobe_reflection_f64 model = lobe_ggx_model(v, LOBE_METHOD_HORIZON_UNIFORM);
    double u[3];
    lobe_draw_numbers_f64(r->options->seed, k, u);
    return lobe_stretched_wo(v, lobe_reflection_sample_f64(&model, u[0], u[1], u[2]).m);
}

static void draw_sphere(run *r, view v, const rims *c, uint64_t draws, box b) {
    const vec3 i = lobe_stretched_wi(v);
    const double azimuth = atan2(i.y, i.x) * 180 / FIGURE_PI;
    const globe g = lobe_globe(&r->canvas, b.x + 0.5 * b.width, b.y + 0.5 * b.height, 0.5 * b.width,
                               lobe_direction(70, azimuth - 65));
    lobe_globe_outline(&g);
    for (uint64_t k = 0; k < draws; k++) {
        const vec3 o = horizon_draw(r, v, k);
        if (lobe_dot3(o, g.toward) > 0)
            lobe_add_dot(&r->canvas, lobe_globe_x(&g, o), lobe_globe_y(&g, o));
    }
    lobe_stroke_dots(&r->canvas, r->canvas.theme->hues[HUE_ORANGE], 0.7);
    for (int k = 0; k < CURVES; k++) lobe_globe_curve(&g, pen_of(r, k), STEPS, c->o[k]);
    const pen ink = {r->canvas.theme->ink, DASH_SOLID, 0.9};
    const vec3 centre = {0, 0, 0}, normal = {0, 0, 1.12}, tip = lobe_mix3(1.12, i, 0, i);
    lobe_globe_arrow(&g, ink, centre, normal);
    lobe_globe_arrow(&g, ink, centre, tip);
    lobe_text(&r->canvas, ink.colour, TEXT_SIZE, ALIGN_CENTRE, lobe_globe_x(&g, normal) + 5,
              lobe_globe_y(&g, normal) - 1, "z");
    lobe_text(&r->canvas, ink.colour, TEXT_SIZE, ALIGN_CENTRE, lobe_globe_x(&g, tip) + 6,
              lobe_globe_y(&g, tip) + 2, "î");
}

static void draw_disk(run *r, view v, const rims *c, uint64_t draws, box b) {
    const plot p = lobe_plot_begin(
        &r->canvas, b, (axis){"across î, horizontal", -1, 1, SCALE_LINEAR},
        (axis){"across î, upward", -1, 1, SCALE_LINEAR}, "stretched normals m, seen along î");
    for (uint64_t k = 0; k < draws; k++) {
        double at[2];
        on_disk(v, horizon_draw(r, v, k), at);
        lobe_add_dot(&r->canvas, lobe_plot_x(&p, at[0]), lobe_plot_y(&p, at[1]));
    }
    lobe_stroke_dots(&r->canvas, r->canvas.theme->hues[HUE_ORANGE], 0.7);
    double circle[2][STEPS];
    for (int i = 0; i < STEPS; i++) {
        circle[0][i] = cos(0.5 * i * FIGURE_PI / 180);
        circle[1][i] = sin(0.5 * i * FIGURE_PI / 180);
    }
    lobe_plot_line(&p, (pen){r->canvas.theme->muted, DASH_SOLID, 0.6}, STEPS, circle[0], circle[1]);
    for (int k = 0; k < CURVES; k++) {
        double x[STEPS], y[STEPS];
        for (int i = 0; i < STEPS; i++) {
            double at[2];
            on_disk(v, c->o[k][i], at);
            /* the rim of the previous cap passes the point opposite to î: a half circle of normals */
            x[i] = k == 1 && lobe_dot3(c->o[k][i], lobe_stretched_wi(v)) < -0.9999 ? NAN : at[0];
            y[i] = at[1];
            const double row[] = {0.5 * i, c->o[k][i].x, c->o[k][i].y, c->o[k][i].z, at[0], at[1]};
            lobe_table_row(&r->table, names[k], 6, row);
        }
        lobe_plot_line(&p, pen_of(r, k), STEPS, x, y);
    }
    lobe_plot_line(&p, pen_of(r, 1), STEPS / 2 + 1, circle[0], circle[1]);
}

lobe_figure_result lobe_figure_stretched(run *r) {
    const view v = lobe_run_view(r, (view){lobe_direction(40, 45), {0.2, 0.8}});
    const uint64_t draws = lobe_run_samples(r, 300) < DOTS ? lobe_run_samples(r, 300) : DOTS;
    rims c;
    char title[128];
    find_rims(v, &c);
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 246);
    lobe_table_begin(&r->table, "curve,phi_deg,ox,oy,oz,across,upward");
    legend_entry entries[CURVES + 1];
    for (int k = 0; k < CURVES; k++) entries[k] = (legend_entry){names[k], pen_of(r, k)};
    entries[0].name = "reflections in the horizon";
    entries[CURVES] = (legend_entry){"draws of horizon sampling",
                                     {r->canvas.theme->hues[HUE_ORANGE], DASH_DOTS, 1.6}};
    lobe_legend(&r->canvas, 11, CURVES + 1, entries);
    snprintf(title, sizeof title, "stretched reflections ô    α = %.3g, %.3g", v.alpha[0],
             v.alpha[1]);
    lobe_text(&r->canvas, r->canvas.theme->ink, TEXT_SIZE, ALIGN_CENTRE, 122, 28, title);
    draw_sphere(r, v, &c, draws, (box){30, 46, 184, 184});
    draw_disk(r, v, &c, draws, (box){300, 32, 184, 184});
    return LOBE_FIGURE_OK;
}
