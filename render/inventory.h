/* What a scene is made of, kept for those who ask (lobe_scene_get_item). */
#ifndef LOBE_RENDER_INVENTORY_H
#define LOBE_RENDER_INVENTORY_H

#include "scene.h"

/* Texts are copied, control characters become '?'. Importers note meshes, animations and extensions whole; of
 * materials, textures and lamps the names, in the order in which they are added to the scene. Failures of memory are
 * kept in out_of_memory. */
void lobe_scene_note(lobe_scene *s, lobe_scene_item item);

/* When all is there: says the rest about materials, textures and lamps, adds those that have no name, and cameras. */
void lobe_scene_note_all(lobe_scene *s);

void lobe_inventory_free(inventory *i);

/* The name of the material of what names none. */
#define NO_MATERIAL "(none)"

/* Adds a word, with ", " before all but the first. */
enum { WORDS_ROOM = 256 };
void lobe_add_word(char words[WORDS_ROOM], int is_true, const char *word);

#endif
