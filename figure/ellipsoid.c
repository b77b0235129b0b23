/* Sampling the projected ellipsoid (Heitz 2018, Figs. 2-5): the ellipsoid whose normals are distributed as
 * GGX, the hemisphere that it becomes, and the unit square of random numbers on its projection. */
#include <math.h>
#include <stdio.h>

#include "figures.h"
#include "plot.h"

enum { STEPS = 181, LINES = 8 };

/* A picture of the plane of incidence. */
typedef struct section {
    canvas *c;
    double x, y, unit; /* origin, and points for 1 */
} section;

/* The upper half of an ellipse of height 1; what faces direction (ix, iz) is green and thick. */
static void draw_half_ellipse(const section *s, double half_width, double ix, double iz) {
    double x[STEPS], z[STEPS];
    int faces[STEPS];
    for (int i = 0; i < STEPS; i++) {
        const double t = i * FIGURE_PI / 180;
        x[i] = half_width * cos(t);
        z[i] = sin(t);
        faces[i] = x[i] / (half_width * half_width) * ix + z[i] * iz > 0;
    }
    const theme *t = s->c->theme;
    for (int kind = 0; kind < 2; kind++) {
        for (int i = 0; i + 1 < STEPS; i++) {
            if (faces[i] != kind) continue;
            cairo_move_to(s->c->cr, s->x + s->unit * x[i], s->y - s->unit * z[i]);
            cairo_line_to(s->c->cr, s->x + s->unit * x[i + 1], s->y - s->unit * z[i + 1]);
        }
        lobe_stroke(s->c, kind ? (pen){t->hues[HUE_GREEN], DASH_SOLID, 2}
                               : (pen){t->muted, DASH_SOLID, 1});
    }
    lobe_stroke_line(s->c, (pen){t->muted, DASH_SOLID, 0.6}, s->x - s->unit * half_width, s->y,
                     s->x + s->unit * half_width, s->y);
}

/* Normals at even steps of the stretched angle: longer outward than the surface. */
static void draw_normals(const section *s, double half_width) {
    const pen thin = {s->c->theme->muted, DASH_SOLID, 0.7};
    for (int i = 1; i < 12; i++) {
        const double t = i * FIGURE_PI / 12, x = half_width * cos(t), z = sin(t);
        const double nx = x / (half_width * half_width), length = hypot(nx, z);
        lobe_arrow(s->c, thin, s->x + s->unit * x, s->y - s->unit * z,
                   s->x + s->unit * x + 11 * nx / length, s->y - s->unit * z - 11 * z / length);
    }
}

static void draw_direction(const section *s, double x, double z, const char *name) {
    const double far = 82;
    lobe_arrow(s->c, lobe_pen(s->c, HUE_ORANGE, DASH_SOLID), s->x, s->y, s->x + far * x,
               s->y - far * z);
    lobe_text(s->c, s->c->theme->ink, TEXT_SIZE, ALIGN_LEFT, s->x + far * x + 3, s->y - far * z + 2,
              name);
}

/* The segment across î that the visible half circle is projected to: from its highest point, as seen along
 * î, down to the end of the base. */
static void draw_projection(const section *s, double x, double z) {
    const pen blue = lobe_pen(s->c, HUE_BLUE, DASH_SOLID);
    const double low_x = s->x + s->unit * z * z, low_y = s->y + s->unit * x * z;
    lobe_stroke_line(s->c, (pen){blue.colour, DASH_SOLID, 2}, low_x, low_y, s->x - s->unit * z,
                     s->y - s->unit * x);
    lobe_stroke_line(s->c, (pen){blue.colour, DASH_DOTS, 1}, s->x + s->unit, s->y, low_x, low_y);
}

static void point_on_disk(view v, const lobe_reflection_f64 *model, double u1, double u2,
                          double at[2]) {
    vec3 t1, t2;
    const vec3 m = lobe_stretched_m(v, lobe_reflection_sample_f64(model, u1, u2, 0.5).m);
    lobe_frame_across(lobe_stretched_wi(v), &t1, &t2);
    at[0] = lobe_dot3(m, t1);
    at[1] = lobe_dot3(m, t2);
}

/* One line of the unit square: of u1, or of u2. */
static void draw_square_line(run *r, const plot *p, view v, int which, int index) {
    const lobe_reflection_f64 model = lobe_ggx_model(v, LOBE_METHOD_ELLIPSOID);
    double x[STEPS], y[STEPS];
    const double fixed = fmin((index + (which ? 0.0 : 1.0)) / LINES, 1 - 1e-9);
    for (int i = 0; i < STEPS; i++) {
        const double moving = fmin((double)i / (STEPS - 1), 1 - 1e-9);
        const double u1 = which ? moving : fixed, u2 = which ? fixed : moving;
        double at[2];
        point_on_disk(v, &model, u1, u2, at);
        x[i] = at[0];
        y[i] = at[1];
        const double row[] = {u1, u2, x[i], y[i]};
        lobe_table_row(&r->table, which ? "u2" : "u1", 4, row);
    }
    lobe_plot_line(p, (pen){r->canvas.theme->hues[which ? HUE_PURPLE : HUE_BLUE], DASH_SOLID, 0.9},
                   STEPS, x, y);
}

lobe_figure_result lobe_figure_ellipsoid(run *r) {
    view v = lobe_run_view(r, (view){lobe_direction(65, 0), {0.5, 0.5}});
    canvas *c = &r->canvas;
    char title[96];
    lobe_canvas_begin(c, PAGE_WIDTH, 180);
    lobe_table_begin(&r->table, "line,u1,u2,across,upward");
    const double theta = acos(v.wi.z), half_width = 1 / v.alpha[0];
    const double stretched = atan2(v.alpha[0] * sin(theta), cos(theta));

    const section flat = {c, 92, 118, fmin(38, 76 / half_width)};
    draw_half_ellipse(&flat, half_width, sin(theta), cos(theta));
    draw_normals(&flat, half_width);
    draw_direction(&flat, sin(theta), cos(theta), "i");
    snprintf(title, sizeof title, "(a) ellipsoid, α = %.3g", v.alpha[0]);
    lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, flat.x, 18, title);

    const section round = {c, 250, 110, 50};
    draw_half_ellipse(&round, 1, sin(stretched), cos(stretched));
    draw_projection(&round, sin(stretched), cos(stretched));
    draw_direction(&round, sin(stretched), cos(stretched), "î");
    lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, round.x, 18, "(b) stretched: hemisphere");
    lobe_text(c, c->theme->hues[HUE_GREEN], SMALL_SIZE, ALIGN_CENTRE, 92, 146, "visible normals");
    lobe_text(c, c->theme->hues[HUE_BLUE], SMALL_SIZE, ALIGN_CENTRE, 250, 168,
              "their projected area");

    v.wi = lobe_direction(theta * 180 / FIGURE_PI, 0);
    const plot p = lobe_plot_begin(c, (box){356, 22, 132, 132}, (axis){"t_1", -1, 1, SCALE_LINEAR},
                                   (axis){"t_2", -1, 1, SCALE_LINEAR}, "(c) random numbers on it");
    for (int k = 0; k < LINES; k++) {
        draw_square_line(r, &p, v, 1, k);
        draw_square_line(r, &p, v, 0, k);
    }
    return LOBE_FIGURE_OK;
}
