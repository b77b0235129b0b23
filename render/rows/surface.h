/* The surface of material.h as a text of the kernel's language: a GGX of metal and coat over a base. Every step is that
 * of material.c, in its order, so that the bits are the same. */
#ifndef LOBE_RENDER_ROWS_SURFACE_H
#define LOBE_RENDER_ROWS_SURFACE_H

#include "../../kernel/bind/c_f32.h"

#include "../../kernel/facet.h"
#include "../../kernel/fresnel.h"

#include "../circle.h"
#include "rows.h"

K_STRUCT(row_frame) {
    v3 x;
    v3 y;
    v3 z;
};

K_FN v3 row_to_local(row_frame f, v3 a) {
    return v3_of(v3_dot(a, f.x), v3_dot(a, f.y), v3_dot(a, f.z));
}

K_FN v3 row_to_world(row_frame f, v3 a) {
    return v3_combine(f.x, a.x, f.y, a.y, f.z, a.z);
}

/* What of a surface its lobes share. `has_base` is known where the text is compiled: without it metallic is 1. */
K_STRUCT(row_surface) {
    row_frame frame;
    v3 geometric;
    v3 base_color;
    real metallic;
    real ior;
    const real *albedo; /* the tables of coat_table.h */
    const real *average;
    real coat;         /* how much of its reflection it keeps */
    real roughness;    /* of the coat: perceptual, */
    real coat_row;     /* and where it lies in the table */
    real base_share_i; /* as in material.h */
    real specular;     /* likewise */
};

K_STRUCT(row_value) {
    real f_cos;
    real pdf;
    real cos_im;
};

K_FN bool row_leaves(row_surface s, v3 wo, v3 direction) {
    return k_and(wo.z > R(0.0), v3_dot(direction, s.geometric) > R(0.0));
}

K_FN real row_schlick(real f0, real white) {
    return f0 * (R(1.0) - white) + R(1.0) * white;
}

K_FN v3 row_metal(row_surface s, real cosine) {
    real white = fresnel_schlick(R(0.0), cosine);
    return v3_of(row_schlick(s.base_color.x, white), row_schlick(s.base_color.y, white),
                 row_schlick(s.base_color.z, white));
}

K_FN v3 row_fresnel(row_surface s, real cosine, bool has_base) {
    v3 metal = row_metal(s, cosine);
    if (!has_base) return metal;
    real dielectric = s.coat * fresnel_dielectric(s.ior, cosine);
    real coat = k_max(dielectric * (R(1.0) - s.metallic), R(0.0));
    v3 both = v3_add(v3_scale(metal, s.metallic), v3_of(coat, coat, coat));
    return v3_select(s.metallic > R(0.0), both, v3_of(coat, coat, coat));
}

K_FN real row_coat_albedo(row_surface s, v3 w) {
    return clampf(s.coat * coat_round_albedo(s.albedo, s.coat_row, s.roughness, w.z), R(0.0),
                  R(1.0));
}

K_FN real row_luminance(v3 a) {
    return R(0.2126) * a.x + R(0.7152) * a.y + R(0.0722) * a.z;
}

/* The base below the coat, and how often it is drawn. */
K_FN void row_add_base(row_surface *s, real alpha_x, real alpha_y, v3 wi) {
    s->roughness = k_sqrt(k_max(alpha_x, alpha_y));
    s->coat_row = coat_row_of(k_sqrt(R(0.5) * (alpha_x + alpha_y)));
    real coat_i = row_coat_albedo(*s, wi);
    real average = clampf(s->coat * coat_round_average(s->average, s->coat_row), R(0.0), R(0.9999));
    real rest = R(1.0) - s->metallic;
    s->base_share_i = rest * (R(1.0) - coat_i) / (LOBE_PI * (R(1.0) - average));
    real luminance = row_luminance(s->base_color);
    real specular = s->metallic * luminance + rest * coat_i;
    real diffuse = rest * luminance * (R(1.0) - coat_i);
    real share = clampf(specular / k_max(specular + diffuse, R(1e-6)), R(0.1), R(1.0));
    bool is_bare = k_and(!(specular > R(0.0)), diffuse > R(0.0));
    s->specular = k_select(is_bare, R(0.0), share);
}

/* All lobes, and the density of drawing any of them. */
K_FN v3 row_value_of(row_surface s, v3 wo, row_value ggx, bool has_base, real *pdf) {
    v3 value = v3_scale(row_fresnel(s, ggx.cos_im, has_base), ggx.f_cos);
    *pdf = s.specular * ggx.pdf + (R(1.0) - s.specular) * wo.z / LOBE_PI;
    if (!has_base) return value;
    real share = s.base_share_i * (R(1.0) - row_coat_albedo(s, wo)) * wo.z;
    return v3_select(s.base_share_i > R(0.0), v3_add(value, v3_scale(s.base_color, share)), value);
}

/* A direction of a cosine's density. */
K_FN v3 row_draw_base(real u1, real u2) {
    real radius = k_sqrt(u1);
    real sine;
    real cosine;
    circle_at(u2, &sine, &cosine);
    return v3_of(radius * cosine, radius * sine, k_sqrt(R(1.0) - u1));
}

#endif
