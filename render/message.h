/* One readable message an error, and warnings. */
#ifndef LOBE_RENDER_MESSAGE_H
#define LOBE_RENDER_MESSAGE_H

#include <stdint.h>

#include "lobe/render.h"

/* Keep the formatted line for lobe_render_error_message and return `result`. Control characters (a
 * file's name may hold any) become '?'. */
__attribute__((format(printf, 2, 3))) lobe_render_result lobe_fail(lobe_render_result result,
                                                                   const char *format, ...);

lobe_render_result lobe_fail_memory(const char *where);

/* Where warnings go. In strict mode the first one is kept as an error instead. */
typedef struct warnings {
    lobe_warning_function function;
    void *user;
    int strict;
    uint64_t count;
    int failed; /* strict, and there was one */
} warnings;

__attribute__((format(printf, 2, 3))) void lobe_warn(warnings *w, const char *format, ...);

#endif
