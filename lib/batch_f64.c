/* lib/batch_f64.c: the batches in double precision. */
#include "../kernel/bind/c_f64.h"

#define BATCH_NAME(stem) stem##_f64

#include "batch_template.h"

void lobe_draw_numbers_f64(uint64_t seed, uint64_t row, double u[3]) {
    lobe_random4 words = lobe_random(seed, 0, row), more = lobe_random(seed, 1, row);
    u[0] = lobe_random_unit_f64(words.word[0], words.word[1]);
    u[1] = lobe_random_unit_f64(words.word[2], words.word[3]);
    u[2] = lobe_random_unit_f64(more.word[0], more.word[1]);
}
