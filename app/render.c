/* app/render.c: `lobe render`: path-trace a scene. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lobe/camera_path.h>

#include "commands.h"
#include "frames.h"
#include "interrupt.h"
#include "json.h"
#include "model.h"
#include "options.h"
#include "output.h"
#include "progress.h"
#include "view.h"

typedef struct picture_part {
    uint32_t part, parts;
} picture_part;

typedef struct render_values {
    lobe_app_view view;
    const char *out, *reference, *checkpoint, *resume;
    const char *camera_path;
    lobe_camera_path *path; /* what it holds; NULL: none */
    uint64_t spp, orbit;    /* orbit: 0: none */
    picture_part part;
    double checkpoint_every, noise, time_limit;
    double footprint; /* negative: by --spp */
    uint32_t aovs;
    lobe_model model; /* of ndf, masking and method */
    int method, progress, lights;
    bool list_scenes, json, keep_seconds, adaptive;
} render_values;

/* One of the pictures of a call. */
typedef struct picture {
    int number; /* from 1; 0: it is the only one */
    const char *out, *checkpoint, *resume;
    const lobe_view *view, *previous; /* NULL: the camera of the options */
    float focus;                      /* 0: that of the options */
} picture;

#define AOV_NAME(ID, name, channels, about) " " name
#define AOV_NAMES LOBE_AOVS(AOV_NAME)

static bool read_part(const lobe_app_option *option, const char *text, void *value) {
    picture_part *part = value;
    char extra;
    if (strspn(text, "0123456789/") == strlen(text) && strlen(text) < 16 &&
        sscanf(text, "%u/%u%c", &part->part, &part->parts, &extra) == 2 && part->part >= 1 &&
        part->part <= part->parts && part->parts <= 1000000)
        return true;
    lobe_app_report(option->name, "give K/N, as 1/4 to 4/4, N at most 1000000",
                    "'%.40s' is not a part", text);
    return false;
}

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

#define AT(member) offsetof(render_values, member)

static const char *const light_choices[] = {"auto", "power", "tree", NULL};

static const lobe_app_option picture_options[] = {
    {"-o", "FILE", NULL, "the picture: .exr, .png, .hdr or .pfm", lobe_app_read_name, AT(out),
     NULL},
    {"--spp", "N", "64", "camera paths a pixel", lobe_app_read_count, AT(spp), NULL},
    {"--time", "S", "none",
     "seconds after which to stop with what is finished, if --spp is not reached before",
     lobe_app_read_f64, AT(time_limit), NULL},
    {"--noise", "LEVEL", "none",
     "stop when the estimated relative standard error of the pixels is at most this, as 0.05",
     lobe_app_read_f64, AT(noise), NULL},
    {"--adaptive", NULL, NULL,
     "more samples where noise is, --spp in the mean; 64 or more (docs/adaptive.md)", NULL,
     AT(adaptive), NULL},
    {"--footprint", "SHARE", "1/sqrt(spp), at least 1/8",
     "over how much of a pixel textures are averaged, as a width; 0: texels as they are",
     lobe_app_read_f64, AT(footprint), NULL},
    {"--lights", "HOW", "auto",
     "how one of many lamps and glowing triangles is chosen: power, tree, or auto, a tree from 16 "
     "on",
     lobe_app_read_choice, AT(lights), light_choices},
    {"--aov", "LIST", "none", "more channels for .exr, with commas between:" AOV_NAMES, read_aovs,
     AT(aovs), NULL},
    {"--method", "NAME", "by surface, else the best for the model", "how to sample reflection",
     lobe_app_read_choice, AT(method), lobe_app_methods},
    {"--list-scenes", NULL, NULL, "print the built-in scenes and stop", NULL, AT(list_scenes),
     NULL},
    {0}};

static const lobe_app_option sequence_options[] = {
    {"--orbit", "N", "none",
     "a turntable: N pictures from around the middle of the scene, FILE.0001.exr and on",
     lobe_app_read_count, AT(orbit), NULL},
    {"--camera-path", "FILE", "none",
     "a picture for each camera of a JSON file (docs/camera.md, docs/gbuffer.md), numbered "
     "likewise",
     lobe_app_read_name, AT(camera_path), NULL},
    {0}};

static const lobe_app_option long_options[] = {
    {"--checkpoint", "FILE", NULL, "keep what is finished in FILE, now and then and at the end",
     lobe_app_read_name, AT(checkpoint), NULL},
    {"--checkpoint-every", "S", "60", "seconds from one checkpoint to the next", lobe_app_read_f64,
     AT(checkpoint_every), NULL},
    {"--resume", "FILE", NULL,
     "go on from a checkpoint of the same scene and options, to the same bits; a missing one "
     "starts "
     "anew if it is --checkpoint too",
     lobe_app_read_name, AT(resume), NULL},
    {"--part", "K/N", "1/1", "render the K-th of N shares of the picture; lobe merge joins them",
     read_part, AT(part), NULL},
    {0}};

static const lobe_app_option output_options[] = {
    {"--reference", "FILE", NULL, "print the error against this picture", lobe_app_read_name,
     AT(reference), NULL},
    {"--json", NULL, NULL, "statistics as JSON on standard output", NULL, AT(json), NULL},
    {"--keep-seconds", NULL, NULL,
     "write the time taken into the .exr, which makes every file another one", NULL,
     AT(keep_seconds), NULL},
    LOBE_APP_PROGRESS_OPTION(render_values, progress),
    {0}};

static render_values default_values(void) {
    const lobe_render_options r = lobe_render_default_options();
    return (render_values){.view = lobe_app_default_view(),
                           .spp = r.samples,
                           .method = LOBE_METHOD_COUNT,
                           .footprint = r.footprint,
                           .part = {r.part, r.parts},
                           .checkpoint_every = r.checkpoint_seconds};
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

/* What the progress callback needs. */
typedef struct render_run {
    double time_limit; /* seconds; 0: none */
    lobe_app_progress progress;
    bool has_begun, has_failed_to_save;
    int index, count; /* of the picture */
    double samples;   /* of the pictures before */
    char label[48];
} render_run;

/* Whichever of the samples and the time comes first ends the work. */
static void show_progress(void *user, const lobe_render_progress *p) {
    render_run *run = user;
    const double work = run->samples + (double)p->samples;
    if (!run->has_begun) {
        run->has_begun = true;
        run->progress.fraction_before = (run->index + p->fraction) / run->count;
        run->progress.work_before = work;
    }
    const double time_share = run->time_limit > 0 ? fmin(p->seconds / run->time_limit, 1) : 0;
    const double share = fmax(p->fraction, time_share);
    lobe_app_show_progress(&run->progress, (run->index + share) / run->count, work);
}

static render_run begin_run(const render_values *v, int count) {
    return (render_run){.time_limit = v->time_limit,
                        .progress = lobe_app_begin_progress(v->progress, "render", "samples"),
                        .count = count};
}

/* Pictures go on without a checkpoint, but that is not what was asked for. */
static lobe_app_status end_run(const render_run *run, lobe_app_status status) {
    return !status && run->has_failed_to_save ? LOBE_APP_FAILED : status;
}

static lobe_render_options render_options(const render_values *v, const picture *picture,
                                          render_run *run) {
    lobe_render_options r = lobe_app_view_render_options(&v->view);
    r.view = picture->view;
    r.previous_view = picture->previous;
    if (picture->focus > 0) r.focus = picture->focus;
    r.reflection.model = v->model;
    r.samples = (uint32_t)v->spp;
    r.time_limit = v->time_limit;
    r.aovs = v->aovs;
    r.progress = show_progress;
    r.progress_user = run;
    r.noise = v->noise;
    r.light_choice = (lobe_light_choice)v->lights;
    r.footprint = (float)v->footprint;
    r.is_adaptive = v->adaptive;
    r.checkpoint = picture->checkpoint;
    r.checkpoint_seconds = v->checkpoint_every;
    r.resume = picture->resume;
    r.part = v->part.part;
    r.parts = v->part.parts;
    return r;
}

static json_t *json_statistics(const render_values *v, const char *scene,
                               const lobe_render_statistics *st) {
    return json_pack(
        "{so ss si si si sI si sI sI sI sI so so so so}", "scene", lobe_app_json_text(scene),
        "method", lobe_render_method_name(v->model.method), "width", v->view.size.width, "height",
        v->view.size.height, "spp", (int)st->pixel_samples, "samples", (json_int_t)st->samples,
        "threads", st->threads, "rays", (json_int_t)st->rays, "draws", (json_int_t)st->ggx_draws,
        "rejected", (json_int_t)st->ggx_rejected, "dropped", (json_int_t)st->dropped_samples,
        "rejected_share", lobe_app_json_number(st->rejected_share), "seconds",
        lobe_app_json_number(st->seconds), "cpu_seconds", lobe_app_json_number(st->cpu_seconds),
        "noise", lobe_app_json_number(st->noise));
}

static json_t *json_error(const lobe_picture_difference *d) {
    return json_pack("{so so so so so}", "rmse", lobe_app_json_number(d->rmse), "relmse",
                     lobe_app_json_number(d->relative_mse), "mean", lobe_app_json_number(d->mean),
                     "mean_reference", lobe_app_json_number(d->mean_reference), "largest",
                     lobe_app_json_number(d->largest));
}

/* What was measured, with the error against the reference if there is one. */
static lobe_app_status print_statistics(const render_values *v, const char *scene, int number,
                                        const lobe_render_statistics *st,
                                        const lobe_picture_difference *d) {
    if (v->json) {
        json_t *object = json_statistics(v, scene, st);
        if (object && v->reference) json_object_set_new(object, "error", json_error(d));
        if (object && number) json_object_set_new(object, "frame", json_integer(number));
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
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    if (lobe_film_width(*film) == v->view.size.width &&
        lobe_film_height(*film) == v->view.size.height)
        return LOBE_APP_DONE;
    return lobe_app_reject(v->reference, "render it at the same --size",
                           "%d x %d pixels, not %d x %d", lobe_film_width(*film),
                           lobe_film_height(*film), v->view.size.width, v->view.size.height);
}

static lobe_app_status finish_picture(const render_values *v, const char *scene,
                                      const picture *picture, const lobe_film *film,
                                      const lobe_film *reference,
                                      const lobe_render_statistics *st) {
    lobe_film_write_options write = lobe_film_default_write_options();
    lobe_picture_difference difference = {0};
    write.exposure = (float)v->view.exposure;
    write.keep_seconds = v->keep_seconds;
    write.durable = picture->number && picture->checkpoint;
    lobe_render_result result = LOBE_RENDER_OK;
    if (picture->out) result = lobe_film_write(film, picture->out, write);
    if (result == LOBE_RENDER_OK && reference)
        result = lobe_film_compare(film, reference, &difference);
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    return print_statistics(v, scene, picture->number, st, &difference);
}

static lobe_app_status render_picture(const render_values *v, const char *source,
                                      const lobe_scene *scene, const picture *picture,
                                      render_run *run, const lobe_film *reference) {
    lobe_film *film = NULL;
    lobe_render_statistics statistics;
    const lobe_render_result result =
        lobe_render(scene, render_options(v, picture, run), &film, &statistics);
    lobe_app_end_progress(&run->progress);
    if (!film && result == LOBE_RENDER_OK) return LOBE_APP_DONE; /* rank 0 has it */
    if (!film) return lobe_app_render_failed(result);
    lobe_app_status status = LOBE_APP_DONE;
    if (statistics.samples > 0) /* else a black picture would replace an older one */
        status = finish_picture(v, source, picture, film, reference, &statistics);
    run->samples += (double)statistics.samples;
    if (status == LOBE_APP_DONE && result == LOBE_RENDER_INTERRUPTED) status = LOBE_APP_INTERRUPTED;
    run->has_failed_to_save |= statistics.has_failed_to_save;
    lobe_film_free(film);
    return status;
}

static lobe_app_status render_alone(const render_values *v, const char *source,
                                    const lobe_scene *scene, const lobe_film *reference) {
    const picture picture = {.out = v->out, .checkpoint = v->checkpoint, .resume = v->resume};
    render_run run = begin_run(v, 1);
    return end_run(&run, render_picture(v, source, scene, &picture, &run, reference));
}

/* What one rank cannot do, none does: they would wait for it. */
static lobe_app_status agree(lobe_app_status status) {
    const bool is_good = status == LOBE_APP_DONE;
    const lobe_render_result own =
        status == LOBE_APP_FAILED ? LOBE_RENDER_FAILED : LOBE_RENDER_BAD_INPUT;
    const lobe_render_result all = lobe_ranks_agree(is_good ? LOBE_RENDER_OK : own);
    return is_good && all != LOBE_RENDER_OK ? lobe_app_render_failed(all) : status;
}

/* ---- Several pictures ------------------------------------------------------------------------ */

/* A picture of a sequence: its names and view. */
typedef struct numbered {
    picture picture;
    char out[LOBE_APP_FRAME_NAME], checkpoint[LOBE_APP_FRAME_NAME], resume[LOBE_APP_FRAME_NAME];
    lobe_view view, previous;
} numbered;

/* 0: one picture alone. */
static int count_frames(const render_values *v) {
    return v->path ? lobe_camera_path_count(v->path) : (int)v->orbit;
}

static lobe_app_status name_files(const render_values *v, numbered *n) {
    picture *p = &n->picture;
    const bool fits =
        (!v->out || lobe_app_frame_picture(n->out, v->out, p->number)) &&
        (!v->checkpoint || lobe_app_frame_checkpoint(n->checkpoint, v->checkpoint, p->number)) &&
        (!v->resume || lobe_app_frame_checkpoint(n->resume, v->resume, p->number));
    if (!fits) return lobe_app_reject("-o", "use shorter names", "a name is too long");
    p->out = v->out ? n->out : NULL;
    p->checkpoint = v->checkpoint ? n->checkpoint : NULL;
    p->resume = v->resume ? n->resume : NULL;
    return LOBE_APP_DONE;
}

/* The focus of a turntable does not move. */
static lobe_render_result aim_on_turntable(const render_values *v, const lobe_scene *scene,
                                           numbered *n) {
    const int count = count_frames(v), index = n->picture.number - 1;
    const float aspect = (float)v->view.size.width / (float)v->view.size.height;
    lobe_view first;
    lobe_render_result result = lobe_scene_orbit(scene, v->view.camera, aspect, 0, count, &first);
    if (result == LOBE_RENDER_OK)
        result = lobe_scene_orbit(scene, v->view.camera, aspect, index, count, &n->view);
    if (result == LOBE_RENDER_OK)
        result = lobe_scene_orbit(scene, v->view.camera, aspect, index ? index - 1 : 0, count,
                                  &n->previous);
    if (result == LOBE_RENDER_OK && isnan(v->view.focus))
        n->picture.focus = lobe_scene_focus(scene, &first);
    return result;
}

static lobe_app_status aim_picture(const render_values *v, const lobe_scene *scene, numbered *n) {
    n->picture.view = &n->view;
    n->picture.previous = &n->previous;
    if (v->path) {
        const lobe_path_frame *frame = lobe_camera_path_get(v->path, n->picture.number - 1);
        n->view = frame->camera.view;
        n->previous = frame->previous.view;
        if (isnan(v->view.focus)) n->picture.focus = frame->camera.focus;
        return LOBE_APP_DONE;
    }
    const lobe_render_result result = aim_on_turntable(v, scene, n);
    return result == LOBE_RENDER_OK ? LOBE_APP_DONE : lobe_app_render_failed(result);
}

static lobe_app_status find_finished(const render_values *v, const lobe_scene *scene,
                                     const picture *p, render_run *run, int *is_finished) {
    *is_finished = 0;
    if (!p->out) return LOBE_APP_DONE;
    const lobe_render_result result = lobe_render_find_finished(
        scene, render_options(v, p, run), p->out, (float)v->view.exposure, is_finished);
    return result == LOBE_RENDER_OK ? LOBE_APP_DONE : lobe_app_render_failed(result);
}

/* It is of no use any more once the picture tells all that it does. */
static lobe_app_status drop_checkpoint(const render_values *v, const lobe_scene *scene,
                                       const picture *p, render_run *run) {
    int is_finished;
    if (!p->checkpoint) return LOBE_APP_DONE;
    const lobe_app_status status = find_finished(v, scene, p, run, &is_finished);
    if (is_finished) unlink(p->checkpoint);
    return status;
}

static lobe_app_status tell_finished(const render_values *v, const picture *p) {
    if (!v->json) return LOBE_APP_DONE;
    return lobe_app_print_json(json_pack("{si sb}", "frame", p->number, "was_finished", (int)true));
}

/* Of the pictures that come after the one that was stopped there is no checkpoint yet. */
static bool is_missing(const char *path) {
    return access(path, F_OK) != 0 && errno == ENOENT;
}

/* One of them; `is_going_on`: something of an earlier run was found. */
static lobe_app_status render_numbered(const render_values *v, const char *source,
                                       const lobe_scene *scene, numbered *n, render_run *run,
                                       bool *is_going_on) {
    picture *p = &n->picture;
    int is_finished = 0;
    lobe_app_status status = name_files(v, n);
    if (!status) status = aim_picture(v, scene, n);
    if (!status && v->resume) status = find_finished(v, scene, p, run, &is_finished);
    if (!status && v->resume && *is_going_on && is_missing(n->resume)) p->resume = NULL;
    *is_going_on = true;
    if (status) return status;
    if (is_finished) return agree(tell_finished(v, p));
    status = render_picture(v, source, scene, p, run, NULL);
    if (status == LOBE_APP_INTERRUPTED || lobe_app_interrupted) return LOBE_APP_INTERRUPTED;
    status = agree(status);
    return status ? status : drop_checkpoint(v, scene, p, run);
}

static lobe_app_status render_sequence(const render_values *v, const char *source,
                                       const lobe_scene *scene) {
    const int count = count_frames(v);
    render_run run = begin_run(v, count);
    lobe_app_status status = LOBE_APP_DONE;
    bool is_going_on = false;
    run.progress.label = run.label;
    for (int i = 0; i < count && !status; i++) {
        numbered n = {.picture.number = i + 1};
        run.index = i;
        snprintf(run.label, sizeof run.label, "frame %d/%d", i + 1, count);
        status = render_numbered(v, source, scene, &n, &run, &is_going_on);
    }
    return end_run(&run, status);
}

static lobe_app_status render_scene(const render_values *v, const char *source,
                                    const lobe_scene *scene, const lobe_film *reference) {
    return count_frames(v) ? render_sequence(v, source, scene)
                           : render_alone(v, source, scene, reference);
}

static lobe_app_status render(const render_values *v, const char *source) {
    lobe_film *reference = NULL;
    lobe_scene *scene = NULL;
    lobe_app_catch_interrupt();
    lobe_app_status status = agree(read_reference(v, &reference));
    if (!status) {
        const lobe_render_result result =
            lobe_ranks_agree(lobe_app_load_scene(&v->view, v->progress, source, &scene));
        status = result == LOBE_RENDER_OK ? render_scene(v, source, scene, reference)
                                          : lobe_app_render_failed(result);
    }
    lobe_scene_free(scene);
    lobe_film_free(reference);
    return status;
}

static bool ends_with(const char *path, const char *ending) {
    const size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

/* Whether a file can be put there. */
static lobe_app_status check_place(const char *path) {
    struct stat status;
    const bool exists = stat(path, &status) == 0;
    const char *slash = strrchr(path, '/');
    char folder[PATH_MAX] = ".";
    if (slash) snprintf(folder, sizeof folder, "%.*s/", (int)(slash - path), path);
    if (exists && S_ISDIR(status.st_mode))
        errno = EISDIR;
    else if (access(folder, W_OK | X_OK) == 0)
        return LOBE_APP_DONE;
    lobe_app_report(path, "choose another place", "cannot be written (%s)", strerror(errno));
    return LOBE_APP_FAILED;
}

/* What would make the picture impossible to write after all the work. */
static lobe_app_status check_picture(const render_values *v) {
    if (!lobe_film_can_write(v->out))
        return lobe_app_reject(v->out, "end the name with .exr, .png, .hdr or .pfm",
                               "unknown picture format");
    if (v->aovs && !ends_with(v->out, ".exr"))
        return lobe_app_reject("--aov", "end the name with .exr", "%.200s cannot hold channels",
                               v->out);
    if ((int64_t)v->view.size.width * v->view.size.height > LOBE_FILM_PNG_PIXELS_MAX &&
        ends_with(v->out, ".png"))
        return lobe_app_reject("--size", "end the name with .exr, .hdr or .pfm",
                               "too large for .png");
    return check_place(v->out);
}

static lobe_app_status check_checkpoint(const render_values *v) {
    if (v->checkpoint_every < 0)
        return lobe_app_reject("--checkpoint-every", "give seconds", "a negative time");
    if (!v->checkpoint) return LOBE_APP_DONE;
    if (v->out && strcmp(v->out, v->checkpoint) == 0)
        return lobe_app_reject("--checkpoint", "give it another name", "it is the picture's file");
    return check_place(v->checkpoint);
}

static lobe_app_status check_part(const render_values *v) {
    if (v->part.parts == 1) return LOBE_APP_DONE;
    if (v->noise > 0)
        return lobe_app_reject("--noise", "leave out one of the two",
                               "a --part does not know the noise of the others");
    if (v->adaptive)
        return lobe_app_reject("--adaptive", "leave out one of the two",
                               "a --part does not know the noise of the others");
    if (v->out && !ends_with(v->out, ".exr"))
        return lobe_app_reject(v->out, "end the name with .exr, or give --checkpoint",
                               "cannot say which pixels --part has rendered");
    return LOBE_APP_DONE;
}

/* Where several pictures come out of one call. */
static lobe_app_status check_sequence(const render_values *v) {
    const char *option = v->path ? "--camera-path" : "--orbit";
    if (!count_frames(v)) return LOBE_APP_DONE;
    if (v->orbit > LOBE_APP_FRAMES_MAX)
        return lobe_app_reject(option, "use 1 to 100000", "too many pictures");
    if (v->reference)
        return lobe_app_reject("--reference", "leave one of the two out",
                               "it is one picture, %s makes several", option);
    const bool tells = v->out && ends_with(v->out, ".exr");
    if (!tells && (v->checkpoint || v->resume))
        return lobe_app_reject(v->checkpoint ? "--checkpoint" : "--resume", "give -o FILE.exr",
                               "of several pictures only .exr tell that they are finished");
    return v->path ? lobe_app_check_shapes(v->camera_path, v->path, v->view.size) : LOBE_APP_DONE;
}

/* A path says where the camera is. */
static lobe_app_status read_path(render_values *v, const lobe_app_arguments *arguments) {
    if (!v->camera_path) return LOBE_APP_DONE;
    lobe_app_status status = lobe_app_exclude(arguments, "--camera-path", "--orbit");
    if (!status) status = lobe_app_exclude(arguments, "--camera-path", "--camera");
    if (status) return status;
    const lobe_render_result result = lobe_camera_path_read(v->camera_path, &v->path);
    return result == LOBE_RENDER_OK ? LOBE_APP_DONE : lobe_app_render_failed(result);
}

static lobe_app_status check(const render_values *v, const lobe_app_arguments *arguments) {
    if (!arguments->operand)
        return lobe_app_reject("render", "give a file or a name of --list-scenes", "no scene");
    if (!v->out && !v->reference && !v->json && !v->checkpoint)
        return lobe_app_reject("-o", "give a file name, as -o picture.png", "no picture to write");
    if (v->aovs && !v->out)
        return lobe_app_reject("--aov", "give -o FILE.exr", "no picture to hold the channels");
    if (v->aovs & LOBE_AOV_BIT(LOBE_AOV_MOTION) && !count_frames(v))
        return lobe_app_reject("--aov", "give --orbit or --camera-path",
                               "one picture alone has no motion");
    if (v->spp > LOBE_RENDER_SAMPLES_MAX)
        return lobe_app_reject("--spp", "use 1 to 16777216", "too many samples");
    if (v->time_limit < 0) return lobe_app_reject("--time", "give seconds", "a negative time");
    if (v->noise < 0) return lobe_app_reject("--noise", "give 0.05 or so", "a negative noise");
    if (lobe_app_is_given(arguments, "--footprint") && !(v->footprint >= 0 && v->footprint <= 1000))
        return lobe_app_reject("--footprint", "use 0 to 1000 pixels", "out of range");
    if (v->adaptive && v->spp < 64)
        return lobe_app_reject("--adaptive", "use --spp 64 or more",
                               "too few samples to tell noise by");
    lobe_app_status status = lobe_app_check_view(&v->view);
    if (!status) status = check_sequence(v);
    if (!status) status = check_part(v);
    if (!status) status = check_checkpoint(v);
    return !status && v->out ? check_picture(v) : status;
}

static lobe_app_status run(int argc, char **argv) {
    render_values values = default_values();
    const lobe_app_group groups[] = {
        {"Picture", picture_options, &values},   {"Several pictures", sequence_options, &values},
        {"Long renders", long_options, &values}, LOBE_APP_VIEW_GROUPS(&values.view),
        {"Output", output_options, &values},     {0}};
    const lobe_app_command command = {"render",
                                      "SCENE -o FILE [OPTIONS]",
                                      "Path-traces a scene: a file (glTF 2.0, OBJ, what else the "
                                      "importer reads) or a built-in one.\n"
                                      "Ctrl-C saves what is finished. The same seed gives the same "
                                      "picture on any number of threads\n"
                                      "and of processes (mpirun -n N lobe render ...).",
                                      "SCENE",
                                      groups,
                                      "lobe render gallery -o gallery.png --spp 64"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if (values.list_scenes) return list_scenes(values.json);
    status = lobe_app_choose_render_model(&values.view, values.method, &values.model);
    if (status || (status = lobe_app_check_floor(&arguments, values.model))) return status;
    status = read_path(&values, &arguments);
    if (!status) status = check(&values, &arguments);
    if (!(status = agree(status))) status = render(&values, arguments.operand);
    lobe_camera_path_free(values.path);
    return status;
}

/* Only rank 0 has something to say. */
static bool be_silent(void) {
    const int file = open("/dev/null", O_WRONLY | O_CLOEXEC);
    return file >= 0 && dup2(file, STDOUT_FILENO) >= 0 && dup2(file, STDERR_FILENO) >= 0;
}

lobe_app_status lobe_app_render(int argc, char **argv) {
    int rank;
    const lobe_render_result joined = lobe_ranks_join(&rank);
    if (joined != LOBE_RENDER_OK) return lobe_app_render_failed(joined);
    if (rank > 0 && !be_silent()) return LOBE_APP_FAILED;
    const lobe_app_status status = run(argc, argv);
    if (!lobe_app_interrupted) lobe_ranks_leave();
    return status;
}
