/* Textures of a file that is being imported: each read once, whatever uses it. */
#ifndef LOBE_RENDER_IMPORT_TEXTURE_H
#define LOBE_RENDER_IMPORT_TEXTURE_H

#include "scene.h"

struct aiScene;

typedef struct read_texture {
    char *name;
    int is_srgb;
    int index;
} read_texture;

typedef struct texture_reader {
    lobe_scene *scene;
    const struct aiScene *file;
    const char *path; /* of the scene's file: textures lie beside it */
    read_texture *known;
    size_t count;
} texture_reader;

/* Index in the scene of the texture called `name`, or NO_TEXTURE. A missing one gets one warning; in
 * place of a colour it is magenta. */
int lobe_import_texture(texture_reader *r, const char *name, int is_srgb);
void lobe_import_textures_end(texture_reader *r);

#endif
