/* app/sample.c: `lobe sample`: draw directions. */
#include <inttypes.h>

#include "commands.h"
#include "interrupt.h"
#include "model.h"
#include "output.h"
#include "progress.h"
#include "rows.h"
#include "table.h"

typedef struct sample_values {
    uint64_t count, seed;
    const char *random;
    int format, progress;
    bool json;
} sample_values;

static const lobe_app_option options[] = {
    {"--count", "N", "1, or all rows of --random", "rows to draw", lobe_app_read_count,
     offsetof(sample_values, count), NULL},
    {"--seed", "S", "0", "of the random numbers, any whole number; --random replaces them",
     lobe_app_read_u64, offsetof(sample_values, seed), NULL},
    {"--random", "FILE", NULL,
     "take the random numbers from rows u1 u2 [u3], each in [0, 1); "
     "- is standard input",
     lobe_app_read_name, offsetof(sample_values, random), NULL},
    {0}};

static const lobe_app_option output_options[] = {
    {"--format", "NAME", "csv", "f32le is nine little-endian floats a row, without a header",
     lobe_app_read_choice, offsetof(sample_values, format), lobe_app_formats},
    {"--json", NULL, NULL, "the same as --format ndjson", NULL, offsetof(sample_values, json),
     NULL},
    LOBE_APP_PROGRESS_OPTION(sample_values, progress),
    {0}};

static const char *const columns[] = {"mx", "my",    "mz",    "ox",     "oy",
                                      "oz", "pdf_m", "pdf_o", "weight", NULL};

/* Where the random numbers come from: a file, or a counter. */
typedef struct random_source {
    lobe_app_rows rows;
    const sample_values *values;
    uint64_t row, count; /* count 0: until the file ends */
} random_source;

static lobe_app_status open_source(random_source *source, const sample_values *values,
                                   bool has_count) {
    source->values = values;
    source->row = 0;
    source->count = values->random && !has_count ? 0 : values->count;
    if (!values->random) return LOBE_APP_DONE;
    return lobe_app_open_rows(&source->rows, values->random, "u1 u2 u3", 2, 3);
}

static lobe_app_status read_random(random_source *source, double u[3], bool *has_ended) {
    int count;
    u[2] = 0;
    const lobe_app_status status = lobe_app_next_row(&source->rows, u, &count);
    if (status) return status;
    for (int i = 0; i < count; i++)
        if (!(u[i] >= 0 && u[i] < 1))
            return lobe_app_reject_row(&source->rows, "a random number is at least 0 and below 1",
                                       "a number out of range");
    *has_ended = count == 0;
    if (*has_ended && source->count)
        return lobe_app_reject(source->rows.name, "give more rows or a smaller --count",
                               "%" PRIu64 " rows, but --count is %" PRIu64, source->row,
                               source->count);
    return LOBE_APP_DONE;
}

static lobe_app_status next_random(random_source *source, const lobe_app_model *model, double u[3],
                                   bool *has_ended) {
    *has_ended = source->count && source->row == source->count;
    if (*has_ended) return LOBE_APP_DONE;
    if (source->values->random) {
        const lobe_app_status status = read_random(source, u, has_ended);
        if (status || *has_ended) return status;
    } else {
        lobe_app_random(model, source->values->seed, source->row, u);
    }
    source->row++;
    return LOBE_APP_DONE;
}

static lobe_app_status draw_rows(const lobe_app_model *model, const lobe_app_table *table,
                                 random_source *source, lobe_app_progress *progress) {
    if (!lobe_app_begin_table(table)) return LOBE_APP_DONE;
    for (;;) {
        double u[3];
        bool has_ended;
        const lobe_app_status status = next_random(source, model, u, &has_ended);
        if (status || has_ended) return status;
        const lobe_reflection_draw_f64 draw = lobe_app_draw(model, u);
        const double row[] = {draw.m.x,  draw.m.y,   draw.m.z, draw.wo.x,  draw.wo.y,
                              draw.wo.z, draw.pdf_m, draw.pdf, draw.weight};
        if (!lobe_app_write_row(table, row)) return LOBE_APP_DONE;
        if (lobe_app_interrupted) return LOBE_APP_INTERRUPTED;
        if (source->row % 16384 == 0) {
            const double done = (double)source->row, all = (double)source->count;
            lobe_app_show_progress(progress, all > 0 ? done / all : -1, done);
        }
    }
}

lobe_app_status lobe_app_sample(int argc, char **argv) {
    sample_values values = {.count = 1};
    lobe_app_model_values model_values = lobe_app_default_model();
    const lobe_app_group groups[] = {{"Model", lobe_app_model_options, &model_values},
                                     {"Draws", options, &values},
                                     {"Output", output_options, &values},
                                     {0}};
    const lobe_app_command command = {
        "sample",
        "--alpha A[,AY] --wi X,Y,Z [OPTIONS]",
        "Draws directions of reflection, with --bsdf dielectric also of transmission. Writes a row "
        "a\n"
        "draw: the microfacet normal m, the direction o, the density of m over normals, the "
        "density "
        "of o\n"
        "over directions, and the weight f(i,o) |o.z| / pdf_o. A draw that does not leave the "
        "surface\n"
        "has pdf_o = weight = 0; it is kept, never drawn again.",
        NULL,
        groups,
        "lobe sample --alpha 0.2,0.8 --wi 0.6,0,0.8 --count 1000 --seed 7 > draws.csv"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;

    lobe_app_model model;
    random_source source;
    if ((status = lobe_app_exclude(&arguments, "--json", "--format"))) return status;
    if ((status = lobe_app_prepare(&model_values, &arguments, &model))) return status;
    status = open_source(&source, &values, lobe_app_is_given(&arguments, "--count"));
    if (status) return status;

    const lobe_app_table table = {values.json ? LOBE_APP_NDJSON : (lobe_app_format)values.format,
                                  model.precision, columns};
    lobe_app_catch_interrupt();
    lobe_app_progress progress = lobe_app_begin_progress(values.progress, "sample", "rows");
    status = draw_rows(&model, &table, &source, &progress);
    lobe_app_end_progress(&progress);
    if (values.random) lobe_app_close_rows(&source.rows);
    return status;
}
