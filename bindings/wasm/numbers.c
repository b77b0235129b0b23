/* Patterns of random numbers: independent, stratified, Sobol's. */
#include "page.h"

enum { RANDOM, STRATIFIED, SOBOL };

/* Those of lobe_draw_numbers_f32, and so of `lobe sample --seed`. */
static void random_numbers(uint64_t seed, int count) {
    for (int i = 0; i < count; ++i) {
        const lobe_random4 words = lobe_random(seed, 0, (uint64_t)i);
        page_numbers[0][i] = lobe_random_unit_f32(words.word[0]);
        page_numbers[1][i] = lobe_random_unit_f32(words.word[2]);
        page_numbers[2][i] = lobe_random_unit_f32(words.word[1]);
    }
}

static float below_one(float u) {
    return u < 1 ? u : 0x1.fffffep-1f;
}

/* One random place in every cell of a grid: as many columns as a square would have. What is left over in
 * the last row lies anywhere in that row's cells, spread evenly. */
static void stratified_numbers(uint64_t seed, int count) {
    int columns = 1;
    while ((columns + 1) * (columns + 1) <= count) ++columns;
    const int in_rows = (count + columns - 1) / columns;
    random_numbers(seed, count);
    for (int i = 0; i < count; ++i) {
        const int row = i / columns, in_row = row + 1 < in_rows ? columns : count - row * columns;
        page_numbers[0][i] =
            below_one(((float)(i - row * columns) + page_numbers[0][i]) / (float)in_row);
        page_numbers[1][i] = below_one(((float)row + page_numbers[1][i]) / (float)in_rows);
    }
}

/* Direction numbers of three dimensions: van der Corput's, and those of the polynomials x + 1 and x^2 + x + 1
 * with the first numbers 1 and 1, 3 (Sobol 1967, Joe & Kuo 2008). */
static uint32_t directions[3][32];

static void make_directions(void) {
    for (int j = 0; j < 32; ++j) {
        uint32_t *x = directions[0] + j, *y = directions[1] + j, *z = directions[2] + j;
        *x = 0x80000000u >> j;
        *y = j == 0 ? *x : y[-1] ^ (y[-1] >> 1);
        *z = j == 0 ? *x : j == 1 ? 0xc0000000u : z[-1] ^ z[-2] ^ (z[-2] >> 2);
    }
}

/* In the order of Gray codes: one digit of the index changes from a point to the next. */
void page_sobol_next(uint32_t x[3], uint32_t i) {
    if (directions[0][0] == 0) make_directions();
    const int digit = __builtin_ctz(i + 1);
    for (int k = 0; k < 3; ++k) x[k] ^= directions[k][digit];
}

/* The digits are shifted by a random number. */
static void sobol_numbers(uint64_t seed, int count) {
    const lobe_random4 shift = lobe_random(seed, 1, 0);
    uint32_t x[3] = {shift.word[0], shift.word[1], shift.word[2]};
    for (int i = 0; i < count; ++i) {
        for (int k = 0; k < 3; ++k) page_numbers[k][i] = lobe_random_unit_f32(x[k]);
        page_sobol_next(x, (uint32_t)i);
    }
}

/* Fills u1, u2, u3. */
EXPORT(make_numbers) void page_make_numbers(int pattern, int seed, int count);
void page_make_numbers(int pattern, int seed, int count) {
    if (pattern == STRATIFIED)
        stratified_numbers((uint64_t)seed, count);
    else if (pattern == SOBOL)
        sobol_numbers((uint64_t)seed, count);
    else
        random_numbers((uint64_t)seed, count);
}
