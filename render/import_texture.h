/* Textures of a file that is being imported: each read once, whatever uses it. */
#ifndef LOBE_RENDER_IMPORT_TEXTURE_H
#define LOBE_RENDER_IMPORT_TEXTURE_H

#include "scene.h"

struct aiScene;

/* What a picture is read for. Of an opacity the alpha counts; a picture without any says it by its green. */
typedef enum picture_use { AS_VALUES, AS_COLOR, AS_OPACITY } picture_use;

typedef struct read_texture {
    char *name;
    picture_use use;
    int index;
} read_texture;

typedef struct texture_reader {
    lobe_scene *scene;
    const struct aiScene *file;
    const char *path; /* of the scene's file: textures lie beside it */
    read_texture *known;
    size_t count;
} texture_reader;

/* A texture beside the scene's file, by its name as it stands or as a URI. 0: unusable. */
int lobe_import_texture_beside(const char *scene_path, const char *name, texture *t, int is_srgb);

/* One more texture is missing: the warning. */
void lobe_import_missing_texture(lobe_scene *s, const char *path, const char *name);

/* What stands in for it: magenta for a colour, else NO_TEXTURE. */
int lobe_import_magenta(lobe_scene *s, int is_srgb);

/* Index in the scene of the texture called `name`, or NO_TEXTURE. A missing one gets one warning; in
 * place of a colour it is magenta. */
int lobe_import_texture(texture_reader *r, const char *name, picture_use use);
void lobe_import_textures_end(texture_reader *r);

#endif
