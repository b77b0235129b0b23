#include "output.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static struct {
    char bytes[1 << 18];
    size_t used;
    int error; /* errno of the first failure */
} output;

bool lobe_app_flush(void) {
    size_t written = 0;
    while (!output.error && written < output.used) {
        const ssize_t count = write(STDOUT_FILENO, output.bytes + written, output.used - written);
        if (count >= 0)
            written += (size_t)count;
        else if (errno != EINTR)
            output.error = errno;
    }
    output.used = 0;
    return !output.error;
}

bool lobe_app_write(const void *bytes, size_t count) {
    while (count > 0 && !output.error) {
        if (output.used == sizeof output.bytes) lobe_app_flush();
        const size_t room = sizeof output.bytes - output.used;
        const size_t part = count < room ? count : room;
        memcpy(output.bytes + output.used, bytes, part);
        output.used += part;
        bytes = (const char *)bytes + part;
        count -= part;
    }
    return !output.error;
}

bool lobe_app_print(const char *format, ...) {
    char text[1024];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return lobe_app_write(text, (size_t)length < sizeof text ? (size_t)length : sizeof text - 1);
}

lobe_app_status lobe_app_finish_output(lobe_app_status status) {
    if (lobe_app_flush() || output.error == EPIPE) return status;
    lobe_app_report("standard output", "check the space and the rights where it goes",
                    "cannot write: %s", strerror(output.error));
    return status == LOBE_APP_DONE ? LOBE_APP_FAILED : status;
}
