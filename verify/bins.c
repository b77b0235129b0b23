#include "bins.h"

#include <math.h>
#include <stdlib.h>

#include "cubature.h"

enum { DEPTH = 16 };

/* The bin of everything that rounding blurs. */
enum { BLURRED };

static const double MOST_SHIFT = 0.02;

enum { DENSITY, VALUE, CUT_MEAN, CUT_SQUARE };

typedef struct field {
    const lobe_verify_model *model;
    lobe_verify_state state;
    double cut;
} field;

static double solid_angle(const lobe_verify_model *model, double t, double a, double wo[3]) {
    double area;
    lobe_disk_point point = lobe_disk_from_square(t, a, &area);
    return area * model->chart.direction(model->chart.self, point, wo);
}

static void evaluate(const void *self, double t, double a, double values[LOBE_CUBATURE_VALUES]) {
    const field *f = self;
    double wo[3];
    double angle = solid_angle(f->model, t, a, wo);
    double density = f->model->density(&f->state, wo);
    double value = f->model->value(&f->state, wo);
    double cut = fmin(value, f->cut * density);
    values[DENSITY] = angle * density;
    values[VALUE] = angle * value;
    values[CUT_MEAN] = angle * cut;
    values[CUT_SQUARE] = density > 0 ? angle * cut * cut / density : 0;
}

static void evaluate_density(const void *self, double t, double a,
                             double values[LOBE_CUBATURE_VALUES]) {
    const field *f = self;
    double wo[3];
    double angle = solid_angle(f->model, t, a, wo);
    values[DENSITY] = angle * f->model->density(&f->state, wo);
}

static lobe_box cell_box(int grid, int cell) {
    int row = cell / grid;
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
    void *array = bins->share;
    int is_good = grow(&array, &bins->room, bins->count + 1, sizeof *bins->share);
    bins->share = array;
    if (is_good) bins->share[bins->count++] = 0;
    return is_good;
}

/* Whether rounding a direction in the middle of a box moves it by more than a small part of the box:
 * where draws are rounded to a lattice as coarse as the bins, the bins count lattice points. */
static int is_blurred(const lobe_verify_model *model, lobe_box box) {
    double wo[3], t, a;
    double middle[2] = {(box.low[0] + box.high[0]) / 2, (box.low[1] + box.high[1]) / 2};
    solid_angle(model, middle[0], middle[1], wo);
    double shift = 0;
    for (int k = 0; k < 6; ++k) {
        double moved[3] = {wo[0], wo[1], wo[2]};
        moved[k / 2] += k % 2 != 0 ? model->rounding : -model->rounding;
        lobe_disk_point point;
        if (!model->chart.point(model->chart.self, moved, &point)) return 1;
        lobe_square_from_disk(point, &t, &a);
        double turn = fabs(a - middle[1]);
        shift = fmax(shift, fabs(t - middle[0]) / (box.high[0] - box.low[0]));
        shift = fmax(shift, fmin(turn, 1 - turn) / (box.high[1] - box.low[1]));
    }
    return shift > MOST_SHIFT;
}

static int make_bin(lobe_bins *bins, const lobe_verify_model *model, size_t node, lobe_box box,
                    const double integral[LOBE_CUBATURE_VALUES]) {
    size_t bin = BLURRED;
    if (!is_blurred(model, box)) {
        bin = bins->count;
        if (!add_bin(bins)) return 0;
    }
    bins->nodes[node] = (lobe_bin_node){0, -1, (int32_t)bin};
    bins->share[bin] += integral[DENSITY];
    bins->density += integral[DENSITY];
    bins->value += integral[VALUE];
    bins->cut_mean += integral[CUT_MEAN];
    bins->cut_square += integral[CUT_SQUARE];
    return 1;
}

/* Halves until a bin holds no more than twice an equal part. */
static int fill_node(lobe_bins *bins, const lobe_verify_model *model,
                     const lobe_integrand *integrand, size_t node, lobe_box box, int depth) {
    double integral[LOBE_CUBATURE_VALUES];
    lobe_cubature(integrand, box, integral);
    double most = 2.0 / ((double)bins->grid * bins->grid);
    if (!(integral[DENSITY] > most) || depth == DEPTH) {
        return make_bin(bins, model, node, box, integral);
    }
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
    return fill_node(bins, model, integrand, child, lower, depth + 1) &&
           fill_node(bins, model, integrand, child + 1, upper, depth + 1);
}

/* The error of a whole integral is at most this times the number of cells, and far less in
 * practice: the tolerance bounds what the last refinement changed. */
static double tolerance(const lobe_verify_model *model) {
    double least = model->has_jumps ? 1e-8 : 1e-10;
    return fmax(least, 8 * model->rounding / 256);
}

int lobe_bins_make(lobe_bins *bins, const lobe_verify_model *model, int grid, double cut) {
    *bins = (lobe_bins){.grid = grid, .cut = cut};
    field f = {.model = model->twin != NULL ? model->twin : model, .cut = cut};
    f.model->prepare(f.model->self, model->wi, &f.state);
    double t = tolerance(f.model);
    /* The cut makes a crease; its integrals are only compared with statistics. */
    lobe_integrand integrand = {evaluate, &f, LOBE_CUBATURE_VALUES, {t, t, 1e3 * t, 1e-5}};
    size_t cells = (size_t)grid * (size_t)grid;
    int is_good = reserve_nodes(bins, cells) && add_bin(bins);
    bins->node_count = cells;
    for (size_t cell = 0; cell < cells && is_good; ++cell) {
        is_good = fill_node(bins, model, &integrand, cell, cell_box(grid, (int)cell), 0);
    }
    if (!is_good) lobe_bins_free(bins);
    return is_good;
}

void lobe_bins_free(lobe_bins *bins) {
    free(bins->nodes);
    free(bins->share);
    *bins = (lobe_bins){0};
}

size_t lobe_bins_find(const lobe_bins *bins, double t, double a) {
    int last = bins->grid - 1;
    int row = (int)fmin(t * bins->grid, last);
    int column = (int)fmin(a * bins->grid, last);
    const lobe_bin_node *node = &bins->nodes[row * bins->grid + column];
    while (node->axis >= 0) {
        double x = node->axis == 0 ? t : a;
        node = &bins->nodes[node->child + (x >= node->at)];
    }
    return (size_t)node->child;
}

double lobe_density_integral(const lobe_verify_model *model) {
    field f = {.model = model};
    model->prepare(model->self, model->wi, &f.state);
    double t = tolerance(model);
    lobe_integrand integrand = {evaluate_density, &f, 1, {t}};
    double sum = 0;
    int grid = 16;
    for (int cell = 0; cell < grid * grid; ++cell) {
        double integral[LOBE_CUBATURE_VALUES];
        lobe_cubature(&integrand, cell_box(grid, cell), integral);
        sum += integral[DENSITY];
    }
    return sum;
}
