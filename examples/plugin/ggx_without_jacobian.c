/* ggx_without_jacobian.c: the density of the normal returned as the density of the direction: the
 * factor 1/(4 wi.m) is missing. */
#define GGX_NAME "ggx_without_jacobian"
#define GGX_JACOBIAN(im) 1

#include "ggx.c"
