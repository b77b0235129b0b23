/* lib/dielectric_energy.h: how much light a rough dielectric scatters once, E = E_R + E_T, of the compensated
 * model (shadowing of what is refracted: separable), from a table over cosine, roughness and index.
 *
 * Everything is measured against the roughness, in which the lobes scale: with s = sqrt((n - 1)/2), n the
 * larger index over the smaller one, the axes are
 *     c (1 + alpha)/(c + alpha),  s (1 + alpha)/(s + alpha),  sqrt(alpha)
 * Range: alpha to 1, n to 3; beyond, the ends of the table. Made by tools/numerics/dielectric_energy.c,
 * which also measures it: |E/table - 1| <= 0.0095 for n >= 1.1 and any cosine from 0.001 on, and 0.0079 for
 * any n where the cosine is at least 0.1. For n below 1.1 nearer to the horizon E itself goes to 0, and the
 * error reaches 0.48 at cosine 0.001.
 */
#ifndef LOBE_DIELECTRIC_ENERGY_H
#define LOBE_DIELECTRIC_ENERGY_H

enum { LOBE_ENERGY_COSINES = 32, LOBE_ENERGY_ALPHAS = 16, LOBE_ENERGY_INDICES = 16 };

/* Cosine to the normal, from 0 on; alpha; eta: far index over near index, seen from the viewer. */
float lobe_dielectric_energy(float cosine, float alpha, float eta, int separable);

/* The factor of unequal roughnesses on that: lib/dielectric_turned.h. wide_share: cos^2 of the azimuth from the
 * wider axis. */
float lobe_dielectric_turned(float cosine, float alpha_wide, float alpha_narrow, float wide_share,
                             float eta, int separable);

#endif
