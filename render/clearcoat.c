#include "clearcoat.h"

#include "lobe/fresnel.h"

clearcoat lobe_clearcoat_at(const lobe_reflection_options *ggx, const coat_table *table,
                            frame shading, vec3 geometric, vec3 to_viewer, float share,
                            float roughness, float below) {
    clearcoat c = {.frame = shading, .geometric = geometric, .share = share};
    const lobe_vec3_f32 wi = frame_to_local(&shading, to_viewer);
    const float alpha = roughness * roughness;
    lobe_reflection_prepare_at_f32(&c.ggx, ggx, wi, alpha, alpha,
                                   frame_to_local(&shading, geometric));
    const coat at = lobe_coat_at(table, &c.ggx);
    const float reflects = share * lobe_coat_albedo(&at, wi);
    c.keeps = 1.0f - reflects;
    c.probability = c.ggx.is_valid
                        ? clampf(reflects / maxf(reflects + c.keeps * below, 1e-6f), 0.1f, 0.9f)
                        : 0.0f;
    return c;
}

static float fresnel(const clearcoat *c, float cosine) {
    return c->share * lobe_fresnel_dielectric_f32(COAT_IOR, cosine);
}

clearcoat_draw lobe_clearcoat_draw(const clearcoat *c, float u1, float u2, float u3) {
    const lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(&c->ggx, u1, u2, u3);
    return (clearcoat_draw){frame_to_world(&c->frame, d.wo), d.weight * fresnel(c, d.cos_im),
                            d.pdf};
}

float lobe_clearcoat_value(const clearcoat *c, vec3 direction, float *pdf) {
    *pdf = 0.0f;
    const vec3 wo = frame_to_local(&c->frame, direction);
    if (!(wo.z > 0.0f && v3_dot(direction, c->geometric) > 0.0f)) return 0.0f;
    const lobe_reflection_eval_f32 e = lobe_reflection_eval_wo_f32(&c->ggx, wo);
    *pdf = e.pdf;
    return e.f_cos * fresnel(c, e.cos_im);
}
