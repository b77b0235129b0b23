/* lobe/methods.h: what can be sampled and how: the lists from which enumerations, names, dispatch,
 * the command line and the cases of `lobe verify` are made. */
#ifndef LOBE_METHODS_H
#define LOBE_METHODS_H

/* Distributions of normals: X(IDENTIFIER, "name") */
#define LOBE_NDFS(X) X(GGX, "ggx")

/* Masking of the microsurface: X(IDENTIFIER, "name") */
#define LOBE_MASKINGS(X) X(SMITH, "smith")

/* Sampling methods: X(IDENTIFIER, "name on the command line", "what it is, and its source") */
#define LOBE_METHODS(X)                                                                            \
    X(NDF, "ndf", "all normals, D cos (Walter et al. 2007)")                                       \
    X(SLOPE_PUBLISHED, "slope-published",                                                          \
      "visible slopes with the printed rational fit (Heitz & d'Eon 2014); fails chi^2 tests")      \
    X(SLOPE, "slope", "visible slopes, every inversion exact (after Heitz & d'Eon 2014)")          \
    X(ELLIPSOID, "ellipsoid", "projected ellipsoid (Heitz 2018)")                                  \
    X(CAPS, "caps", "spherical caps (Dupuy & Benyoub 2023)")                                       \
    X(BOUNDED, "bounded", "bounded caps (Eto & Tokuyoshi 2023, 2024)")                             \
    X(OPTIMAL, "optimal", "smallest cap of any axis (docs/optimal-caps.md)")

/* Which of them go together: X(NDF, MASKING, METHOD, kernel), kernel/<kernel>.h. The last row of a
 * distribution and masking is its best method. */
#define LOBE_MODELS(X)                                                                             \
    X(GGX, SMITH, NDF, ggx_ndf)                                                                    \
    X(GGX, SMITH, SLOPE_PUBLISHED, ggx_slope_published)                                            \
    X(GGX, SMITH, SLOPE, ggx_slope)                                                                \
    X(GGX, SMITH, ELLIPSOID, ggx_ellipsoid)                                                        \
    X(GGX, SMITH, CAPS, ggx_caps)                                                                  \
    X(GGX, SMITH, BOUNDED, ggx_bounded)                                                            \
    X(GGX, SMITH, OPTIMAL, ggx_optimal)

#endif
