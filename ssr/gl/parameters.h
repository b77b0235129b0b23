/* What the shaders are told of the options and of a frame. */
#ifndef LOBE_SSR_GL_PARAMETERS_H
#define LOBE_SSR_GL_PARAMETERS_H

#include "../pipeline.h"

/* What does not change from frame to frame. */
ssr_parameters lobe_ssr_gl_parameters(const lobe_ssr *s);

void lobe_ssr_gl_set_frame(ssr_parameters *p, const lobe_ssr *s, const lobe_ssr_frame *f);

/* Of the whole pyramid. */
size_t lobe_ssr_gl_cells(const ssr_parameters *p);

#endif
