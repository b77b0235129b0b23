/* What is asked of a glTF file before the importer sees it. */
#ifndef LOBE_RENDER_GLTF_CHECK_H
#define LOBE_RENDER_GLTF_CHECK_H

#include "lobe/render.h"

/* Refuses files that the importer would misread silently (an extension it does not know) or that
 * would exhaust its stack (nested too deeply). Files of other formats pass. */
lobe_render_result lobe_gltf_check(const char *path);

#endif
