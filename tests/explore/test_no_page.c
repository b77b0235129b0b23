/* Built without a compiler for WebAssembly: every call says what to install, and leaves nothing. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include <lobe/explore.h>

#include "explore/page.h"

/* In place of the library's: the linker takes no second definition from an archive. */
const page_file lobe_page_files[] = {{0}};
const int lobe_page_count = 0;

static void assert_told(void) {
    assert_non_null(strstr(lobe_explore_error_message(), "; install clang, lld, wasi-libc and "));
    assert_null(strchr(lobe_explore_error_message(), '\n'));
}

static void test_start(void **state) {
    (void)state;
    lobe_explore_server *server = (lobe_explore_server *)state;
    assert_int_equal(lobe_explore_start(0, &server), LOBE_EXPLORE_FAILED);
    assert_null(server);
    assert_told();
    lobe_explore_stop(server);
}

static void test_write(void **state) {
    (void)state;
    assert_int_equal(lobe_explore_write("no_page_written"), LOBE_EXPLORE_FAILED);
    assert_told();
    assert_int_equal(access("no_page_written", F_OK), -1);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_start), cmocka_unit_test(test_write)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
