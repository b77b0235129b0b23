/* tests/kernel/horizon_methods.h: the four horizon samplers behind one name. Before including: a
 * binding. */
#ifndef TESTS_KERNEL_HORIZON_METHODS_H
#define TESTS_KERNEL_HORIZON_METHODS_H

#include "kernel/ggx_horizon.h"
#include "kernel/ggx_horizon_exact.h"
#include "kernel/ggx_horizon_mirror.h"
#include "kernel/ggx_horizon_uniform.h"

#include <stdlib.h>

#define HORIZON_METHODS(X)                                                                         \
    X(MIRROR, horizon_mirror)                                                                      \
    X(UNIFORM, horizon_uniform)                                                                    \
    X(EXACT, horizon_exact)                                                                        \
    X(SHADOWED, horizon)

typedef enum horizon_method {
#define X(ID, name) ID,
    HORIZON_METHODS(X)
#undef X
        METHOD_COUNT
} horizon_method;

static const char *const method_name[] = {
#define X(ID, name) #name,
    HORIZON_METHODS(X)
#undef X
};

typedef struct horizon_any {
    horizon_method method;
    union {
#define X(ID, name) ggx_##name name;
        HORIZON_METHODS(X)
#undef X
    } as;
} horizon_any;

static inline horizon_any any_prepare(horizon_method method, ggx_base g) {
    horizon_any s;
    s.method = method;
    switch (method) {
#define X(ID, name)                                                                                \
    case ID:                                                                                       \
        s.as.name = ggx_##name##_prepare(g);                                                       \
        break;
        HORIZON_METHODS(X)
#undef X
    case METHOD_COUNT:
        break;
    }
    return s;
}

static inline facet_draw any_draw(const horizon_any *s, real u1, real u2, real u3) {
    switch (s->method) {
#define X(ID, name)                                                                                \
    case ID:                                                                                       \
        return ggx_##name##_draw(s->as.name, u1, u2, u3);
        HORIZON_METHODS(X)
#undef X
    case METHOD_COUNT:
        break;
    }
    abort();
}

static inline real any_pdf(const horizon_any *s, facet_pair pair) {
    switch (s->method) {
#define X(ID, name)                                                                                \
    case ID:                                                                                       \
        return ggx_##name##_pdf(s->as.name, pair);
        HORIZON_METHODS(X)
#undef X
    case METHOD_COUNT:
        break;
    }
    abort();
}

static inline real any_pdf_m(const horizon_any *s, facet_pair pair) {
    switch (s->method) {
#define X(ID, name)                                                                                \
    case ID:                                                                                       \
        return ggx_##name##_pdf_m(s->as.name, pair);
        HORIZON_METHODS(X)
#undef X
    case METHOD_COUNT:
        break;
    }
    abort();
}

static inline ggx_base base_with_floor(v3 wi, real ax, real ay, real floor_share) {
    facet_options options = facet_options_of(false, false);
    options.floor_share = floor_share;
    return ggx_base_of(wi, ax, ay, options);
}

#endif
