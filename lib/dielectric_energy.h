/* lib/dielectric_energy.h: how much light a rough dielectric scatters once, E = E_R + E_T, of the compensated
 * model (shadowing of what is refracted: separable), from a table over cosine, roughness and index.
 *
 * The axes are those of lib/dielectric_axes.h, read cubically. Range: alpha to 1, n to 3; beyond, the ends of
 * the table. Made by tools/numerics/dielectric_energy.c, measured by tools/numerics/dielectric_furnace.c.
 */
#ifndef LOBE_DIELECTRIC_ENERGY_H
#define LOBE_DIELECTRIC_ENERGY_H

/* Cosine to the normal, from 0 on; alpha; eta: far index over near index, seen from the viewer. */
float lobe_dielectric_energy(float cosine, float alpha, float eta, int separable);

/* The factor of unequal roughnesses on that: lib/dielectric_turned.h. wide_share: cos^2 of the azimuth from the
 * wider axis. */
float lobe_dielectric_turned(float cosine, float alpha_wide, float alpha_narrow, float wide_share,
                             float eta, int separable);

#endif
