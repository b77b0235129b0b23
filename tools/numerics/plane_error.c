/* tools/numerics/plane_error.c: the worst difference between a draw above two planes in float and the same
 * draw in double, with the input that causes it, over random inputs.
 *
 *     cc -O2 -ffp-contract=off -I. -Iinclude tools/numerics/plane_error.c \
 *         tools/numerics/plane_double.c build/liblobe.a -lm -o plane_error && ./plane_error
 *
 * Roughness 0.05 to 2, wi down to 120 degrees from the normal, tilts to 60 degrees, wi at least 0.01 above
 * the plane, u2 up to 0.98. "direction" is |wo - wo'|, "density" the relative error of pdf against double
 * at the normal that was drawn. The figures stand at the foot of the kernel files. */
#include "kernel/bind/c_f32.h"

#include "plane_double.h"

#include "kernel/ggx_horizon_plane_ellipse.h"
#include "kernel/ggx_horizon_plane_table.h"
#include "kernel/ggx_horizon_plane_uniform.h"
#include "lobe/random.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static float unit(uint64_t k, uint64_t stream, int word) {
    return lobe_random_unit_f32(lobe_random(9, stream, k).word[word]);
}

static void direction_at(double z, double turn, float out[3]) {
    double s = sqrt(1 - z * z);
    out[0] = (float)(s * cos(6.283185307179586 * turn));
    out[1] = (float)(s * sin(6.283185307179586 * turn));
    out[2] = (float)z;
}

static plane_input input_at(uint64_t k) {
    plane_input i;
    direction_at(1 - 1.5 * (double)unit(k, 0, 0), (double)unit(k, 0, 1), i.wi);
    direction_at(1 - 0.5 * (double)unit(k, 0, 2), (double)unit(k, 0, 3), i.plane);
    i.alpha_x = 0.05f * powf(40.0f, unit(k, 1, 0));
    i.alpha_y = k % 4 == 0 ? i.alpha_x : 0.05f * powf(40.0f, unit(k, 1, 1));
    i.u1 = unit(k, 1, 2);
    i.u2 = 0.98f * unit(k, 1, 3);
    i.u3 = unit(k, 2, 0);
    i.floor_share = 0.125f * (float)(k % 9);
    return i;
}

static v3 v3_from(const float x[3]) {
    return v3_of(x[0], x[1], x[2]);
}

static facet_draw draw_of(plane_sampler sampler, const plane_input *i) {
    facet_options options = facet_options_of(false, false);
    options.plane = v3_from(i->plane);
    options.floor_share = i->floor_share;
    ggx_base g = ggx_base_of(v3_from(i->wi), i->alpha_x, i->alpha_y, options);
    real u1 = i->u1, u2 = i->u2, u3 = i->u3;
    if (sampler == PLANE_UNIFORM)
        return ggx_horizon_plane_uniform_draw(ggx_horizon_plane_uniform_prepare(g), u1, u2, u3);
    return sampler == PLANE_TABLE
               ? ggx_horizon_plane_table_draw(ggx_horizon_plane_table_prepare(g), u1, u2, u3)
               : ggx_horizon_plane_ellipse_draw(ggx_horizon_plane_ellipse_prepare(g), u1, u2, u3);
}

typedef struct worst {
    double error;
    plane_input at;
} worst;

static void keep(worst *w, double error, const plane_input *i) {
    if (error > w->error) *w = (worst){error, *i};
}

static void print(const char *name, const char *what, const worst *w) {
    const plane_input *i = &w->at;
    printf("%s %s: %.2g at wi (%a, %a, %a), plane (%a, %a, %a), alpha (%a, %a), u (%a, %a, %a), "
           "floor %g\n",
           name, what, w->error, (double)i->wi[0], (double)i->wi[1], (double)i->wi[2],
           (double)i->plane[0], (double)i->plane[1], (double)i->plane[2], (double)i->alpha_x,
           (double)i->alpha_y, (double)i->u1, (double)i->u2, (double)i->u3, (double)i->floor_share);
}

static int descending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

int main(int argc, char **argv) {
    uint64_t draws = argc > 1 ? strtoull(argv[1], NULL, 10) : 2000000;
    double *errors = malloc(2 * draws * sizeof *errors);
    if (!errors) return 1;
    for (plane_sampler sampler = 0; sampler < PLANE_SAMPLERS; ++sampler) {
        worst direction = {0}, density = {0};
        uint64_t count = 0, chosen = 0;
        for (uint64_t k = 0; k < draws; ++k) {
            plane_input i = input_at(k);
            if (v3_dot(v3_from(i.wi), v3_from(i.plane)) < 0.01f) continue;
            facet_draw a = draw_of(sampler, &i);
            plane_output b = plane_draw_double(sampler, &i);
            if (!(a.pdf > 0) || !(b.pdf > 0)) continue;
            double off = hypot(hypot((double)a.wo.x - b.wo[0], (double)a.wo.y - b.wo[1]),
                               (double)a.wo.z - b.wo[2]);
            double m[3] = {(double)a.m.x, (double)a.m.y, (double)a.m.z};
            double exact = plane_pdf_double(sampler, &i, m);
            if (!(exact > 0)) continue;
            if (sampler != PLANE_TABLE && off > 0.01) {
                /* u3 within rounding of the choice between y and -y, or the ellipses of each other */
                ++chosen;
                continue;
            }
            keep(&direction, off, &i);
            keep(&density, fabs((double)a.pdf / exact - 1), &i);
            errors[count] = off;
            errors[draws + count++] = fabs((double)a.pdf / exact - 1);
        }
        const char *name = (const char *[]){"table", "ellipse", "uniform"}[sampler];
        print(name, "direction", &direction);
        print(name, "density", &density);
        qsort(errors, count, sizeof *errors, descending);
        qsort(errors + draws, count, sizeof *errors, descending);
        printf("%s: %llu draws, %llu chosen; one in 1000 above %.2g, %.2g\n", name,
               (unsigned long long)count, (unsigned long long)chosen, errors[count / 1000],
               errors[draws + count / 1000]);
    }
    free(errors);
    return 0;
}
