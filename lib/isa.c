#include "isa.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "lobe/batch.h"

static const char *name_of(lobe_isa_id isa) {
#define NAME(ID, stem, name) name,
    static const char *const names[LOBE_ISA_COUNT] = {LOBE_ISAS(NAME)};
#undef NAME
    return names[isa];
}

static bool can_run(lobe_isa_id isa) {
#if defined(LOBE_ISA_X86)
    switch (isa) {
    case LOBE_ISA_SSE41:
        return __builtin_cpu_supports("sse4.1");
    case LOBE_ISA_AVX2:
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    case LOBE_ISA_AVX512:
        return can_run(LOBE_ISA_AVX2) && __builtin_cpu_supports("avx512f") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
               __builtin_cpu_supports("avx512dq");
    case LOBE_ISA_SCALAR:
    case LOBE_ISA_COUNT:
        break;
    }
#endif
    return isa < LOBE_ISA_COUNT; /* the baseline of the build */
}

static lobe_isa_id find(const char *name) {
    int isa = 0;
    while (isa < LOBE_ISA_COUNT && strcmp(name_of((lobe_isa_id)isa), name) != 0) ++isa;
    return (lobe_isa_id)isa;
}

static lobe_isa_id widest(void) {
    int isa = LOBE_ISA_COUNT - 1;
    while (!can_run((lobe_isa_id)isa)) --isa;
    return (lobe_isa_id)isa;
}

/* What the environment asks for, if it can be had. */
static lobe_isa_id choose(void) {
    const char *name = getenv("LOBE_ISA");
    lobe_isa_id asked = name ? find(name) : LOBE_ISA_COUNT;
    return asked < LOBE_ISA_COUNT && can_run(asked) ? asked : widest();
}

/* One more than the set in use; 0: not chosen yet. Two threads that choose at once choose alike. */
static atomic_int chosen;

lobe_isa_id lobe_isa_in_use(void) {
    int known = atomic_load_explicit(&chosen, memory_order_relaxed);
    if (known == 0) {
        known = (int)choose() + 1;
        int none = 0;
        if (!atomic_compare_exchange_strong(&chosen, &none, known)) known = none;
    }
    return (lobe_isa_id)(known - 1);
}

int lobe_restrict_isa(const char *name) {
    lobe_isa_id isa = name && *name ? find(name) : widest();
    if (isa >= LOBE_ISA_COUNT || !can_run(isa)) return 0;
    atomic_store(&chosen, (int)isa + 1);
    return 1;
}

const char *lobe_isa(void) {
    return name_of(lobe_isa_in_use());
}

const char *lobe_isa_at(int index) {
    for (int isa = 0; isa < LOBE_ISA_COUNT && index >= 0; ++isa)
        if (can_run((lobe_isa_id)isa) && index-- == 0) return name_of((lobe_isa_id)isa);
    return NULL;
}
