/* The white furnace of the draws, how many were rejected, and what quadrature says. */
#include "page.h"

#include <math.h>

EXPORT(furnace) void page_furnace(int method, int count);
/* page_result: mean weight, its standard error, share of rejected draws, its standard error, variance of the
 * weight. The errors are those of independent numbers; Sobol's and stratified ones do better. */
void page_furnace(int method, int count) {
    const rows *r = &page_rows[method];
    double sum = 0, squares = 0;
    int rejected = 0;
    for (int i = 0; i < count; ++i) {
        const double w = (double)r->weight[i];
        sum += w;
        squares += w * w;
        rejected += !(r->pdf[i] > 0);
    }
    const double n = count, mean = sum / n, share = rejected / n;
    const double spread = squares - n * mean * mean;
    const double variance = n > 1 && spread > 0 ? spread / (n - 1) : 0;
    page_result[0] = mean;
    page_result[1] = sqrt(variance / n);
    page_result[2] = share;
    page_result[3] = sqrt(share * (1 - share) / n);
    page_result[4] = variance;
}

EXPORT(albedo) double page_albedo(void);
/* The integral of f cos over the directions above both planes, by quadrature; NaN where the surface is
 * not seen. */
double page_albedo(void) {
    const scene *s = &page_scene[0];
    const lobe_microsurface surface = {s->options.model.ndf, s->options.model.masking,
                                       LOBE_G2_CORRELATED, (double)s->alpha[0],
                                       (double)s->alpha[1]};
    const lobe_vec3_f64 wi = {(double)s->wi.x, (double)s->wi.y, (double)s->wi.z};
    const lobe_vec3_f64 plane = {(double)s->plane.x, (double)s->plane.y, (double)s->plane.z};
    const double wi_length = sqrt(wi.x * wi.x + wi.y * wi.y + wi.z * wi.z);
    const double plane_length = sqrt(plane.x * plane.x + plane.y * plane.y + plane.z * plane.z);
    const lobe_vec3_f64 i = {wi.x / wi_length, wi.y / wi_length, wi.z / wi_length};
    const lobe_vec3_f64 g = {plane.x / plane_length, plane.y / plane_length,
                             plane.z / plane_length};
    return lobe_albedo_above(surface, lobe_reflectance_one(), i, g, LOBE_EFFORT_MEDIUM);
}
