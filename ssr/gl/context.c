/* EGL: every device of the machine, the GPUs first, then Mesa without a surface. No library of OpenGL has to
 * be there when the program starts: libepoxy ends the process where it misses one, so they are looked for
 * before. */
#include "context.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include "../message.h"

enum { DEVICES_MAX = 32 };

static const char hint[] = "install one, or use the processor (--backend cpu)";

static int has_library(const char *name) {
    void *library = dlopen(name, RTLD_LAZY | RTLD_GLOBAL);
    return library != NULL; /* kept: epoxy asks for it again */
}

static int has_libraries(void) {
    return has_library("libEGL.so.1") &&
           (has_library("libOpenGL.so.0") || has_library("libGL.so.1"));
}

static EGLContext make_context(EGLDisplay display) {
    /* A driver that can tell of a lost device is asked to. */
    static const EGLint robust[] = {EGL_CONTEXT_MAJOR_VERSION,
                                    4,
                                    EGL_CONTEXT_MINOR_VERSION,
                                    5,
                                    EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                    EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                    EGL_CONTEXT_OPENGL_ROBUST_ACCESS,
                                    EGL_TRUE,
                                    EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                    EGL_LOSE_CONTEXT_ON_RESET,
                                    EGL_NONE};
    static const EGLint plain[] = {EGL_CONTEXT_MAJOR_VERSION,
                                   4,
                                   EGL_CONTEXT_MINOR_VERSION,
                                   5,
                                   EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                   EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                   EGL_NONE};
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, robust);
    if (context == EGL_NO_CONTEXT)
        context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, plain);
    return context;
}

static int is_software(const char *renderer) {
    static const char *const names[] = {"llvmpipe", "softpipe", "SWR", "SwiftShader", "Software"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++)
        if (strstr(renderer, names[k])) return 1;
    return 0;
}

/* 0: no OpenGL 4.5 on this display. */
static int open_display(gl_context *c, EGLDisplay display) {
    EGLint major, minor;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return 0;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context") ||
        !epoxy_has_egl_extension(display, "EGL_KHR_no_config_context") ||
        !eglBindAPI(EGL_OPENGL_API))
        return 0;
    c->display = display;
    c->context = make_context(display);
    if (c->context == EGL_NO_CONTEXT) return 0;
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->context)) {
        eglDestroyContext(display, c->context);
        return 0;
    }
    const GLubyte *renderer = glGetString(GL_RENDERER);
    snprintf(c->renderer, sizeof c->renderer, "%s", renderer ? (const char *)renderer : "unknown");
    c->is_software = is_software(c->renderer);
    return 1;
}

/* Keeps the better one of two; `found` counts. */
static void consider(gl_context *best, int *found, EGLDisplay display) {
    gl_context c;
    if (*found && !best->is_software) return;
    if (!open_display(&c, display)) return;
    if (!*found) {
        *best = c;
    } else if (!c.is_software) {
        lobe_ssr_gl_close(best);
        *best = c;
    } else {
        lobe_ssr_gl_close(&c);
    }
    *found = 1;
}

static int find(gl_context *c) {
    int found = 0;
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint count = 0;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        eglQueryDevicesEXT(DEVICES_MAX, devices, &count))
        for (EGLint k = 0; k < count; k++)
            consider(c, &found,
                     eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[k], NULL));
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
        consider(
            c, &found,
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL));
    if (!found) consider(c, &found, eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return found;
}

lobe_ssr_result lobe_ssr_gl_open(gl_context *c) {
    if (!has_libraries())
        return lobe_ssr_fail(LOBE_SSR_FAILED, "OpenGL: no library of EGL and OpenGL; %s", hint);
    if (!find(c))
        return lobe_ssr_fail(LOBE_SSR_FAILED,
                             "OpenGL: no driver of version 4.5 that needs no window; %s", hint);
    return lobe_ssr_gl_take(c);
}

/* The display stays: it is the process's, other contexts may live on it. */
void lobe_ssr_gl_close(gl_context *c) {
    eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(c->display, c->context);
}

lobe_ssr_result lobe_ssr_gl_take(const gl_context *c) {
    if (eglBindAPI(EGL_OPENGL_API) &&
        eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->context))
        return LOBE_SSR_OK;
    return lobe_ssr_fail(LOBE_SSR_FAILED,
                         "OpenGL: the driver refuses its context; start again, or use the "
                         "processor (--backend cpu)");
}

void lobe_ssr_gl_release(const gl_context *c) {
    eglMakeCurrent(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

lobe_ssr_result lobe_ssr_gl_result(const char *where, GLenum error, GLenum reset) {
    if (reset != GL_NO_ERROR || error == GL_CONTEXT_LOST)
        return lobe_ssr_fail(
            LOBE_SSR_FAILED,
            "OpenGL: %s: the device was lost (%s); start again, or use the "
            "processor (--backend cpu)",
            where, reset == GL_GUILTY_CONTEXT_RESET ? "by this program" : "reset or taken away");
    if (error == GL_OUT_OF_MEMORY)
        return lobe_ssr_fail(LOBE_SSR_FAILED,
                             "OpenGL: %s: the device is out of memory; use a smaller --size, or "
                             "the processor (--backend cpu)",
                             where);
    if (error != GL_NO_ERROR)
        return lobe_ssr_fail(LOBE_SSR_FAILED,
                             "OpenGL: %s: error 0x%04x; use the processor (--backend cpu)", where,
                             error);
    return LOBE_SSR_OK;
}

lobe_ssr_result lobe_ssr_gl_check(const char *where) {
    const GLenum reset = glGetGraphicsResetStatus();
    const GLenum error = glGetError();
    /* a lost context gives errors without end: one is enough */
    return lobe_ssr_gl_result(where, error, reset);
}
