/* MTL, the material libraries of OBJ files, with the keys for physically based shading: Pr, Pm, Pc, Pcr, Ps, aniso,
 * anisor, norm. Assimp 5.2 refuses a file with aniso, follows a null pointer at a texture before the first newmtl, and
 * keeps neither the maps of the clear coat nor -o and -s: so it is given the names alone. */
#ifndef LOBE_RENDER_MTL_H
#define LOBE_RENDER_MTL_H

#include <stddef.h>

enum { MTL_NS, MTL_NI, MTL_D, MTL_ILLUM, MTL_PR, MTL_PM, MTL_PC, MTL_PCR, MTL_ANISO, MTL_ANISOR };
enum { MTL_NUMBERS = MTL_ANISOR + 1 };
enum { MTL_KD, MTL_KS, MTL_KE, MTL_TF, MTL_COLORS };
enum { MTL_MAP_KD, MTL_MAP_KE, MTL_MAP_D, MTL_MAP_PR, MTL_MAP_PM, MTL_MAP_PC, MTL_MAP_PCR };
enum { MTL_NORM = MTL_MAP_PCR + 1, MTL_MAPS };

typedef struct mtl_map {
    char *name;                /* of the picture; NULL: no map */
    float offset[3], scale[3]; /* of (u, v, w), v from below: scaled, then moved */
    float strength;            /* -bm */
    int is_clamped;
} mtl_map;

typedef struct mtl_material {
    char *name;
    float numbers[MTL_NUMBERS], colors[MTL_COLORS][3]; /* finite; NaN: not given */
    mtl_map maps[MTL_MAPS];
    size_t place; /* in the files */
} mtl_material;

/* Of all files that were read. */
typedef struct mtl_library {
    mtl_material *materials;
    size_t count;
    char **ignored; /* what was met and is not read, each once, the first MTL_IGNORED_MAX */
    size_t ignored_count;
    int out_of_memory;
} mtl_library;

enum { MTL_IGNORED_MAX = 100 };

/* Adds the materials of a file: `size` bytes and room for one more. Of the text only the lines that name materials
 * are left, the rest is blank. */
void lobe_mtl_read(mtl_library *library, char *text, size_t size);

/* What was met and is not read. */
void lobe_mtl_ignore(mtl_library *library, const char *word);

/* After the last file, before the first lobe_mtl_find. */
void lobe_mtl_sort(mtl_library *library);

/* The last one of this name, or NULL. */
const mtl_material *lobe_mtl_find(const mtl_library *library, const char *name);

void lobe_mtl_free(mtl_library *library);

#endif
