/* app/bench.c: `lobe bench`: what a draw costs. */
#include <stdio.h>
#include <string.h>

#include <lobe/bench.h>

#include "bench_page.h"
#include "commands.h"
#include "interrupt.h"
#include "json.h"
#include "model.h"
#include "options.h"
#include "output.h"
#include "progress.h"

typedef struct bench_values {
    bool quick, json, html;
    const char *only;
    double floor;
    lobe_vec3_f64 plane;
    int progress;
} bench_values;

static const lobe_app_option options[] = {
    {"--quick", NULL, NULL, "fewer and shorter rounds, for a first look", NULL,
     offsetof(bench_values, quick), NULL},
    {"--only", "PATTERN", "all rows",
     "a shell pattern that occurs in \"NDF MASKING METHOD ISA PRECISION PREPARED\", as "
     "\"caps avx2 f32\"",
     lobe_app_read_name, offsetof(bench_values, only), NULL},
    {"--floor", "D", "0.25", "method horizon: how much of the density ignores shadowing, in [0, 1]",
     lobe_app_read_floor, offsetof(bench_values, floor), NULL},
    {"--geometric-normal", "X,Y,Z", "none",
     "normal of the geometric surface in the shading frame, of any length: draws and densities "
     "above it; no batch prepares for each draw there",
     lobe_app_read_direction, offsetof(bench_values, plane), NULL},
    {"--json", NULL, NULL, "one JSON object on standard output", NULL, offsetof(bench_values, json),
     NULL},
    {"--html", NULL, NULL, "a page with bars on standard output", NULL,
     offsetof(bench_values, html), NULL},
    LOBE_APP_PROGRESS_OPTION(bench_values, progress),
    {0}};

typedef struct bench_run {
    const bench_values *values;
    json_t *rows;
    lobe_app_progress progress;
    bool has_header;
} bench_run;

static int show_progress(void *user, double share) {
    bench_run *run = user;
    lobe_app_show_progress(&run->progress, share, 100 * share);
    return lobe_app_interrupted != 0;
}

/* null where there is nothing to compare with */
static json_t *number_or_null(double value) {
    return value > 0 ? json_real(value) : json_null();
}

static void keep_row(bench_run *run, const lobe_bench_row *row) {
    json_array_append_new(
        run->rows,
        json_pack("{ss ss ss ss ss ss so so so so so so}", "ndf", row->ndf, "masking", row->masking,
                  "method", row->method, "isa", row->isa, "precision", row->precision, "prepared",
                  row->prepared, "ns", lobe_app_json_number(row->ns), "ns_normal",
                  number_or_null(row->ns_normal), "ns_pdf", lobe_app_json_number(row->ns_pdf),
                  "spread", lobe_app_json_number(row->spread), "listing",
                  number_or_null(row->listing), "stream", number_or_null(row->stream)));
}

static void print_ratio(double value) {
    if (value > 0)
        lobe_app_print(" %8.2f", value);
    else
        lobe_app_print(" %8s", "-");
}

static void print_row(bench_run *run, const lobe_bench_row *row) {
    if (!run->has_header)
        lobe_app_print("%-10s %-8s %-18s %-7s %-4s %-7s %8s %8s %8s %8s %8s %8s\n", "ndf",
                       "masking", "method", "isa", "prec", "prep", "ns", "ns m", "ns pdf", "spread",
                       "listing", "stream");
    run->has_header = true;
    lobe_app_print("%-10s %-8s %-18s %-7s %-4s %-7s %8.2f", row->ndf, row->masking, row->method,
                   row->isa, row->precision, row->prepared, row->ns);
    print_ratio(row->ns_normal);
    lobe_app_print(" %8.2f %7.0f%%", row->ns_pdf, 100 * row->spread);
    print_ratio(row->listing);
    print_ratio(row->stream);
    lobe_app_print("\n");
}

static void take_row(void *user, const lobe_bench_row *row) {
    bench_run *run = user;
    lobe_app_end_progress(&run->progress);
    if (run->values->json || run->values->html)
        keep_row(run, row);
    else
        print_row(run, row);
}

static lobe_app_status print_machine(bench_run *run, const lobe_bench_machine *machine) {
    if (run->values->html) {
        lobe_app_print_bench_page(machine->cpu, machine->copy, run->rows);
        return LOBE_APP_DONE;
    }
    if (run->values->json)
        return lobe_app_print_json(json_pack("{ss si sf so}", "cpu", machine->cpu, "threads", 1,
                                             "copy_bytes_per_second", machine->copy, "rows",
                                             json_incref(run->rows)));
    lobe_app_print(
        "\n%s, one thread; copies %.1f GB/s (read and written).\n"
        "ns: a draw with density and weight; ns m: a normal with its density alone; ns pdf: "
        "the density of a direction.\n"
        "listing: times faster than the published listing in plain C; stream: times the "
        "copying of the same bytes.\n",
        machine->cpu, 1e-9 * machine->copy);
    return LOBE_APP_DONE;
}

static lobe_app_status finish(bench_run *run, lobe_bench_result result,
                              const lobe_bench_machine *machine) {
    switch (result) {
    case LOBE_BENCH_OK:
        return print_machine(run, machine);
    case LOBE_BENCH_CANCELLED:
        return LOBE_APP_INTERRUPTED;
    case LOBE_BENCH_NO_ROWS:
        return lobe_app_reject("--only", "as in --only 'caps f32'", "no row matches");
    case LOBE_BENCH_NO_MEMORY:
        break;
    }
    lobe_app_report_line("bench: out of memory; 256 MB are needed");
    return LOBE_APP_FAILED;
}

static lobe_app_status run_bench(const bench_values *values) {
    if (values->json && values->html)
        return lobe_app_reject("--html", "choose one", "cannot be combined with --json");
    bench_run run = {.values = values,
                     .rows = json_array(),
                     .progress = lobe_app_begin_progress(values->progress, "bench", "%")};
    const lobe_bench_options bench = {.only = values->only,
                                      .quick = values->quick,
                                      .floor = values->floor,
                                      .geometric_normal = values->plane,
                                      .user = &run,
                                      .on_row = take_row,
                                      .on_progress = show_progress};
    lobe_bench_machine machine;
    lobe_app_catch_interrupt();
    const lobe_bench_result result = lobe_bench_run(&bench, &machine);
    lobe_app_end_progress(&run.progress);
    const lobe_app_status status = finish(&run, result, &machine);
    json_decref(run.rows);
    return status;
}

lobe_app_status lobe_app_bench(int argc, char **argv) {
    if (argc > 0 && strcmp(argv[0], "render") == 0)
        return lobe_app_bench_render(argc - 1, argv + 1);
    bench_values values = {.floor = -1};
    const lobe_app_group groups[] = {{"Options", options, &values}, {0}};
    const lobe_app_command command = {
        "bench",
        "[OPTIONS]",
        "Times every model: nanoseconds a draw, beside the published listing of the same method in "
        "plain C\n"
        "and the time to copy the same bytes through memory, all in one run. Medians over rounds.\n"
        "lobe bench render [SCENE...] does that for the path tracer: see its --help.",
        NULL,
        groups,
        "lobe bench --quick --only 'caps * f32'"};
    lobe_app_arguments arguments;
    const lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    return status || arguments.is_answered ? status : run_bench(&values);
}
