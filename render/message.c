#include "message.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local char last_message[1024];

static void format_line(char *line, size_t size, const char *format, va_list arguments) {
    vsnprintf(line, size, format, arguments);
    for (char *c = line; *c; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f) *c = '?';
}

lobe_render_result lobe_fail(lobe_render_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    format_line(last_message, sizeof last_message, format, arguments);
    va_end(arguments);
    return result;
}

lobe_render_result lobe_fail_memory(const char *where) {
    return lobe_fail(LOBE_RENDER_FAILED, "%s: out of memory; free some, or make the work smaller",
                     where);
}

void lobe_warn(warnings *w, const char *format, ...) {
    char line[1024];
    va_list arguments;
    va_start(arguments, format);
    format_line(line, sizeof line, format, arguments);
    va_end(arguments);
    w->count++;
    if (w->strict && !w->failed) {
        lobe_fail(LOBE_RENDER_BAD_INPUT, "%s", line);
        w->failed = 1;
    } else if (!w->strict && w->function) {
        w->function(w->user, line);
    }
}

const char *lobe_render_error_message(void) {
    return last_message;
}
