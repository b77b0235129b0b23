#include "../kernel/bind/c_f32.h"

#include "dielectric_axes.h"
#include "dielectric_energy.h"

static const lobe_energy_table TABLE = {
#include "dielectric_energy.inc"
};

/* Of four roughnesses at each of four cosines, in one row. */
static float face(const int16_t alphas[LOBE_ENERGY_ALPHAS][LOBE_ENERGY_COSINES],
                  albedo_stencil alpha, albedo_stencil cosine) {
    float along[4];
    for (int k = 0; k < 4; ++k) {
        const int16_t *v = &alphas[(int)alpha.first + k][(int)cosine.first];
        along[k] = albedo_mix(cosine, (float)v[0], (float)v[1], (float)v[2], (float)v[3]);
    }
    return albedo_mix(alpha, along[0], along[1], along[2], along[3]);
}

float lobe_dielectric_energy(float cosine, float alpha, float eta, int separable) {
    const float a = k_min(k_max(alpha, LOBE_ENERGY_LEAST_ALPHA), 1.0f), c = k_saturate(cosine);
    const float s = k_sqrt(k_saturate(0.5f * (k_max(eta, 1.0f / eta) - 1.0f)));
    const float shift = energy_shift(s, a);
    const albedo_stencil row =
        albedo_stencil_of(energy_axis(s, energy_row_scale(a)), LOBE_ENERGY_INDICES);
    const albedo_stencil column = albedo_stencil_of(energy_axis(c, shift), LOBE_ENERGY_COSINES);
    const albedo_stencil rough = albedo_stencil_of(k_sqrt(a), LOBE_ENERGY_ALPHAS);
    float rows[4];
    for (int k = 0; k < 4; ++k)
        rows[k] = face(TABLE[separable != 0][eta < 1.0f][(int)row.first + k], rough, column);
    const float kept = albedo_mix(row, rows[0], rows[1], rows[2], rows[3]);
    return k_min(energy_base(c, shift, a) * k_exp(LOBE_ENERGY_STEP * kept), 1.0f);
}
