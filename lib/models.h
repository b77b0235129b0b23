/* lib/models.h: the kernels of LOBE_MODELS, and how to call their families. Before including: the
 * binding of a precision. */
#include "lobe/reflection.h"

#include "../kernel/beckmann_horizon.h"
#include "../kernel/beckmann_ndf.h"
#include "../kernel/beckmann_newton.h"
#include "../kernel/beckmann_newton_published.h"
#include "../kernel/beckmann_slope.h"
#include "../kernel/beckmann_vcavity.h"
#include "../kernel/beckmann_vcavity_ndf.h"
#include "../kernel/beckmann_vcavity_valid.h"
#include "../kernel/ggx_bounded.h"
#include "../kernel/ggx_caps.h"
#include "../kernel/ggx_ellipsoid.h"
#include "../kernel/ggx_horizon.h"
#include "../kernel/ggx_horizon_exact.h"
#include "../kernel/ggx_horizon_mirror.h"
#include "../kernel/ggx_horizon_plane_ellipse.h"
#include "../kernel/ggx_horizon_plane_uniform.h"
#include "../kernel/ggx_horizon_plane_table.h"
#include "../kernel/ggx_horizon_uniform.h"
#include "../kernel/ggx_ndf.h"
#include "../kernel/ggx_optimal.h"
#include "../kernel/ggx_slope.h"
#include "../kernel/ggx_slope_published.h"
#include "../kernel/ggx_vcavity.h"
#include "../kernel/ggx_vcavity_ndf.h"
#include "../kernel/ggx_vcavity_valid.h"

/* The family of a distribution and a masking: the stem of its kernel functions. */
#define FAMILY_GGX_SMITH ggx
#define FAMILY_BECKMANN_SMITH beckmann
#define FAMILY_GGX_VCAVITY ggx_vcavity
#define FAMILY_BECKMANN_VCAVITY beckmann_vcavity

#define JOIN(a, b) a##b
#define JOIN_EXPANDED(a, b) JOIN(a, b)
#define FAMILY(NDF, MASKING, suffix) JOIN_EXPANDED(FAMILY_##NDF##_##MASKING, suffix)

/* What stands in for a model above a geometric surface that is tilted enough: X as in LOBE_MODELS. A
 * model without one rejects what goes below that surface. */
#define TILTED_MODELS(X)                                                                           \
    X(GGX, SMITH, HORIZON_MIRROR, ggx_horizon_plane_ellipse)                                       \
    X(GGX, SMITH, HORIZON_UNIFORM, ggx_horizon_plane_uniform)                                      \
    X(GGX, SMITH, HORIZON, ggx_horizon_plane_table)

#define ALL_MODELS(X) LOBE_MODELS(X) TILTED_MODELS(X)

#define ROW_INDEX(NDF, MASKING, METHOD, kernel) INDEX_##kernel,
enum { ALL_MODELS(ROW_INDEX) ROW_COUNT };
#undef ROW_INDEX

/* The row of a model, -1 where the combination does not exist. */
int lobe_find_row_f32(lobe_model model);
int lobe_find_row_f64(lobe_model model);
