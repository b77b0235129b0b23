/* One readable message an error. */
#ifndef LOBE_SSR_MESSAGE_H
#define LOBE_SSR_MESSAGE_H

#include "lobe/ssr.h"

/* Keep the formatted line for lobe_ssr_error_message and return `result`. */
__attribute__((format(printf, 2, 3))) lobe_ssr_result lobe_ssr_fail(lobe_ssr_result result,
                                                                    const char *format, ...);
lobe_ssr_result lobe_ssr_fail_memory(const char *where);

#endif
