/* tests/lib/test_random.c: Philox4x32-10 against the known answers published with Random123. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <lobe/random.h>

static void assert_words(lobe_random4 r, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    assert_int_equal(r.word[0], a);
    assert_int_equal(r.word[1], b);
    assert_int_equal(r.word[2], c);
    assert_int_equal(r.word[3], d);
}

static void known_answers(void **state) {
    (void)state;
    assert_words(lobe_random(0, 0, 0), 0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8);
    assert_words(lobe_random(UINT64_MAX, UINT64_MAX, UINT64_MAX), 0x408f276d, 0x41c83b0e,
                 0xa20bc7c6, 0x6d5451fd);
    assert_words(lobe_random(0x299f31d0a4093822, 0x0370734413198a2e, 0x85a308d3243f6a88),
                 0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1);
}

/* Also across the carry into the upper word, and for counts that fill no vector. */
static void many_blocks_are_the_same_blocks(void **state) {
    (void)state;
    enum { COUNT = 45 };
    lobe_random4 blocks[COUNT];
    for (uint32_t count = 0; count <= COUNT; ++count) {
        uint64_t first = 0xFFFFFFF0u + (uint64_t)count;
        lobe_random_many(7, 1ull << 40, first, count, blocks);
        for (uint32_t i = 0; i < count; ++i) {
            lobe_random4 one = lobe_random(7, 1ull << 40, first + i);
            assert_memory_equal(&one, &blocks[i], sizeof one);
        }
    }
}

static void unit_numbers_stay_below_one(void **state) {
    (void)state;
    assert_true(lobe_random_unit_f32(UINT32_MAX) < 1.0f);
    assert_true(lobe_random_unit_f64(UINT32_MAX, UINT32_MAX) < 1.0);
    assert_true(lobe_random_unit_f32(0) == 0.0f);
    assert_true(lobe_random_unit_f64(0, 0) == 0.0);
    assert_true(lobe_random_unit_f32(0x80000000u) == 0.5f);
    assert_true(lobe_random_unit_f64(0x80000000u, 0) == 0.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(known_answers),
                                       cmocka_unit_test(many_blocks_are_the_same_blocks),
                                       cmocka_unit_test(unit_numbers_stay_below_one)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
