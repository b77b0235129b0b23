#include "message.h"

#include <stdarg.h>
#include <stdio.h>

#include "page.h"

static _Thread_local char last_message[1024];

lobe_explore_result lobe_explore_fail(lobe_explore_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(last_message, sizeof last_message, format, arguments);
    va_end(arguments);
    return result;
}

const char *lobe_explore_error_message(void) {
    return last_message;
}

lobe_explore_result lobe_explore_check_page(void) {
    if (lobe_page_count > 0) return LOBE_EXPLORE_OK;
    return lobe_explore_fail(
        LOBE_EXPLORE_FAILED,
        "explore: built without the page, for there was no compiler for "
        "WebAssembly; install clang, lld, wasi-libc and libclang-rt-dev-wasm32, and build again");
}
