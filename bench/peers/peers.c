/* bench/peers/peers.c: draws with density by other projects' code beside the same method here: the batch of the widest
 * instruction set, and its scalar loop. A checkout is named at configuration:
 *
 *     cmake --preset release -DLOBE_PEER_PBRT=DIR -DLOBE_PEER_BSDL=DIR/src/libbsdl -DLOBE_PEER_OPENPBR=DIR
 *     cmake --build --preset release --target bench_peers && build/bench_peers
 *
 * One thread, 1024 rows that stay in the cache, one roughness for all. Prints a table: nanoseconds a draw, medians of
 * rounds that take turns; then how far the peer's densities are from ours at its own normals. */
#include <lobe/batch.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../inputs.h"
#include "../machine.h"
#include "peer.h"

enum { ROUNDS = 41, PASSES = 20, WAYS = 3 };

static const float ALPHA[2] = {0.3f, 0.5f};

typedef struct peer {
    const char *name;
    void (*draw)(const peer_rows *rows);
    lobe_method method;
    int is_of_direction; /* its density is that of the reflected direction */
} peer;

static const peer peers[] = {
#ifdef PEER_PBRT
    {"pbrt-v4", peer_pbrt_ellipsoid, LOBE_METHOD_ELLIPSOID, 0},
#endif
#ifdef PEER_BSDL
    {"OSL libbsdl", peer_bsdl_ellipsoid, LOBE_METHOD_ELLIPSOID, 0},
    {"OSL libbsdl", peer_bsdl_bounded, LOBE_METHOD_BOUNDED, 1},
#endif
#ifdef PEER_OPENPBR
    {"openpbr-bsdf", peer_openpbr_caps, LOBE_METHOD_CAPS, 0},
#endif
};
enum { PEERS = sizeof peers / sizeof *peers };

static inputs in;

/* From above only: that is what the peers are made for. */
static void lift_inputs(void) {
    inputs_fill(&in);
    for (int i = 0; i < INPUTS; ++i) in.f32.wi[2][i] = fabsf(in.f32.wi[2][i]);
}

static void peer_pass(const peer *p) {
    inputs_f32 *f = &in.f32;
    const peer_rows rows = {INPUTS,
                            {ALPHA[0], ALPHA[1]},
                            {f->wi[0], f->wi[1], f->wi[2]},
                            {f->u[0], f->u[1]},
                            {f->out_wo[0], f->out_wo[1], f->out_wo[2]},
                            f->out_pdf};
    p->draw(&rows);
}

/* What a peer computes: the normal and its density, or that of the direction. */
static void batch_pass(const peer *p) {
    inputs_f32 *f = &in.f32;
    lobe_sample_batch_f32 b = {.count = INPUTS, .options = lobe_reflection_default_options()};
    b.options.model.method = p->method;
    for (int k = 0; k < 3; ++k) {
        b.wi[k] = (lobe_in_f32){f->wi[k], 1};
        b.m[k] = (lobe_out_f32){f->out_wo[k], 1};
    }
    for (int k = 0; k < 2; ++k) {
        b.u[k] = (lobe_in_f32){f->u[k], 1};
        b.alpha[k] = (lobe_in_f32){&ALPHA[k], 0};
    }
    lobe_out_f32 *density = p->is_of_direction ? &b.pdf : &b.pdf_m;
    *density = (lobe_out_f32){f->out_pdf, 1};
    lobe_reflection_sample_batch_f32(&b);
}

static void pass(const peer *p, int way) {
    if (way == 0) {
        peer_pass(p);
        return;
    }
    lobe_restrict_isa(way == 1 ? "scalar" : NULL);
    batch_pass(p);
}

static int compare(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Largest relative difference of all but a thousandth of the peer's densities, and its numbers that are none. */
static void judge(const peer *p) {
    static double difference[INPUTS];
    int seen = 0, broken = 0;
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model.method = p->method;
    peer_pass(p);
    const inputs_f32 *f = &in.f32;
    for (int i = 0; i < INPUTS; ++i) {
        const lobe_vec3_f64 wi = {f->wi[0][i], f->wi[1][i], f->wi[2][i]};
        const lobe_vec3_f64 m = {f->out_wo[0][i], f->out_wo[1][i], f->out_wo[2][i]};
        const lobe_reflection_f64 model =
            lobe_reflection_prepare_f64(options, wi, ALPHA[0], ALPHA[1]);
        const lobe_reflection_eval_f64 e = lobe_reflection_eval_m_f64(&model, m);
        const double ours = p->is_of_direction ? e.pdf : e.pdf_m;
        broken += !isfinite(f->out_pdf[i]);
        if (ours > 0 && isfinite(f->out_pdf[i]))
            difference[seen++] = fabs(f->out_pdf[i] / ours - 1);
    }
    qsort(difference, (size_t)seen, sizeof *difference, compare);
    printf("%s %s: 99.9 %% of %d densities within %.1e of ours; %d not finite\n", p->name,
           lobe_method_name(p->method), seen, seen ? difference[(seen - 1) * 999 / 1000] : 0.0,
           broken);
}

int main(void) {
    static double ns[PEERS][WAYS][ROUNDS];
    lift_inputs();
    for (int round = 0; round < ROUNDS; ++round) {
        for (int k = 0; k < PEERS * WAYS; ++k) {
            const double start = machine_seconds();
            for (int i = 0; i < PASSES; ++i) pass(&peers[k / WAYS], k % WAYS);
            ns[k / WAYS][k % WAYS][round] = 1e9 * (machine_seconds() - start) / PASSES / INPUTS;
        }
    }
    lobe_restrict_isa(NULL);
    printf("| project | method | its code | lobe, scalar | lobe, %s |\n|---|---|---|---|---|\n",
           lobe_isa());
    for (int p = 0; p < PEERS; ++p) {
        printf("| %s | %s |", peers[p].name, lobe_method_name(peers[p].method));
        for (int way = 0; way < WAYS; ++way) {
            qsort(ns[p][way], ROUNDS, sizeof(double), compare);
            printf(" %.1f |", ns[p][way][ROUNDS / 2]);
        }
        printf("\n");
    }
    printf("\n");
    for (int p = 0; p < PEERS; ++p) judge(&peers[p]);
    return 0;
}
