/* tests/lib/bits.c: fingerprints of all that the batches give, by every instruction set of this processor.
 *
 *     bits [ROWS]
 *
 * For each model and precision, one line with a hash of the outputs of ROWS random rows, one in eight of
 * them with a special number; the sets of this processor have to agree (status 1 if not). The inputs are
 * made without libm: another processor prints the same lines if its bits are the same
 * (tests/house/test_neon.sh). */
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/batch.h>
#include <lobe/random.h>

enum { BLOCK = 1000 };

/* FNV-1a over words. */
static uint64_t mixed(uint64_t hash, uint64_t word) {
    return (hash ^ word) * UINT64_C(0x100000001b3);
}

static double unit(uint32_t word) {
    return (double)lobe_random_unit_f32(word);
}

static double odd_number(uint32_t word) {
    static const double odd[] = {0,    -0.0, 1,        0.5,       1e-4, 9.9e-5, 1e4,  2e4,
                                 1e-8, -1,   INFINITY, -INFINITY, NAN,  1e-30,  1e30, 0.99999994};
    return odd[word % (sizeof odd / sizeof *odd)];
}

static void random_direction(const uint32_t words[3], double d[3]) {
    double length2 = 0;
    for (int k = 0; k < 3; ++k) {
        d[k] = 2 * unit(words[k]) - 1 + 1e-3;
        length2 += d[k] * d[k];
    }
    for (int k = 0; k < 3; ++k) d[k] /= sqrt(length2);
}

/* wi, wo, alpha, u of a row: eleven numbers. */
enum { INPUTS = 11 };

static void random_row(uint64_t index, double row[INPUTS]) {
    const lobe_random4 a = lobe_random(11, 0, index), b = lobe_random(11, 1, index),
                       c = lobe_random(11, 2, index);
    random_direction(a.word, row);
    random_direction(b.word, row + 3);
    for (int k = 0; k < 2; ++k) {
        const double root = unit(k ? b.word[3] : a.word[3]) * 1.5;
        row[6 + k] = root * root * root * root;
    }
    for (int k = 0; k < 3; ++k) row[8 + k] = unit(c.word[k]);
    if (c.word[3] % 8 == 0) row[(c.word[3] >> 8) % INPUTS] = odd_number(c.word[3] >> 16);
}

#define REAL float
#define NAME(stem) stem##_f32
#define WORD uint32_t
#include "bits_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#define WORD uint64_t
#include "bits_template.h"

static int print_model(lobe_model model, uint64_t rows) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = model;
    int disagree = 0;
    for (int is_double = 0; is_double < 2; ++is_double) {
        uint64_t first = 0;
        for (int k = 0; lobe_isa_at(k); ++k) {
            lobe_restrict_isa(lobe_isa_at(k));
            const uint64_t hash =
                is_double ? hash_of_f64(options, rows) : hash_of_f32(options, rows);
            if (k == 0) first = hash;
            if (hash != first) fprintf(stderr, "bits: %s disagrees with scalar\n", lobe_isa_at(k));
            disagree |= hash != first;
        }
        printf("%s %s %s %s %016" PRIx64 "\n", lobe_ndf_name(model.ndf),
               lobe_masking_name(model.masking), lobe_method_name(model.method),
               is_double ? "f64" : "f32", first);
    }
    return disagree;
}

int main(int argc, char **argv) {
    const uint64_t rows = argc > 1 ? strtoull(argv[1], NULL, 10) : 20000;
    int disagree = 0;
    for (int m = 0; m < lobe_model_count(); ++m) disagree |= print_model(lobe_model_at(m), rows);
    return disagree;
}
