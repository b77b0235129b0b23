/* tools/numerics/beckmann_error.c: the worst difference between a Beckmann draw in float and the same draw in
 * double, with the input that causes it, over random inputs.
 *
 *     for bits in 32 64; do cc -O2 -ffp-contract=off -I. -DBITS=$bits \
 *         -c tools/numerics/beckmann_draws.c -o draws_$bits.o; done
 *     cc -O2 -ffp-contract=off -I. -Iinclude tools/numerics/beckmann_error.c draws_32.o draws_64.o \
 *         build/liblobe.a -lm -o beckmann_error && ./beckmann_error
 *
 * Roughness 0.01 to 2, any direction with c = i_z/b_i above -10: beyond, the float normal itself does not tell
 * visible slopes apart. "direction" is |wo - wo'|, "density" the relative error of pdf against double at the
 * normal that was drawn. The figures stand at the foot of the kernel files. */
#include <lobe/random.h>

#include "beckmann_error.h"

#include <math.h>
#include <stdio.h>

enum { DRAWS = 300000 };

typedef struct input {
    shading at;
    double u1, u2;
} input;

typedef struct worst {
    double error;
    input at;
} worst;

static float unit(lobe_random4 r, int word) {
    return lobe_random_unit_f32(r.word[word]);
}

static input input_at(uint64_t k) {
    lobe_random4 a = lobe_random(9, 0, k), b = lobe_random(9, 1, k);
    float z = 1.0f - 1.9962f * unit(a, 0), turn = 6.2831853f * unit(a, 1);
    float s = sqrtf(1.0f - z * z), alpha_x = 0.01f * powf(200.0f, unit(a, 2));
    float alpha_y = k % 4 == 0 ? alpha_x : 0.01f * powf(200.0f, unit(a, 3));
    input i = {{{s * cosf(turn), s * sinf(turn), z}, alpha_x, alpha_y}, unit(b, 0), unit(b, 1)};
    return i;
}

static void keep(worst *w, double error, const input *i) {
    if (error > w->error) *w = (worst){error, *i};
}

static void compare(int sampler, const input *i, worst *direction, worst *density) {
    drawn a = draw_f32(sampler, &i->at, i->u1, i->u2), b = draw_f64(sampler, &i->at, i->u1, i->u2);
    if (a.pdf == 0 || b.pdf == 0 || b.c < -10) return;
    double x = a.wo[0] - b.wo[0], y = a.wo[1] - b.wo[1], z = a.wo[2] - b.wo[2];
    keep(direction, sqrt(x * x + y * y + z * z), i);
    double exact = density_f64(sampler, &i->at, a.m);
    if (exact > 0) keep(density, fabs(a.pdf / exact - 1), i);
}

static void print(int sampler, const char *what, const worst *w) {
    static const char *const names[] = {
#define NAME(index, name) #name,
        BECKMANN_SAMPLERS(NAME)
#undef NAME
    };
    printf("%-16s %-9s %.2g at wi (%a, %a, %a) alpha (%a, %a) u (%a, %a)\n", names[sampler], what,
           w->error, w->at.at.wi[0], w->at.at.wi[1], w->at.at.wi[2], w->at.at.alpha_x,
           w->at.at.alpha_y, w->at.u1, w->at.u2);
}

int main(void) {
    for (int sampler = 0; sampler < BECKMANN_SAMPLER_COUNT; ++sampler) {
        worst direction = {0}, density = {0};
        for (uint64_t k = 0; k < DRAWS; ++k) {
            input i = input_at(k);
            compare(sampler, &i, &direction, &density);
        }
        print(sampler, "direction", &direction);
        print(sampler, "density", &density);
    }
    return 0;
}
