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

/* Three dimensions: van der Corput's, and those of the polynomials x + 1 and x^2 + x + 1 with the first
 * numbers 1 and 1, 3 (Sobol 1967, Joe & Kuo 2008); the digits are shifted by a random number. */
static void sobol_numbers(uint64_t seed, int count) {
    uint32_t v[3][32];
    for (int j = 0; j < 32; ++j) {
        v[0][j] = 0x80000000u >> j;
        v[1][j] = j == 0 ? 0x80000000u : v[1][j - 1] ^ (v[1][j - 1] >> 1);
        v[2][j] = j == 0   ? 0x80000000u
                  : j == 1 ? 0xc0000000u
                           : v[2][j - 1] ^ v[2][j - 2] ^ (v[2][j - 2] >> 2);
    }
    const lobe_random4 shift = lobe_random(seed, 1, 0);
    uint32_t x[3] = {shift.word[0], shift.word[1], shift.word[2]};
    for (int i = 0; i < count; ++i) {
        const int next = __builtin_ctz((unsigned)i + 1); /* in the order of Gray codes */
        for (int k = 0; k < 3; ++k) {
            page_numbers[k][i] = lobe_random_unit_f32(x[k]);
            x[k] ^= v[k][next];
        }
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
