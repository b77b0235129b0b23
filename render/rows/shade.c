/* The loops over shading points. */
#include "surface.h"

#include "../../kernel/ggx_bounded.h"
#include "../../kernel/ggx_caps.h"
#include "../../kernel/ggx_ellipsoid.h"
#include "../../kernel/ggx_horizon.h"
#include "../../kernel/ggx_horizon_plane_uniform.h"
#include "../../kernel/ggx_horizon_uniform.h"
#include "../../kernel/ggx_ndf.h"

/* No row reads what another writes. To clang it is not said: it would warn of every loop that it leaves scalar. */
#if defined(__clang__)
#define INDEPENDENT_ROWS
#else
#define INDEPENDENT_ROWS _Pragma("GCC ivdep")
#endif

K_FN int whole_vectors(int n) {
    return (n + 15) & ~15;
}

K_FN v3 load(float from[3][ROWS], int i) {
    return v3_of(from[0][i], from[1][i], from[2][i]);
}

K_FN void store(float to[3][ROWS], int i, v3 v) {
    to[0][i] = v.x;
    to[1][i] = v.y;
    to[2][i] = v.z;
}

K_FN row_surface surface_at(shade_rows *r, int i, const row_options *o) {
    row_surface s;
    s.frame.x = load(r->x, i);
    s.frame.y = load(r->y, i);
    s.frame.z = load(r->z, i);
    s.geometric = load(r->geometric, i);
    s.base_color = load(r->base_color, i);
    s.metallic = r->metallic[i];
    s.ior = o->ior;
    s.albedo = o->coat_albedo;
    s.average = o->coat_average;
    s.coat = r->coat[i];
    s.roughness = R(0.0);
    s.coat_row = R(0.0);
    s.base_share_i = R(0.0);
    s.specular = R(1.0);
    return s;
}

K_FN facet_options facet_options_at(shade_rows *r, int i, row_frame f, const row_options *o) {
    facet_options options;
    options.plane = row_to_local(f, load(r->geometric, i));
    options.floor_share = o->floor_share;
    options.separable = o->separable;
    options.previous = o->previous;
    return options;
}

K_FN row_value value_if(bool condition, row_value v) {
    v.f_cos = k_select(condition, v.f_cos, R(0.0));
    v.pdf = k_select(condition, v.pdf, R(0.0));
    v.cos_im = k_select(condition, v.cos_im, R(0.0));
    return v;
}

K_FN row_value value_choice(bool first, row_value a, row_value b) {
    row_value v;
    v.f_cos = k_select(first, a.f_cos, b.f_cos);
    v.pdf = k_select(first, a.pdf, b.pdf);
    v.cos_im = k_select(first, a.cos_im, b.cos_im);
    return v;
}

K_FN void store_value(shade_rows *r, int i, bool leaves, v3 value, real pdf) {
    v3 none = v3_of(R(0.0), R(0.0), R(0.0));
    store(r->value, i, v3_select(leaves, value, none));
    r->value_pdf[i] = k_select(leaves, pdf, R(0.0));
}

K_FN void store_draw(shade_rows *r, int i, bool is_drawn, v3 direction, v3 weight, real pdf) {
    v3 none = v3_of(R(0.0), R(0.0), R(0.0));
    store(r->direction, i, v3_select(is_drawn, direction, none));
    store(r->weight, i, v3_select(is_drawn, weight, none));
    r->pdf[i] = k_select(is_drawn, pdf, R(0.0));
}

/* What a kernel makes of a direction. */
#define DEFINE_EVAL(kernel)                                                                        \
    K_FN row_value kernel##_row_value(ggx_base g, kernel s, v3 wo) {                               \
        facet_pair pair = ggx_pair_of_wo(g, wo);                                                   \
        row_value v;                                                                               \
        v.f_cos = ggx_f_cos(g, pair);                                                              \
        v.pdf = k_select(pair.leaves, k_usable(kernel##_pdf(s, pair)), R(0.0));                    \
        v.cos_im = pair.cos_im;                                                                    \
        return value_if(k_is(g.valid), v);                                                         \
    }
ROW_KERNELS(DEFINE_EVAL)
#undef DEFINE_EVAL

/* One point: the value toward the light, then a draw of the GGX or of the base. */
#define DEFINE_ROW(kernel)                                                                         \
    K_FN void kernel##_shade(shade_rows *r, int i, const row_options *o, bool has_base) {          \
        row_surface s = surface_at(r, i, o);                                                       \
        v3 wi = row_to_local(s.frame, load(r->to_viewer, i));                                      \
        ggx_base g =                                                                               \
            ggx_base_of(wi, r->alpha_x[i], r->alpha_y[i], facet_options_at(r, i, s.frame, o));     \
        kernel k = kernel##_prepare(g);                                                            \
        if (has_base) row_add_base(&s, g.ax, g.ay, wi);                                            \
        v3 to_light = load(r->to_light, i);                                                        \
        v3 wl = row_to_local(s.frame, to_light);                                                   \
        real value_pdf;                                                                            \
        v3 value = row_value_of(s, wl, kernel##_row_value(g, k, wl), has_base, &value_pdf);        \
        store_value(r, i, row_leaves(s, wl, to_light), value, value_pdf);                          \
        real choice = r->u[0][i];                                                                  \
        real u1 = r->u[1][i];                                                                      \
        real u2 = r->u[2][i];                                                                      \
        bool is_ggx = choice < s.specular;                                                         \
        facet_draw d = kernel##_draw(k, k_unit(u1), k_unit(u2), k_unit(choice / s.specular));      \
        d = facet_draw_of(d, g.wi, g.plane, k_is(g.valid), false);                                 \
        row_value drawn;                                                                           \
        drawn.f_cos = d.weight * d.pdf;                                                            \
        drawn.pdf = d.pdf;                                                                         \
        drawn.cos_im = d.cos_im;                                                                   \
        v3 wo = d.wo;                                                                              \
        bool is_drawn = d.pdf > R(0.0);                                                            \
        if (has_base) {                                                                            \
            v3 base = row_draw_base(u1, u2);                                                       \
            drawn = value_choice(is_ggx, drawn, kernel##_row_value(g, k, base));                   \
            wo = v3_select(is_ggx, wo, base);                                                      \
            bool leaves = row_leaves(s, wo, row_to_world(s.frame, wo));                            \
            is_drawn = k_and(k_or(!is_ggx, is_drawn), k_or(is_ggx, leaves));                       \
        }                                                                                          \
        real pdf = d.pdf;                                                                          \
        v3 weight = v3_scale(row_fresnel(s, d.cos_im, has_base), d.weight / s.specular);           \
        if (has_base) {                                                                            \
            real all_pdf;                                                                          \
            v3 all = row_value_of(s, wo, drawn, true, &all_pdf);                                   \
            bool is_alone = k_and(is_ggx, s.specular >= R(1.0));                                   \
            weight = v3_select(is_alone, weight, v3_scale(all, R(1.0) / all_pdf));                 \
            pdf = k_select(is_alone, pdf, all_pdf);                                                \
            is_drawn = k_and(is_drawn, pdf > R(0.0));                                              \
        }                                                                                          \
        store_draw(r, i, is_drawn, row_to_world(s.frame, wo), weight, pdf);                        \
        r->is_ggx[i] = k_flag(is_ggx);                                                             \
    }                                                                                              \
    static void kernel##_metal_rows(shade_rows *r, int n, const row_options *o) {                  \
        const row_options options = *o;                                                            \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i)                                  \
            kernel##_shade(r, i, &options, false);                                                 \
    }                                                                                              \
    static void kernel##_coated_rows(shade_rows *r, int n, const row_options *o) {                 \
        const row_options options = *o;                                                            \
        INDEPENDENT_ROWS                                                                           \
        for (int i = 0, whole = whole_vectors(n); i < whole; ++i)                                  \
            kernel##_shade(r, i, &options, true);                                                  \
    }
ROW_KERNELS(DEFINE_ROW)
#undef DEFINE_ROW

static void matte_rows(shade_rows *r, int n, const row_options *o) {
    const row_options options = *o;
    INDEPENDENT_ROWS
    for (int i = 0, whole = whole_vectors(n); i < whole; ++i) {
        row_surface s = surface_at(r, i, &options);
        v3 to_light = load(r->to_light, i);
        v3 wl = row_to_local(s.frame, to_light);
        real value_pdf = wl.z / LOBE_PI;
        store_value(r, i, row_leaves(s, wl, to_light), v3_scale(s.base_color, value_pdf),
                    value_pdf);
        v3 wo = row_draw_base(r->u[1][i], r->u[2][i]);
        v3 direction = row_to_world(s.frame, wo);
        store_draw(r, i, row_leaves(s, wo, direction), direction, s.base_color, wo.z / LOBE_PI);
        r->is_ggx[i] = 0;
    }
}

#define METAL_ROWS(kernel) kernel##_metal_rows,
#define COATED_ROWS(kernel) kernel##_coated_rows,
extern const row_loops ROW_SYMBOL(LOBE_ROW_SET);
const row_loops ROW_SYMBOL(LOBE_ROW_SET) = {{ROW_KERNELS(METAL_ROWS)},
                                            {ROW_KERNELS(COATED_ROWS)},
                                            matte_rows,
                                            FACET_TABLE_TILT_COSINE,
                                            FACET_ELLIPSE_TILT_COSINE};
