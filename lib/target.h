/* lib/target.h: compile the rest of a file for one instruction set, whatever the flags of the build
 * are. Before including: one of the TARGET_ macros below, defined. Only what stands after the include
 * is affected, and all of it is static, so no code for a newer processor leaks into a shared function. */
#ifndef LOBE_TARGET_H
#define LOBE_TARGET_H

#if defined(TARGET_SSE41)
#define TARGET_TEXT "sse4.1"
#elif defined(TARGET_AVX2)
#define TARGET_TEXT "avx2,fma"
#elif defined(TARGET_AVX512)
#define TARGET_TEXT "avx2,fma,avx512f,avx512vl,avx512bw,avx512dq"
#elif defined(TARGET_SIMD128)
#define TARGET_TEXT "simd128"
#endif

/* TARGET_END stands at the end of the file. */
#if defined(TARGET_TEXT) && defined(__clang__)
#define TARGET_END _Pragma("clang attribute pop")
#else
#define TARGET_END
#endif

#define TARGET_PRAGMA(text) _Pragma(#text)

/* Before a loop over rows: no row reads what another writes. (The same row may: the compiler keeps the order
 * within a row.) */
#if !defined(TARGET_TEXT) && !defined(TARGET_NEON)
#define INDEPENDENT_ROWS
#elif defined(__clang__)
#define INDEPENDENT_ROWS _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT_ROWS _Pragma("GCC ivdep")
#endif

#if !defined(TARGET_TEXT)
/* the baseline of the build */
#elif defined(__clang__)
#define TARGET_ATTRIBUTE(text)                                                                     \
    TARGET_PRAGMA(clang attribute push(__attribute__((target(text))), apply_to = function))
TARGET_ATTRIBUTE(TARGET_TEXT)
#elif defined(TARGET_AVX512)
/* measured: full width is 1.5 times faster here than half */
#pragma GCC target("avx2,fma,avx512f,avx512vl,avx512bw,avx512dq,prefer-vector-width=512")
#elif defined(TARGET_AVX2)
#pragma GCC target("avx2,fma,prefer-vector-width=256")
#elif defined(TARGET_SSE41)
#pragma GCC target("sse4.1")
#endif

#endif
