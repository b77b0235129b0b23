#include "pilot.h"

#include <math.h>
#include <stdlib.h>

#include <lobe/random.h>

/* A stream of their own: the draws of the tests shall not be the ones that chose the bins. */
static const uint64_t PILOT_STREAM = 0x70696C6F74;

/* A draw and those around it; a crowd of draws is what two of 16 x 16 equal parts hold. */
enum { POINTS_A_DRAW = 9, CROWD_PARTS = 128, DEPTH = 60 };

static void add_draw(lobe_pilot *pilot, const lobe_verify_model *model, const double wo[3]) {
    const lobe_verify_chart *chart = lobe_verify_chart_of(model, wo);
    int sheet = chart == &model->below;
    lobe_disk_point point;
    if (!chart->point(chart->self, wo, &point)) return;
    lobe_pilot_point *p = &pilot->points[sheet][pilot->count[sheet]];
    lobe_square_from_disk(point, &p->at[0], &p->at[1]);
    pilot->count[sheet] += p->at[0] >= 0 && p->at[0] <= 1 && p->at[1] >= 0 && p->at[1] <= 1;
}

static void add_draws(lobe_pilot *pilot, const lobe_verify_model *model) {
    lobe_verify_state state;
    model->prepare(model->self, model->wi, &state);
    for (int i = 0; i < model->pilot_draws; ++i) {
        lobe_random4 r = lobe_random(0, PILOT_STREAM, (uint64_t)i);
        double u[3];
        for (int k = 0; k < 3; ++k) u[k] = lobe_random_unit_f32(r.word[k]);
        lobe_verify_draw draw = model->sample(&state, u);
        if (draw.pdf > 0) add_draw(pilot, model, draw.wo);
    }
}

/* Within the square, whose azimuth closes; beyond the pole is the other side. */
static lobe_pilot_point moved(lobe_pilot_point point, double t, double a) {
    t += point.at[0];
    a += point.at[1] + (t < 0 ? 0.5 : 0);
    return (lobe_pilot_point){{fmin(fabs(t), 1), a - floor(a)}};
}

static lobe_pilot_point *add_around(lobe_pilot_point point, const double size[2],
                                    lobe_pilot_point *end) {
    for (int i = 0; i < POINTS_A_DRAW; ++i) {
        if (i != POINTS_A_DRAW / 2)
            *end++ = moved(point, (i / 3 - 1) * size[0], (i % 3 - 1) * size[1]);
    }
    return end;
}

/* Halves a box until it holds no crowd of draws; its size is what the draws resolve there. Returns
 * the end of what it appends. */
static lobe_pilot_point *spread(lobe_pilot_point *points, size_t count, size_t crowd,
                                const double low[2], const double size[2], int depth,
                                lobe_pilot_point *end) {
    if (count <= crowd || depth == DEPTH) {
        for (size_t i = 0; i < count; ++i) end = add_around(points[i], size, end);
        return end;
    }
    int axis = depth & 1;
    double part[2] = {size[0], size[1]};
    part[axis] /= 2;
    double middle[2] = {low[0], low[1]};
    middle[axis] += part[axis];
    size_t below = lobe_pilot_split(points, count, axis, middle[axis]);
    end = spread(points, below, crowd, low, part, depth + 1, end);
    return spread(points + below, count - below, crowd, middle, part, depth + 1, end);
}

int lobe_pilot_make(lobe_pilot *pilot, const lobe_verify_model *model) {
    *pilot = (lobe_pilot){0};
    if (model->pilot_draws == 0) return 1;
    size_t size = POINTS_A_DRAW * (size_t)model->pilot_draws * sizeof(lobe_pilot_point);
    pilot->points[0] = malloc(size);
    pilot->points[1] = malloc(size);
    if (pilot->points[0] == NULL || pilot->points[1] == NULL) {
        lobe_pilot_free(pilot);
        return 0;
    }
    add_draws(pilot, model);
    static const double LOW[2] = {0, 0}, SIZE[2] = {1, 1};
    size_t crowd = (size_t)model->pilot_draws / CROWD_PARTS;
    for (int sheet = 0; sheet < 2; ++sheet) {
        lobe_pilot_point *points = pilot->points[sheet];
        size_t draws = pilot->count[sheet];
        pilot->count[sheet] =
            (size_t)(spread(points, draws, crowd, LOW, SIZE, 0, points + draws) - points);
    }
    pilot->crowd = POINTS_A_DRAW * crowd;
    return 1;
}

void lobe_pilot_free(lobe_pilot *pilot) {
    free(pilot->points[0]);
    free(pilot->points[1]);
    *pilot = (lobe_pilot){0};
}

size_t lobe_pilot_split(lobe_pilot_point *points, size_t count, int axis, double at) {
    size_t below = 0;
    for (size_t i = 0; i < count; ++i) {
        if (points[i].at[axis] >= at) continue;
        lobe_pilot_point moved = points[i];
        points[i] = points[below];
        points[below++] = moved;
    }
    return below;
}
