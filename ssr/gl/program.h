/* Shaders from their texts. */
#ifndef LOBE_SSR_GL_PROGRAM_H
#define LOBE_SSR_GL_PROGRAM_H

#include <epoxy/gl.h>

#include "lobe/ssr.h"

enum { PROGRAM_PARTS_MAX = 4 };

/* From the parts after "common", names of lobe_ssr_texts, NULL at the end; `words` comes before them and may
 * be NULL. 0 in *program after an error. */
lobe_ssr_result lobe_ssr_gl_program(const char *words, const char *const parts[], GLuint *program);

#endif
