#include "globe.h"

#include <math.h>

globe lobe_globe(canvas *c, double x, double y, double radius, vec3 toward) {
    globe g = {.c = c, .x = x, .y = y, .radius = radius, .toward = lobe_unit3(toward)};
    lobe_frame_across(g.toward, &g.right, &g.up);
    return g;
}

double lobe_globe_x(const globe *g, vec3 p) {
    return g->x + g->radius * lobe_dot3(p, g->right);
}

double lobe_globe_y(const globe *g, vec3 p) {
    return g->y - g->radius * lobe_dot3(p, g->up);
}

/* Mixed with the paper: opacity would show where strokes overlap. */
static colour faded(const globe *g, colour k) {
    const colour p = g->c->theme->paper;
    return (colour){0.35 * k.r + 0.65 * p.r, 0.35 * k.g + 0.65 * p.g, 0.35 * k.b + 0.65 * p.b};
}

static void stroke_side(const globe *g, pen pen, int front, int count, const vec3 *points) {
    cairo_new_path(g->c->cr);
    for (int i = 0; i + 1 < count; i++) {
        const vec3 a = points[i], b = points[i + 1];
        if ((lobe_dot3(lobe_mix3(0.5, a, 0.5, b), g->toward) >= 0) != front) continue;
        const double ax = lobe_globe_x(g, a), ay = lobe_globe_y(g, a);
        double x, y;
        cairo_get_current_point(g->c->cr, &x, &y);
        if (!cairo_has_current_point(g->c->cr) || hypot(x - ax, y - ay) > 0.05)
            cairo_move_to(g->c->cr, ax, ay);
        cairo_line_to(g->c->cr, lobe_globe_x(g, b), lobe_globe_y(g, b));
    }
    lobe_stroke(g->c, pen);
}

void lobe_globe_curve(const globe *g, pen p, int count, const vec3 *points) {
    const pen back = {faded(g, p.colour), p.dash, 0.8 * p.width};
    stroke_side(g, back, 0, count, points);
    stroke_side(g, p, 1, count, points);
}

void lobe_globe_outline(const globe *g) {
    const pen thin = {g->c->theme->muted, DASH_SOLID, 0.6};
    cairo_new_path(g->c->cr);
    cairo_arc(g->c->cr, g->x, g->y, g->radius, 0, 2 * FIGURE_PI);
    lobe_stroke(g->c, thin);
    vec3 equator[73];
    for (int i = 0; i < 73; i++) equator[i] = lobe_direction(90, 5 * i);
    lobe_globe_curve(g, thin, 73, equator);
}

void lobe_globe_arrow(const globe *g, pen pen, vec3 from, vec3 to) {
    lobe_arrow(g->c, pen, lobe_globe_x(g, from), lobe_globe_y(g, from), lobe_globe_x(g, to),
               lobe_globe_y(g, to));
}
