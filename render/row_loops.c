#include "row_loops.h"

#include <string.h>

#include "lobe/batch.h"
#include "material.h"

/* The sets: X(end of the symbols, name of lobe_isa) */
#if defined(LOBE_ROW_X86)
#define ROW_SETS(X) X(scalar, "scalar") X(sse41, "sse4.1") X(avx2, "avx2") X(avx512, "avx512")
#elif defined(LOBE_ROW_NEON)
#define ROW_SETS(X) X(scalar, "scalar") X(neon, "neon")
#else
#define ROW_SETS(X) X(scalar, "scalar")
#endif

#define DECLARE(set, name) extern const row_loops ROW_SYMBOL(set);
ROW_SETS(DECLARE)
#undef DECLARE

const row_loops *lobe_row_loops_in_use(void) {
    static const struct {
        const char *isa;
        const row_loops *loops;
    } all[] = {
#define OF_SET(set, name) {name, &ROW_SYMBOL(set)},
        ROW_SETS(OF_SET)
#undef OF_SET
    };
    const char *isa = lobe_isa();
    for (size_t i = 1; i < sizeof all / sizeof *all; i++)
        if (strcmp(all[i].isa, isa) == 0) return all[i].loops;
    return all[0].loops;
}

int lobe_row_kernel(const row_loops *loops, const lobe_model *asked, float metallic, float alpha,
                    float tilt_cosine) {
    if (asked->ndf != LOBE_NDF_GGX || asked->masking != LOBE_MASKING_SMITH) return -1;
    switch (lobe_surface_method(asked->method, metallic, alpha, tilt_cosine)) {
    case LOBE_METHOD_NDF:
        return ROW_ggx_ndf;
    case LOBE_METHOD_ELLIPSOID:
        return ROW_ggx_ellipsoid;
    case LOBE_METHOD_CAPS:
        return ROW_ggx_caps;
    case LOBE_METHOD_BOUNDED:
        return ROW_ggx_bounded;
    case LOBE_METHOD_HORIZON:
        return tilt_cosine < loops->table_tilt_cosine ? -1 : ROW_ggx_horizon;
    case LOBE_METHOD_HORIZON_UNIFORM:
        return tilt_cosine < loops->ellipse_tilt_cosine ? ROW_ggx_horizon_plane_uniform
                                                        : ROW_ggx_horizon_uniform;
    default:
        return -1;
    }
}
