#include "../kernel/bind/c_f32.h"

#include "dielectric_axes.h"
#include "dielectric_energy.h"
#include "dielectric_turned.h"

static const lobe_turned_table TABLE = {
#include "dielectric_turned.inc"
};

static float mix(albedo_stencil s, const float v[4]) {
    return albedo_mix(s, v[0], v[1], v[2], v[3]);
}

/* Of four azimuths at each of four ratios. */
static float face(const int16_t ratios[LOBE_TURNED_RATIOS - 1][LOBE_TURNED_AZIMUTHS],
                  albedo_stencil ratio, albedo_stencil azimuth) {
    float along[4] = {0};
    for (int k = 0; k < 4 && (int)ratio.first + k < LOBE_TURNED_RATIOS - 1; ++k) {
        const int16_t *v = &ratios[(int)ratio.first + k][(int)azimuth.first];
        along[k] = albedo_mix(azimuth, (float)v[0], (float)v[1], (float)v[2], (float)v[3]);
    }
    return mix(ratio, along);
}

float lobe_dielectric_turned(float cosine, float alpha_wide, float alpha_narrow, float wide_share,
                             float eta, int separable) {
    const float wide = k_min(k_max(alpha_wide, 1e-4f), 1),
                narrow = k_min(k_max(alpha_narrow, 1e-4f), wide);
    const float root_w = k_sqrt(wide), root_n = k_sqrt(narrow);
    const float toward = lobe_turned_toward(wide, narrow, wide_share);
    const float least = LOBE_TURNED_LEAST_ROOT;
    const float index = k_sqrt(k_saturate(0.5f * (k_max(eta, 1 / eta) - 1)));
    const albedo_stencil rows =
        albedo_stencil_of(energy_axis(index, energy_row_scale(toward)), LOBE_TURNED_INDICES);
    const albedo_stencil columns =
        albedo_stencil_of(energy_axis(cosine, energy_shift(index, toward)), LOBE_TURNED_COSINES);
    const albedo_stencil alphas = albedo_stencil_of(root_w, LOBE_TURNED_ALPHAS);
    const albedo_stencil ratio =
        albedo_stencil_of(k_saturate((root_n / root_w - least) / (1 - least)), LOBE_TURNED_RATIOS);
    const albedo_stencil azimuth =
        albedo_stencil_of(lobe_turned_azimuth(wide, narrow, toward), LOBE_TURNED_AZIMUTHS);
    float by_row[4], by_column[4], by_alpha[4];
    for (int i = 0; i < 4; ++i) {
        const int step = (int)rows.first + i;
        const int row = LOBE_TURNED_INDICES - 1 + (eta < 1 ? -step : step);
        for (int j = 0; j < 4; ++j) {
            for (int k = 0; k < 4; ++k)
                by_alpha[k] =
                    face(TABLE[separable != 0][row][(int)columns.first + j][(int)alphas.first + k],
                         ratio, azimuth);
            by_column[j] = mix(alphas, by_alpha);
        }
        by_row[i] = mix(columns, by_column);
    }
    return 1 + LOBE_TURNED_STEP * mix(rows, by_row);
}
