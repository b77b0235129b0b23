/* The passes over a band of rows. The files that define them are compiled once for each instruction set, and what
 * stands in their loops becomes vectors; every set gives the same bits. */
#ifndef LOBE_SSR_BANDS_H
#define LOBE_SSR_BANDS_H

#include "pipeline.h"

/* Rays of a band: see lobe_ssr_statistics. */
typedef struct ssr_counts {
    uint64_t rays, rejected, hits, steps;
} ssr_counts;

/* Rows first to end - 1. */
typedef struct ssr_band {
    lobe_ssr *s;
    const lobe_ssr_frame *f;
    int first, end;
} ssr_band;

/* The sets: X(end of the symbols, name of lobe_isa) */
#if defined(LOBE_SSR_X86)
#define SSR_SETS(X) X(scalar, "scalar") X(sse41, "sse4.1") X(avx2, "avx2") X(avx512, "avx512")
#elif defined(LOBE_SSR_NEON)
#define SSR_SETS(X) X(scalar, "scalar") X(neon, "neon")
#else
#define SSR_SETS(X) X(scalar, "scalar")
#endif

#define SSR_DECLARE_BANDS(set, name)                                                               \
    void lobe_ssr_trace_##set(const ssr_band *b, ssr_counts *counts);                              \
    void lobe_ssr_reproject_##set(const ssr_band *b);                                              \
    void lobe_ssr_resolve_##set(const ssr_band *b);                                                \
    void lobe_ssr_accumulate_##set(const ssr_band *b);                                             \
    void lobe_ssr_keep_z_##set(const ssr_band *b);                                                 \
    void lobe_ssr_composite_##set(const ssr_band *b);
SSR_SETS(SSR_DECLARE_BANDS)
#undef SSR_DECLARE_BANDS

/* The symbol of a pass in the set that a file is compiled for. */
#define SSR_SYMBOL_OF(pass, set) lobe_ssr_##pass##_##set
#define SSR_SYMBOL_IN(pass, set) SSR_SYMBOL_OF(pass, set)
#define SSR_SYMBOL(pass) SSR_SYMBOL_IN(pass, LOBE_SSR_SET)

#endif
