/* OBJ files: shapes by Assimp, materials by mtl.h. */
#ifndef LOBE_RENDER_IMPORT_OBJ_H
#define LOBE_RENDER_IMPORT_OBJ_H

#include <assimp/cfileio.h>

#include "import_texture.h"
#include "mtl.h"
#include "scene.h"

typedef struct obj_reader {
    lobe_scene *scene;
    const char *path;
    mtl_library library;
    struct obj_file *open; /* files that Assimp has not closed */
    char missing[256];     /* the first library that cannot be read */
    struct aiFileIO files; /* Assimp keeps its place until it lets go of the scene */
} obj_reader;

/* What Assimp makes of the file, the `steps` taken, or NULL. A library that cannot be read is named. Then the reader
 * stays where it is. */
const struct aiScene *lobe_obj_read(obj_reader *r, unsigned steps);

/* The material of this name, as glTF would say it (docs/scenes.md). */
material lobe_obj_material(obj_reader *r, const char *name, texture_reader *textures,
                           const lobe_scene_options *options);

/* Names what was met and is not read. */
void lobe_obj_warn(obj_reader *r);

void lobe_obj_free(obj_reader *r);

#endif
