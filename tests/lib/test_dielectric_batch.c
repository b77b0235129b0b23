/* tests/lib/test_dielectric_batch.c: a batch of dielectrics gives the bits of the single calls, by every
 * instruction set, whatever its options are. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include <lobe/dielectric_batch.h>

#include "cases.h"

/* Not a multiple of any width. */
enum { COUNT = 1003 };

#define REAL float
#define NAME(stem) stem##_f32
#include "dielectric_batch_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#include "dielectric_batch_template.h"

static void float_batches_have_the_bits_of_single_calls(void **state) {
    (void)state;
    every_choice_f32();
}

static void double_batches_have_the_bits_of_single_calls(void **state) {
    (void)state;
    every_choice_f64();
}

static void numbers_and_strides(void **state) {
    (void)state;
    strides_and_numbers_f32();
    strides_and_numbers_f64();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(float_batches_have_the_bits_of_single_calls),
        cmocka_unit_test(double_batches_have_the_bits_of_single_calls),
        cmocka_unit_test(numbers_and_strides)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
