#include "plot.h"

#include <math.h>

#include "pixels.h"
#include "ticks.h"

double lobe_plot_x(const plot *p, double x) {
    return p->box.x + p->box.width * lobe_axis_share(p->x, x);
}

double lobe_plot_y(const plot *p, double y) {
    return p->box.y + p->box.height * (1 - lobe_axis_share(p->y, y));
}

double lobe_axis_middle(axis a, int k, int count) {
    return lobe_axis_value(a, (k + 0.5) / count);
}

enum { TICK = 2, X_SPACING = 26, Y_SPACING = 15 };

static pen thin(colour k) {
    return (pen){k, DASH_SOLID, 0.5};
}

static void frame(canvas *c, box b) {
    cairo_rectangle(c->cr, b.x, b.y, b.width, b.height);
    lobe_stroke(c, thin(c->theme->muted));
}

/* Numbers below, and the axis' name; `grid` lines across. */
static void x_axis(canvas *c, box b, axis a, int grid) {
    const ticks t = lobe_ticks_of(a, b.width, X_SPACING);
    const double bottom = b.y + b.height;
    for (int i = 0; i < t.count; i++) {
        const double x = b.x + b.width * lobe_axis_share(a, t.at[i]);
        if (grid) lobe_stroke_line(c, thin(c->theme->grid), x, b.y, x, bottom);
        if (!a.label) continue;
        lobe_stroke_line(c, thin(c->theme->muted), x, bottom, x, bottom + TICK);
        lobe_text(c, c->theme->ink, SMALL_SIZE, ALIGN_CENTRE, x, bottom + 9, t.text[i]);
    }
    if (a.label)
        lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, b.x + 0.5 * b.width, bottom + 19,
                  a.label);
}

/* Numbers on the left, or on the right for a colour bar. */
static void y_axis(canvas *c, box b, axis a, int grid, int right) {
    const ticks t = lobe_ticks_of(a, b.height, Y_SPACING);
    const double edge = right ? b.x + b.width : b.x, side = right ? 1 : -1;
    double widest = 0;
    for (int i = 0; i < t.count; i++) {
        const double y = b.y + b.height * (1 - lobe_axis_share(a, t.at[i]));
        if (grid) lobe_stroke_line(c, thin(c->theme->grid), b.x, y, b.x + b.width, y);
        if (!a.label) continue;
        lobe_stroke_line(c, thin(c->theme->muted), edge, y, edge + side * TICK, y);
        lobe_text(c, c->theme->ink, SMALL_SIZE, right ? ALIGN_LEFT : ALIGN_RIGHT, edge + side * 3.5,
                  y + 2.3, t.text[i]);
        widest = fmax(widest, lobe_text_width(c, SMALL_SIZE, t.text[i]));
    }
    if (a.label)
        lobe_text_upward(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE,
                         edge + side * (widest + 9) + (right ? 5 : 0), b.y + 0.5 * b.height,
                         a.label);
}

plot lobe_plot_begin(canvas *c, box b, axis x, axis y, const char *title) {
    const plot p = {c, b, x, y};
    x_axis(c, b, x, 1);
    y_axis(c, b, y, 1, 0);
    frame(c, b);
    if (title)
        lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, b.x + 0.5 * b.width, b.y - 4, title);
    return p;
}

static void clip(const plot *p) {
    cairo_save(p->c->cr);
    cairo_rectangle(p->c->cr, p->box.x, p->box.y, p->box.width, p->box.height);
    cairo_clip(p->c->cr);
}

/* A path far outside the frame would overflow cairo's fixed point. */
static double near_frame(double at, double low, double length) {
    return fmin(fmax(at, low - 2 * length), low + 3 * length);
}

/* Whether the middle of three points may be left out: the line passes it by less than anyone sees. */
static int is_straight(const double a[2], const double b[2], const double c[2]) {
    const double dx = c[0] - a[0], dy = c[1] - a[1], length = hypot(dx, dy);
    const double along = (b[0] - a[0]) * dx + (b[1] - a[1]) * dy;
    const double across = fabs((b[0] - a[0]) * dy - (b[1] - a[1]) * dx);
    return length < 5 && along >= 0 && along <= length * length && across <= 0.01 * length;
}

static void find_point(const plot *p, double x, double y, double at[2]) {
    at[0] = near_frame(lobe_plot_x(p, x), p->box.x, p->box.width);
    at[1] = near_frame(lobe_plot_y(p, y), p->box.y, p->box.height);
    if (isnan(x) || isnan(y)) at[0] = NAN;
}

/* NaN breaks the line. */
static void add_path(const plot *p, int count, const double *x, const double *y) {
    double last[2] = {NAN, NAN};
    for (int i = 0; i < count; i++) {
        double at[2], next[2] = {NAN, NAN};
        find_point(p, x[i], y[i], at);
        if (i + 1 < count) find_point(p, x[i + 1], y[i + 1], next);
        if (isnan(at[0]))
            cairo_new_sub_path(p->c->cr);
        else if (isnan(last[0]))
            cairo_move_to(p->c->cr, at[0], at[1]);
        else if (isnan(next[0]) || !is_straight(last, at, next))
            cairo_line_to(p->c->cr, at[0], at[1]);
        else
            continue;
        last[0] = at[0];
        last[1] = at[1];
    }
}

void lobe_plot_line(const plot *p, pen pen, int count, const double *x, const double *y) {
    clip(p);
    add_path(p, count, x, y);
    lobe_stroke(p->c, pen);
    cairo_restore(p->c->cr);
}

void lobe_plot_fill(const plot *p, colour k, double opacity, int count, const double *x,
                    const double *y) {
    clip(p);
    add_path(p, count, x, y);
    lobe_set_colour(p->c, k, opacity);
    cairo_fill(p->c->cr);
    cairo_restore(p->c->cr);
}

void lobe_plot_dots(const plot *p, colour k, double radius, int count, const double *x,
                    const double *y) {
    for (int i = 0; i < count; i++)
        if (x[i] >= p->x.low && x[i] <= p->x.high && y[i] >= p->y.low && y[i] <= p->y.high)
            lobe_add_dot(p->c, lobe_plot_x(p, x[i]), lobe_plot_y(p, y[i]));
    lobe_stroke_dots(p->c, k, radius);
}

typedef struct cells {
    grid grid;
    colour paper;
} cells;

static colour cell_colour(const void *user, int column, int row) {
    const cells *k = user;
    const grid *g = &k->grid;
    const double value = g->values[(g->rows - 1 - row) * g->columns + column];
    return isnan(value) ? k->paper : g->map((value - g->low) / (g->high - g->low));
}

static void paint_cells(canvas *c, box b, grid g) {
    const cells k = {g, c->theme->paper};
    lobe_paint_pixels(c, b, g.columns, g.rows, cell_colour, &k);
}

void lobe_plot_grid(const plot *p, grid g) {
    paint_cells(p->c, p->box, g);
    frame(p->c, p->box);
}

void lobe_colour_bar(canvas *c, box b, colour_map *map, axis a) {
    enum { CELLS = 128 };
    double values[CELLS];
    for (int i = 0; i < CELLS; i++) values[i] = (i + 0.5) / CELLS;
    const int upright = b.height > b.width;
    paint_cells(c, b, (grid){upright ? 1 : CELLS, upright ? CELLS : 1, values, 0, 1, map});
    frame(c, b);
    if (upright)
        y_axis(c, b, a, 0, 1);
    else
        x_axis(c, b, a, 0);
}
