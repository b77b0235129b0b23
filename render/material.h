/* Reflection at a point: a GGX coat or metal over a diffuse base (glTF 2.0), as one density.
 *
 * Metal and coat share one GGX: F = metallic * metal (metal.h) + (1 - metallic) * dielectric.
 * The base gets what the coat lets through (Kelemen & Szirmay-Kalos 2001):
 * f = base (1 - E(i)) (1 - E(o)) / (pi (1 - E_avg)), E the albedo of the coat as the table of coat.h
 * has it, in the channel that reflects most, E_avg its exact average. A white dielectric then reflects 1 + (true E - E of the table):
 * all light, and never more, for the table bounds E from above.
 *
 * What transmits is a share of the surface, beside all of this (glass.h). A clear coat lies above all of it
 * (clearcoat.h).
 *
 * What the metal scatters more than once is left out, added as a second lobe (Kulla & Conty 2017), drawn
 * like the base, made up for by a factor (Turquin 2019): lobe/albedo.h; or followed by random walks
 * (Heitz et al. 2016): lobe/walk.h. A walk has no density: in its place stands that of the GGX and of a cosine
 * by what was scattered once and more than once, the same wherever densities are weighed. */
#ifndef LOBE_RENDER_MATERIAL_H
#define LOBE_RENDER_MATERIAL_H

#include "clearcoat.h"
#include "coat.h"
#include "glass.h"
#include "lobe/fresnel.h"
#include "lobe/render.h"
#include "lobe/walk.h"
#include "metal.h"

typedef struct surface {
    frame frame;    /* shading */
    vec3 geometric; /* normal, toward the viewer */
    int is_matte;   /* Lambert's, of base_color; nothing below but walks, glass, clearcoat is set */
    lobe_reflection_f32 ggx; /* wi is in the shading frame */
    vec3 base_color;
    float metallic;
    const metal *metal; /* NULL: Schlick's */
    vec3 f0;            /* of the metal */
    float ior;
    coat coat;
    coat_tint tint;
    float base_share_i;     /* (1 - metallic) (1 - E(i))/(pi (1 - E_avg)); 0: no base */
    lobe_albedo_f32 albedo; /* with F = 1; of the metal's later scatterings and of a tinted coat */
    vec3 rest;              /* colour of the metal's second lobe: its f is rest * (1 - E(o)) */
    vec3 factor;            /* on the metal's first; 0 where it walks */
    float specular;         /* probability of drawing from the GGX */
    float walks;            /* probability of a walk, before all else; 0: the metal does not walk */
    float walk_once;        /* share of the walks that scatter once, roughly */
    uint64_t walk_seed;
    lobe_ndf ndf;
    lobe_masking masking;
    const glass *glass; /* NULL: none; its share is also the probability of drawing from it */
    const clearcoat *clearcoat; /* NULL: none */
} surface;

typedef struct surface_draw {
    vec3 direction; /* world */
    vec3 weight;    /* f cos / pdf */
    float pdf;      /* 0: rejected */
    int is_mirror;
    int is_ggx; /* a GGX draw was made */
} surface_draw;

typedef struct surface_options {
    lobe_reflection_options ggx;
    const coat_table *coat;
    lobe_multiscatter multiscatter;
    coat_tint tint;
    const metal *metal; /* NULL: Schlick's */
} surface_options;

/* The method of a metal or coat: what was asked for. LOBE_METHOD_COUNT is a choice by surface: the least error at equal
 * time over the scenes of docs/horizon-results.md. The coat is a small part of a dielectric's light: the cheapest draw is
 * enough. Sampler and density share what is prepared for it. */
lobe_method lobe_surface_method(lobe_method asked, float metallic, float alpha, float tilt_cosine);

/* `to_viewer`: unit, world, on the front of `geometric`. `random`: of the walks. */
void lobe_surface_make(surface *s, const surface_options *options, frame shading, vec3 geometric,
                       vec3 to_viewer, vec3 base_color, float metallic, float roughness,
                       float anisotropy, uint64_t random);

/* A base alone: as a metallic of 0 and a tint of nothing make it, at a small part of the price. */
void lobe_surface_make_matte(surface *s, frame shading, vec3 geometric, vec3 base_color);

/* Puts glass in place of a share of a surface; what was there stays as the rest. It is kept in `room`,
 * which few surfaces need and all would pay for. */
void lobe_surface_add_glass(surface *s, glass *room, const surface_options *options,
                            glass_material material, vec3 to_viewer, int is_back);

/* Puts a clear coat above all of it, kept in `room`. `table` is that of COAT_IOR. */
void lobe_surface_add_clearcoat(surface *s, clearcoat *room, const surface_options *options,
                                const coat_table *table, frame shading, vec3 to_viewer, float share,
                                float roughness);

/* `side` is read by glass only: reflected or transmitted. */
surface_draw lobe_surface_draw(const surface *s, float choice, float u1, float u2, float side);

/* f cos and density at a direction; 0 of point masses, and of opaque surfaces below either surface. Of a
 * metal that walks an estimate, the same at each call. */
vec3 lobe_surface_value(const surface *s, vec3 direction, float *pdf);

/* Nothing but point masses: no lamp can be drawn for it. */
int lobe_surface_is_clear(const surface *s);

#endif
