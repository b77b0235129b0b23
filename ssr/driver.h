/* What runs the passes: the processor (ssr.c) or OpenGL (gl/). */
#ifndef LOBE_SSR_DRIVER_H
#define LOBE_SSR_DRIVER_H

#include "pipeline.h"

typedef struct ssr_driver {
    lobe_ssr_backend backend;
    /* Makes what the driver needs of memory and machinery, in s->driver_state. Anything but LOBE_SSR_OK:
     * nothing was made, and the message says why. */
    lobe_ssr_result (*open)(lobe_ssr *s);
    lobe_ssr_result (*run)(lobe_ssr *s, const lobe_ssr_frame *f, lobe_ssr_statistics *statistics);
    const char *(*device)(const lobe_ssr *s);
    void (*close)(lobe_ssr *s); /* NULL state is fine */
} ssr_driver;

/* Of a clock that never goes back. */
double lobe_ssr_milliseconds(void);

extern const ssr_driver lobe_ssr_cpu_driver, lobe_ssr_gl_driver;

#endif
