/* lobe/fresnel.h: Fresnel reflectances and their averages.
 *
 * `cos_i` is the cosine between the direction and the microfacet normal, clamped to [0, 1]. Every
 * result lies in [0, 1] for inputs in their range. An average is 2 * integral of F(mu) mu dmu over
 * [0, 1], in closed form but for conductors. */
#ifndef LOBE_FRESNEL_H
#define LOBE_FRESNEL_H

#include "types.h"

LOBE_BEGIN_C

/* Schlick 1994: f0 + (1 - f0)(1 - cos_i)^5. f0 in [0, 1]. Average f0 + (1 - f0)/21. */
LOBE_API float lobe_fresnel_schlick_f32(float f0, float cos_i);
LOBE_API double lobe_fresnel_schlick_f64(double f0, double cos_i);
LOBE_API float lobe_fresnel_schlick_average_f32(float f0);
LOBE_API double lobe_fresnel_schlick_average_f64(double f0);

/* Schlick with a chosen reflectance near 82 degrees (Kutz et al. 2021, OpenPBR): at cos_i = 1/7 it is
 * `tint` times Schlick's value there. f0 and tint in [0, 1]. Below a tint of 0.52 F may reach 0 over a range of
 * angles, which the average does not know: it is too small by up to 9e-4 for f0 from 0.4, 8e-3 from 0.1, 0.017. */
LOBE_API float lobe_fresnel_f82_f32(float f0, float tint, float cos_i);
LOBE_API double lobe_fresnel_f82_f64(double f0, double tint, double cos_i);
LOBE_API float lobe_fresnel_f82_average_f32(float f0, float tint);
LOBE_API double lobe_fresnel_f82_average_f64(double f0, double tint);

/* Exact, unpolarised, dielectric. ior > 0: index of the far side over the index of the near side;
 * below 1 there is total internal reflection. */
LOBE_API float lobe_fresnel_dielectric_f32(float ior, float cos_i);
LOBE_API double lobe_fresnel_dielectric_f64(double ior, double cos_i);
LOBE_API float lobe_fresnel_dielectric_average_f32(float ior);
LOBE_API double lobe_fresnel_dielectric_average_f64(double ior);

/* Exact, unpolarised, conductor of index n + i k (n > 0, k >= 0). The average is a weighted sum of twelve values:
 * within 1e-6 for k from 0.5 or n from 1.2, both up to 1000; of neither (no metal in visible light) within 0.06.
 * lobe_reflectance_average (lobe/albedo.h) has more digits. */
LOBE_API float lobe_fresnel_conductor_f32(float n, float k, float cos_i);
LOBE_API double lobe_fresnel_conductor_f64(double n, double k, double cos_i);
LOBE_API float lobe_fresnel_conductor_average_f32(float n, float k);
LOBE_API double lobe_fresnel_conductor_average_f64(double n, double k);

LOBE_END_C

#endif
