#include "bins.h"

#include <math.h>
#include <stdlib.h>

#include "cubature.h"
#include "draws.h"
#include "pilot.h"

/* Halvings of a cell: of what the cubature finds too full, and of what pilot draws do. */
enum { DEPTH = 16, PILOT_DEPTH = 60 };

static const double MOST_SHIFT = 0.02;
static const double ROUGH_TOLERANCE = 1e-6;

enum { DENSITY, VALUE, CUT_MEAN, CUT_SQUARE, UNCOVERED };

typedef struct field {
    const lobe_verify_model *model;
    const lobe_verify_chart *chart;
    lobe_verify_state state;
    double cut;
} field;

static double solid_angle(const lobe_verify_chart *chart, double t, double a, double wo[3]) {
    double area;
    lobe_disk_point point = lobe_disk_from_square(t, a, &area);
    return area * chart->direction(chart->self, point, wo);
}

/* The model at points of its chart. */
typedef struct sights {
    double angle[LOBE_CUBATURE_POINTS]; /* solid angle by area of the chart */
    double density[LOBE_CUBATURE_POINTS], value[LOBE_CUBATURE_POINTS];
} sights;

static void look(const field *f, int points, const double *t, const double *a, sights *s) {
    double wo[3 * LOBE_CUBATURE_POINTS];
    for (int i = 0; i < points; ++i) s->angle[i] = solid_angle(f->chart, t[i], a[i], wo + 3 * i);
    lobe_evaluate_many(f->model, &f->state, (size_t)points, wo, s->density, s->value);
}

static void evaluate(const void *self, int points, const double *t, const double *a,
                     double (*values)[LOBE_CUBATURE_VALUES]) {
    const field *f = self;
    sights s;
    look(f, points, t, a, &s);
    for (int i = 0; i < points; ++i) {
        const double angle = s.angle[i], density = s.density[i], value = s.value[i];
        const double cut = fmin(value, f->cut * density);
        values[i][DENSITY] = angle * density;
        values[i][VALUE] = angle * value;
        values[i][CUT_MEAN] = angle * cut;
        values[i][CUT_SQUARE] = density > 0 ? angle * cut * cut / density : 0;
        values[i][UNCOVERED] = density > 0 ? 0 : angle * value;
    }
}

static void evaluate_density(const void *self, int points, const double *t, const double *a,
                             double (*values)[LOBE_CUBATURE_VALUES]) {
    sights s;
    look(self, points, t, a, &s);
    for (int i = 0; i < points; ++i) values[i][DENSITY] = s.angle[i] * s.density[i];
}

/* Cells are numbered sheet by sheet, row by row. */
static lobe_box cell_box(int grid, int cell) {
    int row = cell / grid % grid;
    int column = cell % grid;
    return (lobe_box){{(double)row / grid, (double)column / grid},
                      {(double)(row + 1) / grid, (double)(column + 1) / grid}};
}

static int grow(void **array, size_t *room, size_t needed, size_t size) {
    if (needed <= *room) return 1;
    size_t larger = 2 * needed;
    void *moved = realloc(*array, larger * size);
    if (moved == NULL) return 0;
    *array = moved;
    *room = larger;
    return 1;
}

static int reserve_nodes(lobe_bins *bins, size_t more) {
    void *array = bins->nodes;
    int is_good = grow(&array, &bins->node_room, bins->node_count + more, sizeof *bins->nodes);
    bins->nodes = array;
    return is_good;
}

static int add_bin(lobe_bins *bins) {
    void *share = bins->share;
    void *area = bins->area;
    size_t room = bins->room;
    int is_good = grow(&share, &bins->room, bins->count + 1, sizeof *bins->share) &&
                  grow(&area, &room, bins->count + 1, sizeof *bins->area);
    bins->share = share;
    bins->area = area;
    if (!is_good) return 0;
    bins->share[bins->count] = 0;
    bins->area[bins->count] = 0;
    bins->count += 1;
    return 1;
}

/* Whether rounding a direction in the middle of a box moves it by more than a small part of the box:
 * where draws are rounded to a lattice as coarse as the bins, the bins count lattice points. */
static int is_blurred(const lobe_verify_model *model, const lobe_verify_chart *chart,
                      lobe_box box) {
    double wo[3], t, a;
    double middle[2] = {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2};
    solid_angle(chart, middle[0], middle[1], wo);
    double shift = 0;
    for (int k = 0; k < 6; ++k) {
        double moved[3] = {wo[0], wo[1], wo[2]};
        moved[k / 2] += k % 2 != 0 ? model->rounding : -model->rounding;
        lobe_disk_point point;
        if (!chart->point(chart->self, moved, &point)) return 1;
        lobe_square_from_disk(point, &t, &a);
        double turn = fabs(a - middle[1]);
        shift = fmax(shift, fabs(t - middle[0]) / (box.high[0] - box.low[0]));
        shift = fmax(shift, fmin(turn, 1 - turn) / (box.high[1] - box.low[1]));
    }
    return shift > MOST_SHIFT;
}

/* Exact: the radius is a function of t alone, and of each quarter's azimuth the angle of a chord. */
static double disk_area(lobe_box box) {
    double inner = 2 * box.low[0] / (1 + box.low[0] * box.low[0]);
    double outer = 2 * box.high[0] / (1 + box.high[0] * box.high[0]);
    double quarter = fmin(floor(2 * (box.low[1] + box.high[1])), 3);
    double low = 4 * box.low[1] - quarter;
    double high = 4 * box.high[1] - quarter;
    double angle = atan2(high, 1 - high) - atan2(low, 1 - low);
    return angle * (outer - inner) * (outer + inner) / 2;
}

/* What a tree of bins is filled from. */
typedef struct filling {
    const lobe_verify_model *model;
    lobe_integrand integrand;
    field field;
    int least_depth;
    double most;       /* share of a bin */
    size_t most_pilot; /* pilot draws of a box that need not be halved */
} filling;

typedef struct pilot_range {
    lobe_pilot_point *points;
    size_t count;
} pilot_range;

static int make_bin(lobe_bins *bins, const filling *f, size_t node, lobe_box box,
                    const double integral[LOBE_CUBATURE_VALUES]) {
    size_t bin = LOBE_BLURRED_BIN;
    if (!is_blurred(f->model, f->field.chart, box)) {
        bin = bins->count;
        if (!add_bin(bins)) return 0;
    }
    bins->nodes[node] = (lobe_bin_node){0, -1, (int32_t)bin};
    bins->share[bin] += integral[DENSITY];
    bins->area[bin] += disk_area(box);
    bins->density += integral[DENSITY];
    bins->value += integral[VALUE];
    bins->uncovered += integral[UNCOVERED];
    bins->cut_mean += integral[CUT_MEAN];
    bins->cut_square += integral[CUT_SQUARE];
    return 1;
}

/* Halves until a bin holds no more than twice an equal part. */
static int fill_node(lobe_bins *bins, const filling *f, size_t node, lobe_box box,
                     pilot_range pilot, int depth) {
    double integral[LOBE_CUBATURE_VALUES];
    int halves = pilot.count > f->most_pilot && depth < PILOT_DEPTH;
    if (!halves) {
        lobe_cubature_of_edges(&f->integrand, box, f->least_depth, integral);
        halves = integral[DENSITY] > f->most && depth < DEPTH;
    }
    if (!halves) return make_bin(bins, f, node, box, integral);
    if (!reserve_nodes(bins, 2)) return 0;
    int axis = depth & 1;
    double middle = (box.low[axis] + box.high[axis]) / 2;
    size_t child = bins->node_count;
    bins->node_count += 2;
    bins->nodes[node] = (lobe_bin_node){middle, axis, (int32_t)child};
    lobe_box lower = box;
    lobe_box upper = box;
    lower.high[axis] = middle;
    upper.low[axis] = middle;
    size_t below = lobe_pilot_split(pilot.points, pilot.count, axis, middle);
    pilot_range first = {pilot.points, below};
    pilot_range second = {pilot.points + below, pilot.count - below};
    return fill_node(bins, f, child, lower, first, depth + 1) &&
           fill_node(bins, f, child + 1, upper, second, depth + 1);
}

/* The pilot draws of one cell leave the front of `rest`, first those of its row. */
static int fill_sheet(lobe_bins *bins, filling *f, int sheet, pilot_range rest) {
    int grid = bins->grid;
    for (int row = 0; row < grid; ++row) {
        double end = row + 1 < grid ? (double)(row + 1) / grid : INFINITY;
        size_t in_row = lobe_pilot_split(rest.points, rest.count, 0, end);
        pilot_range line = {rest.points, in_row};
        for (int column = 0; column < grid; ++column) {
            double stop = column + 1 < grid ? (double)(column + 1) / grid : INFINITY;
            size_t in_cell = lobe_pilot_split(line.points, line.count, 1, stop);
            int cell = (sheet * grid + row) * grid + column;
            pilot_range pilot = {line.points, in_cell};
            if (!fill_node(bins, f, (size_t)cell, cell_box(grid, cell), pilot, 0)) return 0;
            line = (pilot_range){line.points + in_cell, line.count - in_cell};
        }
        rest = (pilot_range){rest.points + in_row, rest.count - in_row};
    }
    return 1;
}

/* The error of a whole integral is at most this times the number of cells, and far less in
 * practice: the tolerance bounds what the last refinement changed. A jump takes four times the
 * work for every digit: it gets what the draws of a level, which has its grid, can tell. */
static double tolerance(const lobe_verify_model *model, int grid) {
    double jump = fmax(4e-4 / ((double)grid * grid * grid), 1e-8);
    return fmax(model->has_jumps ? jump : 1e-10, 8 * model->rounding / 256);
}

static int fill(lobe_bins *bins, const lobe_verify_model *model, const lobe_verify_model *exact,
                lobe_pilot *pilot, double t) {
    filling f = {.model = model, .field = {.model = exact, .cut = bins->cut}};
    exact->prepare(exact->self, model->wi, &f.field.state);
    /* The cut makes a crease, what is not covered a jump: neither needs more than a few digits. */
    f.integrand = (lobe_integrand){.self = &f.field,
                                   .count = LOBE_CUBATURE_VALUES,
                                   .tolerance = {t, t, 1e3 * t, 1e-5, 1e-5},
                                   .evaluate_many = evaluate};
    f.most = 2.0 / ((double)bins->grid * bins->grid);
    f.most_pilot = pilot->crowd;
    f.least_depth = model->pilot_draws > 0 && t < ROUGH_TOLERANCE ? 2 : 0;
    for (int sheet = 0; sheet < bins->sheets; ++sheet) {
        f.field.chart = sheet == 0 ? &model->chart : &model->below;
        pilot_range draws = {pilot->points[sheet], pilot->count[sheet]};
        if (!fill_sheet(bins, &f, sheet, draws)) return 0;
    }
    return 1;
}

static const lobe_verify_model *exact_of(const lobe_verify_model *model) {
    return model->twin != NULL ? model->twin : model;
}

static int make_bins(lobe_bins *bins, const lobe_verify_model *model, int grid, double cut,
                     double t) {
    *bins = (lobe_bins){.grid = grid, .sheets = lobe_verify_is_sphere(model) ? 2 : 1, .cut = cut};
    lobe_pilot pilot;
    if (!lobe_pilot_make(&pilot, model)) return 0;
    size_t cells = (size_t)bins->sheets * (size_t)grid * (size_t)grid;
    int is_good = reserve_nodes(bins, cells) && add_bin(bins);
    bins->node_count = cells;
    is_good = is_good && fill(bins, model, exact_of(model), &pilot, t);
    lobe_pilot_free(&pilot);
    if (!is_good) lobe_bins_free(bins);
    return is_good;
}

int lobe_bins_make(lobe_bins *bins, const lobe_verify_model *model, int grid, double cut) {
    return make_bins(bins, model, grid, cut, tolerance(exact_of(model), grid));
}

int lobe_bins_make_roughly(lobe_bins *bins, const lobe_verify_model *model, int grid, double cut) {
    return make_bins(bins, model, grid, cut, ROUGH_TOLERANCE);
}

void lobe_bins_free(lobe_bins *bins) {
    free(bins->nodes);
    free(bins->share);
    free(bins->area);
    *bins = (lobe_bins){0};
}

/* The cell of x in [0, 1]; anything else gets one too, NaN the last. */
static int cell_of(double x, int grid) {
    double scaled = x * grid;
    return scaled < grid ? (scaled > 0 ? (int)scaled : 0) : grid - 1;
}

size_t lobe_bins_find(const lobe_bins *bins, int sheet, double t, double a) {
    int row = sheet * bins->grid + cell_of(t, bins->grid);
    const lobe_bin_node *node = &bins->nodes[row * bins->grid + cell_of(a, bins->grid)];
    while (node->axis >= 0) {
        double x = node->axis == 0 ? t : a;
        node = &bins->nodes[node->child + (x >= node->at)];
    }
    return (size_t)node->child;
}

size_t lobe_bins_of_direction(const lobe_bins *bins, const lobe_verify_model *model,
                              const double wo[3]) {
    const lobe_verify_chart *chart = lobe_verify_chart_of(model, wo);
    lobe_disk_point point;
    double t, a;
    if (!chart->point(chart->self, wo, &point)) return bins->count;
    lobe_square_from_disk(point, &t, &a);
    return lobe_bins_find(bins, chart == &model->below, t, a);
}

double lobe_density_integral(const lobe_verify_model *model) {
    field f = {.model = model};
    model->prepare(model->self, model->wi, &f.state);
    int grid = 16;
    double t = model->has_jumps ? 1e-8 : tolerance(model, grid);
    lobe_integrand integrand = {
        .self = &f, .count = 1, .tolerance = {t}, .evaluate_many = evaluate_density};
    double sum = 0;
    int sheets = lobe_verify_is_sphere(model) ? 2 : 1;
    for (int cell = 0; cell < sheets * grid * grid; ++cell) {
        double integral[LOBE_CUBATURE_VALUES];
        f.chart = cell < grid * grid ? &model->chart : &model->below;
        lobe_cubature(&integrand, cell_box(grid, cell), integral);
        sum += integral[DENSITY];
    }
    return sum;
}
