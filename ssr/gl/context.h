/* A context of OpenGL 4.5 without a window. */
#ifndef LOBE_SSR_GL_CONTEXT_H
#define LOBE_SSR_GL_CONTEXT_H

#include <epoxy/gl.h>
#include <epoxy/egl.h>

#include "lobe/ssr.h"

typedef struct gl_context {
    EGLDisplay display;
    EGLContext context;
    int is_software; /* drawn by the processor */
    char renderer[256];
} gl_context;

/* The first GPU, or where there is none the software renderer. On success the context is current. */
lobe_ssr_result lobe_ssr_gl_open(gl_context *c);
void lobe_ssr_gl_close(gl_context *c);

/* A thread has one current context, a context one thread: taken for a call, and let go. */
lobe_ssr_result lobe_ssr_gl_take(const gl_context *c);
void lobe_ssr_gl_release(const gl_context *c);

/* What went wrong since the last call, if anything did. */
lobe_ssr_result lobe_ssr_gl_check(const char *where);

/* The same for a given error and reset status. */
lobe_ssr_result lobe_ssr_gl_result(const char *where, GLenum error, GLenum reset);

#endif
