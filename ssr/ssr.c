/* The handle: options, memory, driver; and the passes of the processor in order. */
#include "lobe/ssr.h"

#include <limits.h>
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "driver.h"
#include "message.h"

lobe_ssr_options lobe_ssr_default_options(void) {
    return (lobe_ssr_options){.mode = LOBE_SSR_VNDF,
                              .method = LOBE_METHOD_BOUNDED,
                              .resolve = LOBE_SSR_CONFIDENCE,
                              .max_iterations = 64,
                              .thickness = 0.01f,
                              .edge_fade = 0.1f,
                              .fade_start = 0.1f,
                              .fade_end = 0.1f,
                              .accumulation = 0.75f,
                              .bias = 0.5f,
                              .speed_rejection = 0.5f,
                              .speed_scale = 0.2f,
                              .reflect_sky = 1};
}

int lobe_ssr_has_bias(lobe_method method) {
    return method != LOBE_METHOD_SLOPE && method != LOBE_METHOD_SLOPE_PUBLISHED;
}

static const struct {
    const char *name;
    void (*run)(lobe_ssr *s, const lobe_ssr_frame *f);
} passes[LOBE_SSR_PASS_COUNT] = {
    [LOBE_SSR_PASS_PYRAMID] = {"pyramid", lobe_ssr_pass_pyramid},
    [LOBE_SSR_PASS_TRACE] = {"trace", NULL}, /* the one that counts */
    [LOBE_SSR_PASS_REPROJECT] = {"reproject", lobe_ssr_pass_reproject},
    [LOBE_SSR_PASS_RESOLVE] = {"resolve", lobe_ssr_pass_resolve},
    [LOBE_SSR_PASS_ACCUMULATE] = {"accumulate", lobe_ssr_pass_accumulate},
    [LOBE_SSR_PASS_COMPOSITE] = {"composite", lobe_ssr_pass_composite}};

const char *lobe_ssr_pass_name(lobe_ssr_pass pass) {
    return (unsigned)pass < LOBE_SSR_PASS_COUNT ? passes[pass].name : NULL;
}

static int is_share(float x) {
    return x >= 0.0f && x <= 1.0f;
}

static lobe_ssr_result check_options(const lobe_ssr_options *o) {
    const lobe_model model = {LOBE_NDF_GGX, LOBE_MASKING_SMITH, o->method};
    if ((unsigned)o->mode > LOBE_SSR_VNDF || (unsigned)o->resolve > LOBE_SSR_OWN ||
        (unsigned)o->backend > LOBE_SSR_AUTO || o->max_iterations < 1 ||
        o->max_iterations > 1000000 || !is_share(o->thickness) || !is_share(o->edge_fade) ||
        !is_share(o->fade_start) || !is_share(o->fade_end) || !is_share(o->accumulation) ||
        !is_share(o->bias) || o->bias == 1.0f || !is_share(o->speed_rejection) ||
        !is_share(o->speed_scale) || o->threads < 0 || o->threads > 1024)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "options: a value is out of range; see lobe/ssr.h");
    if (o->fade_start > o->fade_end)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "options: the fade over roughness ends before it starts; swap them");
    if (o->mode == LOBE_SSR_VNDF && !lobe_model_exists(model))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "method: not one of Smith-GGX; see lobe/methods.h");
    if (o->mode == LOBE_SSR_VNDF && o->bias > 0.0f && !lobe_ssr_has_bias(o->method))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "bias: unknown for method %s; use 0",
                             lobe_method_name(o->method));
    return LOBE_SSR_OK;
}

/* The levels of depth lie behind one another. 0: no memory. */
static int make_pyramid(lobe_ssr *s) {
    pyramid *p = &s->pyramid;
    int width = s->width, height = s->height;
    size_t start[SSR_LEVELS_MAX], cells = 0;
    for (;;) {
        const int level = p->levels++;
        const size_t of_level = (size_t)width * (size_t)height;
        p->width[level] = width;
        p->height[level] = height;
        start[level] = cells;
        cells += of_level;
        if (level > 0 && s->options.resolve == LOBE_SSR_APPROX) {
            p->color[level] = malloc(3 * of_level * sizeof *p->color[level]);
            if (!p->color[level]) return 0;
        }
        if (width == 1 && height == 1) break;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    ssr_cell *all = malloc(cells * sizeof *all);
    for (int level = 0; all && level < p->levels; level++) p->depth[level] = all + start[level];
    return all != NULL;
}

/* What only the processor's passes keep. */
static int make_state(lobe_ssr *s) {
    const size_t count = ssr_pixels(s);
    s->found = calloc(4 * count, sizeof *s->found);
    s->history = calloc(4 * count, sizeof *s->history);
    s->last_z = calloc(count, sizeof *s->last_z);
    return make_pyramid(s) && s->found && s->history && s->last_z;
}

static int make_results(lobe_ssr *s) {
    const size_t count = ssr_pixels(s);
    s->rays = calloc(count, sizeof *s->rays);
    s->resolved = calloc(4 * count, sizeof *s->resolved);
    s->reflection = calloc(4 * count, sizeof *s->reflection);
    s->radiance = calloc(3 * count, sizeof *s->radiance);
    s->composite = calloc(3 * count, sizeof *s->composite);
    return s->rays && s->resolved && s->reflection && s->radiance && s->composite;
}

/* The driver that is asked for; for LOBE_SSR_AUTO the processor after all, and why. */
static lobe_ssr_result open_driver(lobe_ssr *s) {
    const char *why = NULL;
    if (s->options.backend != LOBE_SSR_CPU) {
        s->driver = &lobe_ssr_gl_driver;
        const lobe_ssr_result result = s->driver->open(s);
        if (result == LOBE_SSR_OK) {
            snprintf(s->device, sizeof s->device, "%s", s->driver->device(s));
            return LOBE_SSR_OK;
        }
        s->driver = NULL;
        if (s->options.backend == LOBE_SSR_GL) return result;
        why = lobe_ssr_error_message();
    }
    s->driver = &lobe_ssr_cpu_driver;
    const int length = why ? (int)strcspn(why, ";") : 0; /* without the hint */
    snprintf(s->device, sizeof s->device, why ? "processor (%.*s)" : "processor", length, why);
    return s->driver->open(s);
}

lobe_ssr_result lobe_ssr_create(int width, int height, lobe_ssr_options options, lobe_ssr **ssr) {
    *ssr = NULL;
    if (width < 1 || height < 1 || width > LOBE_SSR_SIZE_MAX || height > LOBE_SSR_SIZE_MAX)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "size: %d x %d is out of range; use 1 to %d",
                             width, height, LOBE_SSR_SIZE_MAX);
    lobe_ssr_result result = check_options(&options);
    if (result != LOBE_SSR_OK) return result;
    lobe_ssr *s = calloc(1, sizeof *s);
    if (!s) return lobe_ssr_fail_memory("reflections");
    s->width = width;
    s->height = height;
    s->options = options;
    /* HDRP's weights are of 3 x 3 rays, and take what was met alone */
    if (options.as_hdrp && options.resolve == LOBE_SSR_CONFIDENCE)
        s->options.resolve = LOBE_SSR_NEIGHBOURHOOD;
    s->threads = options.threads ? options.threads : omp_get_max_threads();
    result = open_driver(s);
    if (result == LOBE_SSR_OK && !make_results(s)) result = lobe_ssr_fail_memory("reflections");
    if (result != LOBE_SSR_OK) {
        lobe_ssr_free(s);
        return result;
    }
    *ssr = s;
    return LOBE_SSR_OK;
}

void lobe_ssr_free(lobe_ssr *s) {
    if (!s) return;
    if (s->driver && s->driver->close) s->driver->close(s);
    free(s->rays);
    free(s->resolved);
    free(s->reflection);
    free(s->radiance);
    free(s->composite);
    free(s);
}

static lobe_ssr_result open_cpu(lobe_ssr *s) {
    return make_state(s) ? LOBE_SSR_OK : lobe_ssr_fail_memory("reflections");
}

static void close_cpu(lobe_ssr *s) {
    free(s->pyramid.depth[0]);
    for (int level = 1; level < s->pyramid.levels; level++) free(s->pyramid.color[level]);
    free(s->found);
    free(s->history);
    free(s->last_z);
}

lobe_ssr_backend lobe_ssr_backend_of(const lobe_ssr *s) {
    return s->driver->backend;
}

const char *lobe_ssr_device(const lobe_ssr *s) {
    return s->device;
}

double lobe_ssr_milliseconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static lobe_ssr_result run_cpu(lobe_ssr *s, const lobe_ssr_frame *frame, lobe_ssr_statistics *st) {
    for (int pass = 0; pass < LOBE_SSR_PASS_COUNT; pass++) {
        const double start = lobe_ssr_milliseconds();
        if (passes[pass].run)
            passes[pass].run(s, frame);
        else
            lobe_ssr_pass_trace(s, frame, st);
        st->milliseconds[pass] = lobe_ssr_milliseconds() - start;
    }
    return LOBE_SSR_OK;
}

const ssr_driver lobe_ssr_cpu_driver = {LOBE_SSR_CPU, open_cpu, run_cpu, NULL, close_cpu};

static int is_direction(lobe_vec3_f32 d) {
    const float length2 = d.x * d.x + d.y * d.y + d.z * d.z;
    return length2 > 0.98f && length2 < 1.02f;
}

static int is_across(lobe_vec3_f32 a, lobe_vec3_f32 b) {
    return fabsf(a.x * b.x + a.y * b.y + a.z * b.z) < 0.01f;
}

int lobe_ssr_is_camera(const lobe_ssr_camera *c) {
    return isfinite(c->eye.x) && isfinite(c->eye.y) && isfinite(c->eye.z) &&
           is_direction(c->right) && is_direction(c->up) && is_direction(c->forward) &&
           is_across(c->right, c->up) && is_across(c->up, c->forward) &&
           is_across(c->forward, c->right) && c->tan_x > 0.0f && c->tan_x < 1e6f &&
           c->tan_y > 0.0f && c->tan_y < 1e6f && c->near_z > 0.0f && c->near_z < c->far_z &&
           c->far_z < 1e30f;
}

static lobe_ssr_result check_frame(const lobe_ssr_frame *f) {
    if (!f->z || !f->normal || !f->roughness || !f->previous_color)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "frame: z, normal, roughness or previous colour is missing; give all");
    if (!lobe_ssr_is_camera(&f->camera) || !lobe_ssr_is_camera(&f->previous_camera))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT, "camera: not a frame of unit vectors, or an angle "
                                                 "or a plane is out of range; see lobe/ssr.h");
    const lobe_ssr_environment *e = &f->environment;
    if (e->rgb && (e->width < 1 || e->height < 1 || e->levels < 1))
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "environment: it has no texel; give sizes of 1 at least");
    if (e->rgb && 3.0 * e->width * e->height * e->levels > INT_MAX)
        return lobe_ssr_fail(LOBE_SSR_BAD_INPUT,
                             "environment: 2^31 numbers or more; give a smaller picture");
    return LOBE_SSR_OK;
}

lobe_ssr_result lobe_ssr_run(lobe_ssr *s, const lobe_ssr_frame *frame,
                             lobe_ssr_statistics *statistics) {
    lobe_ssr_result result = check_frame(frame);
    if (result != LOBE_SSR_OK) return result;
    lobe_ssr_statistics own;
    lobe_ssr_statistics *st = statistics ? statistics : &own;
    *st = (lobe_ssr_statistics){0};
    result = s->driver->run(s, frame, st);
    if (result == LOBE_SSR_OK) s->frame++;
    return result;
}

const lobe_ssr_ray *lobe_ssr_rays(const lobe_ssr *s) {
    return s->rays;
}

const float *lobe_ssr_resolved(const lobe_ssr *s) {
    return s->resolved;
}

const float *lobe_ssr_reflection(const lobe_ssr *s) {
    return s->reflection;
}

const float *lobe_ssr_radiance(const lobe_ssr *s) {
    return s->radiance;
}

const float *lobe_ssr_composite(const lobe_ssr *s) {
    return s->composite;
}
