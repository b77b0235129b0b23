/* Where the build found no libepoxy or EGL. */
#include "../driver.h"
#include "../message.h"

static lobe_ssr_result open_gl(lobe_ssr *s) {
    (void)s;
    return lobe_ssr_fail(LOBE_SSR_FAILED,
                         "OpenGL: this build has none; build with libepoxy and EGL, or use the "
                         "processor (--backend cpu)");
}

const ssr_driver lobe_ssr_gl_driver = {LOBE_SSR_GL, open_gl, NULL, NULL, NULL};
