#include "inventory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- The list ------------------------------------------------------------------------------------ */

/* By malloc. NULL: no memory. */
static char *copy_text(const char *text) {
    const size_t size = strlen(text) + 1;
    char *copy = malloc(size);
    for (size_t i = 0; copy && i < size; i++) {
        const unsigned char c = (unsigned char)text[i];
        copy[i] = c && (c < 0x20 || c == 0x7f) ? '?' : text[i];
    }
    return copy;
}

void lobe_add_word(char words[WORDS_ROOM], int is_true, const char *word) {
    const size_t used = strlen(words);
    if (is_true) snprintf(words + used, WORDS_ROOM - used, "%s%s", used ? ", " : "", word);
}

static int make_room(inventory *i) {
    if (i->count < i->room) return 1;
    const size_t room = i->room ? 2 * i->room : 64;
    inventory_row *rows = realloc(i->rows, room * sizeof *rows);
    if (!rows) return 0;
    i->rows = rows;
    i->room = room;
    return 1;
}

static void set_about(lobe_scene *s, inventory_row *row, const char *about) {
    free(row->about);
    row->about = copy_text(about);
    row->item.about = row->about;
    s->out_of_memory |= !row->about;
}

void lobe_scene_note(lobe_scene *s, lobe_scene_item item) {
    inventory *i = &s->inventory;
    if (!make_room(i)) {
        s->out_of_memory = 1;
        return;
    }
    inventory_row *row = &i->rows[i->count++];
    *row = (inventory_row){.item = item, .name = copy_text(item.name ? item.name : "")};
    row->item.name = row->name;
    s->out_of_memory |= !row->name;
    set_about(s, row, item.about ? item.about : "");
}

void lobe_inventory_free(inventory *i) {
    for (size_t k = 0; k < i->count; k++) {
        free(i->rows[k].name);
        free(i->rows[k].about);
    }
    free(i->rows);
    *i = (inventory){0};
}

size_t lobe_scene_item_count(const lobe_scene *scene) {
    return scene->inventory.count;
}

const lobe_scene_item *lobe_scene_get_item(const lobe_scene *scene, size_t index) {
    return index < scene->inventory.count ? &scene->inventory.rows[index].item : NULL;
}

const char *lobe_scene_part_name(lobe_scene_part part) {
    static const char *const names[] = {"mesh",   "material",  "texture",  "light",
                                        "camera", "animation", "extension"};
    return (unsigned)part < sizeof names / sizeof *names ? names[part] : NULL;
}

/* ---- What can be said of each ---------------------------------------------------------------------- */

static void describe_material(const lobe_scene *s, uint32_t index, lobe_scene_item *item,
                              char words[WORDS_ROOM]) {
    const material *m = &s->materials[index];
    const int is_solid = m->transmission > 0.0f && m->thickness > 0.0f;
    item->part = LOBE_SCENE_MATERIAL;
    lobe_add_word(words, m->is_unlit, "unlit");
    lobe_add_word(words, !m->is_unlit && m->metallic > 0.0f, "metal");
    lobe_add_word(words, !m->is_unlit && m->metallic < 1.0f, "dielectric");
    lobe_add_word(words, m->anisotropy != 0.0f || m->stretch > 0.0f, "anisotropy");
    lobe_add_word(words, m->clearcoat > 0.0f, "clear coat");
    lobe_add_word(words,
                  m->specular != 1.0f || v3_max(v3_sub(m->specular_color, v3_all(1.0f))) != 0.0f,
                  "specular");
    lobe_add_word(words, m->transmission > 0.0f, is_solid ? "glass" : "thin glass");
    lobe_add_word(words, is_solid && v3_max(m->absorption) > 0.0f, "absorption");
    lobe_add_word(words, m->ior != COAT_IOR, "index");
    lobe_add_word(words, v3_max(m->emission) > 0.0f, "emission");
    lobe_add_word(words, m->alpha_mode == ALPHA_MASK, "alpha mask");
    lobe_add_word(words, m->alpha_mode == ALPHA_BLEND, "alpha blend");
    lobe_add_word(words, m->base_map.texture != NO_TEXTURE, "colour map");
    lobe_add_word(words, m->normal_map.texture != NO_TEXTURE, "normal map");
    lobe_add_word(words, m->roughness_map.texture != NO_TEXTURE, "roughness map");
    lobe_add_word(words,
                  m->metallic_map.texture != NO_TEXTURE &&
                      m->metallic_map.texture != m->roughness_map.texture,
                  "metal map");
    lobe_add_word(words, m->opacity_map.texture != NO_TEXTURE, "opacity map");
    lobe_add_word(words, m->emission_map.texture != NO_TEXTURE, "emission map");
}

static void describe_texture(const lobe_scene *s, uint32_t index, lobe_scene_item *item,
                             char words[WORDS_ROOM]) {
    const texture *t = &s->textures[index];
    item->part = LOBE_SCENE_TEXTURE;
    item->width = t->width;
    item->height = t->height;
    lobe_add_word(words, t->is_srgb, "colour");
    lobe_add_word(words, !t->is_srgb, "values");
    lobe_add_word(words, t->channels == 4, "alpha");
}

static void describe_lamp(const lobe_scene *s, uint32_t index, lobe_scene_item *item,
                          char words[WORDS_ROOM]) {
    static const char *const kinds[] = {"point", "spot", "directional"};
    item->part = LOBE_SCENE_LIGHT;
    lobe_add_word(words, 1, kinds[s->lamps[index].kind]);
    lobe_add_word(words, s->lamps[index].range > 0.0f, "range");
}

static void describe_camera(const lobe_scene *s, uint32_t index, lobe_scene_item *item,
                            char words[WORDS_ROOM]) {
    item->part = LOBE_SCENE_CAMERA;
    item->name = s->cameras[index].name;
    snprintf(words, WORDS_ROOM, "%.4g degrees high", (double)s->cameras[index].vertical_degrees);
}

typedef void describe(const lobe_scene *s, uint32_t index, lobe_scene_item *item,
                      char words[WORDS_ROOM]);

/* The row of the part with this number, or a new one. */
static void note_one(lobe_scene *s, size_t *row, uint32_t index, describe *about) {
    inventory *i = &s->inventory;
    char words[WORDS_ROOM] = "";
    lobe_scene_item item = {0};
    about(s, index, &item, words);
    while (*row < i->count && i->rows[*row].item.part != item.part) ++*row;
    if (*row == i->count) lobe_scene_note(s, item);
    if (*row == i->count) return; /* no memory */
    inventory_row *r = &i->rows[(*row)++];
    r->item.width = item.width;
    r->item.height = item.height;
    set_about(s, r, words);
}

static void note_each(lobe_scene *s, uint32_t count, describe *about) {
    size_t row = 0;
    for (uint32_t i = 0; i < count; i++) note_one(s, &row, i, about);
}

static void count_triangles(lobe_scene *s) {
    inventory *i = &s->inventory;
    uint64_t *counts = calloc((size_t)s->material_count + 1, sizeof *counts);
    s->out_of_memory |= !counts;
    for (uint32_t k = 0; counts && k < s->triangle_count; k++) counts[s->triangles[k].material]++;
    uint32_t index = 0;
    for (size_t k = 0; counts && k < i->count; k++)
        if (i->rows[k].item.part == LOBE_SCENE_MATERIAL && index < s->material_count)
            i->rows[k].item.count = counts[index++];
    free(counts);
}

/* The material of what names none is always there; not to be told if nothing has it. */
static void drop_unused_default(inventory *i) {
    for (size_t k = 0; k < i->count; k++) {
        const lobe_scene_item *item = &i->rows[k].item;
        if (item->part != LOBE_SCENE_MATERIAL || item->count ||
            strcmp(item->name, NO_MATERIAL) != 0)
            continue;
        free(i->rows[k].name);
        free(i->rows[k].about);
        memmove(&i->rows[k], &i->rows[k + 1], (i->count - k - 1) * sizeof *i->rows);
        i->count--;
        return;
    }
}

/* A scene that no file brings is one mesh. */
static void note_builtin(lobe_scene *s) {
    for (size_t i = 0; i < s->inventory.count; i++)
        if (s->inventory.rows[i].item.part == LOBE_SCENE_MESH) return;
    lobe_scene_note(
        s, (lobe_scene_item){
               .part = LOBE_SCENE_MESH, .name = s->name, .count = s->triangle_count, .uses = 1});
}

void lobe_scene_note_all(lobe_scene *s) {
    note_builtin(s);
    note_each(s, s->material_count, describe_material);
    note_each(s, s->texture_count, describe_texture);
    note_each(s, s->lamp_count, describe_lamp);
    note_each(s, (uint32_t)s->info.cameras, describe_camera);
    count_triangles(s);
    drop_unused_default(&s->inventory);
}
