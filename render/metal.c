#include "metal.h"

#include "lobe/fresnel.h"

static int lie_in(const float v[3], float least, float most) {
    for (int c = 0; c < 3; c++)
        if (!(v[c] >= least && v[c] <= most)) return 0;
    return 1;
}

int lobe_metal_is_usable(const lobe_metal *law) {
    switch (law->law) {
    case LOBE_METAL_SCHLICK:
        return 1;
    case LOBE_METAL_F82:
        return lie_in(law->tint, 0.0f, 1.0f);
    case LOBE_METAL_CONDUCTOR:
        return lie_in(law->n, LOBE_METAL_N_MIN, LOBE_METAL_INDEX_MAX) &&
               lie_in(law->k, 0.0f, LOBE_METAL_INDEX_MAX);
    }
    return 0;
}

static lobe_metal_law law_of(const metal *m) {
    return m ? m->law.law : LOBE_METAL_SCHLICK;
}

static lobe_reflectance conductor(const lobe_metal *law, int channel) {
    return (lobe_reflectance){LOBE_REFLECTANCE_CONDUCTOR, (double)law->n[channel],
                              (double)law->k[channel]};
}

metal lobe_metal_prepare(const lobe_metal *law) {
    metal m = {.law = *law};
    if (law->law != LOBE_METAL_CONDUCTOR) return m;
    float f0[3], average[3];
    for (int c = 0; c < 3; c++) {
        const lobe_reflectance f = conductor(law, c);
        f0[c] = (float)lobe_reflectance_at(f, 1.0);
        average[c] = (float)lobe_reflectance_average(f);
    }
    m.f0 = v3(f0[0], f0[1], f0[2]);
    m.average = v3(average[0], average[1], average[2]);
    return m;
}

vec3 lobe_metal_f0(const metal *m, vec3 base_color) {
    return law_of(m) == LOBE_METAL_CONDUCTOR ? m->f0 : base_color;
}

static vec3 schlick_at(vec3 f0, float cosine) {
    /* of a black metal: what every colour has of white */
    const float white = lobe_fresnel_schlick_f32(0.0f, cosine);
    return v3_lerp(f0, v3_all(1.0f), white);
}

vec3 lobe_metal_at(const metal *m, vec3 base_color, float cosine) {
    if (law_of(m) == LOBE_METAL_SCHLICK) return schlick_at(base_color, cosine);
    const lobe_metal *l = &m->law;
    if (l->law == LOBE_METAL_F82)
        return v3(lobe_fresnel_f82_f32(base_color.x, l->tint[0], cosine),
                  lobe_fresnel_f82_f32(base_color.y, l->tint[1], cosine),
                  lobe_fresnel_f82_f32(base_color.z, l->tint[2], cosine));
    return v3(lobe_fresnel_conductor_f32(l->n[0], l->k[0], cosine),
              lobe_fresnel_conductor_f32(l->n[1], l->k[1], cosine),
              lobe_fresnel_conductor_f32(l->n[2], l->k[2], cosine));
}

vec3 lobe_metal_average(const metal *m, vec3 base_color) {
    switch (law_of(m)) {
    case LOBE_METAL_CONDUCTOR:
        return m->average;
    case LOBE_METAL_F82:
        return v3(lobe_fresnel_f82_average_f32(base_color.x, m->law.tint[0]),
                  lobe_fresnel_f82_average_f32(base_color.y, m->law.tint[1]),
                  lobe_fresnel_f82_average_f32(base_color.z, m->law.tint[2]));
    case LOBE_METAL_SCHLICK:
        break;
    }
    return v3(lobe_fresnel_schlick_average_f32(base_color.x),
              lobe_fresnel_schlick_average_f32(base_color.y),
              lobe_fresnel_schlick_average_f32(base_color.z));
}

void lobe_metal_reflectances(const metal *m, vec3 base_color, lobe_reflectance by_channel[3]) {
    const double f0[] = {(double)base_color.x, (double)base_color.y, (double)base_color.z};
    const lobe_metal_law law = law_of(m);
    for (int c = 0; c < 3; c++) {
        by_channel[c] = (lobe_reflectance){LOBE_REFLECTANCE_SCHLICK, f0[c], 0.0};
        if (law == LOBE_METAL_F82)
            by_channel[c] = (lobe_reflectance){LOBE_REFLECTANCE_F82, f0[c], (double)m->law.tint[c]};
        if (law == LOBE_METAL_CONDUCTOR) by_channel[c] = conductor(&m->law, c);
    }
}
