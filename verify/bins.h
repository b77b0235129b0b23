/* Bins of about equal expected count on the charts of a model, with what is expected of them by
 * cubature.
 *
 * A regular grid over the unit square of each chart; cells that hold too much are halved. Where a
 * chart does not know the lobe, pilot draws say where it is: a lobe much narrower than a cell could
 * pass between all points of the cubature. */
#ifndef LOBE_VERIFY_BINS_H
#define LOBE_VERIFY_BINS_H

#include <stddef.h>
#include <stdint.h>

#include "model.h"

typedef struct lobe_bin_node {
    double at;     /* where `axis` is halved */
    int32_t axis;  /* -1: a bin */
    int32_t child; /* the lower child, the upper one follows; or the number of the bin */
} lobe_bin_node;

typedef struct lobe_bins {
    int grid;             /* cells in each direction */
    int sheets;           /* 1: reflection, 2: both sides of the surface */
    lobe_bin_node *nodes; /* the first sheets * grid * grid are the cells */
    size_t node_count, node_room;
    double *share; /* of the draws expected in each bin */
    double *area;  /* of each bin, in the unit disks */
    size_t count, room;
    double density;    /* integral of the density */
    double value;      /* integral of f |cos| */
    double uncovered;  /* the part of it where the density is 0 */
    double cut;        /* weights are cut to this in the next two */
    double cut_mean;   /* expectation of the weight of a draw */
    double cut_square; /* and of its square */
} lobe_bins;

/* `density` is integrated from the model's twin where it has one: draws in single precision are held
 * against exact expectations. Returns 0 without memory. */
int lobe_bins_make(lobe_bins *bins, const lobe_verify_model *model, int grid, double cut);

/* The same for the eye: integrals to four digits. */
int lobe_bins_make_roughly(lobe_bins *bins, const lobe_verify_model *model, int grid, double cut);
void lobe_bins_free(lobe_bins *bins);

/* The bin of a point of a chart: sheet 1 is the one below. Any numbers, also NaN, have one. */
size_t lobe_bins_find(const lobe_bins *bins, int sheet, double t, double a);

/* The bin of a direction; bins->count where no chart has it. */
size_t lobe_bins_of_direction(const lobe_bins *bins, const lobe_verify_model *model,
                              const double wo[3]);

/* The bin of everything that rounding blurs. */
enum { LOBE_BLURRED_BIN };

/* Integral of the density of the model itself, in its own precision. */
double lobe_density_integral(const lobe_verify_model *model);

#endif
