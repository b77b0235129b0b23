/* The scenes that need no file. */
#include <string.h>

#include "shapes.h"

static const struct {
    const char *name, *about;
    void (*build)(lobe_scene *s);
} scenes[] = {
    {"gallery", "rough metals and coated dielectrics, smooth to rough, some brushed",
     lobe_scene_gallery},
    {"furnace", "a white sphere in white light: invisible if right", lobe_scene_furnace},
    {"brushed", "strongly anisotropic disks and cylinders", lobe_scene_brushed},
    {"normal-mapped", "a metal wall with a strong normal map", lobe_scene_normal_mapped},
    {"cornell", "a closed box with a lamp", lobe_scene_cornell},
    {"glass", "spheres of glass, smooth to rough, thin, tinted", lobe_scene_glass},
};

enum { SCENES = sizeof scenes / sizeof *scenes };

size_t lobe_builtin_scene_count(void) {
    return SCENES;
}

const char *lobe_builtin_scene_name(size_t index) {
    return index < SCENES ? scenes[index].name : NULL;
}

const char *lobe_builtin_scene_about(size_t index) {
    return index < SCENES ? scenes[index].about : NULL;
}

int lobe_scene_build(lobe_scene *s, const char *name) {
    for (size_t i = 0; i < SCENES; i++)
        if (strcmp(scenes[i].name, name) == 0) {
            scenes[i].build(s);
            return 1;
        }
    return 0;
}
