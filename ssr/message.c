#include "message.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local char last_message[1024];

lobe_ssr_result lobe_ssr_fail(lobe_ssr_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(last_message, sizeof last_message, format, arguments);
    va_end(arguments);
    for (char *c = last_message; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
    return result;
}

lobe_ssr_result lobe_ssr_fail_memory(const char *where) {
    return lobe_ssr_fail(LOBE_SSR_FAILED, "%s: out of memory; free some, or make the work smaller",
                         where);
}

const char *lobe_ssr_error_message(void) {
    return last_message;
}
