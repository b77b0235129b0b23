/* app/verify.c: `lobe verify`: prove every model and method by statistics. */
#include <inttypes.h>
#include <stdio.h>

#include <lobe/verify.h>

#include "commands.h"
#include "interrupt.h"
#include "json.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "verify_report.h"

typedef struct verify_values {
    bool quick, full, list, json, failures;
    const char *only, *plugin, *resume, *report;
    uint64_t seed, draws, threads;
    double case_seconds;
    int progress;
} verify_values;

static const lobe_app_option options[] = {
    {"--quick", NULL, "yes", "about 10^5 draws a case, seconds in all", NULL,
     offsetof(verify_values, quick), NULL},
    {"--full", NULL, "no",
     "10^8 draws a case; without --only of an even choice of all cases, half an hour on two cores",
     NULL, offsetof(verify_values, full), NULL},
    {"--draws", "N", "those of the level", "draws a case, 1000 to 10^12", lobe_app_read_count,
     offsetof(verify_values, draws), NULL},
    {"--only", "PATTERN", "all cases",
     "a shell pattern that occurs in \"MODEL CONFIGURATION\", as \"caps f32\"", lobe_app_read_name,
     offsetof(verify_values, only), NULL},
    {"--seed", "S", "1", "of the random numbers, any whole number", lobe_app_read_u64,
     offsetof(verify_values, seed), NULL},
    {"--threads", "N", "one a processor", "results do not depend on it", lobe_app_read_count,
     offsetof(verify_values, threads), NULL},
    {"--resume", "FILE", NULL, "keep finished cases in FILE, and go on from it if it is there",
     lobe_app_read_name, offsetof(verify_values, resume), NULL},
    {"--list", NULL, NULL, "print the cases and stop", NULL, offsetof(verify_values, list), NULL},
    {0}};

static const lobe_app_option plugin_options[] = {
    {"--plugin", "FILE.so", "the library's own models",
     "test the BSDF in this shared library (docs/verifying-your-bsdf.md)", lobe_app_read_name,
     offsetof(verify_values, plugin), NULL},
    {"--case-seconds", "S", "20, full: 1800", "time after which a case of a plugin has failed",
     lobe_app_read_f64, offsetof(verify_values, case_seconds), NULL},
    {0}};

static const lobe_app_option output_options[] = {
    {"--report", "FILE.html", NULL,
     "a page with pictures of what was drawn in the failed cases, or in those of --only",
     lobe_app_read_name, offsetof(verify_values, report), NULL},
    {"--failures", NULL, NULL, "print failed tests only", NULL, offsetof(verify_values, failures),
     NULL},
    {"--json", NULL, NULL, "one JSON object a test, then one with the counts", NULL,
     offsetof(verify_values, json), NULL},
    LOBE_APP_PROGRESS_OPTION(verify_values, progress),
    {0}};

/* What the callbacks share. */
typedef struct verify_run {
    const verify_values *values;
    lobe_app_progress progress;
    lobe_app_page page;
} verify_run;

static void print_test_json(const lobe_verify_test *t) {
    lobe_app_print_json(json_pack(
        "{ss ss ss ss ss so so so sb sb}", "model", t->model, "configuration", t->configuration,
        "test", t->test, "detail", t->detail, "kind",
        t->kind == LOBE_VERIFY_P_VALUE ? "p" : "error", "statistic",
        lobe_app_json_number(t->statistic), "value", lobe_app_json_number(t->value), "limit",
        lobe_app_json_number(t->limit), "passed", (int)t->passed, "known", (int)t->is_known));
}

static void print_test_row(const lobe_verify_test *t) {
    lobe_app_print("%-6s %-34s %-48s %-13s %-5s %9.3g, limit %9.3g  %s\n",
                   t->passed     ? "ok"
                   : t->is_known ? "known"
                                 : "FAILED",
                   t->model, t->configuration, t->test,
                   t->kind == LOBE_VERIFY_P_VALUE ? "p" : "error", t->value, t->limit, t->detail);
}

static void print_test(void *user, const lobe_verify_test *t) {
    verify_run *run = user;
    lobe_app_add_test(&run->page, t);
    if (run->values->failures && t->passed) return;
    lobe_app_end_progress(&run->progress); /* the row takes the place of the bar */
    if (run->values->json)
        print_test_json(t);
    else
        print_test_row(t);
    lobe_app_flush(); /* a full run takes half an hour: each row as soon as it is known */
}

static void keep_picture(void *user, const lobe_verify_picture *picture) {
    verify_run *run = user;
    lobe_app_add_picture(&run->page, picture);
}

static int show_progress(void *user, double share) {
    verify_run *run = user;
    lobe_app_show_progress(&run->progress, share, 100 * share);
    return lobe_app_interrupted != 0;
}

static void print_case(void *user, const lobe_verify_case *c) {
    if (*(const bool *)user)
        lobe_app_print_json(
            json_pack("{ss ss}", "model", c->model, "configuration", c->configuration));
    else
        lobe_app_print("%s %s\n", c->model, c->configuration);
}

static void print_summary(const lobe_verify_summary *summary, bool json) {
    if (json)
        lobe_app_print_json(json_pack(
            "{sI sI sI sI sI}", "cases", (json_int_t)summary->cases, "draws",
            (json_int_t)summary->draws, "passed", (json_int_t)summary->tests_passed, "failed",
            (json_int_t)summary->tests_failed, "known", (json_int_t)summary->tests_known));
    else if (summary->tests_known)
        lobe_app_print("%" PRIu64 " failed as documented\n%" PRIu64 " passed, %" PRIu64 " failed\n",
                       summary->tests_known, summary->tests_passed, summary->tests_failed);
    else
        lobe_app_print("%" PRIu64 " passed, %" PRIu64 " failed\n", summary->tests_passed,
                       summary->tests_failed);
}

/* An error line for what kept the run from its end. */
static void report_trouble(lobe_verify_result result, const lobe_verify_summary *summary) {
    char line[640];
    const char *where = result == LOBE_VERIFY_BAD_PLUGIN ? "--plugin"
                        : result == LOBE_VERIFY_BAD_STATE || result == LOBE_VERIFY_NOT_SAVED
                            ? "--resume"
                            : "verify";
    snprintf(line, sizeof line, "%s: %s", where, summary->message);
    lobe_app_report_line(line);
}

static lobe_app_status status_of(lobe_verify_result result) {
    switch (result) {
    case LOBE_VERIFY_OK:
        return LOBE_APP_DONE;
    case LOBE_VERIFY_FAILED:
        return LOBE_APP_NOT_HELD;
    case LOBE_VERIFY_CANCELLED:
        return LOBE_APP_INTERRUPTED;
    case LOBE_VERIFY_NO_CASES:
    case LOBE_VERIFY_BAD_OPTION:
    case LOBE_VERIFY_BAD_PLUGIN:
    case LOBE_VERIFY_BAD_STATE:
        return LOBE_APP_BAD_INPUT;
    case LOBE_VERIFY_NO_MEMORY:
    case LOBE_VERIFY_NOT_SAVED:
        break;
    }
    return LOBE_APP_FAILED;
}

/* What leaves nothing to list leaves nothing to run, and the run says why. */
static lobe_app_status list_cases(const lobe_verify_options *verify, bool json) {
    if (lobe_verify_list(verify, print_case, &json) > 0) return LOBE_APP_DONE;
    lobe_verify_summary summary;
    const lobe_verify_result result = lobe_verify_run(verify, &summary);
    if (result == LOBE_VERIFY_NO_CASES)
        return lobe_app_reject("--only", "lobe verify --list has the names", "no case matches");
    report_trouble(result, &summary);
    return status_of(result);
}

static lobe_app_status finish_page(verify_run *run, bool is_wanted,
                                   const lobe_verify_summary *summary) {
    const verify_values *v = run->values;
    const lobe_app_page_head head = {v->plugin, v->only, v->full ? "full" : "quick", v->seed,
                                     v->draws};
    return lobe_app_finish_page(&run->page, &head, is_wanted ? summary : NULL);
}

static lobe_app_status run_cases(const verify_values *values, lobe_verify_options *verify) {
    verify_run run = {.values = values};
    lobe_app_status status = lobe_app_begin_page(&run.page, values->report);
    if (status) return status;
    run.progress = lobe_app_begin_progress(values->progress, "verify", "%");
    verify->on_test = print_test;
    verify->on_progress = show_progress;
    verify->on_picture = values->report ? keep_picture : NULL;
    verify->user = &run;
    lobe_verify_summary summary;
    lobe_app_catch_interrupt();
    const lobe_verify_result result = lobe_verify_run(verify, &summary);
    lobe_app_end_progress(&run.progress);
    status = status_of(result);
    const bool has_results = status != LOBE_APP_BAD_INPUT && status != LOBE_APP_FAILED;
    if (has_results)
        print_summary(&summary, values->json);
    else
        report_trouble(result, &summary);
    const lobe_app_status page_status = finish_page(&run, has_results, &summary);
    return page_status ? page_status : status;
}

lobe_app_status lobe_app_verify(int argc, char **argv) {
    lobe_verify_options verify = lobe_verify_default_options();
    verify_values values = {.seed = verify.seed};
    const lobe_app_group groups[] = {{"Cases", options, &values},
                                     {"Plugin", plugin_options, &values},
                                     {"Output", output_options, &values},
                                     {0}};
    const lobe_app_command command = {"verify",
                                      "[OPTIONS]",
                                      "Tests every method in both precisions over a grid of "
                                      "roughness and incidence: draws against\n"
                                      "the density, what the density integrates to, the white "
                                      "furnace, weights, reciprocity, float\n"
                                      "against double, special numbers. Ends with a line N passed, "
                                      "N failed; status 3 if any failed.",
                                      NULL,
                                      groups,
                                      "lobe verify --only 'bounded f32'"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if ((status = lobe_app_exclude(&arguments, "--quick", "--full"))) return status;
    if (values.threads > 1024)
        return lobe_app_reject("--threads", "use 1 to 1024", "too many threads");
    if (lobe_app_is_given(&arguments, "--case-seconds") &&
        !(values.case_seconds > 0 && values.case_seconds <= 1e6))
        return lobe_app_reject("--case-seconds", "use a number up to 10^6", "out of range");
    verify.level = values.full ? LOBE_VERIFY_FULL : LOBE_VERIFY_QUICK;
    verify.only = values.only;
    verify.seed = values.seed;
    verify.draws = values.draws;
    verify.threads = (int32_t)values.threads;
    verify.plugin = values.plugin;
    verify.case_seconds = values.case_seconds;
    verify.state = values.resume;
    verify.pictures = values.only ? LOBE_VERIFY_PICTURES_ALL : LOBE_VERIFY_PICTURES_FAILED;
    if (values.list) return list_cases(&verify, values.json);
    return run_cases(&values, &verify);
}
