#include "mtl.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* ---- What is known ------------------------------------------------------------------------------- */

/* NOTHING: means nothing to a path tracer, or is read elsewhere. */
typedef enum mtl_kind { NUMBER, COLOR, MAP, NOTHING } mtl_kind;

typedef struct mtl_key {
    const char *name; /* of any case: exporters differ */
    mtl_kind kind;
    int index;
} mtl_key;

static const mtl_key keys[] = {
    {"Ns", NUMBER, MTL_NS},         {"Ni", NUMBER, MTL_NI},
    {"d", NUMBER, MTL_D},           {"Tr", NUMBER, MTL_D},
    {"illum", NUMBER, MTL_ILLUM},   {"Pr", NUMBER, MTL_PR},
    {"Pm", NUMBER, MTL_PM},         {"Pc", NUMBER, MTL_PC},
    {"Pcr", NUMBER, MTL_PCR},       {"aniso", NUMBER, MTL_ANISO},
    {"anisor", NUMBER, MTL_ANISOR}, {"Kd", COLOR, MTL_KD},
    {"Ks", COLOR, MTL_KS},          {"Ke", COLOR, MTL_KE},
    {"Tf", COLOR, MTL_TF},          {"map_Kd", MAP, MTL_MAP_KD},
    {"map_Ke", MAP, MTL_MAP_KE},    {"map_emissive", MAP, MTL_MAP_KE},
    {"map_d", MAP, MTL_MAP_D},      {"map_Pr", MAP, MTL_MAP_PR},
    {"map_Pm", MAP, MTL_MAP_PM},    {"map_Pc", MAP, MTL_MAP_PC},
    {"map_Pcr", MAP, MTL_MAP_PCR},  {"norm", MAP, MTL_NORM},
    {"map_Kn", MAP, MTL_NORM},      {"Ka", NOTHING, 0},
    {"map_Ka", NOTHING, 0},         {"map_aat", NOTHING, 0},
};

/* Options of maps: how many numbers may follow. READ: one of mtl_map's. */
typedef enum map_option { READ_OFFSET, READ_SCALE, READ_STRENGTH, READ_CLAMP, UNREAD } map_option;

static const struct option {
    const char *name; /* after a blank */
    map_option what;
    int numbers, words;
} options[] = {
    {" -o", READ_OFFSET, 3, 0},    {" -s", READ_SCALE, 3, 0},      {" -bm", READ_STRENGTH, 1, 0},
    {" -clamp", READ_CLAMP, 0, 1}, {" -t", UNREAD, 3, 0},          {" -mm", UNREAD, 2, 0},
    {" -boost", UNREAD, 1, 0},     {" -texres", UNREAD, 1, 0},     {" -imfchan", UNREAD, 0, 1},
    {" -blendu", UNREAD, 0, 1},    {" -blendv", UNREAD, 0, 1},     {" -cc", UNREAD, 0, 1},
    {" -type", UNREAD, 0, 1},      {" -colorspace", UNREAD, 0, 1},
};

/* ---- Words of a line ------------------------------------------------------------------------------- */

/* Lines are taken apart where they stand: words end in 0. */
static char *skip_blanks(char *text) {
    return text + strspn(text, " \t");
}

/* Cuts the first word off; returns it, and in *rest what follows. */
static char *cut_word(char *text, char **rest) {
    text = skip_blanks(text);
    char *end = text + strcspn(text, " \t");
    *rest = *end ? skip_blanks(end + 1) : end;
    *end = 0;
    return text;
}

static void trim(char *text) {
    size_t length = strlen(text);
    while (length && strchr(" \t", text[length - 1])) text[--length] = 0;
}

/* A number that ends where a word does. */
static int read_number(const char *text, char **end, float *value) {
    const float x = strtof(text, end);
    if (*end == text || !strchr(" \t", **end) || !isfinite(x)) return 0;
    *value = x;
    return 1;
}

static int is_end(const char *text) {
    return *text == 0 || *text == '#';
}

/* How many of up to `most` numbers were there; *rest is what follows them. */
static int read_numbers(char *text, float *values, int most, char **rest) {
    int count = 0;
    for (*rest = skip_blanks(text); count < most; count++) {
        char *end;
        if (!read_number(*rest, &end, &values[count])) break;
        *rest = skip_blanks(end);
    }
    return count;
}

/* ---- A library that grows -------------------------------------------------------------------------- */

static char *copy_of(mtl_library *l, const char *text) {
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    if (copy) memcpy(copy, text, size);
    l->out_of_memory |= !copy;
    return copy;
}

void lobe_mtl_ignore(mtl_library *l, const char *word) {
    for (size_t i = 0; i < l->ignored_count; i++)
        if (strcmp(l->ignored[i], word) == 0) return;
    if (l->ignored_count == MTL_IGNORED_MAX) return;
    if (!l->ignored) l->ignored = calloc(MTL_IGNORED_MAX, sizeof *l->ignored);
    l->out_of_memory |= !l->ignored;
    char *copy = l->ignored ? copy_of(l, word) : NULL;
    if (copy) l->ignored[l->ignored_count++] = copy;
}

/* Two words as one. */
static void ignore_both(mtl_library *l, const char *key, const char *more) {
    char words[80];
    snprintf(words, sizeof words, "%.39s%.39s", key, more);
    lobe_mtl_ignore(l, words);
}

static mtl_material *add_material(mtl_library *l, const char *name) {
    const int is_full = (l->count & (l->count - 1)) == 0; /* sizes are powers of 2 */
    mtl_material *grown = is_full
                              ? realloc(l->materials, (l->count ? 2 * l->count : 1) * sizeof *grown)
                              : l->materials;
    l->out_of_memory |= !grown;
    if (!grown) return NULL;
    l->materials = grown;
    char *copy = copy_of(l, name);
    if (!copy) return NULL;
    mtl_material *m = &l->materials[l->count];
    *m = (mtl_material){.name = copy, .place = l->count++};
    for (int i = 0; i < MTL_NUMBERS; i++) m->numbers[i] = NAN;
    for (int i = 0; i < MTL_COLORS; i++) m->colors[i][0] = NAN;
    return m;
}

/* ---- Lines ----------------------------------------------------------------------------------------- */

static void read_number_line(mtl_library *l, mtl_material *m, const mtl_key *key, char *rest) {
    float value;
    const int is_dissolve = key->index == MTL_D;
    /* a halo is opaque where it is seen from the side */
    if (is_dissolve && strncmp(rest, "-halo", 5) == 0) {
        ignore_both(l, key->name, " -halo");
        rest = skip_blanks(rest + 5);
    }
    if (read_numbers(rest, &value, 1, &rest) != 1 || !is_end(rest))
        ignore_both(l, key->name, " that is not a number");
    else
        m->numbers[key->index] = is_dissolve && key->name[0] == 'T' ? 1.0f - value : value;
}

/* One number is a grey. */
static void read_color_line(mtl_library *l, mtl_material *m, const mtl_key *key, char *rest) {
    float rgb[3];
    const int count = read_numbers(rest, rgb, 3, &rest);
    if ((count != 1 && count != 3) || !is_end(rest)) {
        ignore_both(l, key->name, " that is not one number or three");
        return;
    }
    if (count == 1) rgb[1] = rgb[2] = rgb[0];
    memcpy(m->colors[key->index], rgb, sizeof rgb);
}

static const struct option *find_option(const char *word) {
    for (size_t i = 0; i < sizeof options / sizeof *options; i++)
        if (strcasecmp(word, options[i].name + 1) == 0) return &options[i];
    return NULL;
}

/* Values and words of an option; returns what follows. */
static char *read_option(mtl_library *l, mtl_map *map, const mtl_key *key, const struct option *o,
                         char *rest) {
    float values[3];
    const int count = read_numbers(rest, values, o->numbers, &rest);
    const char *word = "";
    for (int i = 0; i < o->words; i++) word = cut_word(rest, &rest);
    for (int i = 0; i < count; i++) {
        if (o->what == READ_OFFSET) map->offset[i] = values[i];
        if (o->what == READ_SCALE) map->scale[i] = values[i];
        if (o->what == READ_STRENGTH) map->strength = values[i];
    }
    if (o->what == READ_CLAMP) map->is_clamped = strcasecmp(word, "on") == 0;
    if (o->what == UNREAD || (o->what == READ_STRENGTH && key->index != MTL_NORM))
        ignore_both(l, key->name, o->name);
    return rest;
}

static void read_map_line(mtl_library *l, mtl_material *m, const mtl_key *key, char *rest) {
    mtl_map map = {.scale = {1.0f, 1.0f, 1.0f}, .strength = 1.0f};
    while (*rest == '-') {
        char *word = rest, *after = word + strcspn(word, " \t");
        const char end = *after;
        *after = 0;
        const struct option *o = find_option(word);
        *after = end;
        if (!o) break; /* the name of a picture */
        rest = read_option(l, &map, key, o, skip_blanks(after));
    }
    if (!*rest) {
        ignore_both(l, key->name, " without a picture");
        return;
    }
    map.name = copy_of(l, rest);
    free(m->maps[key->index].name);
    m->maps[key->index] = map;
}

static const mtl_key *find_key(const char *word) {
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcasecmp(word, keys[i].name) == 0) return &keys[i];
    return NULL;
}

static void read_line(mtl_library *l, mtl_material *m, const char *word, char *rest) {
    const mtl_key *key = find_key(word);
    if (!key)
        ignore_both(l, word, "");
    else if (!m)
        ignore_both(l, key->name, " before the first newmtl");
    else if (key->kind == NUMBER)
        read_number_line(l, m, key, rest);
    else if (key->kind == COLOR)
        read_color_line(l, m, key, rest);
    else if (key->kind == MAP)
        read_map_line(l, m, key, rest);
}

/* ---- Files ----------------------------------------------------------------------------------------- */

/* "newmtl NAME" and blanks over `size` bytes: what the line was. */
static void leave_name(char *line, size_t size, const char *name) {
    const size_t length = strlen(name);
    memmove(line + 7, name, length);
    memcpy(line, "newmtl ", 7);
    memset(line + 7 + length, ' ', size - 7 - length);
}

static size_t line_length(const char *text, size_t size) {
    size_t length = 0;
    while (length < size && !strchr("\n\r\f", text[length])) length++; /* or 0 */
    return length;
}

/* A line that ends in 0. Returns the material that following lines are about. */
static mtl_material *read_any_line(mtl_library *l, mtl_material *m, char *line, size_t size) {
    char *rest;
    trim(line);
    char *word = cut_word(line, &rest);
    if (strcasecmp(word, "newmtl") == 0) {
        m = *rest ? add_material(l, rest) : NULL;
        if (!*rest) lobe_mtl_ignore(l, "newmtl without a name");
        if (m) {
            leave_name(line, size, rest);
            return m;
        }
    } else if (*word && *word != '#') {
        read_line(l, m, word, rest);
    }
    memset(line, ' ', size);
    return m;
}

void lobe_mtl_read(mtl_library *l, char *text, size_t size) {
    mtl_material *m = NULL;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) memset(text, ' ', 3);
    text[size] = 0;
    for (size_t at = 0; at < size;) {
        const size_t length = line_length(text + at, size - at);
        const char end = text[at + length];
        text[at + length] = 0;
        m = read_any_line(l, m, text + at, length);
        text[at + length] = end ? end : ' ';
        at += length + 1;
    }
}

/* ---- Finding --------------------------------------------------------------------------------------- */

static int compare(const void *a, const void *b) {
    const mtl_material *x = a, *y = b;
    const int order = strcmp(x->name, y->name);
    return order ? order : (x->place > y->place) - (x->place < y->place);
}

void lobe_mtl_sort(mtl_library *l) {
    if (l->count) qsort(l->materials, l->count, sizeof *l->materials, compare);
}

const mtl_material *lobe_mtl_find(const mtl_library *l, const char *name) {
    size_t low = 0, high = l->count; /* the first one that comes after the name */
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (strcmp(l->materials[middle].name, name) > 0)
            high = middle;
        else
            low = middle + 1;
    }
    return low > 0 && strcmp(l->materials[low - 1].name, name) == 0 ? &l->materials[low - 1] : NULL;
}

void lobe_mtl_free(mtl_library *l) {
    for (size_t i = 0; i < l->count; i++) {
        free(l->materials[i].name);
        for (int k = 0; k < MTL_MAPS; k++) free(l->materials[i].maps[k].name);
    }
    for (size_t i = 0; i < l->ignored_count; i++) free(l->ignored[i]);
    free(l->materials);
    free(l->ignored);
    *l = (mtl_library){0};
}
