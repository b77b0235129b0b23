/* bench/inline.c: one draw a call of the single-file samplers (tools/dropin.sh), as a renderer that includes them
 * compiles it; called by bench/measure.py.
 *
 * Prints, for caps, bounded and optimal: method, ns of an inlined draw, ns of the library's call, ns of its scalar
 * batch, each prepared for every draw; medians of rounds that take turns. */
#include <lobe_ggx.h>

#include <lobe/batch.h>
#include <lobe/random.h>

#include <stdio.h>
#include <stdlib.h>

#include "inputs.h"
#include "machine.h"
#include "work.h"

enum { ROUNDS = 41, PASSES = 20, WAYS = 3, METHODS = 3 };

#define INLINE_DRAW(kernel)                                                                        \
    static double kernel##_inline(const inputs_f32 *in) {                                          \
        double sum = 0;                                                                            \
        for (int i = 0; i < INPUTS; ++i) {                                                         \
            const lobe_v3 wi = lobe_v3_of(in->wi[0][i], in->wi[1][i], in->wi[2][i]);               \
            const lobe_ggx_base base = lobe_ggx_base_of(wi, in->alpha[0][i], in->alpha[1][i],      \
                                                        lobe_facet_options_of(false, false));      \
            const lobe_facet_draw d = lobe_##kernel##_draw(lobe_##kernel##_prepare(base),          \
                                                           in->u[0][i], in->u[1][i], in->u[2][i]); \
            sum += d.wo.x + d.pdf + d.weight;                                                      \
        }                                                                                          \
        return sum;                                                                                \
    }
INLINE_DRAW(ggx_caps)
INLINE_DRAW(ggx_bounded)
INLINE_DRAW(ggx_optimal)

typedef struct subject {
    const char *name;
    lobe_method method;
    double (*inlined)(const inputs_f32 *in);
} subject;

static const subject subjects[METHODS] = {{"caps", LOBE_METHOD_CAPS, ggx_caps_inline},
                                          {"bounded", LOBE_METHOD_BOUNDED, ggx_bounded_inline},
                                          {"optimal", LOBE_METHOD_OPTIMAL, ggx_optimal_inline}};

static double pass(const subject *s, int way, inputs *in) {
    if (way == 0) return s->inlined(&in->f32);
    work w = {.options = lobe_reflection_default_options(),
              .precision = PRECISION_F32,
              .isa = way == 1 ? NULL : "scalar",
              .plane = {0, 0, 1}};
    w.options.model.method = s->method;
    return work_draw(&w, in);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(void) {
    static inputs in;
    static double ns[METHODS][WAYS][ROUNDS];
    volatile double sum = 0;
    inputs_fill(&in);
    lobe_restrict_isa("scalar");
    for (int round = 0; round < ROUNDS; ++round) {
        for (int k = 0; k < METHODS * WAYS; ++k) {
            const double start = machine_seconds();
            for (int i = 0; i < PASSES; ++i) sum = sum + pass(&subjects[k / WAYS], k % WAYS, &in);
            ns[k / WAYS][k % WAYS][round] = 1e9 * (machine_seconds() - start) / PASSES / INPUTS;
        }
    }
    for (int m = 0; m < METHODS; ++m) {
        printf("%s", subjects[m].name);
        for (int way = 0; way < WAYS; ++way) {
            qsort(ns[m][way], ROUNDS, sizeof(double), compare);
            printf(" %.2f", ns[m][way][ROUNDS / 2]);
        }
        printf("\n");
    }
    return 0;
}
