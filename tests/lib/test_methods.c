/* tests/lib/test_methods.c: names and numbers of the methods. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <lobe/reflection.h>

static void names_round_trip(void **state) {
    (void)state;
    for (int m = 0; m < LOBE_METHOD_COUNT; ++m) {
        assert_int_equal(lobe_method_from_name(lobe_method_name((lobe_method)m)), m);
        assert_non_null(lobe_method_about((lobe_method)m));
    }
    assert_int_equal(lobe_method_from_name("no-such-method"), LOBE_METHOD_COUNT);
    assert_int_equal(lobe_method_from_name(NULL), LOBE_METHOD_COUNT);
    assert_null(lobe_method_name(LOBE_METHOD_COUNT));
}

static void unknown_method_is_invalid(void **state) {
    (void)state;
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = LOBE_METHOD_COUNT;
    lobe_vec3_f32 wi = {0, 0, 1};
    lobe_reflection_f32 model = lobe_reflection_prepare_f32(options, wi, 0.5f, 0.5f);
    assert_false(model.is_valid);
    assert_true(lobe_reflection_sample_f32(&model, 0.5f, 0.5f, 0).pdf == 0);
    assert_true(lobe_reflection_pdf_f32(&model, wi) == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(names_round_trip),
                                       cmocka_unit_test(unknown_method_is_invalid)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
