/* Vectors, and the stretched space in which GGX is a hemisphere (Heitz 2018). */
#ifndef LOBE_FIGURE_GEOMETRY_H
#define LOBE_FIGURE_GEOMETRY_H

#include <lobe/reflection.h>

#define FIGURE_PI 3.14159265358979323846

typedef lobe_vec3_f64 vec3;

/* A surface seen from somewhere. */
typedef struct view {
    vec3 wi; /* unit */
    double alpha[2];
} view;

double lobe_dot3(vec3 a, vec3 b);
vec3 lobe_cross3(vec3 a, vec3 b);
vec3 lobe_unit3(vec3 a);
vec3 lobe_mix3(double s, vec3 a, double t, vec3 b);

/* Degrees, from the normal and around it. */
vec3 lobe_direction(double theta, double phi);

vec3 lobe_stretched_wi(view v);           /* î */
vec3 lobe_stretched_m(view v, vec3 m);    /* m̂ */
vec3 lobe_stretched_wo(view v, vec3 m);   /* ô: î reflected about m̂ */
vec3 lobe_half(vec3 wi, vec3 wo);         /* m */
vec3 lobe_grazing_wo(view v, double phi); /* ô of the direction in the horizon at phi degrees */

/* Two directions across `axis`: the first horizontal. */
void lobe_frame_across(vec3 axis, vec3 *t1, vec3 *t2);

/* Where the reflections of a method lie: a . ô >= height. */
typedef struct cap {
    vec3 axis;
    double height;
} cap;

/* The prepared model of Smith-GGX. */
lobe_reflection_f64 lobe_ggx_model(view v, lobe_method method);

/* Of caps, bounded, optimal: read off the draws and the density of the library. */
cap lobe_cap_of(view v, lobe_method method);

/* Points of the rim of a cap; phi in degrees around its axis. */
vec3 lobe_cap_rim(cap k, double phi);

#endif
