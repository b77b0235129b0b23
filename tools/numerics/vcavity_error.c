/* tools/numerics/vcavity_error.c: the worst difference between float and double of the V-cavity samplers
 * and hit probabilities, with the input that causes it, over random inputs.
 *
 *     for part in FLOAT DOUBLE; do
 *         cc -O2 -ffp-contract=off -I. -Iinclude -D$part -c tools/numerics/vcavity_error.c -o $part.o
 *     done
 *     cc FLOAT.o DOUBLE.o build/liblobe.a -lm -o vcavity_error && ./vcavity_error
 *
 * Roughness 0.01 to 2, any direction down to 175 degrees from the normal that sees more than 1e-8 of the
 * surface, u1 above 0, u2 up to 0.98. "direction" is
 * |wo - wo'|, at the u3 within 1e-6 where both take the same side; "density" the relative error of pdf
 * against double at the normal that was drawn. The figures stand at the foot of the kernel files. */
#ifdef DOUBLE
#include "kernel/bind/c_f64.h"
#else
#include "kernel/bind/c_f32.h"
#endif

#include "kernel/beckmann_vcavity.h"
#include "kernel/beckmann_vcavity_ndf.h"
#include "kernel/beckmann_vcavity_valid.h"
#include "kernel/ggx_vcavity.h"
#include "kernel/ggx_vcavity_ndf.h"
#include "kernel/ggx_vcavity_valid.h"

/* What both parts know: a case, and what one precision makes of it, in double. */
typedef struct input {
    double wi[3], alpha_x, alpha_y, u1, u2, u3;
} input;

typedef struct result {
    double m[3], wo[3], pdf, hit;
} result;

typedef struct model {
    const char *name;
    result (*draw)(const input *i);
    double (*pdf)(const input *i, const double m[3]);
} model;

#define BASE(family, i)                                                                            \
    family##_base_of(v3_of((real)(i)->wi[0], (real)(i)->wi[1], (real)(i)->wi[2]),                  \
                     (real)(i)->alpha_x, (real)(i)->alpha_y, facet_options_of(false, false))

#define MODEL(family, name)                                                                        \
    static result name##_result(const input *i) {                                                  \
        family##_base g = BASE(family, i);                                                         \
        facet_draw d = name##_draw(name##_prepare(g), (real)i->u1, (real)i->u2, (real)i->u3);      \
        result r = {{d.m.x, d.m.y, d.m.z}, {d.wo.x, d.wo.y, d.wo.z}, d.pdf, g.cavity.hit};         \
        return r;                                                                                  \
    }                                                                                              \
    static double name##_pdf_at(const input *i, const double m[3]) {                               \
        family##_base g = BASE(family, i);                                                         \
        v3 normal = v3_of((real)m[0], (real)m[1], (real)m[2]);                                     \
        return name##_pdf(name##_prepare(g), family##_pair_of_m(g, normal));                       \
    }

#define MODELS(ROW)                                                                                \
    ROW(ggx_vcavity, ggx_vcavity_ndf)                                                              \
    ROW(ggx_vcavity, ggx_vcavity)                                                                  \
    ROW(ggx_vcavity, ggx_vcavity_valid)                                                            \
    ROW(beckmann_vcavity, beckmann_vcavity_ndf)                                                    \
    ROW(beckmann_vcavity, beckmann_vcavity)                                                        \
    ROW(beckmann_vcavity, beckmann_vcavity_valid)
MODELS(MODEL)

#define ENTRY(family, name) {#name, name##_result, name##_pdf_at},

#ifdef DOUBLE
const model double_models[] = {MODELS(ENTRY)};
#else

#include <lobe/random.h>

#include <math.h>
#include <stdio.h>

extern const model double_models[];
static const model float_models[] = {MODELS(ENTRY)};

enum { DRAWS = 5000000, COUNT = sizeof float_models / sizeof float_models[0] };

static float unit(lobe_random4 r, int word) {
    return lobe_random_unit_f32(r.word[word]);
}

static input input_at(uint64_t k) {
    lobe_random4 a = lobe_random(9, 0, k), b = lobe_random(9, 1, k);
    float z = 1.0f - 1.9962f * unit(a, 0), turn = 6.2831853f * unit(a, 1);
    float s = sqrtf(1.0f - z * z), alpha_x = 0.01f * powf(200.0f, unit(a, 2));
    float alpha_y = k % 4 == 0 ? alpha_x : 0.01f * powf(200.0f, unit(a, 3));
    input i = {{s * cosf(turn), s * sinf(turn), z},
               alpha_x,
               alpha_y,
               unit(b, 0),
               0.98f * unit(b, 1),
               unit(b, 2)};
    return i;
}

typedef struct worst {
    double error;
    input at;
} worst;

static void keep(worst *w, double error, const input *i) {
    if (error > w->error) *w = (worst){error, *i};
}

static double distance(const double a[3], const double b[3]) {
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* The nearest of three draws in double: u3 within 1e-6 of where a choice changes. */
static double direction_error(const model *exact, const input *i, const result *drawn) {
    double least = 2;
    for (int step = -1; step <= 1; ++step) {
        input near = *i;
        near.u3 = fmin(fmax(i->u3 + 1e-6 * step, 0), 1 - 1e-16);
        result r = exact->draw(&near);
        if (r.pdf > 0) least = fmin(least, distance(drawn->wo, r.wo));
    }
    return least;
}

static void print(const char *name, const char *what, const worst *w) {
    printf("%-24s %-9s %.2g at wi (%a, %a, %a) alpha (%a, %a) u (%a, %a, %a)\n", name, what,
           w->error, w->at.wi[0], w->at.wi[1], w->at.wi[2], w->at.alpha_x, w->at.alpha_y, w->at.u1,
           w->at.u2, w->at.u3);
}

int main(void) {
    for (int m = 0; m < COUNT; ++m) {
        worst direction = {0}, density = {0}, hit = {0};
        for (uint64_t k = 0; k < DRAWS; ++k) {
            input i = input_at(k);
            result drawn = float_models[m].draw(&i), exact = double_models[m].draw(&i);
            if (i.u1 == 0 || exact.hit < 1e-8) continue;
            keep(&hit, fabs(drawn.hit / exact.hit - 1), &i);
            if (drawn.pdf == 0) continue;
            double error = direction_error(&double_models[m], &i, &drawn);
            if (error < 2) keep(&direction, error, &i);
            double pdf = double_models[m].pdf(&i, drawn.m);
            if (pdf > 0) keep(&density, fabs(drawn.pdf / pdf - 1), &i);
        }
        print(float_models[m].name, "direction", &direction);
        print(float_models[m].name, "density", &density);
        print(float_models[m].name, "hit", &hit);
    }
    return 0;
}
#endif
