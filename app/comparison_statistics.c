/* Means, slopes, gains and floors, with errors from independent seeds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/metrics.h>

#include "comparison.h"

/* ---- Means ----------------------------------------------------------------------------------- */

#define RUN_AT(member) offsetof(lobe_app_measurement, member)

static double value_of(const lobe_app_cell *cell, int run, size_t offset) {
    double value;
    memcpy(&value, (const char *)&cell->runs[run] + offset, sizeof value);
    return value;
}

static double mean_without(const lobe_app_cell *cell, size_t offset, int left_out) {
    double sum = 0;
    int count = 0;
    for (int s = 0; s < cell->count; s++)
        if (s != left_out) {
            sum += value_of(cell, s, offset);
            count++;
        }
    return count ? sum / count : NAN;
}

static lobe_app_estimate mean_of(const lobe_app_cell *cell, size_t offset) {
    const double mean = mean_without(cell, offset, -1);
    double squares = 0;
    for (int s = 0; s < cell->count; s++) {
        const double d = value_of(cell, s, offset) - mean;
        squares += d * d;
    }
    if (cell->count < 2) return (lobe_app_estimate){mean, NAN};
    return (lobe_app_estimate){mean, sqrt(squares / cell->count / (cell->count - 1))};
}

lobe_app_estimate lobe_app_relmse(const lobe_app_cell *cell) {
    return mean_of(cell, RUN_AT(relmse));
}

lobe_app_estimate lobe_app_flip(const lobe_app_cell *cell) {
    return mean_of(cell, RUN_AT(flip));
}

lobe_app_estimate lobe_app_rmse(const lobe_app_cell *cell) {
    const lobe_app_estimate mse = mean_of(cell, RUN_AT(mse));
    const double rmse = sqrt(fmax(mse.value, 0));
    return (lobe_app_estimate){rmse, rmse > 0 ? mse.error / (2 * rmse) : mse.error};
}

double lobe_app_rejected_share(const lobe_app_cell *cell) {
    const double draws = mean_without(cell, RUN_AT(draws), -1);
    return draws > 0 ? mean_without(cell, RUN_AT(rejected), -1) / draws : 0;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double lobe_app_median_seconds(const lobe_app_cell *cell) {
    double seconds[LOBE_APP_SEEDS_MAX];
    if (cell->count == 0) return NAN;
    for (int s = 0; s < cell->count; s++) seconds[s] = cell->runs[s].seconds;
    qsort(seconds, (size_t)cell->count, sizeof *seconds, by_value);
    return 0.5 * (seconds[(cell->count - 1) / 2] + seconds[cell->count / 2]);
}

double lobe_app_cpu_seconds(const lobe_app_cell *cell) {
    return mean_without(cell, RUN_AT(cpu_seconds), -1);
}

double lobe_app_rays_per_second(const lobe_app_cell *cell) {
    return mean_without(cell, RUN_AT(rays), -1) / mean_without(cell, RUN_AT(seconds), -1);
}

/* ---- Lines through logarithms ---------------------------------------------------------------- */

/* What a contender spent and what was left of the error, both as logarithms. */
typedef struct log_points {
    int count;
    double x[LOBE_APP_SIZES_MAX], y[LOBE_APP_SIZES_MAX];
} log_points;

static double mean(const double *values, int count) {
    double sum = 0;
    for (int i = 0; i < count; i++) sum += values[i];
    return sum / count;
}

static log_points points_of(const lobe_app_comparison *c, int contender, lobe_app_axis axis,
                            int left_out) {
    log_points p = {0};
    for (int n = 0; n < c->sizes; n++) {
        const lobe_app_cell *cell = &c->cell[contender][n];
        const double error = mean_without(cell, RUN_AT(relmse), left_out);
        const double spent = axis == LOBE_APP_AXIS_SAMPLES
                                 ? cell->spp
                                 : mean_without(cell, RUN_AT(cpu_seconds), left_out);
        if (!(error > 0) || !(spent > 0)) continue;
        p.x[p.count] = log(spent);
        p.y[p.count++] = log(error);
    }
    return p;
}

/* Least squares; the lines may lie apart but share one slope. NAN: nothing to fit. */
static double common_slope(const log_points *lines, int count) {
    double products = 0, squares = 0;
    for (int k = 0; k < count; k++) {
        const log_points *p = &lines[k];
        for (int i = 0; i < p->count; i++) {
            const double dx = p->x[i] - mean(p->x, p->count);
            products += dx * (p->y[i] - mean(p->y, p->count));
            squares += dx * dx;
        }
    }
    return squares > 1e-9 ? products / squares : NAN;
}

static double slope_without(const lobe_app_comparison *c, int contender, lobe_app_axis axis,
                            int left_out) {
    const log_points p = points_of(c, contender, axis, left_out);
    return common_slope(&p, 1);
}

/* Logarithm of the share of what `base` spends that `contender` does for the same error: the distance of two
 * parallel lines. Pictures of one size only: the error falls with the samples. */
static double log_need_without(const lobe_app_comparison *c, int contender, int base,
                               lobe_app_axis axis, int left_out) {
    const log_points p[2] = {points_of(c, contender, axis, left_out),
                             points_of(c, base, axis, left_out)};
    if (p[0].count == 0 || p[1].count == 0) return NAN;
    double slope = common_slope(p, 2);
    if (!(slope < -0.25)) slope = -1;
    const double x[2] = {mean(p[0].x, p[0].count), mean(p[1].x, p[1].count)};
    const double y[2] = {mean(p[0].y, p[0].count), mean(p[1].y, p[1].count)};
    return x[0] - x[1] - (y[0] - y[1]) / slope;
}

/* Seeds that both have. */
static int shared_seeds(const lobe_app_comparison *c, int contender, int base) {
    int seeds = LOBE_APP_SEEDS_MAX;
    for (int n = 0; n < c->sizes; n++) {
        if (c->cell[contender][n].count < seeds) seeds = c->cell[contender][n].count;
        if (c->cell[base][n].count < seeds) seeds = c->cell[base][n].count;
    }
    return seeds;
}

/* Standard error by the jackknife: how far the value moves when one seed is left out. */
static double jackknife(const double *without, int seeds) {
    if (seeds < 2) return NAN;
    const double middle = mean(without, seeds);
    double squares = 0;
    for (int s = 0; s < seeds; s++) squares += (without[s] - middle) * (without[s] - middle);
    return sqrt(squares * (seeds - 1) / seeds);
}

lobe_app_estimate lobe_app_slope(const lobe_app_comparison *c, int contender, lobe_app_axis axis) {
    double without[LOBE_APP_SEEDS_MAX];
    const int seeds = shared_seeds(c, contender, contender);
    for (int s = 0; s < seeds; s++) without[s] = slope_without(c, contender, axis, s);
    return (lobe_app_estimate){slope_without(c, contender, axis, -1), jackknife(without, seeds)};
}

lobe_app_estimate lobe_app_need(const lobe_app_comparison *c, int contender, int base,
                                lobe_app_axis axis) {
    double without[LOBE_APP_SEEDS_MAX];
    const int seeds = shared_seeds(c, contender, base);
    for (int s = 0; s < seeds; s++) without[s] = log_need_without(c, contender, base, axis, s);
    const double value = exp(log_need_without(c, contender, base, axis, -1));
    return (lobe_app_estimate){value, value * jackknife(without, seeds)};
}

bool lobe_app_is_told_apart(lobe_app_estimate need, int seeds) {
    /* two-sided 95 % quantiles for 1 to 10 degrees of freedom; beyond, a little above the true ones */
    static const double student[] = {12.71, 4.31, 3.19, 2.78, 2.58, 2.45, 2.37, 2.31, 2.27, 2.23};
    if (seeds < 2 || !isfinite(need.value) || !isfinite(need.error)) return false;
    const double t = student[seeds - 2 < 9 ? seeds - 2 : 9];
    return fabs(log(need.value)) > t * need.error / need.value;
}

/* ---- The floor ------------------------------------------------------------------------------- */

/* Of two seeds s and t, (x_s - A) (x_t - B) has the squared bias as its mean, noise or not: all four pictures
 * are independent. All pairs together are (S - K A) (S - K B) - sum of (x_s - A) (x_s - B). Without bias the
 * pixels are independent and have mean 0, so their squares give the deviation of the sum. */
lobe_app_floor lobe_app_find_floor(const lobe_app_comparison *c, int contender) {
    const lobe_app_cell *cell = &c->cell[contender][c->sizes - 1];
    if (!cell->sum || cell->count < 2) return (lobe_app_floor){0};
    const double seeds = cell->count;
    const size_t pixels = (size_t)c->width * (size_t)c->height;
    double sum = 0, squares = 0;
    for (size_t p = 0; p < pixels; p++) {
        double pixel = 0;
        for (size_t i = 3 * p; i < 3 * p + 3; i++) {
            const double a = (double)c->half[0][i], b = (double)c->half[1][i];
            const double pairs =
                (cell->sum[i] - seeds * a) * (cell->sum[i] - seeds * b) - cell->product[i];
            pixel +=
                pairs / (seeds * (seeds - 1)) / lobe_relative_scale((double)c->reference[i]) / 3;
        }
        sum += pixel;
        squares += pixel * pixel;
    }
    lobe_app_floor f = {.relmse = sum / (double)pixels, .is_known = true};
    f.deviations = squares > 0 ? sum / sqrt(squares) : 0;
    f.is_biased = f.deviations > 5;
    return f;
}

/* ---- Who is best ----------------------------------------------------------------------------- */

static bool may_win(const lobe_app_comparison *c, int contender) {
    return !lobe_app_find_floor(c, contender).is_biased;
}

/* The one that needs least of what `base` does, `but` aside. */
static int least_needy(const lobe_app_comparison *c, int base, int but, lobe_app_axis axis) {
    int best = -1;
    double least = INFINITY;
    for (int m = 0; m < c->contenders; m++) {
        const double need = lobe_app_need(c, m, base, axis).value;
        if (m == but || !may_win(c, m) || !(need < least)) continue;
        least = need;
        best = m;
    }
    return best;
}

int lobe_app_best_contender(const lobe_app_comparison *c, lobe_app_axis axis) {
    return least_needy(c, 0, -1, axis);
}

int lobe_app_rival(const lobe_app_comparison *c, int best, lobe_app_axis axis) {
    if (best > 0 && may_win(c, 0)) return 0;
    return least_needy(c, best < 0 ? 0 : best, best, axis);
}

static void write_winner(const lobe_app_comparison *c, int best, int rival, char *text,
                         size_t size) {
    const char *const what = c->equal == LOBE_APP_AXIS_SAMPLES ? "samples" : "time";
    const lobe_app_estimate need = lobe_app_need(c, best, rival, c->equal);
    const char *const winner = c->contender[best].name, *const other = c->contender[rival].name;
    const int seeds = shared_seeds(c, best, rival);
    if (seeds < 2)
        snprintf(text, size,
                 "On this scene %s needs about %.0f %% of the %s of %s (one seed: no error bar)",
                 winner, 100 * need.value, what, other);
    else if (lobe_app_is_told_apart(need, seeds))
        snprintf(text, size, "On this scene %s needs %.0f %% of the %s of %s", winner,
                 100 * need.value, what, other);
    else
        snprintf(text, size,
                 "On this scene %s and %s cannot be told apart: %.0f %% \u00b1 %.0f %% of the %s",
                 winner, other, 100 * need.value, 100 * need.error, what);
}

void lobe_app_headline(const lobe_app_comparison *c, char *text, size_t size) {
    const int best = lobe_app_best_contender(c, c->equal);
    const int rival = best < 0 ? -1 : lobe_app_rival(c, best, c->equal);
    if (c->is_of_files)
        snprintf(text, size, "FLIP %.4f, RMSE %.4g, relMSE %.4g", c->cell[0][0].runs[0].flip,
                 lobe_app_rmse(&c->cell[0][0]).value, c->cell[0][0].runs[0].relmse);
    else if (best >= 0 && rival >= 0)
        write_winner(c, best, rival, text, size);
    else if (best >= 0 && c->contenders == 1)
        snprintf(text, size, "The relMSE of %s on this scene is %.3g at %u samples",
                 c->contender[best].name, lobe_app_relmse(&c->cell[best][c->sizes - 1]).value,
                 c->cell[best][c->sizes - 1].spp);
    else if (best >= 0)
        snprintf(text, size, "On this scene only %s reaches the reference",
                 c->contender[best].name);
    else
        snprintf(text, size, "On this scene no method reaches the reference");
}
