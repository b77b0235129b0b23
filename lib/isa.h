/* lib/isa.h: the instruction sets of the batches, and which one is in use. */
#ifndef LOBE_ISA_H
#define LOBE_ISA_H

/* LOBE_SCALAR_ONLY: instrumented builds, where loops are not vectorised and take minutes to compile.
 * LOBE_SMALL: WebAssembly that has to be small (bindings/wasm): of the batches only
 * draws of prepared models, and them in vectors only. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(LOBE_SCALAR_ONLY)
#define LOBE_ISA_X86
#endif

/* From the plainest to the widest of a family of processors: X(IDENTIFIER, stem of the files, "name") */
#if defined(LOBE_ISA_X86)
#define LOBE_ISAS(X)                                                                               \
    X(SCALAR, scalar, "scalar")                                                                    \
    X(SSE41, sse41, "sse4.1")                                                                      \
    X(AVX2, avx2, "avx2")                                                                          \
    X(AVX512, avx512, "avx512")
#elif defined(__aarch64__) && !defined(LOBE_SCALAR_ONLY)
#define LOBE_ISAS(X) X(SCALAR, scalar, "scalar") X(NEON, neon, "neon")
#elif defined(__wasm__) && defined(LOBE_SMALL)
#define LOBE_ISAS(X) X(SIMD128, simd128, "simd128")
#elif defined(__wasm__) && !defined(LOBE_SCALAR_ONLY)
#define LOBE_ISAS(X) X(SCALAR, scalar, "scalar") X(SIMD128, simd128, "simd128")
#else
#define LOBE_ISAS(X) X(SCALAR, scalar, "scalar")
#endif

#define LOBE_ISA_ENUMERATOR(ID, stem, name) LOBE_ISA_##ID,
typedef enum lobe_isa_id { LOBE_ISAS(LOBE_ISA_ENUMERATOR) LOBE_ISA_COUNT } lobe_isa_id;
#undef LOBE_ISA_ENUMERATOR

/* The set in use; chosen at the first call. */
lobe_isa_id lobe_isa_in_use(void);

#endif
