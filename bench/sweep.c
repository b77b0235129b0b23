/* bench/sweep.c: what `lobe bench` does not show of the batches; called by bench/measure.py.
 *
 *     bench_sweep sizes METHOD        ns a draw by the number of rows of a batch, 1 to 10^7
 *     bench_sweep angles METHOD       ns a draw by the angle of wi and by roughness: constant time
 *     bench_sweep stream METHOD       10^7 draws by 1 and by all threads, and copying the same bytes
 *     bench_sweep draw METHOD ROWS    ROWS draws and nothing else, to count instructions
 *
 * Smith-GGX in float, wi and alpha for each row, with density and weight; medians. The instruction set is that
 * of LOBE_ISA. Lines of numbers, one a measurement. */
#include <lobe/batch.h>
#include <lobe/random.h>

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "machine.h"

enum { ROUNDS = 15, NUMBERS_IN = 7, NUMBERS_OUT = 5, NUMBERS = NUMBERS_IN + NUMBERS_OUT };
static const size_t MOST_ROWS = 10000000;

/* wi, alpha, u1, u2; wo, pdf, weight. */
typedef struct arrays {
    float *number[NUMBERS];
} arrays;

static void fill_row(arrays a, size_t i, double cos_theta, double alpha) {
    const lobe_random4 r = lobe_random(1, 0, i);
    const double phi = 6.283185307179586 * lobe_random_unit_f32(r.word[0]);
    const double sine = sqrt(1 - cos_theta * cos_theta);
    a.number[0][i] = (float)(sine * cos(phi));
    a.number[1][i] = (float)(sine * sin(phi));
    a.number[2][i] = (float)cos_theta;
    a.number[3][i] = a.number[4][i] = (float)alpha;
    a.number[5][i] = lobe_random_unit_f32(r.word[1]);
    a.number[6][i] = lobe_random_unit_f32(r.word[2]);
}

static arrays arrays_of(size_t rows) {
    arrays a;
    for (int k = 0; k < NUMBERS; ++k) {
        a.number[k] = calloc(rows, sizeof(float));
        if (a.number[k] == NULL) {
            fputs("sweep: out of memory; 500 MB are needed\n", stderr);
            exit(1);
        }
    }
    for (size_t i = 0; i < rows; ++i) {
        const lobe_random4 r = lobe_random(2, 0, i);
        fill_row(a, i, 0.05 + 0.95 * lobe_random_unit_f32(r.word[0]),
                 0.05 + 0.95 * lobe_random_unit_f32(r.word[1]));
    }
    return a;
}

static void draw(arrays a, lobe_method method, size_t first, size_t rows) {
    lobe_sample_batch_f32 b = {.count = rows, .options = lobe_reflection_default_options()};
    b.options.model.method = method;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (lobe_in_f32){a.number[k] + first, 1};
        b.wo[k] = (lobe_out_f32){a.number[NUMBERS_IN + k] + first, 1};
    }
    for (int k = 0; k < 2; ++k) {
        b.alpha[k] = (lobe_in_f32){a.number[3 + k] + first, 1};
        b.u[k] = (lobe_in_f32){a.number[5 + k] + first, 1};
    }
    b.pdf = (lobe_out_f32){a.number[NUMBERS_IN + 3] + first, 1};
    b.weight = (lobe_out_f32){a.number[NUMBERS_IN + 4] + first, 1};
    lobe_reflection_sample_batch_f32(&b);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Median nanoseconds a draw, in calls of `rows` rows. */
static double time_draws(arrays a, lobe_method method, size_t rows) {
    const size_t least = 200000, calls = rows < least ? least / rows : 1;
    double ns[ROUNDS];
    for (int round = 0; round < ROUNDS; ++round) {
        const double start = machine_seconds();
        for (size_t k = 0; k < calls; ++k) draw(a, method, 0, rows);
        ns[round] = 1e9 * (machine_seconds() - start) / (double)(calls * rows);
    }
    qsort(ns, ROUNDS, sizeof *ns, compare);
    return ns[ROUNDS / 2];
}

static void sweep_sizes(lobe_method method) {
    const arrays a = arrays_of(MOST_ROWS);
    for (size_t rows = 1; rows <= MOST_ROWS; rows *= rows < 64 ? 2 : 10) {
        if (rows == 64) rows = 100;
        printf("%zu %.2f\n", rows, time_draws(a, method, rows));
    }
}

static void sweep_angles(lobe_method method) {
    enum { ROWS = 1024 };
    const arrays a = arrays_of(ROWS);
    static const double degrees[] = {0, 30, 60, 80, 89, 100, 150}, alphas[] = {0.001, 0.03, 0.3, 1};
    for (size_t k = 0; k < sizeof alphas / sizeof *alphas; ++k) {
        for (size_t j = 0; j < sizeof degrees / sizeof *degrees; ++j) {
            for (size_t i = 0; i < ROWS; ++i)
                fill_row(a, i, cos(degrees[j] / 57.29577951308232), alphas[k]);
            printf("%g %g %.2f\n", alphas[k], degrees[j], time_draws(a, method, ROWS));
        }
    }
}

/* The part of the rows of one thread. */
typedef struct part {
    arrays a;
    lobe_method method;
    size_t first, rows;
    int is_copy;
} part;

static void *run_part(void *user) {
    const part *p = user;
    if (!p->is_copy) {
        draw(p->a, p->method, p->first, p->rows);
        return NULL;
    }
    /* twelve numbers are read or written, as by a draw: six arrays onto the other six */
    for (int k = 0; k < NUMBERS / 2; ++k)
        memcpy(p->a.number[k + NUMBERS / 2] + p->first, p->a.number[k] + p->first,
               p->rows * sizeof(float));
    return NULL;
}

static double time_threads(part whole, int threads) {
    pthread_t thread[256];
    part parts[256];
    const double start = machine_seconds();
    for (int t = 0; t < threads; ++t) {
        parts[t] = whole;
        parts[t].rows = whole.rows / (size_t)threads;
        parts[t].first = (size_t)t * parts[t].rows;
        if (pthread_create(&thread[t], NULL, run_part, &parts[t])) exit(1);
    }
    for (int t = 0; t < threads; ++t) pthread_join(thread[t], NULL);
    return 1e9 * (machine_seconds() - start) / (double)whole.rows;
}

static void sweep_stream(lobe_method method) {
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    const int all = online < 1 ? 1 : online > 256 ? 256 : (int)online;
    const arrays drawn = arrays_of(MOST_ROWS), copied = arrays_of(MOST_ROWS);
    for (int threads = 1; threads <= all; threads += all > 1 ? all - 1 : 1) {
        double ns[2][ROUNDS];
        for (int round = 0; round < ROUNDS; ++round) {
            for (int is_copy = 0; is_copy < 2; ++is_copy) {
                const part whole = {is_copy ? copied : drawn, method, 0, MOST_ROWS, is_copy};
                ns[is_copy][round] = time_threads(whole, threads);
            }
        }
        for (int k = 0; k < 2; ++k) qsort(ns[k], ROUNDS, sizeof **ns, compare);
        printf("%d %.2f %.2f\n", threads, ns[0][ROUNDS / 2], ns[1][ROUNDS / 2]);
    }
}

int main(int argc, char **argv) {
    const lobe_method method = argc > 2 ? lobe_method_from_name(argv[2]) : LOBE_METHOD_COUNT;
    const char *what = argc > 1 ? argv[1] : "";
    if (method == LOBE_METHOD_COUNT) {
        fputs("usage: bench_sweep sizes|angles|stream|draw METHOD [ROWS]\n", stderr);
        return 2;
    }
    if (strcmp(what, "sizes") == 0) sweep_sizes(method);
    if (strcmp(what, "angles") == 0) sweep_angles(method);
    if (strcmp(what, "stream") == 0) sweep_stream(method);
    if (strcmp(what, "draw") == 0) {
        const size_t rows = argc > 3 ? strtoull(argv[3], NULL, 10) : 1000000;
        draw(arrays_of(rows), method, 0, rows);
    }
    return 0;
}
