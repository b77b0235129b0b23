/* Screen-space reflections, pass by pass: what the frame holds after each, beside real rays. */
#include <math.h>
#include <stdlib.h>

#include <lobe/render.h>
#include <lobe/ssr_frames.h>

#include "figures.h"
#include "pixels.h"
#include "plot.h"

enum { WIDTH = 288, HEIGHT = 162, PIXELS = WIDTH * HEIGHT, FRAMES = 6, CHANNELS = 3 };
/* The rows that are shown: the others are sky and floor. */
enum { FIRST_ROW = 30, ROWS = 112 };
enum { STATES = LOBE_SSR_LOST + 1, LEVELS_SHOWN = 4 };

typedef enum panel {
    BEFORE,
    PYRAMID,
    TRACE,
    REPROJECT,
    RESOLVE,
    ACCUMULATE,
    COMPOSITE,
    FRESNEL,
    REAL,
    PANELS
} panel;

static const char *const titles[PANELS] = {
    "(a) colour, one frame before",  "(b) pyramid: levels 0, 2, 4, 6",
    "(c) trace: what a ray meets",   "(d) reproject: its colour there",
    "(e) resolve: neighbours' rays", "(f) accumulate: six frames",
    "(g) composite: with the sky",   "(h) times Fresnel",
    "(i) real rays, times Fresnel"};

/* One picture a panel, and what the rays did. */
typedef struct pictures {
    float rgb[PANELS][CHANNELS * PIXELS];
    float nearness[PIXELS]; /* of the pyramid's level that is shown there; 0: nothing there */
    int state[PIXELS];
    float on_screen[PIXELS];
} pictures;

/* ---- The pipeline ---------------------------------------------------------------------------- */

typedef struct share {
    const run *run;
    int frame;
} share;

static void show_share(void *user, double fraction) {
    const share *s = user;
    lobe_run_goes_on(s->run, (s->frame + fraction) / (FRAMES + 2));
}

static lobe_figure_result failed(lobe_ssr_result result) {
    if (result == LOBE_SSR_OK) return LOBE_FIGURE_OK;
    if (result == LOBE_SSR_INTERRUPTED) return LOBE_FIGURE_INTERRUPTED;
    return lobe_figure_fail(LOBE_FIGURE_FAILED, "%s", lobe_ssr_error_message());
}

static uint32_t spp_of(const run *r) {
    return r->options->spp ? r->options->spp : 32;
}

static lobe_ssr_scene_options scene_options(const run *r, share *s) {
    lobe_ssr_scene_options o = lobe_ssr_scene_default_options();
    o.width = WIDTH;
    o.height = HEIGHT;
    o.count = FRAMES;
    o.samples = spp_of(r);
    o.roughness = 0.3f; /* the floor of the scene is too rough to show where things stand in it */
    o.seed = r->options->seed;
    o.progress = show_share;
    o.progress_user = s;
    o.cancel = r->options->cancel;
    return o;
}

static lobe_ssr_options ssr_options(const run *r) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.fade_start = o.fade_end = 1;
    o.bias = 0;
    o.seed = r->options->seed;
    return o;
}

/* The farther to the right, the coarser the level; of each cell the nearest. */
static void keep_pyramid(const lobe_ssr_frame *f, pictures *p) {
    double least = HUGE_VAL;
    for (int i = 0; i < PIXELS; i++)
        if (f->z[i] > 0) least = fmin(least, (double)f->z[i]);
    for (int row = 0; row < HEIGHT; row++)
        for (int column = 0; column < WIDTH; column++) {
            const int cell = 1 << 2 * (LEVELS_SHOWN * column / WIDTH);
            double nearness = 0;
            for (int y = row / cell * cell; y < HEIGHT && y < (row / cell + 1) * cell; y++)
                for (int x = column / cell * cell; x < WIDTH && x < (column / cell + 1) * cell; x++)
                    if (f->z[y * WIDTH + x] > 0)
                        nearness = fmax(nearness, least / (double)f->z[y * WIDTH + x]);
            p->nearness[row * WIDTH + column] = (float)nearness;
        }
}

/* Where what was met was one frame before. */
static int source_of(const lobe_ssr_frame *f, const lobe_ssr_ray *ray) {
    if (ray->x < 0) return -1;
    const float *motion = f->motion + 2 * (ray->y * WIDTH + ray->x);
    const double x = ray->x + 0.5 - (double)motion[0] * WIDTH,
                 y = ray->y + 0.5 - (double)motion[1] * HEIGHT;
    return x >= 0 && x < WIDTH && y >= 0 && y < HEIGHT ? (int)y * WIDTH + (int)x : -1;
}

static void keep_rays(const lobe_ssr *ssr, const lobe_ssr_frame *f, pictures *p) {
    const lobe_ssr_ray *rays = lobe_ssr_rays(ssr);
    for (int i = 0; i < PIXELS; i++) {
        const int source = source_of(f, &rays[i]);
        p->state[i] = rays[i].state;
        for (int k = 0; k < CHANNELS; k++)
            p->rgb[REPROJECT][CHANNELS * i + k] =
                source < 0 ? 0 : f->previous_color[CHANNELS * source + k];
    }
}

static void keep_pictures(const lobe_ssr *ssr, const lobe_ssr_frame *f, pictures *p) {
    const float *resolved = lobe_ssr_resolved(ssr), *reflection = lobe_ssr_reflection(ssr);
    const float *radiance = lobe_ssr_radiance(ssr), *composite = lobe_ssr_composite(ssr);
    for (int i = 0; i < PIXELS; i++)
        for (int k = 0; k < CHANNELS; k++) {
            const int at = CHANNELS * i + k;
            p->rgb[BEFORE][at] = f->previous_color[at];
            p->rgb[RESOLVE][at] = resolved[4 * i + k];
            p->rgb[ACCUMULATE][at] = reflection[4 * i + k];
            p->rgb[COMPOSITE][at] = radiance[at];
            p->rgb[FRESNEL][at] = composite[at];
            if (radiance[at] > 0) p->rgb[REAL][at] *= composite[at] / radiance[at];
        }
}

static lobe_figure_result run_frames(const run *r, lobe_ssr_frames *frames, lobe_ssr *ssr, share *s,
                                     pictures *p) {
    lobe_ssr_frame f = {0};
    lobe_ssr_result result = LOBE_SSR_OK;
    for (s->frame = 0; s->frame < FRAMES && !result; s->frame++) {
        result = lobe_ssr_frames_get(frames, s->frame, &f);
        if (!result) result = lobe_ssr_run(ssr, &f, NULL);
    }
    if (!result)
        result = lobe_ssr_truth(frames, LOBE_SSR_VNDF, (int)spp_of(r), p->rgb[REAL], p->on_screen);
    if (result) return failed(result);
    keep_pyramid(&f, p);
    keep_rays(ssr, &f, p);
    keep_pictures(ssr, &f, p);
    return LOBE_FIGURE_OK;
}

static lobe_figure_result make_pictures(const run *r, const lobe_scene *scene, pictures *p) {
    share s = {r, 0};
    lobe_ssr_frames *frames = NULL;
    lobe_ssr *ssr = NULL;
    lobe_figure_result result =
        failed(lobe_ssr_frames_of_scene(scene, scene_options(r, &s), &frames));
    if (!result) result = failed(lobe_ssr_create(WIDTH, HEIGHT, ssr_options(r), &ssr));
    if (!result) result = run_frames(r, frames, ssr, &s, p);
    lobe_ssr_free(ssr);
    lobe_ssr_frames_free(frames);
    return result;
}

/* ---- The page -------------------------------------------------------------------------------- */

static double to_srgb(double linear) {
    const double l = fmin(fmax(linear, 0), 1);
    return l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1 / 2.4) - 0.055;
}

static colour picture_colour(const void *user, int column, int row) {
    const float *rgb = (const float *)user + CHANNELS * ((row + FIRST_ROW) * WIDTH + column);
    return (colour){to_srgb((double)rgb[0]), to_srgb((double)rgb[1]), to_srgb((double)rgb[2])};
}

static colour pyramid_colour(const void *user, int column, int row) {
    const pictures *p = user;
    return lobe_map_sequential((double)p->nearness[(row + FIRST_ROW) * WIDTH + column]);
}

/* In the order of lobe_ssr_state. */
static const char *const states[STATES] = {"no surface", "rejected", "off the screen",
                                           "hit",        "sky",      "lost"};

typedef struct state_map {
    colour colours[STATES];
    const pictures *pictures;
} state_map;

static colour state_colour(const void *user, int column, int row) {
    const state_map *m = user;
    return m->colours[m->pictures->state[(row + FIRST_ROW) * WIDTH + column]];
}

static state_map map_of(const canvas *c, const pictures *p) {
    const colour *hues = c->theme->hues;
    return (state_map){{c->theme->grid, hues[HUE_RED], hues[HUE_ORANGE], hues[HUE_GREEN],
                        hues[HUE_SKY], hues[HUE_PURPLE]},
                       p};
}

static void draw_key(canvas *c, const state_map *m, double y) {
    legend_entry entries[STATES];
    for (int k = 0; k < STATES; k++)
        entries[k] = (legend_entry){states[k], {m->colours[k], DASH_SOLID, 5}};
    lobe_legend(c, y, STATES, entries);
}

static void draw_panels(run *r, const pictures *p) {
    enum { COLUMNS = 3 };
    canvas *c = &r->canvas;
    const double gap = 6, width = (PAGE_WIDTH - (COLUMNS - 1) * gap) / COLUMNS,
                 height = width * ROWS / WIDTH, pitch = height + 15;
    lobe_canvas_begin(c, PAGE_WIDTH, COLUMNS * pitch + 16);
    const state_map m = map_of(c, p);
    for (int k = 0; k < PANELS; k++) {
        const box b = {(width + gap) * (k % COLUMNS), 12 + pitch * (k / COLUMNS), width, height};
        lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_LEFT, b.x, b.y - 3.5, titles[k]);
        pixel_function *colour_of = k == PYRAMID ? pyramid_colour
                                    : k == TRACE ? state_colour
                                                 : picture_colour;
        const void *what = k == PYRAMID ? (const void *)p
                           : k == TRACE ? (const void *)&m
                                        : p->rgb[k];
        lobe_paint_pixels(c, b, WIDTH, ROWS, colour_of, what);
    }
    draw_key(c, &m, COLUMNS * pitch + 10);
}

static void keep_means(run *r, const pictures *p) {
    static const char *const names[PANELS] = {
        "before", NULL, NULL, "reproject", "resolve", "accumulate", "composite", "fresnel", "real"};
    lobe_table_begin(&r->table, "pass,red,green,blue");
    for (int k = 0; k < PANELS; k++) {
        double mean[CHANNELS] = {0};
        for (int i = 0; i < CHANNELS * PIXELS; i++)
            mean[i % CHANNELS] += (double)p->rgb[k][i] / PIXELS;
        if (names[k]) lobe_table_row(&r->table, names[k], CHANNELS, mean);
    }
}

lobe_figure_result lobe_figure_ssr_passes(run *r) {
    lobe_scene *scene = NULL;
    pictures *p = calloc(1, sizeof *p);
    if (!p) return lobe_figure_fail_memory();
    lobe_figure_result result = LOBE_FIGURE_OK;
    const lobe_render_result loaded =
        lobe_scene_load("gallery", lobe_scene_default_options(), &scene);
    if (loaded != LOBE_RENDER_OK)
        result = lobe_figure_fail(LOBE_FIGURE_FAILED, "%s", lobe_render_error_message());
    if (!result) result = make_pictures(r, scene, p);
    if (!result) {
        draw_panels(r, p);
        keep_means(r, p);
    }
    lobe_scene_free(scene);
    free(p);
    return result;
}
