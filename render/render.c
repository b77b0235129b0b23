/* From a scene and options to a film. The samples of a pixel are added up in one order, whoever makes them
 * (schedule.h), so the bits do not depend on the number of threads or processes. */

#include <errno.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "adaptive.h"
#include "camera_rays.h"
#include "crew.h"
#include "exr_film.h"
#include "integrator.h"
#include "ranks.h"

enum { FILTER_STEPS = 256 };

static const struct {
    lobe_heuristic value;
    const char *name;
} heuristics[] = {{LOBE_HEURISTIC_BALANCE, "balance"},
                  {LOBE_HEURISTIC_POWER, "power"},
                  {LOBE_HEURISTIC_BSDF_ONLY, "bsdf-only"},
                  {LOBE_HEURISTIC_LIGHT_ONLY, "light-only"}};

lobe_heuristic lobe_heuristic_from_name(const char *name, int *known) {
    for (size_t i = 0; i < sizeof heuristics / sizeof *heuristics; i++)
        if (strcmp(heuristics[i].name, name) == 0) {
            *known = 1;
            return heuristics[i].value;
        }
    *known = 0;
    return LOBE_HEURISTIC_POWER;
}

const char *lobe_heuristic_name(lobe_heuristic heuristic) {
    return (unsigned)heuristic < 4u ? heuristics[heuristic].name : NULL;
}

static const char *const light_choices[] = {"auto", "power", "tree"};

const char *lobe_light_choice_name(lobe_light_choice choice) {
    return (unsigned)choice < 3u ? light_choices[choice] : NULL;
}

lobe_render_options lobe_render_default_options(void) {
    lobe_reflection_options reflection = lobe_reflection_default_options();
    reflection.model.method = LOBE_METHOD_COUNT; /* by surface: render/material.c */
    return (lobe_render_options){.reflection = reflection,
                                 .width = 960,
                                 .height = 540,
                                 .samples = 64,
                                 .depth = 8,
                                 .roulette_depth = 5,
                                 .footprint = -1.0f,
                                 .heuristic = LOBE_HEURISTIC_BALANCE,
                                 .checkpoint_seconds = 60.0,
                                 .part = 1,
                                 .parts = 1};
}

/* What the threads share. */
typedef struct job {
    const lobe_scene *scene;
    const lobe_render_options *options;
    integrator integrator;
    metal metal;
    lobe_view view;
    camera_rays camera, previous;
    float filter[FILTER_STEPS + 1];
} job;

/* Inverse distribution of the Blackman-Harris window (Harris 1978), 3 pixels wide: pixels are filtered
 * by drawing from it, so every sample weighs the same. */
static void make_filter(float table[FILTER_STEPS + 1]) {
    enum { CELLS = 4096 };
    const double width = 3.0;
    double sum[CELLS + 1] = {0.0};
    for (int i = 0; i < CELLS; i++) {
        double t = 6.283185307179586 * (i + 0.5) / CELLS;
        sum[i + 1] =
            sum[i] + 0.35875 - 0.48829 * cos(t) + 0.14128 * cos(2 * t) - 0.01168 * cos(3 * t);
    }
    for (int k = 0, i = 0; k <= FILTER_STEPS; k++) {
        double target = sum[CELLS] * k / FILTER_STEPS;
        while (i < CELLS && sum[i + 1] < target) i++;
        double share = i < CELLS ? (target - sum[i]) / (sum[i + 1] - sum[i]) : 0.0;
        table[k] = (float)(width * ((i + share) / CELLS - 0.5));
    }
}

static float filter_offset(const job *j, uint32_t bits) {
    float x = sampler_unit(bits) * FILTER_STEPS;
    int k = (int)x;
    return j->filter[k] + (x - (float)k) * (j->filter[k + 1] - j->filter[k]);
}

/* The paths of a tile, and the pixels they belong to. */
typedef struct batch {
    int count;
    path paths[WAVE_PATHS];
    vec3 origins[WAVE_PATHS], directions[WAVE_PATHS]; /* of the camera's rays */
    size_t pixels[WAVE_PATHS];
} batch;

static void begin_path(const job *j, batch *b, int x, int y, sampler points) {
    const lobe_render_options *o = j->options;
    const int i = b->count++;
    vec3 *origin = &b->origins[i], *direction = &b->directions[i];
    const sampler_point p = lobe_sampler_next(&points);
    float px = ((float)x + 0.5f + filter_offset(j, p.bits[0])) / (float)o->width * 2.0f - 1.0f;
    float py = 1.0f - ((float)y + 0.5f + filter_offset(j, p.bits[1])) / (float)o->height * 2.0f;
    lobe_camera_ray(&j->camera, px, py, sampler_unit(p.bits[2]), sampler_unit(p.bits[3]), origin,
                    direction);
    lobe_path_begin(&b->paths[i], &j->integrator, *origin, *direction, points);
}

/* Samples are added in the order of their paths. */
static void finish_paths(const job *j, batch *b, lobe_film *tile, uint64_t *rays) {
    if (b->count == 0) return;
    lobe_trace_paths(b->paths, b->count);
    for (int i = 0; i < b->count; i++) {
        film_sample *sample = &b->paths[i].sample;
        if (j->options->aovs & LOBE_AOV_BIT(LOBE_AOV_MOTION))
            lobe_camera_motion(&j->camera, &j->previous, b->origins[i], b->directions[i],
                               sample->depth, sample->motion);
        const uint32_t index = b->paths[i].numbers.index;
        sample->is_first_half = j->options->is_adaptive ? !(index & ADAPTIVE_HALF_BLOCK)
                                                        : lobe_film_is_first_half(index);
        lobe_film_add(tile, b->pixels[i], sample);
        *rays += b->paths[i].rays;
    }
    b->count = 0;
}

static void render_tile(const void *user, const unit *u, lobe_film *tile, uint64_t *rays) {
    const job *j = user;
    if (j->integrator.log) lobe_ray_log_begin_unit(j->integrator.log);
    const lobe_render_options *o = j->options;
    const int across = (o->width + TILE - 1) / TILE;
    const int left = (int)u->tile % across * TILE, top = (int)u->tile / across * TILE;
    batch b;
    b.count = 0;
    for (int y = 0; y < TILE && top + y < o->height; y++)
        for (int x = 0; x < TILE && left + x < o->width; x++) {
            sampler points = {.key = lobe_sampler_round_key(o->seed, (uint32_t)(left + x),
                                                            (uint32_t)(top + y), u->round),
                              .index_bits = lobe_sampler_index_bits(u->of)};
            for (uint32_t i = u->first; i < u->first + u->count; i++) {
                points.index = i;
                b.pixels[b.count] = (size_t)(y * TILE + x);
                begin_path(j, &b, left + x, top + y, points);
                if (b.count == WAVE_PATHS) finish_paths(j, &b, tile, rays);
            }
        }
    finish_paths(j, &b, tile, rays);
}

float lobe_lens_radius(float f_number, float vertical_degrees) {
    const float half_height = 0.012f; /* metres */
    return half_height / (2.0f * f_number * tanf(0.5f * vertical_degrees * (LOBE_PI / 180.0f)));
}

float lobe_scene_focus(const lobe_scene *scene, const lobe_view *view) {
    const camera_rays c = lobe_camera_rays(view, 1, 1);
    lobe_ray_surface surface;
    return lobe_first_surface(scene, c.eye, c.forward, &surface) ? surface.distance : 0.0f;
}

/* What was asked for, or what follows from the view. */
static lobe_render_result find_lens(const lobe_scene *scene, const lobe_view *view,
                                    lobe_render_options *o) {
    if (o->f_number > 0.0f) o->aperture = lobe_lens_radius(o->f_number, view->vertical_degrees);
    if (o->aperture > 0.0f && o->focus == 0.0f) o->focus = lobe_scene_focus(scene, view);
    if (o->aperture > 0.0f && o->focus == 0.0f)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: nothing to focus on in the middle of the picture; give a distance",
                         scene->name);
    return LOBE_RENDER_OK;
}

static lobe_render_result find_view(const lobe_scene *scene, lobe_render_options *o,
                                    lobe_view *view) {
    lobe_render_result result = LOBE_RENDER_OK;
    if (o->view)
        *view = *o->view;
    else
        result = lobe_scene_view(scene, o->camera, (float)o->width / (float)o->height, view);
    return result == LOBE_RENDER_OK ? find_lens(scene, view, o) : result;
}

static void aim(job *j) {
    const lobe_render_options *o = j->options;
    j->camera = lobe_camera_rays(&j->view, o->width, o->height);
    j->previous =
        o->previous_view ? lobe_camera_rays(o->previous_view, o->width, o->height) : j->camera;
    if (o->aperture > 0.0f) lobe_camera_add_lens(&j->camera, o->aperture, o->focus);
    integrator *k = &j->integrator;
    const float few = maxf(1.0f / sqrtf((float)o->samples), 0.125f);
    k->share = o->footprint >= 0.0f ? o->footprint : few;
    k->axis = j->camera.forward;
    k->pixel_angle = k->share * 2.0f * v3_length(j->camera.up) / (float)o->height;
}

const char *lobe_render_method_name(lobe_method method) {
    return method == LOBE_METHOD_COUNT ? "by surface" : lobe_method_name(method);
}

static lobe_method method_or_best(lobe_model model) {
    return model.method == LOBE_METHOD_COUNT ? lobe_best_method(model.ndf, model.masking)
                                             : model.method;
}

static int is_offered(lobe_model model) {
    model.method = method_or_best(model);
    return lobe_model_exists(model);
}

static int is_view(const lobe_view *v) {
    return v3_is_finite(v->position) && v3_is_finite(v->target) && v3_is_finite(v->up) &&
           v->vertical_degrees > 0.0f && v->vertical_degrees < 180.0f;
}

/* Whose reciprocals are finite too. */
static int is_lens(const lobe_render_options *o) {
    return o->aperture >= 0.0f && o->aperture <= 1e15f && o->f_number >= 0.0f &&
           o->f_number <= 1e15f && (o->f_number == 0.0f || o->f_number >= 1e-3f) &&
           (o->focus == 0.0f || (o->focus >= 1e-15f && o->focus <= 1e15f));
}

static lobe_render_result check_options(const lobe_render_options *o) {
    if (o->width < 1 || o->height < 1 || o->width > LOBE_RENDER_SIZE_MAX ||
        o->height > LOBE_RENDER_SIZE_MAX)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "size: %d x %d is out of range; use 1 to %d",
                         o->width, o->height, LOBE_RENDER_SIZE_MAX);
    if (o->samples < 1 || o->samples > LOBE_RENDER_SAMPLES_MAX)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "samples: %u is out of range; use 1 to %d",
                         o->samples, LOBE_RENDER_SAMPLES_MAX);
    if (o->depth < 0 || o->depth > 1000000)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "depth: %d is out of range; use 0 to 1000000",
                         o->depth);
    if (o->threads < 0 || o->threads > 1024)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "threads: %d is out of range; use 0 to 1024",
                         o->threads);
    if (o->part < 1 || o->part > o->parts)
        return lobe_fail(LOBE_RENDER_BAD_INPUT, "part: there is no part %u of %u; use 1 to %u",
                         o->part, o->parts, o->parts);
    if (o->parts > 1 && (o->noise > 0.0 || o->is_adaptive))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "part: a part does not know the noise of the others; leave one out");
    if (o->is_adaptive && o->samples < ADAPTIVE_SAMPLES_MIN)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "samples: %u are too few to tell noise by; use %d or more", o->samples,
                         ADAPTIVE_SAMPLES_MIN);
    const lobe_model model = o->reflection.model;
    if (o->multiscatter == LOBE_MULTISCATTER_WALK &&
        (model.masking != LOBE_MASKING_SMITH || o->reflection.g2 != LOBE_G2_CORRELATED))
        return lobe_fail(
            LOBE_RENDER_BAD_INPUT,
            "multiscatter: walks are known for --masking smith --g2 correlated only; use "
            "another");
    if (!lobe_metal_is_usable(&o->metal))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "metal: a tint or an index is out of range; see lobe_metal in "
                         "lobe/render.h");
    if (!is_offered(model) || (unsigned)o->multiscatter > LOBE_MULTISCATTER_WALK ||
        !(o->reflection.floor >= 0.0 && o->reflection.floor <= 1.0) ||
        (unsigned)o->heuristic >= 4u || (unsigned)o->light_choice >= 3u ||
        (o->view && !is_view(o->view)) || (o->previous_view && !is_view(o->previous_view)) ||
        !is_lens(o) || !(o->footprint <= 1000.0f) || !(o->time_limit >= 0.0) ||
        !(o->noise >= 0.0) || !(o->checkpoint_seconds >= 0.0))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "options: a value is out of range; see lobe/render.h");
    return LOBE_RENDER_OK;
}

static int is_in_part(const lobe_render_options *o, size_t pixel) {
    const size_t across = (size_t)(o->width + TILE - 1) / TILE;
    const size_t x = pixel % (size_t)o->width / TILE, y = pixel / (size_t)o->width / TILE;
    return (y * across + x) % o->parts == o->part - 1;
}

static void fill_statistics(const crew *c, lobe_render_statistics *st) {
    const checkpoint_cost cost = lobe_crew_cost(c);
    *st = (lobe_render_statistics){.rays = cost.rays,
                                   .seconds = cost.seconds,
                                   .cpu_seconds = cost.cpu_seconds,
                                   .threads = c->threads,
                                   .pixel_samples = UINT32_MAX,
                                   .noise = lobe_film_noise(c->film),
                                   .has_failed_to_save = c->has_failed_to_save};
    for (size_t i = 0; i < (size_t)c->film->width * (size_t)c->film->height; i++) {
        const film_pixel *p = &c->film->pixels[i];
        if (!is_in_part(c->options, i)) continue;
        st->samples += p->samples + p->dropped;
        st->dropped_samples += p->dropped;
        st->ggx_draws += p->draws;
        st->ggx_rejected += p->rejected;
        uint32_t samples = p->samples + p->dropped;
        if (samples < st->pixel_samples) st->pixel_samples = samples;
    }
    if (st->ggx_draws) st->rejected_share = (double)st->ggx_rejected / (double)st->ggx_draws;
}

static int describe(lobe_film *film, const job *j, const char *identity) {
    film_metadata *m = &film->metadata;
    const char *method = lobe_render_method_name(j->options->reflection.model.method);
    memcpy(m->scene, j->scene->name, sizeof m->scene);
    memcpy(m->method, method, strlen(method) + 1);
    memcpy(m->identity, identity, sizeof m->identity);
    m->part = j->options->part;
    m->parts = j->options->parts;
    return lobe_film_set_seeds(film, &j->options->seed, 1);
}

/* ---- Going on -------------------------------------------------------------------------------- */

static lobe_render_result refuse(const char *path, const char *key, const char *value,
                                 const char *wanted) {
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: of another render, its %s is %s, not %s; use the same scene and options",
                     path, key, value, wanted);
}

static lobe_render_result check_same(const char *path, const film_metadata *m,
                                     const lobe_render_options *o, const char *identity) {
    identity_difference d;
    char value[32], wanted[32];
    if (lobe_identity_differs(identity, m->identity, NULL, &d))
        return refuse(path, d.key, d.other, d.value);
    if (lobe_identity_differs(m->identity, identity, NULL, &d)) /* a line too many */
        return refuse(path, d.key, d.value, d.other);
    snprintf(wanted, sizeof wanted, "%llu", (unsigned long long)o->seed);
    snprintf(value, sizeof value, "%llu", (unsigned long long)m->seeds[0]);
    if (m->seed_count != 1) return refuse(path, "seed", "more than one", wanted);
    return m->seeds[0] == o->seed ? LOBE_RENDER_OK : refuse(path, "seed", value, wanted);
}

static lobe_render_result check_resumed(const lobe_film *film, const lobe_render_options *o,
                                        const char *identity) {
    const film_metadata *m = &film->metadata;
    char value[32], wanted[32];
    const lobe_render_result result = check_same(o->resume, m, o, identity);
    if (result != LOBE_RENDER_OK) return result;
    snprintf(wanted, sizeof wanted, "%u/%u", o->part, o->parts);
    snprintf(value, sizeof value, "%u/%u", m->part, m->parts);
    if (m->part != o->part || m->parts != o->parts) return refuse(o->resume, "part", value, wanted);
    if (film->width == o->width && film->height == o->height && film->aovs == o->aovs)
        return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT, "%s: its parts do not fit together; take another one",
                     o->resume);
}

/* A job that is always started by the same command has no checkpoint the first time. */
static int is_first_run(const lobe_render_options *o) {
    return o->checkpoint && strcmp(o->checkpoint, o->resume) == 0 && access(o->resume, F_OK) != 0 &&
           errno == ENOENT;
}

static lobe_render_result open_film(crew *c, const job *j, const char *identity) {
    const lobe_render_options *o = j->options;
    lobe_render_result result = LOBE_RENDER_OK;
    if (o->checkpoint && lobe_checkpoint_would_destroy(o->checkpoint))
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: there is a file that is no checkpoint; choose another name",
                         o->checkpoint);
    if (o->resume && !is_first_run(o)) {
        result = lobe_checkpoint_read(o->resume, &c->film, &c->before);
        if (result == LOBE_RENDER_OK) result = check_resumed(c->film, o, identity);
    } else {
        c->film = lobe_film_create(o->width, o->height, o->aovs);
        if (!c->film || (o->is_adaptive && !lobe_adaptive_begin(c->film, o->samples)))
            result = lobe_fail_memory("film");
    }
    if (result == LOBE_RENDER_OK && !describe(c->film, j, identity))
        result = lobe_fail_memory("film");
    return result;
}

/* All ranks have to mean the same picture. */
static lobe_render_result compare_with_first_rank(const char *identity) {
    char first[IDENTITY_ROOM];
    identity_difference d;
    memcpy(first, identity, sizeof first);
    lobe_ranks_broadcast(first, sizeof first);
    if (!lobe_identity_differs(identity, first, NULL, &d)) return LOBE_RENDER_OK;
    return lobe_fail(LOBE_RENDER_BAD_INPUT,
                     "%s: %s here, %s at rank 0; give all nodes the same files", d.key, d.value,
                     d.other);
}

/* A file with very many indices gets the nearest ones. */
const coat_table **lobe_find_coats(const lobe_scene *s, const lobe_reflection_options *o) {
    enum { INDICES_MAX = 64 };
    const coat_table *known[INDICES_MAX], **coats = malloc((s->material_count + 1) * sizeof *coats);
    int count = 0;
    for (uint32_t i = 0; coats && i <= s->material_count; i++) {
        const float ior = i < s->material_count ? s->materials[i].ior : COAT_IOR;
        int nearest = 0;
        for (int k = 1; k < count; k++)
            if (fabsf(known[k]->ior - ior) < fabsf(known[nearest]->ior - ior)) nearest = k;
        if (count < INDICES_MAX && (count == 0 || known[nearest]->ior != ior)) {
            nearest = count++;
            known[nearest] =
                lobe_coat_table(o->model.ndf, o->model.masking, o->g2, ior, s->has_anisotropy);
        }
        coats[i] = known[nearest];
        if (coats[i]) continue;
        free(coats);
        coats = NULL;
    }
    return coats;
}

/* Rank 0, or the only process. */
static lobe_render_result lead(crew *c, lobe_film **film, lobe_render_statistics *statistics) {
    lobe_render_result result = lobe_crew_run(c);
    if (result != LOBE_RENDER_OK) return result;
    lobe_render_statistics own;
    fill_statistics(c, statistics ? statistics : &own);
    c->film->metadata.samples = lobe_film_most_samples(c->film);
    c->film->metadata.seconds = lobe_crew_cost(c).seconds;
    *film = c->film;
    c->film = NULL;
    return c->is_cancelled ? LOBE_RENDER_INTERRUPTED : LOBE_RENDER_OK;
}

/* With few lights, what the tree costs is more than what it gains. */
static int has_light_tree(const lobe_scene *s, lobe_light_choice choice) {
    enum { FEW = 15 };
    if (choice != LOBE_LIGHTS_AUTOMATIC) return choice == LOBE_LIGHTS_TREE;
    return s->light_count + s->lamp_count > FEW;
}

static lobe_render_result render_with(const coat_table *const *coats, const lobe_scene *scene,
                                      lobe_render_options *options, ray_log *log, lobe_film **film,
                                      lobe_render_statistics *statistics) {
    job j = {.scene = scene, .options = options, .metal = lobe_metal_prepare(&options->metal)};
    crew c = {.options = options,
              .render = render_tile,
              .user = &j,
              .start = lobe_clock(),
              .before.cpu_seconds = -lobe_cpu_clock()};
    j.integrator = (integrator){
        scene,
        {.ggx = options->reflection, .multiscatter = options->multiscatter, .metal = &j.metal},
        coats,
        options->heuristic,
        options->depth,
        options->roulette_depth,
        (options->aovs & LOBE_AOV_BIT(LOBE_AOV_VNDF_INTEGRAL)) != 0,
        .has_light_tree = has_light_tree(scene, options->light_choice),
        .log = log};
    char identity[IDENTITY_ROOM] = "";
    lobe_render_result result = find_view(scene, options, &j.view);
    if (result == LOBE_RENDER_OK) {
        aim(&j);
        make_filter(j.filter);
        lobe_identity_write(identity, scene, &j.view, options);
    }
    if (result == LOBE_RENDER_OK && lobe_ranks_own() == 0) result = open_film(&c, &j, identity);
    result = lobe_ranks_agree(result);
    if (result == LOBE_RENDER_OK) result = lobe_ranks_agree(compare_with_first_rank(identity));
    if (result == LOBE_RENDER_OK) {
        c.threads = options->threads ? options->threads : omp_get_max_threads();
        omp_init_lock(&c.lock);
        result = lobe_ranks_own() == 0 ? lead(&c, film, statistics) : lobe_ranks_help(&c);
        omp_destroy_lock(&c.lock);
    }
    lobe_film_free(c.film);
    return result;
}

/* The choice by surface is known for Smith-GGX; else the best method is one for all. */
static void choose_method(lobe_render_options *o) {
    lobe_model *model = &o->reflection.model;
    if (model->ndf != LOBE_NDF_GGX || model->masking != LOBE_MASKING_SMITH)
        model->method = method_or_best(*model);
}

static lobe_render_result render_and_log(const lobe_scene *scene, lobe_render_options options,
                                         ray_log *log, lobe_film **film,
                                         lobe_render_statistics *statistics) {
    *film = NULL;
    lobe_render_result result = check_options(&options);
    if (result != LOBE_RENDER_OK) return result;
    choose_method(&options);
    const coat_table **coats = lobe_find_coats(scene, &options.reflection);
    result = lobe_ranks_agree(coats ? LOBE_RENDER_OK : lobe_fail_memory(scene->name));
    if (result == LOBE_RENDER_OK)
        result = render_with(coats, scene, &options, log, film, statistics);
    free(coats);
    return result;
}

lobe_render_result lobe_render(const lobe_scene *scene, lobe_render_options options,
                               lobe_film **film, lobe_render_statistics *statistics) {
    return render_and_log(scene, options, NULL, film, statistics);
}

/* ---- What need not be rendered again --------------------------------------------------------- */

static int has_all_samples(const lobe_film *film, const lobe_render_options *o) {
    if (film->aovs != o->aovs || film->width != o->width || film->height != o->height ||
        (film->weights != NULL) != o->is_adaptive)
        return 0;
    for (size_t i = 0; i < (size_t)film->width * (size_t)film->height; i++)
        if (lobe_film_weight(film, i) != (is_in_part(o, i) ? (double)o->samples : 0.0)) return 0;
    return 1;
}

/* What cannot be read as a picture of this program is none that was finished. */
static lobe_render_result look_at(const lobe_scene *scene, lobe_render_options *o, const char *path,
                                  float exposure, int *is_finished) {
    char identity[IDENTITY_ROOM], options[EXR_OPTIONS_ROOM];
    lobe_view view;
    lobe_film *film = NULL;
    lobe_render_result result = check_options(o);
    if (result == LOBE_RENDER_OK) result = find_view(scene, o, &view);
    if (result != LOBE_RENDER_OK || lobe_exr_read_film(path, &film) != LOBE_RENDER_OK)
        return result;
    choose_method(o);
    lobe_identity_write(identity, scene, &view, o);
    lobe_exr_options(options, identity, exposure);
    result = check_same(path, &film->metadata, o, options);
    *is_finished = result == LOBE_RENDER_OK && has_all_samples(film, o);
    lobe_film_free(film);
    return result;
}

lobe_render_result lobe_render_find_finished(const lobe_scene *scene, lobe_render_options options,
                                             const char *path, float exposure, int *is_finished) {
    *is_finished = 0;
    lobe_render_result result = LOBE_RENDER_OK;
    if (lobe_ranks_own() == 0) result = look_at(scene, &options, path, exposure, is_finished);
    lobe_ranks_broadcast(is_finished, sizeof *is_finished);
    return lobe_ranks_agree(result);
}

lobe_render_result lobe_render_logged(const lobe_scene *scene, lobe_render_options options,
                                      ray_log *log, lobe_render_statistics *statistics) {
    lobe_film *film = NULL;
    options.threads = 1;
    const lobe_render_result result = render_and_log(scene, options, log, &film, statistics);
    lobe_film_free(film);
    return result;
}
