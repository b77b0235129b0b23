#include "material.h"

static const float COAT_IOR = 1.5f;

/* Albedo of one row and column: the mean of weight times Fresnel over a regular square. */
static float coat_albedo(float roughness, float cosine) {
    enum { SIDE = 16 };
    float alpha = roughness * roughness;
    lobe_vec3_f32 wi = {sqrtf(1.0f - cosine * cosine), 0.0f, cosine};
    lobe_reflection_f32 ggx =
        lobe_reflection_prepare_f32(lobe_reflection_default_options(), wi, alpha, alpha);
    double sum = 0.0;
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            float u1 = ((float)i + 0.5f) / SIDE, u2 = ((float)j + 0.5f) / SIDE;
            lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(&ggx, u1, u2, 0.0f);
            if (d.pdf > 0.0f)
                sum += (double)(d.weight * lobe_fresnel_dielectric_f32(COAT_IOR, d.cos_im));
        }
    return (float)(sum / (SIDE * SIDE));
}

enum { COAT_CELLS = COAT_COLUMNS - 2 };

/* Columns crowd toward grazing directions, where the albedo turns fastest: cosine = t |t|. */
static float column_of(float cosine) {
    float t = copysignf(sqrtf(fminf(fabsf(cosine), 1.0f)), cosine);
    return 0.5f * (t + 1.0f) * COAT_CELLS;
}

static float column_cosine(int column) {
    float t = 2.0f * (float)column / COAT_CELLS - 1.0f;
    return t * fabsf(t);
}

void lobe_coat_table(float table[COAT_ROWS][COAT_COLUMNS]) {
    for (int r = 0; r < COAT_ROWS; r++) {
        float roughness = (float)r / (COAT_ROWS - 1), average = 0.0f;
        for (int c = 0; c <= COAT_CELLS; c++)
            table[r][c] = coat_albedo(roughness, column_cosine(c));
        /* 2 * integral of E mu dmu over the front, by trapezia in mu^2 */
        for (int c = COAT_CELLS / 2; c < COAT_CELLS; c++) {
            float low = column_cosine(c), high = column_cosine(c + 1);
            average += 0.5f * (table[r][c] + table[r][c + 1]) * (high * high - low * low);
        }
        table[r][COAT_COLUMNS - 1] = average;
    }
}

/* The roughness that the Smith model sees along a direction: Lambda depends on nothing else. */
static float roughness_toward(const lobe_reflection_f32 *ggx, vec3 d) {
    float x = ggx->alpha_x * d.x, y = ggx->alpha_y * d.y, plane = d.x * d.x + d.y * d.y;
    float squared = ggx->alpha_x * ggx->alpha_y;
    if (ggx->alpha_x != ggx->alpha_y && plane > 1e-12f) squared = (x * x + y * y) / plane;
    return sqrtf(sqrtf(squared));
}

/* Position on the roughness axis of the table: the lower row and the share of the next. */
static int coat_row(float roughness, float *share) {
    float y = clampf(roughness, 0.0f, 1.0f) * (COAT_ROWS - 1);
    int row = (int)fminf(y, COAT_ROWS - 2);
    *share = y - (float)row;
    return row;
}

static float coat_at(const surface *s, vec3 d) {
    float along, across = column_of(d.z);
    int row = coat_row(roughness_toward(&s->ggx, d), &along);
    int c = (int)fminf(across, COAT_CELLS - 1);
    across -= (float)c;
    const float *low = s->coat[row] + c, *high = s->coat[row + 1] + c;
    float a = low[0] + across * (low[1] - low[0]), b = high[0] + across * (high[1] - high[0]);
    return a + along * (b - a);
}

static float coat_average(const surface *s) {
    float along;
    int row = coat_row(sqrtf(sqrtf(s->ggx.alpha_x * s->ggx.alpha_y)), &along);
    float a = s->coat[row][COAT_COLUMNS - 1], b = s->coat[row + 1][COAT_COLUMNS - 1];
    return a + along * (b - a);
}

static vec3 fresnel(const surface *s, float cosine) {
    float coat = (1.0f - s->metallic) * lobe_fresnel_dielectric_f32(COAT_IOR, cosine);
    vec3 f0 = s->base_color;
    vec3 metal = {lobe_fresnel_schlick_f32(f0.x, cosine), lobe_fresnel_schlick_f32(f0.y, cosine),
                  lobe_fresnel_schlick_f32(f0.z, cosine)};
    return v3_add(v3_scale(metal, s->metallic), v3_all(coat));
}

/* In proportion to what each lobe reflects; neither is starved. */
static float specular_probability(const surface *s, float coat_i) {
    if (s->metallic >= 1.0f) return 1.0f;
    float base = v3_luminance(s->base_color);
    float specular = s->metallic * base + (1.0f - s->metallic) * coat_i;
    float diffuse = (1.0f - s->metallic) * base * (1.0f - coat_i);
    return clampf(specular / fmaxf(specular + diffuse, 1e-6f), 0.1f, 1.0f);
}

surface lobe_surface_at(const surface_options *options, frame shading, vec3 geometric,
                        vec3 to_viewer, vec3 base_color, float metallic, float roughness,
                        float anisotropy) {
    surface s = {
        .frame = shading, .geometric = geometric, .base_color = base_color, .metallic = metallic};
    lobe_vec3_f32 wi = frame_to_local(&shading, to_viewer);
    float alpha = roughness * roughness;
    s.ggx = lobe_reflection_prepare_f32(options->ggx, wi, alpha * (1.0f + anisotropy),
                                        alpha * (1.0f - anisotropy));
    s.coat = options->coat;
    float coat_i = coat_at(&s, wi);
    s.base_share_i = (1.0f - coat_i) / (LOBE_PI * (1.0f - coat_average(&s)));
    s.specular = specular_probability(&s, coat_i);
    return s;
}

vec3 lobe_surface_value(const surface *s, vec3 direction, float *pdf) {
    *pdf = 0.0f;
    vec3 wo = frame_to_local(&s->frame, direction);
    if (!(wo.z > 0.0f) || !(v3_dot(direction, s->geometric) > 0.0f)) return v3_all(0.0f);
    lobe_reflection_eval_f32 e = lobe_reflection_eval_wo_f32(&s->ggx, wo);
    vec3 value = v3_scale(fresnel(s, e.cos_im), e.f_cos);
    *pdf = s->specular * e.pdf + (1.0f - s->specular) * wo.z / LOBE_PI;
    float share = (1.0f - s->metallic) * s->base_share_i * (1.0f - coat_at(s, wo)) * wo.z;
    return v3_add(value, v3_scale(s->base_color, share));
}

static surface_draw rejected(int is_ggx) {
    return (surface_draw){.is_ggx = is_ggx};
}

static surface_draw draw_ggx(const surface *s, float u1, float u2) {
    lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(&s->ggx, u1, u2, 0.0f);
    vec3 direction = frame_to_world(&s->frame, d.wo);
    if (!(d.pdf > 0.0f) || !(v3_dot(direction, s->geometric) > 0.0f)) return rejected(1);
    surface_draw draw = {.direction = direction, .pdf = d.pdf, .is_ggx = 1};
    if (s->ggx.is_mirror || s->specular >= 1.0f) {
        /* the weight of the draw itself: exact, no density is divided out */
        draw.is_mirror = s->ggx.is_mirror;
        draw.weight = v3_scale(fresnel(s, d.cos_im), d.weight / s->specular);
        return draw;
    }
    vec3 value = lobe_surface_value(s, direction, &draw.pdf);
    draw.weight = draw.pdf > 0.0f ? v3_scale(value, 1.0f / draw.pdf) : v3_all(0.0f);
    return draw;
}

static surface_draw draw_base(const surface *s, float u1, float u2) {
    float radius = sqrtf(u1), angle = 2.0f * LOBE_PI * u2;
    vec3 wo = {radius * cosf(angle), radius * sinf(angle), sqrtf(1.0f - u1)};
    surface_draw draw = {.direction = frame_to_world(&s->frame, wo)};
    vec3 value = lobe_surface_value(s, draw.direction, &draw.pdf);
    if (!(draw.pdf > 0.0f)) return rejected(0);
    draw.weight = v3_scale(value, 1.0f / draw.pdf);
    return draw;
}

surface_draw lobe_surface_draw(const surface *s, float choice, float u1, float u2) {
    return choice < s->specular ? draw_ggx(s, u1, u2) : draw_base(s, u1, u2);
}
