/* ggx_without_g1.c: the density of visible normals without their masking: D wi.m / wi.z. */
#define GGX_NAME "ggx_without_g1"
#define GGX_G1_OF_DENSITY 1

#include "ggx.c"
