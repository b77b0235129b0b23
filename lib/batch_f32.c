/* lib/batch_f32.c: the batches in single precision. */
#include "../kernel/bind/c_f32.h"

#define BATCH_NAME(stem) stem##_f32

#include "batch_template.h"

void lobe_draw_numbers_f32(uint64_t seed, uint64_t row, float u[3]) {
    lobe_random4 words = lobe_random(seed, 0, row);
    u[0] = lobe_random_unit_f32(words.word[0]);
    u[1] = lobe_random_unit_f32(words.word[2]);
    u[2] = lobe_random_unit_f32(words.word[1]);
}
