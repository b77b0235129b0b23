/* tests/verify/bad_plugin.c: a diffuse plugin that misbehaves as its BAD_ macro says, somewhere after
 * its first thousand draws or at its start. */
#include <lobe/plugin.h>

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

enum { PATIENCE = 100000 };

static int calls;

static void misbehave(lobe_plugin_draw *draw) {
    (void)draw;
#if defined(BAD_CRASH)
    raise(SIGSEGV);
#elif defined(BAD_ABORT)
    abort();
#elif defined(BAD_EXIT)
    exit(0);
#elif defined(BAD_HANG)
    for (;;) pause();
#elif defined(BAD_SPIN)
    for (volatile int i = 0;; i = !i) continue;
#elif defined(BAD_MEMORY)
    for (;;) {
        volatile char *block = malloc(1 << 26);
        *block = 1; /* crashes where malloc gives up, as unguarded code does */
    }
#elif defined(BAD_NAN)
    draw->pdf = NAN;
#elif defined(BAD_FORK)
    if (fork() == 0) sleep(1000);
    abort();
#endif
}

static double density(const lobe_plugin_block *block, const double wo[3]) {
#ifdef BAD_NAN_DENSITY
    if (wo[2] < 0.01) return NAN;
#endif
    return block->wi[2] > 0 && wo[2] > 0 ? wo[2] / 3.14159265358979323846 : 0;
}

static void sample(const lobe_plugin_block *block, const double u[3], lobe_plugin_draw *draw) {
    double radius = sqrt(u[0]);
    draw->wo[0] = radius * cos(6.28318530717958648 * u[1]);
    draw->wo[1] = radius * sin(6.28318530717958648 * u[1]);
    draw->wo[2] = sqrt(1 - u[0]);
    draw->pdf = density(block, draw->wo);
    draw->weight = draw->pdf > 0;
    if (++calls > PATIENCE) misbehave(draw);
}

#ifndef BAD_SYMBOL
LOBE_PLUGIN_EXPORT const lobe_plugin *lobe_plugin_describe(void) {
    static const lobe_plugin plugin = {
#ifdef BAD_VERSION
        .version = LOBE_PLUGIN_VERSION + 1,
#else
        .version = LOBE_PLUGIN_VERSION,
#endif
#ifdef BAD_NAME
        .name = "two words; and more",
#else
        .name = "bad",
#endif
        .sample = sample,
        .density = density,
#ifndef BAD_FUNCTION
        .value = density,
#endif
        .flags = LOBE_PLUGIN_RECIPROCAL};
#ifdef BAD_NULL
    return NULL;
#endif
#ifdef BAD_START_CRASH
    raise(SIGSEGV);
#endif
    return &plugin;
}
#else
LOBE_PLUGIN_EXPORT const void *another_symbol(void);
const void *another_symbol(void) {
    static void (*const used)(const lobe_plugin_block *, const double *, lobe_plugin_draw *) =
        sample;
    return &used;
}
#endif
