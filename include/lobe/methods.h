/* lobe/methods.h: what can be sampled and how: the lists from which enumerations, names, dispatch,
 * the command line and the cases of `lobe verify` are made. */
#ifndef LOBE_METHODS_H
#define LOBE_METHODS_H

/* Distributions of normals: X(IDENTIFIER, "name") */
#define LOBE_NDFS(X) X(GGX, "ggx") X(BECKMANN, "beckmann")

/* Masking of the microsurface: X(IDENTIFIER, "name") */
#define LOBE_MASKINGS(X) X(SMITH, "smith") X(VCAVITY, "vcavity")

/* Sampling methods: X(IDENTIFIER, "name on the command line", "what it is, and its source") */
#define LOBE_METHODS(X)                                                                            \
    X(NDF, "ndf", "all normals, D cos (Walter et al. 2007)")                                       \
    X(SLOPE_PUBLISHED, "slope-published",                                                          \
      "visible slopes with the printed rational fit (Heitz & d'Eon 2014); fails chi^2 tests")      \
    X(SLOPE, "slope", "visible slopes, every inversion exact (after Heitz & d'Eon 2014)")          \
    X(NEWTON_PUBLISHED, "newton-published",                                                        \
      "visible slopes by three unguarded Newton steps (Jakob 2014), for comparison")               \
    X(NEWTON, "newton", "visible slopes by a bracketed inversion (after Jakob 2014)")              \
    X(VCAVITY, "vcavity", "V-cavities (Heitz & d'Eon 2014, Tokuyoshi 2021)")                       \
    X(VCAVITY_VALID, "vcavity-valid",                                                              \
      "the same; of a mirrored pair, the normal that reflects upward (docs/departures.md)")        \
    X(ELLIPSOID, "ellipsoid", "projected ellipsoid (Heitz 2018)")                                  \
    X(CAPS, "caps", "spherical caps (Dupuy & Benyoub 2023)")                                       \
    X(BOUNDED, "bounded", "bounded caps (Eto & Tokuyoshi 2023, 2024)")                             \
    X(OPTIMAL, "optimal", "smallest cap of any axis (docs/optimal-caps.md)")                       \
    X(HORIZON_MIRROR, "horizon-mirror",                                                            \
      "uniform over what leaves the surface, by u3 (docs/horizon-sampling.md)")                    \
    X(HORIZON_EXACT, "horizon-exact",                                                              \
      "the same, continuous, by a fixed number of steps (docs/horizon-sampling.md)")               \
    X(HORIZON_UNIFORM, "horizon-uniform",                                                          \
      "nearly the same, in closed form (docs/horizon-sampling.md)")                                \
    X(HORIZON, "horizon",                                                                          \
      "nothing rejected, and shadowing followed down to a floor (docs/horizon-sampling.md)")

/* Which of them go together: X(NDF, MASKING, METHOD, kernel), kernel/<kernel>.h. The last row of a
 * distribution and masking is its best method. */
#define LOBE_MODELS(X)                                                                             \
    X(GGX, SMITH, NDF, ggx_ndf)                                                                    \
    X(GGX, SMITH, SLOPE_PUBLISHED, ggx_slope_published)                                            \
    X(GGX, SMITH, SLOPE, ggx_slope)                                                                \
    X(GGX, SMITH, ELLIPSOID, ggx_ellipsoid)                                                        \
    X(GGX, SMITH, CAPS, ggx_caps)                                                                  \
    X(GGX, SMITH, BOUNDED, ggx_bounded)                                                            \
    X(GGX, SMITH, OPTIMAL, ggx_optimal)                                                            \
    X(GGX, SMITH, HORIZON_MIRROR, ggx_horizon_mirror)                                              \
    X(GGX, SMITH, HORIZON_EXACT, ggx_horizon_exact)                                                \
    X(GGX, SMITH, HORIZON_UNIFORM, ggx_horizon_uniform)                                            \
    X(GGX, SMITH, HORIZON, ggx_horizon)                                                            \
    X(BECKMANN, SMITH, NDF, beckmann_ndf)                                                          \
    X(BECKMANN, SMITH, SLOPE, beckmann_slope)                                                      \
    X(BECKMANN, SMITH, NEWTON_PUBLISHED, beckmann_newton_published)                                \
    X(BECKMANN, SMITH, NEWTON, beckmann_newton)                                                    \
    X(BECKMANN, SMITH, HORIZON, beckmann_horizon)                                                  \
    X(GGX, VCAVITY, NDF, ggx_vcavity_ndf)                                                          \
    X(GGX, VCAVITY, VCAVITY, ggx_vcavity)                                                          \
    X(GGX, VCAVITY, VCAVITY_VALID, ggx_vcavity_valid)                                              \
    X(BECKMANN, VCAVITY, NDF, beckmann_vcavity_ndf)                                                \
    X(BECKMANN, VCAVITY, VCAVITY, beckmann_vcavity)                                                \
    X(BECKMANN, VCAVITY, VCAVITY_VALID, beckmann_vcavity_valid)

#endif
