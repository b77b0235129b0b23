/* tools/numerics/metal_table.c: the table of named metals of docs/multiple-scattering.md.
 *
 *     cc -O2 -Iinclude tools/numerics/metal_table.c render/metal_names.c build/liblobe.a -lm -o metal_table
 *
 * By metal and channel: F straight ahead and at mu = 1/7, its average and Schlick's, the tint that makes F82 meet
 * F at 1/7, and the largest error of Schlick's F and of F82 over all angles. */
#include <lobe/lobe.h>
#include <lobe/render.h>

#include <math.h>
#include <stdio.h>

static const double at_82 = 1.0 / 7.0;

static void print_channels(const double values[3]) {
    printf(" %.3f %.3f %.3f |", values[0], values[1], values[2]);
}

static void print_metal(const char *name, const lobe_metal *m) {
    double ahead[3], grazing[3], average[3], schlick[3], tint[3], by_schlick = 0, by_f82 = 0;
    for (int c = 0; c < 3; c++) {
        const double n = (double)m->n[c], k = (double)m->k[c];
        ahead[c] = lobe_fresnel_conductor_f64(n, k, 1);
        grazing[c] = lobe_fresnel_conductor_f64(n, k, at_82);
        average[c] = lobe_reflectance_average((lobe_reflectance){LOBE_REFLECTANCE_CONDUCTOR, n, k});
        schlick[c] = lobe_fresnel_schlick_average_f64(ahead[c]);
        tint[c] = fmin(grazing[c] / lobe_fresnel_schlick_f64(ahead[c], at_82), 1);
        for (int i = 0; i <= 256; i++) {
            const double mu = i / 256.0, f = lobe_fresnel_conductor_f64(n, k, mu);
            by_schlick = fmax(by_schlick, fabs(lobe_fresnel_schlick_f64(ahead[c], mu) - f));
            by_f82 = fmax(by_f82, fabs(lobe_fresnel_f82_f64(ahead[c], tint[c], mu) - f));
        }
    }
    printf("| %s |", name);
    print_channels(ahead);
    print_channels(grazing);
    print_channels(average);
    print_channels(schlick);
    print_channels(tint);
    printf(" %.3f | %.3f |\n", by_schlick, by_f82);
}

int main(void) {
    lobe_metal metal;
    for (size_t i = 0; lobe_metal_name(i); i++)
        if (lobe_metal_from_name(lobe_metal_name(i), &metal))
            print_metal(lobe_metal_name(i), &metal);
    return 0;
}
