/* lib/isa.h: the instruction sets of the batches, and which one is in use. */
#ifndef LOBE_ISA_H
#define LOBE_ISA_H

/* From the plainest to the widest of a family of processors: X(IDENTIFIER, stem of the files) */
#if defined(__x86_64__) && defined(__GNUC__)
#define LOBE_ISAS(X) X(SCALAR, scalar) X(SSE41, sse41) X(AVX2, avx2) X(AVX512, avx512)
#elif defined(__aarch64__)
#define LOBE_ISAS(X) X(SCALAR, scalar) X(NEON, neon)
#else
#define LOBE_ISAS(X) X(SCALAR, scalar)
#endif

#define LOBE_ISA_ENUMERATOR(ID, stem) LOBE_ISA_##ID,
typedef enum lobe_isa_id { LOBE_ISAS(LOBE_ISA_ENUMERATOR) LOBE_ISA_COUNT } lobe_isa_id;
#undef LOBE_ISA_ENUMERATOR

/* The set in use; chosen at the first call. */
lobe_isa_id lobe_isa_in_use(void);

#endif
