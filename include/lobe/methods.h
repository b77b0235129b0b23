/* lobe/methods.h: the list of sampling methods for Smith-GGX reflection. One row a method:
 *
 *     X(IDENTIFIER, name, "name on the command line", "what it is, and its source")
 *
 * `name` is also the name of the kernel: kernel/ggx_<name>.h. */
#ifndef LOBE_METHODS_H
#define LOBE_METHODS_H

#define LOBE_GGX_METHODS(X)                                                                        \
    X(NDF, ndf, "ndf", "all normals, D cos (Walter et al. 2007)")                                  \
    X(SLOPE_PUBLISHED, slope_published, "slope-published",                                         \
      "visible slopes with the printed rational fit (Heitz & d'Eon 2014); fails chi^2 tests")      \
    X(SLOPE, slope, "slope", "visible slopes, every inversion exact (after Heitz & d'Eon 2014)")   \
    X(ELLIPSOID, ellipsoid, "ellipsoid", "projected ellipsoid (Heitz 2018)")                       \
    X(CAPS, caps, "caps", "spherical caps (Dupuy & Benyoub 2023)")                                 \
    X(BOUNDED, bounded, "bounded", "bounded caps (Eto & Tokuyoshi 2023, 2024)")                    \
    X(OPTIMAL, optimal, "optimal", "smallest cap of any axis (docs/optimal-caps.md)")

#endif
