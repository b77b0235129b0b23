#include "import_obj.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <sys/stat.h>

/* ---- Files that Assimp opens ----------------------------------------------------------------------- */

/* Assimp's file, and what it reads from. */
typedef struct obj_file {
    struct aiFile face;
    FILE *file;
    char *text; /* of a library; NULL: the scene itself */
    struct obj_file *next;
} obj_file;

static FILE *file_of(struct aiFile *f) {
    return ((obj_file *)(void *)f->UserData)->file;
}

static size_t read_bytes(struct aiFile *f, char *to, size_t size, size_t count) {
    return fread(to, size, count, file_of(f));
}

static size_t write_nothing(struct aiFile *f, const char *from, size_t size, size_t count) {
    (void)f, (void)from, (void)size, (void)count;
    return 0;
}

static size_t tell(struct aiFile *f) {
    const long at = ftell(file_of(f));
    return at > 0 ? (size_t)at : 0;
}

static enum aiReturn seek(struct aiFile *f, size_t offset, enum aiOrigin origin) {
    const int whence = origin == aiOrigin_CUR   ? SEEK_CUR
                       : origin == aiOrigin_END ? SEEK_END
                                                : SEEK_SET;
    return fseek(file_of(f), (long)offset, whence) == 0 ? aiReturn_SUCCESS : aiReturn_FAILURE;
}

static size_t size_of(struct aiFile *f) {
    const size_t at = tell(f);
    seek(f, 0, aiOrigin_END);
    const size_t size = tell(f);
    seek(f, at, aiOrigin_SET);
    return size;
}

static void flush_nothing(struct aiFile *f) {
    (void)f;
}

/* Assimp takes nothing shorter for a text. */
enum { SHORTEST = 8 };

/* SHORTEST line ends, all of a file and room for a byte more, by malloc; NULL: it cannot be read. A pipe might never
 * end. */
static char *read_text(const char *path, size_t *size) {
    struct stat status;
    FILE *file = stat(path, &status) == 0 && S_ISREG(status.st_mode) ? fopen(path, "rb") : NULL;
    if (!file) return NULL;
    size_t room = 65536;
    char *text = malloc(room);
    if (text) memset(text, '\n', SHORTEST);
    *size = SHORTEST;
    for (size_t n; text && (n = fread(text + *size, 1, room - 1 - *size, file)) > 0;) {
        *size += n;
        if (*size < room - 1) continue;
        char *grown = realloc(text, room *= 2);
        if (!grown) free(text);
        text = grown;
    }
    if (text && ferror(file)) {
        free(text);
        text = NULL;
    }
    fclose(file);
    return text;
}

static const char *last_part(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/* A library: its materials are read here, their names by Assimp, which looks for it in several places. */
static void open_library(obj_reader *r, obj_file *f, const char *path) {
    size_t size;
    const char *name = last_part(path);
    f->text = read_text(path, &size);
    if (!f->text) {
        if (!r->missing[0]) snprintf(r->missing, sizeof r->missing, "%s", name);
        return;
    }
    if (strncmp(r->missing, name, sizeof r->missing - 1) == 0) r->missing[0] = 0;
    lobe_mtl_read(&r->library, f->text + SHORTEST, size - SHORTEST);
    f->text[size] = '\n';
    f->file = fmemopen(f->text, size + 1, "rb");
}

static void free_file(obj_file *f) {
    if (f->file) fclose(f->file);
    free(f->text);
    free(f);
}

static void close_file(struct aiFileIO *io, struct aiFile *face) {
    obj_reader *r = (obj_reader *)(void *)io->UserData;
    obj_file **place = &r->open;
    while (*place && &(*place)->face != face) place = &(*place)->next;
    if (!*place) return;
    obj_file *f = *place;
    *place = f->next;
    free_file(f);
}

/* The scene stays open while its libraries are read: when it is opened once more, it calls itself one. */
static int is_scene(const obj_reader *r, const char *path) {
    if (strcmp(path, r->path) != 0) return 0;
    for (const obj_file *f = r->open; f; f = f->next)
        if (!f->text) return 0;
    return 1;
}

static struct aiFile *open_path(struct aiFileIO *io, const char *path, const char *mode) {
    (void)mode;
    obj_reader *r = (obj_reader *)(void *)io->UserData;
    obj_file *f = calloc(1, sizeof *f);
    if (!f) return NULL;
    f->face = (struct aiFile){.ReadProc = read_bytes,
                              .WriteProc = write_nothing,
                              .TellProc = tell,
                              .FileSizeProc = size_of,
                              .SeekProc = seek,
                              .FlushProc = flush_nothing,
                              .UserData = (char *)f};
    if (is_scene(r, path))
        f->file = fopen(path, "rb");
    else
        open_library(r, f, path);
    if (!f->file) {
        free_file(f);
        return NULL;
    }
    f->next = r->open;
    r->open = f;
    return &f->face;
}

/* What Assimp leaves open where it gives up. */
static void close_all(obj_reader *r) {
    while (r->open) close_file(&r->files, &r->open->face);
}

const struct aiScene *lobe_obj_read(obj_reader *r, unsigned steps) {
    r->files = (struct aiFileIO){open_path, close_file, (char *)r};
    const struct aiScene *scene = aiImportFileEx(r->path, steps, &r->files);
    close_all(r);
    lobe_mtl_sort(&r->library);
    r->scene->out_of_memory |= r->library.out_of_memory;
    return scene;
}

/* ---- Materials ------------------------------------------------------------------------------------- */

static vec3 clamp_color(vec3 c) {
    return v3(minf(c.x, 1.0f), minf(c.y, 1.0f), minf(c.z, 1.0f));
}

static float unit(float x) {
    return clampf(x, 0.0f, 1.0f);
}

static float number_or(const mtl_material *from, int index, float fallback) {
    return isnan(from->numbers[index]) ? fallback : from->numbers[index];
}

static vec3 color_or(const mtl_material *from, int index, vec3 fallback) {
    const float *c = from->colors[index];
    return isnan(c[0]) ? fallback : v3(maxf(c[0], 0.0f), maxf(c[1], 0.0f), maxf(c[2], 0.0f));
}

/* A map multiplies its number. Exporters write maps beside a number of 0, or none: then it is the map alone. */
static float factor_or(const mtl_material *from, int index, int map, float fallback) {
    const float x = number_or(from, index, from->maps[map].name ? 1.0f : fallback);
    return from->maps[map].name && !(x > 0.0f) ? 1.0f : unit(x);
}

static texture_map read_map(const mtl_material *from, int index, texture_reader *textures,
                            picture_use use) {
    const mtl_map *own = &from->maps[index];
    texture_map map = lobe_texture_map(NO_TEXTURE);
    if (!own->name) return map;
    map.texture = lobe_import_texture(textures, own->name, use);
    /* v of ours points down */
    map.u[0] = own->scale[0];
    map.u[2] = own->offset[0];
    map.v[1] = own->scale[1];
    map.v[2] = 1.0f - own->scale[1] - own->offset[1];
    if (own->is_clamped) map.wrap_u = map.wrap_v = WRAP_CLAMP;
    return map;
}

/* One of the keys for physically based shading is there: Phong's are copies for others. */
static int is_physical(const mtl_material *from) {
    for (int i = MTL_PR; i <= MTL_ANISO; i++)
        if (!isnan(from->numbers[i])) return 1;
    for (int i = MTL_MAP_PR; i <= MTL_MAP_PCR; i++)
        if (from->maps[i].name) return 1;
    return 0;
}

/* What Phong's keys say beyond what is read of them. */
static void ignore_highlights(const mtl_material *from, mtl_library *library) {
    if (is_physical(from) || !(v3_max(color_or(from, MTL_KS, v3_all(0.0f))) > 0.0f)) return;
    lobe_mtl_ignore(library, "Ks");
    if (!isnan(from->numbers[MTL_NS])) lobe_mtl_ignore(library, "Ns");
}

/* 6 and 7 refract: what Tf leaves, as much as d does not take. */
static void read_glass(const mtl_material *from, material *m) {
    const float opacity = m->alpha;
    m->alpha = 1.0f;
    m->thickness = 1.0f;
    m->transmission = opacity < 1.0f ? 1.0f - opacity : 1.0f;
    if (!(opacity < 1.0f)) m->base_color = clamp_color(color_or(from, MTL_TF, v3_all(1.0f)));
    if (isnan(from->numbers[MTL_PR]) && !from->maps[MTL_MAP_PR].name) m->roughness = 0.0f;
}

static void read_illumination(const mtl_material *from, mtl_library *library, material *m) {
    const float illum = number_or(from, MTL_ILLUM, 2.0f), index = number_or(from, MTL_NI, 1.0f);
    const vec3 filter = color_or(from, MTL_TF, v3_all(1.0f));
    const int is_glass = illum == 6.0f || illum == 7.0f;
    if (index > 1.0f) m->ior = minf(index, 1000.0f);
    m->is_unlit = illum == 0.0f;
    if (illum == 1.0f && !is_physical(from)) m->specular = 0.0f;
    if (illum > 1.0f) ignore_highlights(from, library);
    if (illum < 0.0f || illum > 9.0f || illum != floorf(illum))
        lobe_mtl_ignore(library, "illum beyond 0 to 9");
    if (m->alpha < 1.0f && (filter.x < 1.0f || filter.y < 1.0f || filter.z < 1.0f))
        lobe_mtl_ignore(library, "Tf of what d leaves a share of");
    if (is_glass) read_glass(from, m);
}

static void read_opacity(const mtl_material *from, texture_reader *textures, material *m) {
    m->alpha = factor_or(from, MTL_D, MTL_MAP_D, 1.0f);
    m->opacity_map = read_map(from, MTL_MAP_D, textures, AS_OPACITY);
    if (m->alpha < 1.0f || m->opacity_map.texture != NO_TEXTURE) m->alpha_mode = ALPHA_BLEND;
}

static void read_emission(const mtl_material *from, texture_reader *textures, material *m) {
    m->emission = color_or(from, MTL_KE, v3_all(0.0f));
    if (!from->maps[MTL_MAP_KE].name) return;
    if (!(v3_max(m->emission) > 0.0f)) m->emission = v3_all(1.0f);
    m->emission_map = read_map(from, MTL_MAP_KE, textures, AS_COLOR);
}

static void read_clearcoat(const mtl_material *from, texture_reader *textures, material *m) {
    m->clearcoat = factor_or(from, MTL_PC, MTL_MAP_PC, 0.0f);
    if (!(m->clearcoat > 0.0f)) return;
    m->clearcoat_roughness = factor_or(from, MTL_PCR, MTL_MAP_PCR, 0.0f);
    m->clearcoat_map = read_map(from, MTL_MAP_PC, textures, AS_VALUES);
    m->clearcoat_roughness_map = read_map(from, MTL_MAP_PCR, textures, AS_VALUES);
}

/* Turns of the direction, counter-clockwise. Less than 0 is across it. */
static void read_anisotropy(const mtl_material *from, material *m) {
    const float strength = number_or(from, MTL_ANISO, 0.0f);
    const float turns = number_or(from, MTL_ANISOR, 0.0f) + (strength < 0.0f ? 0.25f : 0.0f);
    m->stretch = unit(fabsf(strength));
    m->stretch_x = cosf(2.0f * LOBE_PI * turns);
    m->stretch_y = sinf(2.0f * LOBE_PI * turns);
}

static material read_material(const mtl_material *from, mtl_library *library,
                              texture_reader *textures) {
    material m = lobe_default_material();
    const vec3 usual = from->maps[MTL_MAP_KD].name ? v3_all(1.0f) : m.base_color;
    m.base_color = clamp_color(color_or(from, MTL_KD, usual));
    m.base_map = read_map(from, MTL_MAP_KD, textures, AS_COLOR);
    m.roughness = factor_or(from, MTL_PR, MTL_MAP_PR, m.roughness);
    m.roughness_map = read_map(from, MTL_MAP_PR, textures, AS_VALUES);
    m.metallic = factor_or(from, MTL_PM, MTL_MAP_PM, 0.0f);
    m.metallic_map = read_map(from, MTL_MAP_PM, textures, AS_VALUES);
    m.normal_map = read_map(from, MTL_NORM, textures, AS_VALUES);
    m.normal_scale = from->maps[MTL_NORM].name ? from->maps[MTL_NORM].strength : 1.0f;
    read_emission(from, textures, &m);
    read_opacity(from, textures, &m);
    read_clearcoat(from, textures, &m);
    read_anisotropy(from, &m);
    read_illumination(from, library, &m);
    return m;
}

material lobe_obj_material(obj_reader *r, const char *name, texture_reader *textures,
                           const lobe_scene_options *options) {
    const mtl_material *from = lobe_mtl_find(&r->library, name);
    if (from) return read_material(from, &r->library, textures);
    if (strcmp(name, AI_DEFAULT_MATERIAL_NAME) != 0)
        lobe_mtl_ignore(&r->library, "usemtl of a name that no library has");
    return lobe_fallback_material(options);
}

/* Words of a file that may be any bytes. */
static void make_printable(char *text) {
    for (char *c = text; *c; c++)
        if (*c < ' ' || *c > '~') *c = '?';
}

void lobe_obj_warn(obj_reader *r) {
    make_printable(r->missing);
    if (r->missing[0])
        lobe_warn(&r->scene->warnings,
                  "%s: the material library %s cannot be read; what it describes is shown as if it "
                  "had no material",
                  r->path, r->missing);
    for (size_t i = 0; i < r->library.ignored_count; i++) {
        make_printable(r->library.ignored[i]);
        lobe_warn(&r->scene->warnings, "%s: its materials have %s; it is ignored", r->path,
                  r->library.ignored[i]);
    }
}

void lobe_obj_free(obj_reader *r) {
    lobe_mtl_free(&r->library);
}
