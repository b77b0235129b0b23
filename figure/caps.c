/* Spherical caps (Dupuy & Benyoub 2023, Figs. 4 and 5; Eto & Tokuyoshi 2023, Fig. 3): a hemispherical mirror
 * sends parallel light into a cap; which of its directions leave the surface; the bounded cap. */
#include <math.h>
#include <stdio.h>

#include <lobe/batch.h>

#include "figures.h"
#include "globe.h"
#include "text.h"

enum { RIM = 181, RAYS = 9 };

/* In the plane of incidence: rays along î, the mirror, and the arc that they fill. */
static void draw_mirror(canvas *c, double theta, double x, double y, double radius) {
    const theme *t = c->theme;
    const pen mirror = {t->ink, DASH_SOLID, 1.6}, in = {t->hues[HUE_ORANGE], DASH_SOLID, 0.8},
              out = {t->hues[HUE_BLUE], DASH_SOLID, 0.8};
    for (int k = 0; k < RAYS; k++) {
        /* visible normals lie within 90 degrees of î and above the base; even steps across î */
        const double low = -cos(theta), share = (k + 0.5) / RAYS;
        const double m = theta - asin(low + share * (1 - low)), o = 2 * m - theta;
        const double px = x + radius * sin(m), py = y - radius * cos(m);
        const double far = 1.02 * radius;
        lobe_arrow(c, in, px + far * sin(theta), py - far * cos(theta), px, py);
        lobe_arrow(c, out, px, py, px + 0.55 * radius * sin(o), py - 0.55 * radius * cos(o));
    }
    cairo_new_path(c->cr);
    cairo_arc(c->cr, x, y, radius, FIGURE_PI, 2 * FIGURE_PI);
    lobe_stroke(c, mirror);
    lobe_stroke_line(c, (pen){t->muted, DASH_SOLID, 0.6}, x - radius, y, x + radius, y);
}

static pen method_pen(const canvas *c, lobe_method method) {
    return method == LOBE_METHOD_CAPS ? lobe_pen(c, HUE_GREEN, DASH_LONG)
                                      : lobe_pen(c, HUE_RED, DASH_SOLID);
}

/* Draws that leave the surface, or those that do not. */
static void draw_dots(run *r, const globe *g, view v, lobe_method method, int leaving) {
    canvas *c = &r->canvas;
    const lobe_reflection_f64 model = lobe_ggx_model(v, method);
    const uint64_t wanted = lobe_run_samples(r, 700), count = wanted < 20000 ? wanted : 20000;
    for (uint64_t k = 0; k < count; k++) {
        double u[3];
        lobe_draw_numbers_f64(r->options->seed, k, u);
        const lobe_reflection_draw_f64 d = lobe_reflection_sample_f64(&model, u[0], u[1], u[2]);
        const vec3 o = lobe_stretched_wo(v, d.m);
        if ((d.pdf > 0) != leaving) continue;
        const double row[] = {o.x, o.y, o.z, leaving};
        lobe_table_row(&r->table, lobe_method_name(method), 4, row);
        if (lobe_dot3(o, g->toward) > 0) lobe_add_dot(c, lobe_globe_x(g, o), lobe_globe_y(g, o));
    }
    lobe_stroke_dots(c, c->theme->hues[leaving ? HUE_ORANGE : HUE_BLUE], 0.75);
}

/* A method on the sphere of stretched reflections. */
static void draw_cap(run *r, view v, lobe_method method, double x, double y, double radius) {
    canvas *c = &r->canvas;
    const vec3 i = lobe_stretched_wi(v);
    const globe g =
        lobe_globe(c, x, y, radius, lobe_direction(78, atan2(i.y, i.x) * 180 / FIGURE_PI - 70));
    lobe_globe_outline(&g);
    draw_dots(r, &g, v, method, 1);
    draw_dots(r, &g, v, method, 0);
    const cap k = lobe_cap_of(v, method);
    vec3 rim[RIM];
    for (int j = 0; j < RIM; j++) rim[j] = lobe_cap_rim(k, 2 * j);
    lobe_globe_curve(&g, method_pen(c, method), RIM, rim);
    const vec3 centre = {0, 0, 0}, tip = lobe_mix3(1.2, i, 0, i);
    lobe_globe_arrow(&g, (pen){c->theme->ink, DASH_SOLID, 0.9}, centre, tip);
    lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_LEFT, lobe_globe_x(&g, tip) + 2,
              lobe_globe_y(&g, tip) - 1, "î");
}

lobe_figure_result lobe_figure_caps(run *r) {
    const view v = lobe_run_view(r, (view){lobe_direction(60, 0), {0.5, 0.5}});
    canvas *c = &r->canvas;
    lobe_canvas_begin(c, PAGE_WIDTH, 196);
    lobe_table_begin(&r->table, "method,ox,oy,oz,leaves");
    const legend_entry entries[] = {
        {"previous cap", method_pen(c, LOBE_METHOD_CAPS)},
        {"bounded cap", method_pen(c, LOBE_METHOD_BOUNDED)},
        {"leaves the surface", {c->theme->hues[HUE_ORANGE], DASH_DOTS, 1.8}},
        {"rejected", {c->theme->hues[HUE_BLUE], DASH_DOTS, 1.8}}};
    lobe_legend(c, 11, 4, entries);
    lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, 84, 28, "(a) a mirror fills a cap");
    draw_mirror(c, acos(lobe_stretched_wi(v).z), 72, 138, 50);
    static const lobe_method methods[] = {LOBE_METHOD_CAPS, LOBE_METHOD_BOUNDED};
    for (int k = 0; k < 2; k++) {
        char title[96];
        const double x = 252 + 168 * k;
        const lobe_reflection_f64 model = lobe_ggx_model(v, methods[k]);
        const double rejected = 1 - lobe_reflection_acceptance_f64(&model);
        draw_cap(r, v, methods[k], x, 116, 66);
        snprintf(title, sizeof title, "(%c) %s: %.1f %% rejected", 'b' + k,
                 lobe_method_name(methods[k]), 100 * rejected);
        lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, x, 28, title);
    }
    return LOBE_FIGURE_OK;
}
