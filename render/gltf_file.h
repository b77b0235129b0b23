/* A .gltf or .glb file as one .glb in memory that tinygltf can take. */
#ifndef LOBE_RENDER_GLTF_FILE_H
#define LOBE_RENDER_GLTF_FILE_H

#include <stddef.h>

#include "lobe/render.h"

typedef struct gltf_file {
    unsigned char *glb; /* by malloc */
    size_t size;
} gltf_file;

/* Nonzero if an extension is understood. */
int lobe_gltf_knows(const char *extension);

/* Refused are: what is not whole, nesting that would exhaust a stack, required extensions that are not
 * known, nodes in a circle. Rewritten is what tinygltf (2.7) stumbles over: see gltf_file.c. */
lobe_render_result lobe_gltf_file_read(const char *path, gltf_file *file);

#endif
