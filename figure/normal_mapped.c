/* A wall whose shading normals often face away (Tokuyoshi 2021, supplement, Fig. 2): with the previous
 * normalisation too bright where the visible normals' density integrates to less than one. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/render.h>

#include "figures.h"
#include "pixels.h"
#include "plot.h"

enum { WIDTH = 192, HEIGHT = 108, PIXELS = WIDTH * HEIGHT, BLOCK = 6, MODELS = 4, PICTURES = 3 };

static const struct {
    const char *name;
    lobe_model model;
} models[MODELS] = {
    {"Smith–Beckmann", {LOBE_NDF_BECKMANN, LOBE_MASKING_SMITH, LOBE_METHOD_NEWTON}},
    {"V-cavity–GGX", {LOBE_NDF_GGX, LOBE_MASKING_VCAVITY, LOBE_METHOD_VCAVITY}},
    {"V-cavity–Beckmann", {LOBE_NDF_BECKMANN, LOBE_MASKING_VCAVITY, LOBE_METHOD_VCAVITY}},
    {"Smith–GGX", {LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_METHOD_ELLIPSOID}}};

/* The reference draws all normals and the lights: no normalisation of visible normals can bias it. */
typedef enum kind { PREVIOUS, UNBIASED, REFERENCE } kind;

typedef struct pictures {
    float rgb[PICTURES][3 * PIXELS], integral[PICTURES][PIXELS];
} pictures;

typedef struct share {
    const run *run;
    double done, part; /* of the whole figure */
} share;

static void show_share(void *user, const lobe_render_progress *p) {
    const share *s = user;
    lobe_run_goes_on(s->run, s->done + s->part * p->fraction);
}

static lobe_render_options options_of(const run *r, lobe_model model, kind k, share *s) {
    lobe_render_options o = lobe_render_default_options();
    const uint32_t spp = r->options->spp ? r->options->spp : 64;
    o.reflection.model = model;
    if (k == REFERENCE) o.reflection.model.method = LOBE_METHOD_NDF;
    o.reflection.normalization =
        k == PREVIOUS ? LOBE_NORMALIZATION_PREVIOUS : LOBE_NORMALIZATION_UNBIASED;
    o.heuristic = k == REFERENCE ? LOBE_HEURISTIC_BALANCE : LOBE_HEURISTIC_BSDF_ONLY;
    o.width = WIDTH;
    o.height = HEIGHT;
    o.samples = k == REFERENCE ? 4 * spp : spp;
    o.depth = 1;
    o.seed = r->options->seed + (k == REFERENCE);
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_VNDF_INTEGRAL);
    o.cancel = r->options->cancel;
    o.progress = show_share;
    o.progress_user = s;
    return o;
}

static lobe_figure_result failed(lobe_render_result result) {
    if (result == LOBE_RENDER_INTERRUPTED) return LOBE_FIGURE_INTERRUPTED;
    return lobe_figure_fail(LOBE_FIGURE_FAILED, "%s", lobe_render_error_message());
}

static lobe_figure_result render_pictures(const run *r, const lobe_scene *scene, int model,
                                          pictures *p) {
    for (int k = 0; k < PICTURES; k++) {
        lobe_film *film = NULL;
        share s = {r, (model + (double)k / PICTURES) / MODELS, 1.0 / (PICTURES * MODELS)};
        const lobe_render_result result =
            lobe_render(scene, options_of(r, models[model].model, (kind)k, &s), &film, NULL);
        if (result == LOBE_RENDER_OK) {
            lobe_film_copy_rgb(film, p->rgb[k]);
            lobe_film_copy_aov(film, LOBE_AOV_VNDF_INTEGRAL, p->integral[k]);
        }
        lobe_film_free(film);
        if (result != LOBE_RENDER_OK) return failed(result);
    }
    return LOBE_FIGURE_OK;
}

static double to_srgb(double linear) {
    const double l = fmin(fmax(linear, 0), 1);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1 / 2.4) - 0.055;
}

static colour picture_colour(const void *user, int column, int row) {
    const float *rgb = (const float *)user + 3 * (row * WIDTH + column);
    return (colour){to_srgb((double)rgb[0]), to_srgb((double)rgb[1]), to_srgb((double)rgb[2])};
}

static colour integral_colour(const void *user, int column, int row) {
    return lobe_map_sequential((double)((const float *)user)[row * WIDTH + column]);
}

static double block_mean(const float *rgb, int column, int row) {
    double sum = 0;
    for (int y = 0; y < BLOCK; y++)
        for (int x = 0; x < 3 * BLOCK; x++)
            sum += (double)rgb[3 * ((BLOCK * row + y) * WIDTH + BLOCK * column) + x];
    return sum / (3 * BLOCK * BLOCK);
}

/* Relative to the reference, over blocks: the noise of single pixels would hide the bias. */
typedef struct errors {
    double block[(WIDTH / BLOCK) * (HEIGHT / BLOCK)];
} errors;

static errors find_errors(const pictures *p, kind k) {
    errors e;
    for (int i = 0; i < (WIDTH / BLOCK) * (HEIGHT / BLOCK); i++) {
        const int column = i % (WIDTH / BLOCK), row = i / (WIDTH / BLOCK);
        const double expected = block_mean(p->rgb[REFERENCE], column, row);
        e.block[i] = block_mean(p->rgb[k], column, row) / fmax(expected, 1e-3) - 1;
    }
    return e;
}

static colour error_colour(const void *user, int column, int row) {
    const errors *e = user;
    return lobe_map_diverging(0.5 + e->block[row * (WIDTH / BLOCK) + column]);
}

static void keep_row(run *r, int model, const pictures *p) {
    double mean[PICTURES] = {0}, least = 1;
    for (int k = 0; k < PICTURES; k++)
        for (int i = 0; i < 3 * PIXELS; i++) mean[k] += (double)p->rgb[k][i] / (3 * PIXELS);
    for (int i = 0; i < PIXELS; i++) least = fmin(least, (double)p->integral[PREVIOUS][i]);
    const double row[] = {mean[REFERENCE], mean[PREVIOUS], mean[UNBIASED], least};
    lobe_table_row(&r->table, models[model].name, 4, row);
}

static void draw_row(run *r, int model, const pictures *p) {
    enum { COLUMNS = 5 };
    canvas *c = &r->canvas;
    const double width = 92, height = width * HEIGHT / WIDTH, top = 20 + (height + 4) * model;
    const errors previous = find_errors(p, PREVIOUS), unbiased = find_errors(p, UNBIASED);
    box b = {22, top, width, height};
    lobe_text_upward(c, c->theme->ink, SMALL_SIZE, ALIGN_CENTRE, 16, top + 0.5 * height,
                     models[model].name);
    for (int k = 0; k < COLUMNS; k++) {
        b.x = 22 + (width + 4) * k;
        if (k == 0 || k == 3)
            lobe_paint_pixels(c, b, WIDTH, HEIGHT, picture_colour, p->rgb[k ? UNBIASED : PREVIOUS]);
        else if (k == 2)
            lobe_paint_pixels(c, b, WIDTH, HEIGHT, integral_colour, p->integral[PREVIOUS]);
        else
            lobe_paint_pixels(c, b, WIDTH / BLOCK, HEIGHT / BLOCK, error_colour,
                              k == 1 ? &previous : &unbiased);
    }
    keep_row(r, model, p);
}

static void draw_frame(run *r) {
    static const char *const heads[] = {"previous", "error", "VNDF integral", "unbiased", "error"};
    canvas *c = &r->canvas;
    lobe_canvas_begin(c, PAGE_WIDTH, 284);
    lobe_table_begin(&r->table, "model,reference,previous,unbiased,least_integral");
    for (int k = 0; k < 5; k++)
        lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_CENTRE, 22 + 46 + 96 * k, 14, heads[k]);
    const axis error = {"error (%)", -50, 50, SCALE_LINEAR},
               integral = {"integral", 0, 1, SCALE_LINEAR};
    lobe_colour_bar(c, (box){22 + 104, 252, 76, 6}, lobe_map_diverging, error);
    lobe_colour_bar(c, (box){22 + 200, 252, 76, 6}, lobe_map_sequential, integral);
    lobe_colour_bar(c, (box){22 + 392, 252, 76, 6}, lobe_map_diverging, error);
}

lobe_figure_result lobe_figure_normal_mapped(run *r) {
    lobe_scene *scene = NULL;
    pictures *p = malloc(sizeof *p);
    if (!p) return lobe_figure_fail_memory();
    lobe_figure_result result = LOBE_FIGURE_OK;
    const lobe_render_result loaded =
        lobe_scene_load("normal-mapped", lobe_scene_default_options(), &scene);
    if (loaded != LOBE_RENDER_OK) result = failed(loaded);
    if (!result) draw_frame(r);
    for (int model = 0; model < MODELS && !result; model++) {
        result = render_pictures(r, scene, model, p);
        if (!result) draw_row(r, model, p);
    }
    lobe_scene_free(scene);
    free(p);
    return result;
}
