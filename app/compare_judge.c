#include "compare_judge.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "interrupt.h"
#include "progress.h"

/* ---- Pictures as files ----------------------------------------------------------------------- */

void lobe_app_picture_path(const lobe_app_comparison *c, int contender, int size,
                           const char *folder, const char *ending, char *path, size_t length) {
    if (size < 0)
        snprintf(path, length, "%s/reference%s", folder, ending);
    else if (c->is_of_files)
        snprintf(path, length, "%s/picture%s", folder, ending);
    else
        snprintf(path, length, "%s/%s-%uspp%s", folder, c->contender[contender].file,
                 c->cell[contender][size].spp, ending);
}

lobe_app_status lobe_app_save_picture(const lobe_app_comparison *c, const char *folder,
                                      int contender, int size, const float *rgb) {
    static const char *const endings[] = {".exr", ".png"};
    lobe_film *film;
    lobe_film_write_options options = lobe_film_default_write_options();
    lobe_render_result result = lobe_film_from_rgb(rgb, c->width, c->height, &film);
    for (int i = 0; i < 2 && result == LOBE_RENDER_OK; i++) {
        char path[4096];
        lobe_app_picture_path(c, contender, size, folder, endings[i], path, sizeof path);
        options.pixels = LOBE_FILM_FLOAT;
        options.exposure = i == 1 ? (float)c->exposure : 0.0f;
        result = lobe_film_write(film, path, options);
    }
    lobe_film_free(film);
    return result == LOBE_RENDER_OK ? LOBE_APP_DONE : lobe_app_render_failed(result);
}

/* The film's means; frees the film. NULL: out of memory. */
static float *take_rgb(lobe_film *film) {
    float *rgb =
        malloc(3 * sizeof *rgb * (size_t)lobe_film_width(film) * (size_t)lobe_film_height(film));
    if (rgb) lobe_film_copy_rgb(film, rgb);
    lobe_film_free(film);
    return rgb;
}

static lobe_app_status out_of_memory(void) {
    lobe_app_report("compare", "make the pictures smaller", "out of memory");
    return LOBE_APP_FAILED;
}

static lobe_app_status read_picture(const char *path, float **rgb, int *width, int *height) {
    lobe_film *film;
    const lobe_render_result result = lobe_film_read(path, &film);
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    *width = lobe_film_width(film);
    *height = lobe_film_height(film);
    *rgb = take_rgb(film);
    return *rgb ? LOBE_APP_DONE : out_of_memory();
}

/* ---- Renders --------------------------------------------------------------------------------- */

typedef struct work {
    const lobe_app_judge *judge;
    lobe_app_comparison *c;
    const lobe_scene *scene;
    lobe_app_progress progress;
    double done, total;   /* camera paths of a pixel, over all pictures */
    double picture_paths; /* of the present one */
} work;

static void show_progress(void *user, const lobe_render_progress *p) {
    work *w = user;
    const double paths = w->done + p->fraction * w->picture_paths;
    lobe_app_show_progress(&w->progress, paths / w->total, paths * w->c->width * w->c->height);
}

/* A picture of options `o`; *rgb is NULL unless it is whole. */
/* Of textures: the same for all numbers of samples, so that all pictures have one expectation. */
static const float even_footprint = 0.125f;

static lobe_app_status render_picture(work *w, lobe_render_options o, float **rgb,
                                      lobe_app_measurement *measured) {
    lobe_film *film = NULL;
    lobe_render_statistics st;
    *rgb = NULL;
    w->picture_paths = o.samples;
    o.progress = show_progress;
    o.progress_user = w;
    const lobe_render_result result = lobe_render(w->scene, o, &film, &st);
    if (result == LOBE_RENDER_INTERRUPTED) {
        lobe_film_free(film);
        return LOBE_APP_INTERRUPTED;
    }
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    w->done += o.samples;
    *measured = (lobe_app_measurement){.seconds = st.seconds,
                                       .cpu_seconds = st.cpu_seconds,
                                       .rays = (double)st.rays,
                                       .draws = (double)st.ggx_draws,
                                       .rejected = (double)st.ggx_rejected};
    *rgb = take_rgb(film);
    return *rgb ? LOBE_APP_DONE : out_of_memory();
}

/* Two independent halves, by the method that the renderer chooses and without bias, whatever is compared. */
static lobe_app_status render_reference(work *w) {
    lobe_render_options o = lobe_app_view_render_options(&w->judge->view);
    lobe_app_measurement unused;
    o.reflection.normalization = LOBE_NORMALIZATION_UNBIASED;
    o.heuristic = LOBE_HEURISTIC_BALANCE;
    o.samples = w->c->reference_spp / 2;
    o.footprint = even_footprint;
    for (int k = 0; k < 2; k++) {
        /* no seed of a picture lies there */
        o.seed = w->judge->view.seed + (UINT64_C(1) << 40) + (uint64_t)k;
        const lobe_app_status status = render_picture(w, o, &w->c->half[k], &unused);
        if (status) return status;
    }
    return LOBE_APP_DONE;
}

static lobe_app_status read_reference(work *w) {
    lobe_app_comparison *c = w->c;
    int width, height;
    const lobe_app_status status = read_picture(w->judge->reference, &c->half[0], &width, &height);
    if (status) return status;
    c->half[1] = c->half[0];
    if (width == c->width && height == c->height) return LOBE_APP_DONE;
    return lobe_app_reject(w->judge->reference, "render it at the same --size",
                           "%d x %d pixels, not %d x %d", width, height, c->width, c->height);
}

static lobe_render_options contender_options(const work *w, int contender) {
    const lobe_app_contender *k = &w->c->contender[contender];
    lobe_render_options o = lobe_app_view_render_options(&w->judge->view);
    o.footprint = even_footprint;
    o.reflection.model = k->model;
    o.reflection.floor = k->floor;
    o.reflection.normalization = k->normalization;
    return o;
}

/* ---- Equal time ------------------------------------------------------------------------------ */

/* Samples of the pictures that tell how fast each contender is. */
static uint32_t pilot_samples(const work *w) {
    return (uint32_t)fmin(fmax((double)w->judge->spp[w->c->sizes - 1] / 4, 1), 32);
}

/* Gives every contender the samples that fit into the processor time of the first one. */
static lobe_app_status share_out_time(work *w) {
    lobe_app_comparison *c = w->c;
    double cost[LOBE_APP_CONTENDERS_MAX];
    for (int m = 0; m < c->contenders; m++) {
        lobe_render_options o = contender_options(w, m);
        lobe_app_measurement measured;
        float *rgb;
        o.samples = pilot_samples(w);
        const lobe_app_status status = render_picture(w, o, &rgb, &measured);
        free(rgb);
        if (status) return status;
        cost[m] = fmax(measured.cpu_seconds, 1e-9);
    }
    for (int m = 1; m < c->contenders; m++)
        for (int n = 0; n < c->sizes; n++) {
            const double samples = round((double)w->judge->spp[n] * cost[0] / cost[m]);
            c->cell[m][n].spp = (uint32_t)fmin(fmax(samples, 1), LOBE_RENDER_SAMPLES_MAX);
        }
    return LOBE_APP_DONE;
}

/* ---- The whole ------------------------------------------------------------------------------- */

static double planned_paths(const work *w) {
    const lobe_app_comparison *c = w->c;
    double paths = w->judge->reference ? 0 : c->reference_spp;
    if (c->equal == LOBE_APP_AXIS_TIME) paths += (double)pilot_samples(w) * c->contenders;
    for (int m = 0; m < c->contenders; m++)
        for (int n = 0; n < c->sizes; n++) paths += (double)c->cell[m][n].spp * c->seeds;
    return paths;
}

static lobe_app_status add_picture(work *w, int contender, int size, int seed) {
    lobe_app_comparison *c = w->c;
    lobe_render_options o = contender_options(w, contender);
    lobe_app_measurement measured;
    float *rgb;
    o.samples = c->cell[contender][size].spp;
    o.seed = w->judge->view.seed + (uint64_t)seed;
    lobe_app_status status = render_picture(w, o, &rgb, &measured);
    if (!status && !lobe_app_add_picture_to(c, contender, size, rgb, measured))
        status = out_of_memory();
    if (!status && seed == 0 && w->judge->folder)
        status = lobe_app_save_picture(c, w->judge->folder, contender, size, rgb);
    free(rgb);
    return status;
}

/* Seed by seed, so that an interrupt leaves every contender with as many, and a slow moment of the machine
 * meets all of them. */
static lobe_app_status add_pictures(work *w) {
    lobe_app_status status = LOBE_APP_DONE;
    for (int s = 0; s < w->c->seeds && !status; s++)
        for (int n = 0; n < w->c->sizes && !status; n++)
            for (int m = 0; m < w->c->contenders && !status; m++)
                status = lobe_app_interrupted ? LOBE_APP_INTERRUPTED : add_picture(w, m, n, s);
    return status;
}

static lobe_app_status judge(work *w) {
    lobe_app_comparison *c = w->c;
    lobe_app_status status = w->judge->reference ? read_reference(w) : render_reference(w);
    if (!status && !lobe_app_set_reference(c)) status = out_of_memory();
    if (!status && w->judge->folder)
        status = lobe_app_save_picture(c, w->judge->folder, 0, -1, c->reference);
    if (!status && c->equal == LOBE_APP_AXIS_TIME) status = share_out_time(w);
    w->total = planned_paths(w);
    return status ? status : add_pictures(w);
}

lobe_app_status lobe_app_judge_scene(const lobe_app_judge *judge_options, lobe_app_comparison *c) {
    work w = {.judge = judge_options, .c = c};
    lobe_scene *scene = NULL;
    for (int m = 0; m < c->contenders; m++)
        for (int n = 0; n < c->sizes; n++) c->cell[m][n].spp = (uint32_t)judge_options->spp[n];
    const double most = (double)judge_options->spp[c->sizes - 1];
    const double wanted =
        judge_options->reference_spp ? (double)judge_options->reference_spp : fmax(16 * most, 64);
    c->reference_spp = judge_options->reference
                           ? 0
                           : 2 * (uint32_t)fmin(ceil(wanted / 2), LOBE_RENDER_SAMPLES_MAX);
    c->reference_name = judge_options->reference;
    lobe_app_catch_interrupt();
    const lobe_render_result result = lobe_scene_load(
        judge_options->source, lobe_app_view_scene_options(&judge_options->view), &scene);
    if (result != LOBE_RENDER_OK) return lobe_app_render_failed(result);
    w.scene = scene;
    w.total = planned_paths(&w);
    w.progress = lobe_app_begin_progress(judge_options->progress, "compare", "samples");
    const lobe_app_status status = judge(&w);
    lobe_app_end_progress(&w.progress);
    lobe_scene_free(scene);
    c->is_interrupted = status == LOBE_APP_INTERRUPTED;
    return status;
}

lobe_app_status lobe_app_judge_files(const char *picture, const char *reference,
                                     lobe_app_comparison *c) {
    int width, height;
    float *rgb = NULL;
    lobe_app_status status = read_picture(picture, &rgb, &width, &height);
    if (!status) status = read_picture(reference, &c->half[0], &c->width, &c->height);
    if (!status && (width != c->width || height != c->height))
        status = lobe_app_reject(reference, "compare pictures of one size",
                                 "%d x %d pixels, not %d x %d", c->width, c->height, width, height);
    if (!status) {
        c->half[1] = c->half[0];
        c->reference_name = reference;
        c->is_of_files = true;
        c->contenders = c->sizes = c->seeds = 1;
        if (!lobe_app_set_reference(c) ||
            !lobe_app_add_picture_to(c, 0, 0, rgb, (lobe_app_measurement){0}))
            status = out_of_memory();
    }
    free(rgb);
    return status;
}
