/* The five ways in which a V-cavity is seen (Tokuyoshi 2021, supplement, Fig. 1). How much of a facet is
 * visible is the library's masking; where it lies follows from the picture. */
#include <math.h>
#include <stdio.h>

#include "figures.h"
#include "text.h"

enum { PANELS = 5, GROOVES = 3 };

static const double angles[PANELS] = {20, 65, 100, 125, 150}; /* of i to the normal, degrees */
static const double tilt = 50;                                /* of the facets, degrees */

typedef struct visibility {
    double toward, away; /* of the facet tilted toward i, and of the other */
    double hit;
} visibility;

static visibility find_visibility(double theta) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = (lobe_model){LOBE_NDF_GGX, LOBE_MASKING_VCAVITY, LOBE_METHOD_VCAVITY};
    const vec3 wi = lobe_direction(theta, 0);
    const lobe_reflection_f64 exact = lobe_reflection_prepare_f64(options, wi, 1, 1);
    options.normalization = LOBE_NORMALIZATION_PREVIOUS;
    const lobe_reflection_f64 previous = lobe_reflection_prepare_f64(options, wi, 1, 1);
    visibility v = {.hit = lobe_reflection_vndf_integral_f64(&previous)};
    /* g1_i is the masking over the hit probability */
    v.toward = v.hit * lobe_reflection_eval_m_f64(&exact, lobe_direction(tilt, 0)).g1_i;
    v.away = v.hit * lobe_reflection_eval_m_f64(&exact, lobe_direction(-tilt, 0)).g1_i;
    return v;
}

/* A facet from its peak to its valley; the visible share from the peak, or from the valley. */
static void draw_facet(canvas *c, double peak_x, double valley_x, double top, double depth,
                       double visible, int from_valley) {
    const pen hidden = {c->theme->muted, DASH_SOLID, 1},
              seen = {c->theme->hues[HUE_GREEN], DASH_SOLID, 2.4};
    lobe_stroke_line(c, hidden, peak_x, top, valley_x, top + depth);
    if (!(visible > 0)) return;
    const double begin = from_valley ? 1 - visible : 0, end = from_valley ? 1 : visible;
    lobe_stroke_line(c, seen, peak_x + begin * (valley_x - peak_x), top + begin * depth,
                     peak_x + end * (valley_x - peak_x), top + end * depth);
}

static void draw_panel(run *r, int index, double x) {
    canvas *c = &r->canvas;
    const double theta = angles[index] * FIGURE_PI / 180, half = 14;
    const double depth = half * tan(tilt * FIGURE_PI / 180), top = 62;
    const visibility v = find_visibility(angles[index]);
    for (int g = 0; g < GROOVES; g++) {
        const double left = x + 2 * half * (g - 0.5 * GROOVES), valley = left + half;
        draw_facet(c, left, valley, top, depth, v.toward, theta > 0.5 * FIGURE_PI);
        draw_facet(c, left + 2 * half, valley, top, depth, v.away, 0);
    }
    const double y = theta > 0.5 * FIGURE_PI ? top + depth : top, far = 36;
    lobe_arrow(c, lobe_pen(c, HUE_ORANGE, DASH_SOLID), x, y, x + far * sin(theta),
               y - far * cos(theta));
    lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_LEFT, x + far * sin(theta) + 3,
              y - far * cos(theta) + 2, "i");
    lobe_stroke_line(c, (pen){c->theme->muted, DASH_DOTS, 0.6}, x - 46, top, x + 46, top);
    char text[64];
    snprintf(text, sizeof text, "(%c)  θ = %.0f°", 'a' + index, angles[index]);
    lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, x, 12, text);
    snprintf(text, sizeof text, "G = %.3g and %.3g", v.toward, v.away);
    lobe_text(c, c->theme->ink, SMALL_SIZE, ALIGN_CENTRE, x, 124, text);
    const double row[] = {angles[index], tilt, v.toward, v.away, v.hit};
    lobe_table_row(&r->table, NULL, 5, row);
}

lobe_figure_result lobe_figure_masking(run *r) {
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 132);
    lobe_table_begin(&r->table, "theta_deg,tilt_deg,g_toward,g_away,hit_probability");
    for (int k = 0; k < PANELS; k++) draw_panel(r, k, 0.5 * PAGE_WIDTH + 100 * (k - 2));
    return LOBE_FIGURE_OK;
}
