#include "identity.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <xxhash.h>

#include "lobe/version.h"
#include "scene.h"

/* Raised by every change of the renderer that changes the bits of pictures. */
enum { PICTURE_BITS = 3 };

__attribute__((format(printf, 2, 3))) static void add_line(char *text, const char *format, ...) {
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, IDENTITY_ROOM - used, format, arguments);
    va_end(arguments);
}

static void add_hash(char *text, const char *key, XXH64_hash_t hash) {
    add_line(text, "%s %016llx\n", key, (unsigned long long)hash);
}

static XXH64_hash_t hash_textures(const lobe_scene *s) {
    XXH64_hash_t hash = 0;
    for (uint32_t i = 0; i < s->texture_count; i++) {
        const texture *t = &s->textures[i];
        const int32_t shape[4] = {t->width, t->height, t->channels, t->is_srgb};
        hash = XXH3_64bits_withSeed(shape, sizeof shape, hash);
        hash = XXH3_64bits_withSeed(
            t->texels, (size_t)t->width * (size_t)t->height * (size_t)t->channels, hash);
    }
    return hash;
}

static XXH64_hash_t hash_sky(const lobe_scene *s) {
    if (!s->has_sky) return 0;
    const environment *e = &s->sky;
    const float turn[2] = {e->sine, e->cosine};
    const XXH64_hash_t hash = XXH3_64bits_withSeed(turn, sizeof turn, (XXH64_hash_t)e->width);
    return XXH3_64bits_withSeed(e->texels, (size_t)e->width * (size_t)e->height * sizeof *e->texels,
                                hash);
}

static XXH64_hash_t hash_view(const lobe_view *v) {
    const float view[10] = {v->position.x, v->position.y,      v->position.z, v->target.x,
                            v->target.y,   v->target.z,        v->up.x,       v->up.y,
                            v->up.z,       v->vertical_degrees};
    return XXH3_64bits(view, sizeof view);
}

/* What was read, not the files: a scene that moved is the same scene. None of these structures has padding. */
static void add_scene(char *text, const lobe_scene *s, const lobe_view *c) {
    if (isfinite(s->frame_time)) add_line(text, "frame-time %.17g\n", s->frame_time);
    const XXH64_hash_t places =
        XXH3_64bits(s->vertices, (size_t)s->vertex_count * sizeof *s->vertices);
    const XXH64_hash_t shapes = XXH3_64bits(s->shapes, (size_t)s->shape_count * sizeof *s->shapes);
    if (s->instance_count)
        add_hash(text, "instances",
                 XXH3_64bits_withSeed(s->instances,
                                      (size_t)s->instance_count * sizeof *s->instances, shapes));
    add_hash(text, "triangles",
             XXH3_64bits_withSeed(s->triangles, (size_t)s->triangle_count * sizeof *s->triangles,
                                  places));
    add_hash(text, "materials",
             XXH3_64bits(s->materials, s->material_count * sizeof *s->materials));
    add_hash(text, "textures", hash_textures(s));
    add_hash(text, "lamps", XXH3_64bits(s->lamps, s->lamp_count * sizeof *s->lamps));
    add_hash(text, "environment", hash_sky(s));
    add_hash(text, "camera", hash_view(c));
}

static void add_metal(char *text, const lobe_metal *m) {
    const float *t = m->tint, *n = m->n, *k = m->k;
    if (m->law == LOBE_METAL_SCHLICK) add_line(text, "metal schlick\n");
    if (m->law == LOBE_METAL_F82)
        add_line(text, "metal f82:%.9g,%.9g,%.9g\n", (double)t[0], (double)t[1], (double)t[2]);
    if (m->law == LOBE_METAL_CONDUCTOR)
        add_line(text, "metal conductor:%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", (double)n[0],
                 (double)n[1], (double)n[2], (double)k[0], (double)k[1], (double)k[2]);
}

static void add_options(char *text, const lobe_render_options *o) {
    static const char *const multiscatters[] = {"none", "kulla-conty", "turquin", "walk"};
    const lobe_reflection_options *r = &o->reflection;
    if (o->light_choice != LOBE_LIGHTS_AUTOMATIC)
        add_line(text, "lights %s\n", lobe_light_choice_name(o->light_choice));
    if (o->footprint >= 0.0f) add_line(text, "footprint %.9g\n", (double)o->footprint);
    if (o->is_adaptive) add_line(text, "adaptive yes\n");
    add_line(text, "size %dx%d\nspp %u\ndepth %d\nroulette %d\n", o->width, o->height, o->samples,
             o->depth, o->roulette_depth);
    if (o->aperture > 0.0f)
        add_line(text, "aperture %.9g\nfocus %.9g\n", (double)o->aperture, (double)o->focus);
    add_line(text, "ndf %s\nmasking %s\nmethod %s\n", lobe_ndf_name(r->model.ndf),
             lobe_masking_name(r->model.masking), lobe_render_method_name(r->model.method));
    add_line(text, "floor %.9g\ng2 %s\nnormalization %s\n", (double)r->floor,
             r->g2 == LOBE_G2_SEPARABLE ? "separable" : "correlated",
             r->normalization == LOBE_NORMALIZATION_UNBIASED ? "unbiased" : "previous");
    add_line(text, "multiscatter %s\nheuristic %s\n", multiscatters[o->multiscatter],
             lobe_heuristic_name(o->heuristic));
    add_metal(text, &o->metal);
    if (o->aovs & LOBE_AOV_BIT(LOBE_AOV_MOTION) && o->previous_view)
        add_hash(text, "previous-camera", hash_view(o->previous_view));
    add_line(text, "aov");
    for (int aov = 0; aov < LOBE_AOV_COUNT; aov++)
        if (o->aovs & LOBE_AOV_BIT(aov)) add_line(text, " %s", lobe_aov_name((lobe_aov)aov));
    add_line(text, "%s\n", o->aovs ? "" : " none");
}

void lobe_identity_write(char text[IDENTITY_ROOM], const lobe_scene *scene, const lobe_view *view,
                         const lobe_render_options *options) {
    memset(text, 0, IDENTITY_ROOM);
    add_line(text, "version %s\nbits %d\n", LOBE_VERSION_STRING, PICTURE_BITS);
    add_scene(text, scene, view);
    add_options(text, options);
}

void lobe_identity_value(const char *text, const char *key, char value[IDENTITY_VALUE_ROOM]) {
    const size_t length = strlen(key);
    for (const char *line = text; *line;) {
        const size_t rest = strcspn(line, "\n");
        if (rest > length && strncmp(line, key, length) == 0 && line[length] == ' ') {
            snprintf(value, IDENTITY_VALUE_ROOM, "%.*s", (int)(rest - length - 1),
                     line + length + 1);
            return;
        }
        line += rest + (line[rest] == '\n');
    }
    snprintf(value, IDENTITY_VALUE_ROOM, "none");
}

int lobe_identity_differs(const char *text, const char *other, const char *but,
                          identity_difference *d) {
    for (const char *line = text; *line;) {
        const size_t rest = strcspn(line, "\n");
        snprintf(d->key, sizeof d->key, "%.*s", (int)strcspn(line, " \n"), line);
        lobe_identity_value(text, d->key, d->value);
        lobe_identity_value(other, d->key, d->other);
        if (strcmp(d->value, d->other) != 0 && !(but && strcmp(but, d->key) == 0)) return 1;
        line += rest + (line[rest] == '\n');
    }
    return 0;
}
