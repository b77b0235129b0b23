/* app/bench_render.c: `lobe bench render`: how near the path tracer comes to the bare ray caster. */
#include <string.h>
#include <unistd.h>

#include <lobe/ray_bench.h>

#include "commands.h"
#include "interrupt.h"
#include "json.h"
#include "model.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "view.h"

enum { ROUNDS_MAX = 1000 };

typedef struct bench_values {
    lobe_app_view view;
    uint64_t spp, rounds;
    int method, progress;
    bool json;
} bench_values;

#define AT(member) offsetof(bench_values, member)

static const lobe_app_option options[] = {
    {"--spp", "N", "4", "camera paths a pixel; a ray of them takes 32 bytes", lobe_app_read_count,
     AT(spp), NULL},
    {"--rounds", "N", "5", "how often each is timed, in turn", lobe_app_read_count, AT(rounds),
     NULL},
    {"--method", "NAME", "by surface, else the best for the model", "how to sample reflection",
     lobe_app_read_choice, AT(method), lobe_app_methods},
    {"--json", NULL, NULL, "one JSON object on standard output", NULL, AT(json), NULL},
    LOBE_APP_PROGRESS_OPTION(bench_values, progress),
    {0}};

typedef struct bench_run {
    const bench_values *values;
    lobe_model model;
    lobe_app_progress progress;
    double done, all; /* scenes and numbers of threads */
    json_t *rows;     /* NULL: a table */
} bench_run;

static void show_progress(void *user, double share) {
    bench_run *run = user;
    const double fraction = (run->done + share) / run->all;
    lobe_app_show_progress(&run->progress, fraction, 100 * fraction);
}

static json_t *json_row(const char *scene, const lobe_ray_bench *b) {
    return json_pack(
        "{so si sI sI sI sI sI so so so so so so so so}", "scene", lobe_app_json_text(scene),
        "threads", b->threads, "samples", (json_int_t)b->samples, "camera_rays",
        (json_int_t)b->camera_rays, "bounce_rays", (json_int_t)b->bounce_rays, "shadow_rays",
        (json_int_t)b->shadow_rays, "hits", (json_int_t)b->hits, "samples_per_cpu_second",
        lobe_app_json_number(b->samples_per_cpu_second), "rays_per_cpu_second",
        lobe_app_json_number(b->rays_per_cpu_second), "raw_rays_per_cpu_second",
        lobe_app_json_number(b->raw_rays_per_cpu_second), "ratio", lobe_app_json_number(b->ratio),
        "spread", lobe_app_json_number(b->spread), "rays_per_sample",
        lobe_app_json_number((double)(b->camera_rays + b->bounce_rays + b->shadow_rays) /
                             (double)b->samples),
        "seconds", lobe_app_json_number(b->seconds), "raw_seconds",
        lobe_app_json_number(b->raw_seconds));
}

static void print_row(const char *scene, const lobe_ray_bench *b) {
    const double rays = (double)(b->camera_rays + b->bounce_rays + b->shadow_rays);
    const char *slash = strrchr(scene, '/');
    lobe_app_print("%-24.24s %7d %11.3f %10.2f %10.2f %10.2f %6.3f %6.0f%% %9.3f\n",
                   slash ? slash + 1 : scene, b->threads, 1e-6 * b->samples_per_cpu_second,
                   rays / (double)b->samples, 1e-6 * b->rays_per_cpu_second,
                   1e-6 * b->raw_rays_per_cpu_second, b->ratio, 100 * b->spread, b->seconds);
}

static lobe_app_status bench_threads(bench_run *run, const char *name, const lobe_scene *scene,
                                     int threads) {
    lobe_ray_bench_options o = {.render = lobe_app_view_render_options(&run->values->view),
                                .rounds = (int)run->values->rounds,
                                .user = run,
                                .on_progress = show_progress};
    o.render.reflection.model = run->model;
    o.render.samples = (uint32_t)run->values->spp;
    o.render.threads = threads;
    lobe_ray_bench b;
    const lobe_render_result result = lobe_ray_bench_run(scene, &o, &b);
    lobe_app_end_progress(&run->progress);
    if (result == LOBE_RENDER_INTERRUPTED) return LOBE_APP_INTERRUPTED;
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    if (run->rows)
        json_array_append_new(run->rows, json_row(name, &b));
    else
        print_row(name, &b);
    run->done++;
    return LOBE_APP_DONE;
}

/* One thread and one a processor, unless one number was asked for. */
static int thread_counts(const bench_values *v, int counts[2]) {
    const int processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    counts[0] = v->view.threads > 0 ? (int)v->view.threads : 1;
    counts[1] = processors;
    return v->view.threads > 0 || processors < 2 ? 1 : 2;
}

static lobe_app_status bench_scene(bench_run *run, const char *name) {
    lobe_scene *scene = NULL;
    const lobe_render_result result =
        lobe_scene_load(name, lobe_app_view_scene_options(&run->values->view), &scene);
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    int counts[2];
    const int count = thread_counts(run->values, counts);
    lobe_app_status status = LOBE_APP_DONE;
    for (int i = 0; i < count && !status; i++) status = bench_threads(run, name, scene, counts[i]);
    lobe_scene_free(scene);
    return status;
}

static lobe_app_status bench_scenes(bench_run *run, char **names, int count) {
    lobe_app_status status = LOBE_APP_DONE;
    int counts[2];
    const int scenes = count ? count : (int)lobe_builtin_scene_count();
    run->all = scenes * thread_counts(run->values, counts);
    if (!run->rows)
        lobe_app_print("%-24s %7s %11s %10s %10s %10s %6s %7s %9s\n", "scene", "threads",
                       "Msamples/s", "rays/path", "Mrays/s", "raw", "ratio", "spread", "seconds");
    for (int i = 0; i < scenes && !status; i++)
        status = bench_scene(run, count ? names[i] : lobe_builtin_scene_name((size_t)i));
    if (!status && !run->rows)
        lobe_app_print("\nRates are a second of processor time; raw: the same rays through Embree "
                       "alone;\nratio: time of Embree alone / of the renderer, median of %d "
                       "rounds; seconds: of the wall clock.\n",
                       (int)run->values->rounds);
    return status;
}

static lobe_app_status check(const bench_values *v) {
    if (v->spp > LOBE_RENDER_SAMPLES_MAX)
        return lobe_app_reject("--spp", "use 1 to 16777216", "too many samples");
    if (v->rounds > ROUNDS_MAX)
        return lobe_app_reject("--rounds", "use 1 to 1000", "too many rounds");
    return lobe_app_check_view(&v->view);
}

lobe_app_status lobe_app_bench_render(int argc, char **argv) {
    bench_values values = {
        .view = lobe_app_default_view(), .spp = 4, .rounds = 5, .method = LOBE_METHOD_COUNT};
    values.view.size = (lobe_app_size){640, 360};
    const lobe_app_group groups[] = {
        {"Options", options, &values}, LOBE_APP_VIEW_GROUPS(&values.view), {0}};
    const lobe_app_command command = {
        "bench render",
        "[SCENE...] [OPTIONS]",
        "Traces the rays of a picture through Embree alone, and tells how much of the renderer's "
        "time that is.\n"
        "Without a scene: all built-in ones, at --size 640x360. Without --threads: one, and one a "
        "processor.",
        "SCENE...",
        groups,
        "lobe bench render gallery --threads 1"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    bench_run run = {.values = &values,
                     .progress = lobe_app_begin_progress(values.progress, "bench", "%")};
    status = lobe_app_choose_render_model(&values.view, values.method, &run.model);
    if (status || (status = check(&values))) return status;
    if (values.json) run.rows = json_array();
    lobe_app_catch_interrupt();
    status = bench_scenes(&run, arguments.operands, arguments.operand_count);
    lobe_app_end_progress(&run.progress);
    if (!status && run.rows) status = lobe_app_print_json(json_pack("{sO}", "rows", run.rows));
    json_decref(run.rows);
    return status;
}
