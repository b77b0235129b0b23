/* app/compare.c: `lobe compare`: which method is better on a scene, or how far one picture is from another. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "compare_judge.h"
#include "compare_methods.h"
#include "compare_print.h"
#include "compare_report.h"
#include "json.h"
#include "number.h"
#include "page.h"
#include "progress.h"

typedef struct sizes {
    int count;
    uint64_t spp[LOBE_APP_SIZES_MAX]; /* rising */
} sizes;

typedef struct compare_values {
    lobe_app_view view;
    const char *methods, *reference, *out;
    sizes sizes;
    uint64_t seeds, reference_spp;
    int equal, metric, progress;
    double threshold;
    bool json;
} compare_values;

enum { METRIC_RMSE, METRIC_RELMSE, METRIC_FLIP, METRIC_FLIP_HDR };

static const char *const metrics[] = {"rmse", "relmse", "flip", "flip-hdr", NULL};
static const char *const equals[] = {"samples", "time", NULL};

static int by_value(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Reads "16,64,256", in any order, each once. */
static bool read_sizes(const lobe_app_option *option, const char *text, void *value) {
    sizes *s = value;
    *s = (sizes){0};
    for (const char *at = text;; at++) {
        char number[24] = {0};
        const size_t length = strcspn(at, ",");
        if (length < sizeof number) memcpy(number, at, length);
        uint64_t *spp = &s->spp[s->count];
        if (s->count == LOBE_APP_SIZES_MAX || !lobe_app_read_integer(number, spp) || *spp < 1 ||
            *spp > LOBE_RENDER_SAMPLES_MAX)
            break;
        s->count++;
        at += length;
        if (*at) continue;
        qsort(s->spp, (size_t)s->count, sizeof *s->spp, by_value);
        for (int i = 1; i < s->count; i++)
            if (s->spp[i] == s->spp[i - 1]) s->count = 0;
        if (s->count) return true;
        break;
    }
    lobe_app_report(option->name, "give up to 12 different whole numbers, as 16,64,256",
                    "'%.60s' is no list of samples, each 1 to 16777216", text);
    return false;
}

#define AT(member) offsetof(compare_values, member)

static const lobe_app_option scene_options[] = {
    {"--methods", "A,B,...", NULL,
     "what to compare, the first is held against; each a name of lobe render's --method, or "
     "default "
     "(by surface), with :floor=D or :normalization=NAME behind it for settings of its own",
     lobe_app_read_name, AT(methods), NULL},
    {"--spp", "N,...", "16,64", "camera paths a pixel, a picture each", read_sizes, AT(sizes),
     NULL},
    {"--equal", "WHAT", "samples",
     "time: --spp is of the first method, the others get what fits into its processor time",
     lobe_app_read_choice, AT(equal), equals},
    {"--seeds", "N", "4", "independent pictures of each, for the error bars", lobe_app_read_count,
     AT(seeds), NULL},
    {"--reference", "FILE", "rendered", "picture that is taken for the truth", lobe_app_read_name,
     AT(reference), NULL},
    {"--reference-spp", "N", "16 times the most of --spp", "camera paths a pixel of the reference",
     lobe_app_read_count, AT(reference_spp), NULL},
    {0}};

static const lobe_app_option file_options[] = {
    {"--threshold", "T", "none", "status 3 if the metric is above", lobe_app_read_f64,
     AT(threshold), NULL},
    {"--metric", "NAME", "flip", "what the threshold is for", lobe_app_read_choice, AT(metric),
     metrics},
    {0}};

static const lobe_app_option output_options[] = {
    {"-o", "DIR", NULL,
     "folder for report.html, pictures and error maps; made if it is not there. Needed for a scene",
     lobe_app_read_name, AT(out), NULL},
    {"--json", NULL, NULL, "the results as JSON on standard output", NULL, AT(json), NULL},
    LOBE_APP_PROGRESS_OPTION(compare_values, progress),
    {0}};

/* ---- Checks ---------------------------------------------------------------------------------- */

static lobe_app_status fail_folder(const char *folder, int why) {
    lobe_app_report(folder, "choose another folder", "cannot be written (%s)", strerror(why));
    return LOBE_APP_FAILED;
}

/* Makes the folder; what cannot be written shall not be noticed after an hour. */
static lobe_app_status prepare_folder(const char *folder) {
    struct stat status;
    if (!folder) return LOBE_APP_DONE;
    if (strlen(folder) > 2048) return fail_folder(folder, ENAMETOOLONG);
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) return fail_folder(folder, errno);
    if (stat(folder, &status) != 0) return fail_folder(folder, errno);
    if (!S_ISDIR(status.st_mode)) return fail_folder(folder, ENOTDIR);
    return access(folder, W_OK | X_OK) == 0 ? LOBE_APP_DONE : fail_folder(folder, errno);
}

static lobe_app_status reject_others(const lobe_app_arguments *arguments,
                                     const char *const *allowed, const char *what) {
    for (const char *const *given = arguments->given; *given; given++) {
        bool is_allowed = false;
        for (const char *const *name = allowed; *name; name++)
            is_allowed = is_allowed || strcmp(*name, *given) == 0;
        if (!is_allowed)
            return lobe_app_reject(*given, "leave it out", "does not go with %s", what);
    }
    return LOBE_APP_DONE;
}

static lobe_app_status check_scene(const compare_values *v, const lobe_app_arguments *arguments) {
    static const char *const of_files[] = {"--threshold", "--metric"};
    for (int i = 0; i < 2; i++)
        if (lobe_app_is_given(arguments, of_files[i]))
            return lobe_app_reject(of_files[i], "give two pictures", "does not go with a scene");
    if (!v->methods)
        return lobe_app_reject("--methods", "as --methods ellipsoid,bounded,horizon",
                               "nothing to compare");
    if (!v->out)
        return lobe_app_reject("-o", "give a folder, as -o report", "no place to write to");
    if (v->seeds > LOBE_APP_SEEDS_MAX)
        return lobe_app_reject("--seeds", "use 1 to 64", "too many seeds");
    if (v->reference_spp > LOBE_RENDER_SAMPLES_MAX)
        return lobe_app_reject("--reference-spp", "use 1 to 16777216", "too many samples");
    if (v->reference && v->reference_spp)
        return lobe_app_exclude(arguments, "--reference-spp", "--reference");
    return lobe_app_check_view(&v->view);
}

/* ---- Both kinds ------------------------------------------------------------------------------ */

static double metric_of(const lobe_app_comparison *c, int metric) {
    const lobe_app_cell *cell = &c->cell[0][0];
    switch (metric) {
    case METRIC_RMSE:
        return lobe_app_rmse(cell).value;
    case METRIC_RELMSE:
        return lobe_app_relmse(cell).value;
    case METRIC_FLIP_HDR:
        return cell->flip_hdr;
    default:
        return cell->runs[0].flip;
    }
}

static lobe_app_status print_result(const lobe_app_comparison *c, bool json) {
    if (json) return lobe_app_print_json(lobe_app_json_comparison(c));
    lobe_app_print_comparison(c);
    return LOBE_APP_DONE;
}

static lobe_app_status compare_files(const compare_values *v, const lobe_app_arguments *arguments,
                                     lobe_app_comparison *c) {
    static const char *const allowed[] = {"--threshold", "--metric",   "-o", "--json",
                                          "--exposure",  "--progress", NULL};
    lobe_app_status status = reject_others(arguments, allowed, "two pictures");
    if (!status && !(v->threshold >= 0))
        status = lobe_app_reject("--threshold", "use 0 or more", "a negative threshold");
    if (!status) status = lobe_app_check_view(&v->view);
    if (status) return status;
    snprintf(c->contender[0].name, sizeof c->contender[0].name, "picture");
    status = lobe_app_judge_files(arguments->operands[0], arguments->operands[1], c);
    if (!status) status = prepare_folder(v->out);
    if (!status && v->out) status = lobe_app_write_report(c, v->out);
    if (!status) status = print_result(c, v->json);
    const bool is_held = !lobe_app_is_given(arguments, "--threshold") ||
                         (!status && metric_of(c, v->metric) <= v->threshold);
    return status || is_held ? status : LOBE_APP_NOT_HELD;
}

static lobe_app_status compare_scene(const compare_values *v, const lobe_app_arguments *arguments,
                                     lobe_app_comparison *c) {
    lobe_app_status status = check_scene(v, arguments);
    if (!status) status = lobe_app_read_methods(v->methods, &v->view, c);
    if (!status) status = prepare_folder(v->out);
    if (status) return status;
    lobe_app_judge judge = {.view = v->view,
                            .source = arguments->operand,
                            .reference = v->reference,
                            .folder = v->out,
                            .reference_spp = v->reference_spp,
                            .progress = v->progress};
    memcpy(judge.spp, v->sizes.spp, sizeof judge.spp);
    c->width = v->view.size.width;
    c->height = v->view.size.height;
    c->sizes = v->sizes.count;
    c->seeds = (int)v->seeds;
    c->equal = (lobe_app_axis)v->equal;
    const lobe_app_status judged = lobe_app_judge_scene(&judge, c);
    const bool has_results = judged == LOBE_APP_DONE || judged == LOBE_APP_INTERRUPTED;
    if (!has_results || !c->cell[0][0].count) return judged;
    status = lobe_app_write_report(c, v->out);
    if (!status) status = print_result(c, v->json);
    return status ? status : judged;
}

static lobe_app_status compare(const compare_values *v, const lobe_app_arguments *arguments,
                               const char *line) {
    lobe_app_comparison *c = calloc(1, sizeof *c);
    if (!c || !line) {
        lobe_app_report("compare", "free some", "out of memory");
        free(c);
        return LOBE_APP_FAILED;
    }
    c->title = arguments->operand;
    c->command = line;
    c->exposure = v->view.exposure;
    const lobe_app_status status = arguments->operand_count == 2 ? compare_files(v, arguments, c)
                                                                 : compare_scene(v, arguments, c);
    lobe_app_free_comparison(c);
    free(c);
    return status;
}

lobe_app_status lobe_app_compare(int argc, char **argv) {
    compare_values values = {
        .view = lobe_app_default_view(), .sizes = {2, {16, 64}}, .seeds = 4, .metric = METRIC_FLIP};
    const lobe_app_group groups[] = {{"Scene or method", scene_options, &values},
                                     {"Two pictures", file_options, &values},
                                     {"Output", output_options, &values},
                                     LOBE_APP_VIEW_GROUPS(&values.view),
                                     {0}};
    const lobe_app_command command = {
        "compare",
        "SCENE --methods A,B,... -o DIR | PICTURE REFERENCE [OPTIONS]",
        "Renders a scene by several methods and tells which one needs fewer samples, with error "
        "bars "
        "from\nindependent seeds: a table, and DIR/report.html with pictures, error maps and "
        "curves. Ctrl-C keeps\nwhat is finished. Of two pictures: how far the first is from the "
        "second.",
        "SCENE...",
        groups,
        "lobe compare gallery --methods ellipsoid,bounded,horizon --spp 16,64 -o report"};
    lobe_app_arguments arguments;
    const lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if (arguments.operand_count == 0)
        return lobe_app_reject("compare", "give a scene, or two pictures", "nothing to compare");
    if (arguments.operand_count > 2)
        return lobe_app_reject(arguments.operands[2], "give a scene, or two pictures",
                               "unexpected argument");
    char *line = lobe_app_command_line("compare", argc, argv);
    const lobe_app_status result = compare(&values, &arguments, line);
    free(line);
    return result;
}
