/* app/output.h: standard output, through one buffer, with the reason kept when it fails. */
#ifndef LOBE_APP_OUTPUT_H
#define LOBE_APP_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>

#include "report.h"

/* false: standard output failed, now or before. There is no use in producing more. */
bool lobe_app_write(const void *bytes, size_t count);
bool lobe_app_print(const char *format, ...) __attribute__((format(printf, 1, 2)));
bool lobe_app_flush(void);

/* Flushes, and turns the status of the command into that of the program: a closed pipe ends it
 * quietly, anything else that went wrong is reported. */
lobe_app_status lobe_app_finish_output(lobe_app_status status);

#endif
