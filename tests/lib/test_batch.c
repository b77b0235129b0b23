/* tests/lib/test_batch.c: a batch gives the bits of the scalar functions: by every instruction set, at
 * every length, alignment and stride, with arrays used twice, and without touching what is not its. */
#define _DEFAULT_SOURCE
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <lobe/batch.h>
#include <lobe/random.h>

#include "cases.h"
#include "fence.h"

#define REAL float
#define NAME(stem) stem##_f32
#define WORD uint32_t
#include "batch_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#define WORD uint64_t
#include "batch_template.h"

static void float_batches_have_the_bits_of_single_calls(void **state) {
    (void)state;
    every_model_f32();
}

static void double_batches_have_the_bits_of_single_calls(void **state) {
    (void)state;
    every_model_f64();
}

static void every_length_and_alignment(void **state) {
    (void)state;
    lengths_f32();
    lengths_f64();
}

static void strides_and_arrays_used_twice(void **state) {
    (void)state;
    strides_f32();
    strides_f64();
    in_place_f32();
    in_place_f64();
}

static void nothing_is_touched_outside(void **state) {
    (void)state;
    guarded_f32();
    guarded_f64();
}

static void built_in_random_numbers(void **state) {
    (void)state;
    own_numbers_f32();
    own_numbers_f64();
}

static void accepted_rows_in_order(void **state) {
    (void)state;
    const float pdf[] = {0, 1, 2, 0, 0, 3, 0};
    uint32_t rows[7];
    assert_int_equal(lobe_accepted_rows_f32(7, (lobe_in_f32){pdf, 1}, rows), 3);
    assert_true(rows[0] == 1 && rows[1] == 2 && rows[2] == 5);
    assert_int_equal(lobe_accepted_rows_f32(4, (lobe_in_f32){pdf, 2}, rows), 1);
    assert_int_equal(rows[0], 1);
    assert_int_equal(lobe_accepted_rows_f64(0, (lobe_in_f64){NULL, 1}, rows), 0);
}

static void an_instruction_set_can_be_chosen(void **state) {
    (void)state;
    assert_string_equal(lobe_isa_at(0), "scalar");
    assert_false(lobe_restrict_isa("no such set"));
    const char *last = NULL;
    for (int k = 0; lobe_isa_at(k); ++k) {
        assert_true(lobe_restrict_isa(lobe_isa_at(k)));
        assert_string_equal(lobe_isa(), lobe_isa_at(k));
        last = lobe_isa_at(k);
    }
    assert_null(lobe_isa_at(-1));
    assert_true(lobe_restrict_isa(NULL));
    assert_string_equal(lobe_isa(), last);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(float_batches_have_the_bits_of_single_calls),
        cmocka_unit_test(double_batches_have_the_bits_of_single_calls),
        cmocka_unit_test(every_length_and_alignment),
        cmocka_unit_test(strides_and_arrays_used_twice),
        cmocka_unit_test(nothing_is_touched_outside),
        cmocka_unit_test(built_in_random_numbers),
        cmocka_unit_test(accepted_rows_in_order),
        cmocka_unit_test(an_instruction_set_can_be_chosen)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
