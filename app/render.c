/* app/render.c: `lobe render`: path-trace a scene. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/render.h>

#include "commands.h"
#include "interrupt.h"
#include "json.h"
#include "model.h"
#include "number.h"
#include "options.h"
#include "output.h"
#include "progress.h"

typedef struct render_values {
    const char *out, *environment, *camera, *reference;
    uint64_t spp, depth, seed, threads;
    double time_limit, exposure, rotation, material[5], floor;
    lobe_app_size size;
    uint32_t aovs;
    lobe_model model; /* of ndf, masking and method */
    int ndf, masking, method, g2, normalization, heuristic, multiscatter, progress;
    bool strict, ground, list_scenes, json;
} render_values;

static const char *const heuristics[] = {"balance", "power", "bsdf-only", "light-only", NULL};
static const char *const multiscatters[] = {"none", "kulla-conty", "turquin", "walk", NULL};

#define AOV_NAME(ID, name, channels, about) " " name
#define AOV_NAMES LOBE_AOVS(AOV_NAME)

static bool read_aovs(const lobe_app_option *option, const char *text, void *value) {
    uint32_t *bits = value;
    *bits = 0;
    for (;;) {
        char name[32] = {0};
        const size_t length = strcspn(text, ",");
        if (length < sizeof name) memcpy(name, text, length);
        const lobe_aov aov = lobe_aov_from_name(name);
        if (aov == LOBE_AOV_COUNT) {
            lobe_app_report(option->name, "known, with commas between, are" AOV_NAMES,
                            "'%.40s' is not a channel", text);
            return false;
        }
        *bits |= LOBE_AOV_BIT(aov);
        if (text[length] == '\0') return true;
        text += length + 1;
    }
}

static bool read_material(const lobe_app_option *option, const char *text, void *value) {
    if (lobe_app_read_numbers(text, 5, 5, value) == 5) return true;
    lobe_app_report(option->name, "give R,G,B,METALLIC,ROUGHNESS, each in [0, 1]",
                    "'%.60s' is not a material", text);
    return false;
}

#define AT(member) offsetof(render_values, member)

static const lobe_app_option picture_options[] = {
    {"-o", "FILE", NULL, "the picture: .exr, .png, .hdr or .pfm", lobe_app_read_name, AT(out),
     NULL},
    {"--size", "WxH", "960x540", "in pixels", lobe_app_read_size, AT(size), NULL},
    {"--spp", "N", "64", "camera paths a pixel", lobe_app_read_count, AT(spp), NULL},
    {"--time", "S", "none",
     "seconds after which to stop with what is finished, if --spp is not reached before",
     lobe_app_read_f64, AT(time_limit), NULL},
    {"--depth", "N", "8", "greatest number of surface scatterings on a path", lobe_app_read_u64,
     AT(depth), NULL},
    {"--seed", "S", "0", "of the random numbers, any whole number", lobe_app_read_u64, AT(seed),
     NULL},
    {"--threads", "N", "one a processor", "the picture does not depend on it", lobe_app_read_count,
     AT(threads), NULL},
    {"--exposure", "EV", "0", "stops, for the written picture", lobe_app_read_f64, AT(exposure),
     NULL},
    {"--aov", "LIST", "none", "more channels for .exr, with commas between:" AOV_NAMES, read_aovs,
     AT(aovs), NULL},
    {"--camera", "NAME", "the first", "a camera of the file", lobe_app_read_name, AT(camera), NULL},
    {0}};

static const lobe_app_option scene_options[] = {
    {"--env", "FILE", "the scene's own light, or a sky", "panorama to light with",
     lobe_app_read_name, AT(environment), NULL},
    {"--env-rotate", "DEG", "0", "degrees about +Y", lobe_app_read_f64, AT(rotation), NULL},
    {"--material", "R,G,B,M,R", "0.8,0.8,0.8,0,0.5",
     "colour, metallic and roughness of meshes that bring no material", read_material, AT(material),
     NULL},
    {"--ground", NULL, NULL, "put a large matte floor below a file's scene", NULL, AT(ground),
     NULL},
    {"--strict", NULL, NULL, "a warning is an error", NULL, AT(strict), NULL},
    {"--list-scenes", NULL, NULL, "print the built-in scenes and stop", NULL, AT(list_scenes),
     NULL},
    {0}};

static const lobe_app_option method_options[] = {
    {"--ndf", "NAME", "ggx", "distribution of normals", lobe_app_read_choice, AT(ndf),
     lobe_app_ndfs},
    {"--masking", "NAME", "smith", "masking of the microsurface", lobe_app_read_choice, AT(masking),
     lobe_app_maskings},
    {"--method", "NAME", "by surface, else the best for the model", "how to sample reflection",
     lobe_app_read_choice, AT(method), lobe_app_methods},
    {"--floor", "D", "0.25", "method horizon: how much of the density ignores shadowing, in [0, 1]",
     lobe_app_read_floor, AT(floor), NULL},
    {"--g2", "NAME", "correlated", "masking and shadowing", lobe_app_read_choice, AT(g2),
     lobe_app_g2s},
    {"--normalization", "NAME", "unbiased", "of the densities behind a shading normal",
     lobe_app_read_choice, AT(normalization), lobe_app_normalizations},
    {"--multiscatter", "NAME", "none",
     "what metals and glass scatter more than once: an approximation, or random walks",
     lobe_app_read_choice, AT(multiscatter), multiscatters},
    {"--heuristic", "NAME", "balance", "how light and surface samples are combined",
     lobe_app_read_choice, AT(heuristic), heuristics},
    {0}};

static const lobe_app_option output_options[] = {
    {"--reference", "FILE", NULL, "print the error against this picture", lobe_app_read_name,
     AT(reference), NULL},
    {"--json", NULL, NULL, "statistics as JSON on standard output", NULL, AT(json), NULL},
    LOBE_APP_PROGRESS_OPTION(render_values, progress),
    {0}};

static render_values default_values(void) {
    const lobe_render_options r = lobe_render_default_options();
    return (render_values){.spp = r.samples,
                           .depth = (uint64_t)r.depth,
                           .size = {r.width, r.height},
                           .method = LOBE_METHOD_COUNT,
                           .floor = r.reflection.floor,
                           .heuristic = (int)r.heuristic,
                           .material = {0.8, 0.8, 0.8, 0, 0.5}};
}

static lobe_app_status list_scenes(bool json) {
    lobe_app_status status = LOBE_APP_DONE;
    for (size_t i = 0; lobe_builtin_scene_name(i) && !status; i++) {
        const char *name = lobe_builtin_scene_name(i), *about = lobe_builtin_scene_about(i);
        if (json)
            status = lobe_app_print_json(json_pack("{ss ss}", "name", name, "about", about));
        else
            lobe_app_print("%-15s%s\n", name, about);
    }
    return status;
}

static void print_warning(void *user, const char *message) {
    (void)user;
    lobe_app_report_line(message);
}

static lobe_app_status failed(lobe_render_result result) {
    lobe_app_report_line(lobe_render_error_message());
    return result == LOBE_RENDER_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
}

/* What the progress callback needs. */
typedef struct render_run {
    double time_limit; /* seconds; 0: none */
    lobe_app_progress progress;
} render_run;

/* Whichever of the samples and the time comes first ends the work. */
static void show_progress(void *user, const lobe_render_progress *p) {
    render_run *run = user;
    const double time_share = run->time_limit > 0 ? fmin(p->seconds / run->time_limit, 1) : 0;
    lobe_app_show_progress(&run->progress, fmax(p->fraction, time_share), (double)p->samples);
}

static lobe_render_options render_options(const render_values *v, render_run *run) {
    lobe_render_options r = lobe_render_default_options();
    r.reflection.model = v->model;
    r.reflection.floor = v->floor;
    r.reflection.g2 = (lobe_g2)v->g2;
    r.reflection.normalization = (lobe_normalization)v->normalization;
    r.width = v->size.width;
    r.height = v->size.height;
    r.samples = (uint32_t)v->spp;
    r.depth = (int)v->depth;
    r.seed = v->seed;
    r.threads = (int)v->threads;
    r.time_limit = v->time_limit;
    r.camera = v->camera;
    r.heuristic = (lobe_heuristic)v->heuristic;
    r.multiscatter = (lobe_multiscatter)v->multiscatter;
    r.aovs = v->aovs;
    r.progress = show_progress;
    r.progress_user = run;
    r.cancel = &lobe_app_interrupted;
    return r;
}

static lobe_scene_options scene_options_of(const render_values *v) {
    lobe_scene_options s = lobe_scene_default_options();
    s.environment = v->environment;
    s.environment_rotation = (float)v->rotation;
    s.strict = v->strict;
    s.ground = v->ground;
    for (int c = 0; c < 3; c++) s.default_base_color[c] = (float)v->material[c];
    s.default_metallic = (float)v->material[3];
    s.default_roughness = (float)v->material[4];
    s.warning = print_warning;
    return s;
}

static json_t *json_statistics(const render_values *v, const char *scene,
                               const lobe_render_statistics *st) {
    return json_pack(
        "{so ss si si si sI si sI sI sI sI so so so}", "scene", lobe_app_json_text(scene), "method",
        lobe_render_method_name(v->model.method), "width", v->size.width, "height", v->size.height,
        "spp", (int)st->pixel_samples, "samples", (json_int_t)st->samples, "threads", st->threads,
        "rays", (json_int_t)st->rays, "draws", (json_int_t)st->ggx_draws, "rejected",
        (json_int_t)st->ggx_rejected, "dropped", (json_int_t)st->dropped_samples, "rejected_share",
        lobe_app_json_number(st->rejected_share), "seconds", lobe_app_json_number(st->seconds),
        "cpu_seconds", lobe_app_json_number(st->cpu_seconds));
}

static json_t *json_error(const lobe_film_difference *d) {
    return json_pack("{so so so so so}", "rmse", lobe_app_json_number(d->rmse), "relmse",
                     lobe_app_json_number(d->relative_mse), "mean", lobe_app_json_number(d->mean),
                     "mean_reference", lobe_app_json_number(d->mean_reference), "largest",
                     lobe_app_json_number(d->largest));
}

/* What was measured, with the error against the reference if there is one. */
static lobe_app_status print_statistics(const render_values *v, const char *scene,
                                        const lobe_render_statistics *st,
                                        const lobe_film_difference *d) {
    if (v->json) {
        json_t *object = json_statistics(v, scene, st);
        if (object && v->reference) json_object_set_new(object, "error", json_error(d));
        return lobe_app_print_json(object);
    }
    if (v->reference)
        lobe_app_print("rmse %.6g, relative mse %.6g, mean %.6g of %.6g\n", d->rmse,
                       d->relative_mse, d->mean, d->mean_reference);
    return LOBE_APP_DONE;
}

/* The picture to compare with, read before the work; an empty `film` if none was asked for. */
static lobe_app_status read_reference(const render_values *v, lobe_film **film) {
    *film = NULL;
    if (!v->reference) return LOBE_APP_DONE;
    const lobe_render_result result = lobe_film_read(v->reference, film);
    if (result != LOBE_RENDER_OK) return failed(result);
    if (lobe_film_width(*film) == v->size.width && lobe_film_height(*film) == v->size.height)
        return LOBE_APP_DONE;
    return lobe_app_reject(v->reference, "render it at the same --size",
                           "%d x %d pixels, not %d x %d", lobe_film_width(*film),
                           lobe_film_height(*film), v->size.width, v->size.height);
}

static lobe_app_status finish_picture(const render_values *v, const char *scene,
                                      const lobe_film *film, const lobe_film *reference,
                                      const lobe_render_statistics *st) {
    lobe_film_write_options write = lobe_film_default_write_options();
    lobe_film_difference difference = {0};
    write.exposure = (float)v->exposure;
    lobe_render_result result = LOBE_RENDER_OK;
    if (v->out) result = lobe_film_write(film, v->out, write);
    if (result == LOBE_RENDER_OK && reference)
        result = lobe_film_compare(film, reference, &difference);
    if (result != LOBE_RENDER_OK) return failed(result);
    return print_statistics(v, scene, st, &difference);
}

static lobe_app_status render_scene(const render_values *v, const char *source,
                                    const lobe_scene *scene, const lobe_film *reference) {
    lobe_film *film = NULL;
    lobe_render_statistics statistics;
    render_run run = {v->time_limit, lobe_app_begin_progress(v->progress, "render", "samples")};
    const lobe_render_result result =
        lobe_render(scene, render_options(v, &run), &film, &statistics);
    lobe_app_end_progress(&run.progress);
    if (!film) return failed(result);
    lobe_app_status status = LOBE_APP_DONE;
    if (statistics.samples > 0) /* else a black picture would replace an older one */
        status = finish_picture(v, source, film, reference, &statistics);
    if (status == LOBE_APP_DONE && result == LOBE_RENDER_INTERRUPTED) status = LOBE_APP_INTERRUPTED;
    lobe_film_free(film);
    return status;
}

static lobe_app_status render(const render_values *v, const char *source) {
    lobe_film *reference = NULL;
    lobe_scene *scene = NULL;
    lobe_app_catch_interrupt();
    lobe_app_status status = read_reference(v, &reference);
    if (!status) {
        const lobe_render_result result = lobe_scene_load(source, scene_options_of(v), &scene);
        status =
            result == LOBE_RENDER_OK ? render_scene(v, source, scene, reference) : failed(result);
    }
    lobe_scene_free(scene);
    lobe_film_free(reference);
    return status;
}

static bool ends_with(const char *path, const char *ending) {
    const size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

/* What would make the picture impossible to write after all the work. */
static lobe_app_status check_picture(const render_values *v) {
    if (!lobe_film_can_write(v->out))
        return lobe_app_reject(v->out, "end the name with .exr, .png, .hdr or .pfm",
                               "unknown picture format");
    if (v->aovs && !ends_with(v->out, ".exr"))
        return lobe_app_reject("--aov", "end the name with .exr", "%.200s cannot hold channels",
                               v->out);
    if ((int64_t)v->size.width * v->size.height > LOBE_FILM_PNG_PIXELS_MAX &&
        ends_with(v->out, ".png"))
        return lobe_app_reject("--size", "end the name with .exr, .hdr or .pfm",
                               "too large for .png");
    struct stat status;
    const bool exists = stat(v->out, &status) == 0;
    const char *slash = strrchr(v->out, '/');
    char folder[PATH_MAX] = ".";
    if (slash) snprintf(folder, sizeof folder, "%.*s/", (int)(slash - v->out), v->out);
    if (exists && S_ISDIR(status.st_mode))
        errno = EISDIR;
    else if (access(folder, W_OK | X_OK) == 0)
        return LOBE_APP_DONE;
    lobe_app_report(v->out, "choose another place", "cannot be written (%s)", strerror(errno));
    return LOBE_APP_FAILED;
}

static lobe_app_status check(const render_values *v, const lobe_app_arguments *arguments) {
    if (!arguments->operand)
        return lobe_app_reject("render", "give a file or a name of --list-scenes", "no scene");
    if (!v->out && !v->reference && !v->json)
        return lobe_app_reject("-o", "give a file name, as -o picture.png", "no picture to write");
    if (v->aovs && !v->out)
        return lobe_app_reject("--aov", "give -o FILE.exr", "no picture to hold the channels");
    if (v->spp > LOBE_RENDER_SAMPLES_MAX)
        return lobe_app_reject("--spp", "use 1 to 16777216", "too many samples");
    if (v->depth > 1000000) return lobe_app_reject("--depth", "use 0 to 1000000", "too deep");
    if (v->threads > 1024) return lobe_app_reject("--threads", "use 1 to 1024", "too many threads");
    if (!(fabs(v->exposure) <= 100))
        return lobe_app_reject("--exposure", "use -100 to 100", "out of range");
    if (!(fabs(v->rotation) <= 36000))
        return lobe_app_reject("--env-rotate", "use degrees, at most 36000", "out of range");
    for (int k = 0; k < 5; k++)
        if (!(v->material[k] >= 0 && v->material[k] <= 1))
            return lobe_app_reject("--material", "each number lies in [0, 1]", "out of range");
    if (v->size.width < 1 || v->size.width > LOBE_RENDER_SIZE_MAX || v->size.height < 1 ||
        v->size.height > LOBE_RENDER_SIZE_MAX)
        return lobe_app_reject("--size", "use 1x1 to 32768x32768", "out of range");
    if (v->time_limit < 0) return lobe_app_reject("--time", "give seconds", "a negative time");
    return v->out ? check_picture(v) : LOBE_APP_DONE;
}

lobe_app_status lobe_app_render(int argc, char **argv) {
    render_values values = default_values();
    const lobe_app_group groups[] = {{"Picture", picture_options, &values},
                                     {"Scene", scene_options, &values},
                                     {"Method", method_options, &values},
                                     {"Output", output_options, &values},
                                     {0}};
    const lobe_app_command command = {"render",
                                      "SCENE -o FILE [OPTIONS]",
                                      "Path-traces a scene: a file (glTF 2.0, OBJ, what else the "
                                      "importer reads) or a built-in one.\n"
                                      "Ctrl-C saves what is finished. The same seed gives the same "
                                      "picture on any number of threads.",
                                      "SCENE",
                                      groups,
                                      "lobe render gallery -o gallery.png --spp 64"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if (values.list_scenes) return list_scenes(values.json);
    status = lobe_app_choose_model(values.ndf, values.masking, values.method, &values.model);
    if (status || (status = lobe_app_check_floor(&arguments, values.model))) return status;
    /* the choice by surface; any other distribution has one best method */
    const bool has_choice = values.ndf == LOBE_NDF_GGX && values.masking == LOBE_MASKING_SMITH;
    if (values.method == LOBE_METHOD_COUNT && has_choice) values.model.method = LOBE_METHOD_COUNT;
    if ((status = check(&values, &arguments))) return status;
    return render(&values, arguments.operand);
}
