/* The public entrance: choosing rows, going round them, medians. */
#include <lobe/bench.h>

#include <lobe/batch.h>

#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "machine.h"
#include "work.h"

enum { ROUNDS_MAX = 21, TITLE_ROOM = 128, PATTERN_ROOM = 256 };

/* Seconds a round of one loop lasts at least. */
static const double QUICK_SECONDS = 1e-3, SECONDS = 4e-3;

typedef enum loop { LOOP_DRAW, LOOP_NORMAL, LOOP_PDF, LOOP_LISTING, LOOPS } loop;

typedef struct timed_row {
    work work;
    listing *published;
    int repetitions[LOOPS]; /* passes over the inputs that make a round */
    double ns[LOOPS][ROUNDS_MAX];
} timed_row;

typedef struct run {
    const lobe_bench_options *options;
    inputs inputs;
    timed_row *rows;
    int count;
    int rounds;
    double least_seconds;
    double copy;
    double sum; /* of all results: keeps the loops alive */
} run;

static const char *const precision_names[PRECISIONS] = {"f32", "f64"};

static const char *prepared_name(const work *w) {
    return w->is_shared ? "shared" : "each";
}

static const char *isa_name(const work *w) {
    return w->isa ? w->isa : "call";
}

static const char *method_name(const work *w) {
    return w->is_glass ? "dielectric" : lobe_method_name(w->options.model.method);
}

static int is_chosen(const char *only, const work *w) {
    if (only == NULL) return 1;
    char title[TITLE_ROOM], pattern[PATTERN_ROOM];
    lobe_model m = w->options.model;
    snprintf(title, sizeof title, "%s %s %s %s %s %s", lobe_ndf_name(m.ndf),
             lobe_masking_name(m.masking), method_name(w), isa_name(w),
             precision_names[w->precision], prepared_name(w));
    if (strlen(only) >= PATTERN_ROOM - 2) return 0;
    snprintf(pattern, sizeof pattern, "*%s*", only);
    return fnmatch(pattern, title, 0) == 0;
}

static lobe_vec3_f64 plane_of(const lobe_bench_options *o) {
    const lobe_vec3_f64 up = {0, 0, 1}, g = o->geometric_normal;
    return g.x == 0 && g.y == 0 && g.z == 0 ? up : g;
}

/* Batches have no geometric normals of their own for every row; dielectrics have none at all. */
static int exists(const work *w) {
    if (w->is_glass) return w->plane.z >= 1;
    return w->is_shared || w->isa == NULL || w->plane.z >= 1;
}

static int choose_rows(run *r) {
    int sets = 1; /* single calls, then every instruction set */
    while (lobe_isa_at(sets - 1)) ++sets;
    int models = lobe_model_count() + 1; /* glass is the last */
    int all = models * sets * PRECISIONS * 2;
    r->rows = calloc((size_t)all, sizeof *r->rows);
    if (r->rows == NULL) return 0;
    for (int i = 0; i < all; ++i) {
        int model = i / 2 / PRECISIONS / sets;
        work w = {.options = lobe_reflection_default_options(),
                  .is_glass = model == models - 1,
                  .precision = (precision)(i / 2 % PRECISIONS),
                  .is_shared = i % 2 == 0,
                  .isa = lobe_isa_at(i / 2 / PRECISIONS % sets - 1),
                  .plane = plane_of(r->options)};
        if (!w.is_glass) w.options.model = lobe_model_at(model);
        if (r->options->floor >= 0) w.options.floor = r->options->floor;
        if (!exists(&w) || !is_chosen(r->options->only, &w)) continue;
        timed_row *row = &r->rows[r->count++];
        row->work = w;
        if (w.precision == PRECISION_F32 && !w.is_glass)
            row->published = lobe_listing_of(w.options.model);
    }
    return 1;
}

static double run_loop(run *r, const timed_row *row, loop which) {
    switch (which) {
    case LOOP_DRAW:
        return work_draw(&row->work, &r->inputs);
    case LOOP_NORMAL:
        return work_normal(&row->work, &r->inputs);
    case LOOP_PDF:
        return work_pdf(&row->work, &r->inputs);
    case LOOP_LISTING:
    case LOOPS:
        break;
    }
    return work_listing(row->published, &r->inputs);
}

/* Seconds for `repetitions` passes. */
static double time_loop(run *r, const timed_row *row, loop which, int repetitions) {
    lobe_restrict_isa(row->work.isa);
    double start = machine_seconds();
    for (int k = 0; k < repetitions; ++k) r->sum += run_loop(r, row, which);
    return machine_seconds() - start;
}

/* As many passes as the shortest time takes. */
static void calibrate(run *r, timed_row *row, loop which) {
    int repetitions = 1;
    while (time_loop(r, row, which, repetitions) < r->least_seconds) repetitions *= 2;
    row->repetitions[which] = repetitions;
}

static int has_loop(const timed_row *row, loop which) {
    if (which == LOOP_NORMAL) return row->work.isa != NULL && !row->work.is_glass;
    return which != LOOP_LISTING || row->published != NULL;
}

/* 0: stopped. Round -1 only finds the number of passes. */
static int measure(run *r) {
    for (int round = -1; round < r->rounds; ++round) {
        for (int i = 0; i < r->count; ++i) {
            timed_row *row = &r->rows[i];
            for (int which = 0; which < LOOPS; ++which) {
                if (!has_loop(row, (loop)which)) continue;
                if (round < 0) {
                    calibrate(r, row, (loop)which);
                    continue;
                }
                int passes = row->repetitions[which];
                double seconds = time_loop(r, row, (loop)which, passes);
                row->ns[which][round] = 1e9 * seconds / passes / INPUTS;
            }
        }
        double share = (round + 2.0) / (r->rounds + 1.0);
        if (r->options->on_progress && r->options->on_progress(r->options->user, share)) return 0;
    }
    return 1;
}

static int compare(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Sorts the rounds of a loop. */
static double median(run *r, timed_row *row, loop which) {
    qsort(row->ns[which], (size_t)r->rounds, sizeof(double), compare);
    return row->ns[which][r->rounds / 2];
}

static void report(run *r, timed_row *row) {
    lobe_bench_row out = {.ndf = lobe_ndf_name(row->work.options.model.ndf),
                          .masking = lobe_masking_name(row->work.options.model.masking),
                          .method = method_name(&row->work),
                          .isa = isa_name(&row->work),
                          .precision = precision_names[row->work.precision],
                          .prepared = prepared_name(&row->work)};
    out.ns = median(r, row, LOOP_DRAW);
    if (has_loop(row, LOOP_NORMAL)) out.ns_normal = median(r, row, LOOP_NORMAL);
    out.ns_pdf = median(r, row, LOOP_PDF);
    const double *sorted = row->ns[LOOP_DRAW];
    out.spread = (sorted[3 * r->rounds / 4] - sorted[r->rounds / 4]) / out.ns;
    /* The listing prepares for every draw, as published. */
    if (row->published) out.listing = median(r, row, LOOP_LISTING) / out.ns;
    if (r->copy > 0) out.stream = out.ns / (1e9 * work_bytes(&row->work) / r->copy);
    if (r->options->on_row) r->options->on_row(r->options->user, &out);
}

lobe_bench_result lobe_bench_run(const lobe_bench_options *options, lobe_bench_machine *machine) {
    run r = {.options = options,
             .rounds = options->quick ? 5 : ROUNDS_MAX,
             .least_seconds = options->quick ? QUICK_SECONDS : SECONDS};
    inputs_fill(&r.inputs);
    if (!choose_rows(&r)) return LOBE_BENCH_NO_MEMORY;
    lobe_bench_result result = LOBE_BENCH_NO_ROWS;
    if (r.count > 0) {
        r.copy = machine_copy_rate(r.rounds);
        result = r.copy > 0 ? LOBE_BENCH_OK : LOBE_BENCH_NO_MEMORY;
    }
    if (result == LOBE_BENCH_OK && !measure(&r)) result = LOBE_BENCH_CANCELLED;
    if (result == LOBE_BENCH_OK)
        for (int i = 0; i < r.count; ++i) report(&r, &r.rows[i]);
    if (machine) {
        machine_name(machine->cpu, sizeof machine->cpu);
        machine->copy = r.copy;
    }
    lobe_restrict_isa(NULL);
    free(r.rows);
    return result;
}
