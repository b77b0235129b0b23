#include "draws.h"

#include <lobe/random.h>

/* In single precision a draw takes three words, so four draws take three blocks and waste none. */
enum { WORDS = 3, GROUP = 4, MOST_GROUPS = 64 };

/* Exact: 24 bits. */
static double unit_of(uint32_t word) {
    return (double)(int32_t)(word >> 8) * 0x1p-24;
}

static void groups_of_24_bits(const lobe_settings *settings, uint64_t group, size_t groups,
                              double *u) {
    lobe_random4 blocks[WORDS * MOST_GROUPS];
    lobe_random_many(settings->seed, settings->stream, WORDS * group, (uint32_t)(WORDS * groups),
                     blocks);
    for (size_t b = 0; b < WORDS * groups; ++b) {
        for (size_t k = 0; k < 4; ++k) u[4 * b + k] = unit_of(blocks[b].word[k]);
    }
}

/* The third number is of the 22 bits that the others leave: enough for a choice, and free. */
static void of_53_bits(const lobe_random4 *r, double u[3]) {
    u[0] = lobe_random_unit_f64(r->word[0], r->word[1]);
    u[1] = lobe_random_unit_f64(r->word[2], r->word[3]);
    u[2] = ((r->word[1] & 2047) * 2048.0 + (r->word[3] & 2047)) / 4194304.0;
}

void lobe_random_numbers(const lobe_verify_model *model, const lobe_settings *settings,
                         uint64_t index, double u[3]) {
    if (model->random_bits == 24) {
        double four[GROUP * WORDS];
        groups_of_24_bits(settings, index / GROUP, 1, four);
        for (uint64_t k = 0; k < 3; ++k) u[k] = four[WORDS * (index % GROUP) + k];
    } else {
        lobe_random4 r = lobe_random(settings->seed, settings->stream, index);
        of_53_bits(&r, u);
    }
}

static void many_of_53_bits(const lobe_settings *settings, uint64_t first, size_t count,
                            double *u) {
    lobe_random4 blocks[GROUP * MOST_GROUPS];
    for (size_t done = 0; done < count;) {
        size_t part = count - done < GROUP * MOST_GROUPS ? count - done : GROUP * MOST_GROUPS;
        lobe_random_many(settings->seed, settings->stream, first + done, (uint32_t)part, blocks);
        for (size_t i = 0; i < part; ++i) of_53_bits(&blocks[i], u + 3 * (done + i));
        done += part;
    }
}

void lobe_many_random_numbers(const lobe_verify_model *model, const lobe_settings *settings,
                              uint64_t first, size_t count, double *u) {
    if (model->random_bits != 24) {
        many_of_53_bits(settings, first, count, u);
        return;
    }
    for (size_t done = 0; done < count;) {
        uint64_t index = first + done;
        size_t groups = (count - done) / GROUP;
        if (groups > MOST_GROUPS) groups = MOST_GROUPS;
        if (index % GROUP == 0 && groups > 0) {
            groups_of_24_bits(settings, index / GROUP, groups, u + 3 * done);
            done += GROUP * groups;
        } else {
            lobe_random_numbers(model, settings, index, u + 3 * done);
            done += 1;
        }
    }
}

void lobe_draw_many(const lobe_verify_model *model, const lobe_verify_state *state, size_t count,
                    const double *u, lobe_verify_draw *draws) {
    if (model->sample_many != NULL) {
        model->sample_many(state, count, u, draws);
        return;
    }
    for (size_t i = 0; i < count; ++i) draws[i] = model->sample(state, u + 3 * i);
}

void lobe_evaluate_many(const lobe_verify_model *model, const lobe_verify_state *state,
                        size_t count, const double *wo, double *density, double *value) {
    if (model->evaluate_many != NULL) {
        model->evaluate_many(state, count, wo, density, value);
        return;
    }
    for (size_t i = 0; i < count; ++i) {
        density[i] = model->density(state, wo + 3 * i);
        value[i] = model->value(state, wo + 3 * i);
    }
}
