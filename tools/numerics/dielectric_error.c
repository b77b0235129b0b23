/* tools/numerics/dielectric_error.c: the worst difference between a rough dielectric in float and in
 * double, with the input that causes it, over random inputs.
 *
 *     cc -O2 -ffp-contract=off -I. -Iinclude tools/numerics/dielectric_error.c build/liblobe.a -lm \
 *         -o dielectric_error && ./dielectric_error
 *
 * Roughness 0.01 to 1, index 1.1 to 2.5, u2 up to 0.98, both sides, cosine of wi at least 0.01.
 * "direction" is |wo - wo'| of draws that make the same choice; "density" the error of pdf against
 * double at the direction drawn in float, in units of what rounding that direction by half an ulp of
 * 1 does to it; "beta" the relative error of (1 + a) B(1 + a, 1 + b), a and b from 1e-4 to 1e7, where it is
 * at least 1e-6. The figures stand at the foot of kernel/ggx_dielectric.h and dielectric_masking.h. */
#include "kernel/bind/c_f32.h"

#include "kernel/dielectric_masking.h"

#include <lobe/lobe.h>

#include <float.h>
#include <math.h>
#include <stdio.h>

enum { DRAWS = 2000000 };

typedef struct input {
    lobe_vec3_f32 wi;
    float alpha_x, alpha_y, ior, u1, u2, u3;
} input;

static float unit(lobe_random4 r, int word) {
    return lobe_random_unit_f32(r.word[word]);
}

static input input_at(uint64_t k) {
    lobe_random4 a = lobe_random(19, 0, k), b = lobe_random(19, 1, k);
    float z = 0.01f + 0.99f * unit(a, 0), turn = 6.2831853f * unit(a, 1);
    float s = sqrtf((1 - z) * (1 + z));
    input i = {
        {s * cosf(turn), s * sinf(turn), k & 1 ? -z : z}, powf(100, unit(a, 2) - 1), 0, 0, 0, 0, 0};
    i.alpha_y = k % 4 < 2 ? i.alpha_x : powf(100, unit(a, 3) - 1);
    i.ior = 1.1f + 1.4f * unit(b, 3);
    i.u1 = unit(b, 0);
    i.u2 = 0.98f * unit(b, 1);
    i.u3 = unit(b, 2);
    return i;
}

typedef struct worst {
    double error;
    input at;
} worst;

static void keep(worst *w, double error, const input *i) {
    if (error > w->error) *w = (worst){error, *i};
}

static lobe_vec3_f64 widen(lobe_vec3_f32 v) {
    return (lobe_vec3_f64){v.x, v.y, v.z};
}

/* What moving each component of wo by half an ulp of 1 adds up to. */
static double rounding_of(const lobe_dielectric_f64 *model, lobe_vec3_f64 wo) {
    double here = lobe_dielectric_pdf_f64(model, wo), sum = FLT_EPSILON / 2 * here;
    for (int k = 0; k < 6; ++k) {
        double step = k & 1 ? -FLT_EPSILON / 2 : FLT_EPSILON / 2;
        lobe_vec3_f64 v = {wo.x + (k / 2 == 0) * step, wo.y + (k / 2 == 1) * step,
                           wo.z + (k / 2 == 2) * step};
        sum += fabs(lobe_dielectric_pdf_f64(model, v) - here) / 2;
    }
    return sum;
}

static void compare(const input *i, worst w[2]) {
    lobe_dielectric_options options = lobe_dielectric_default_options();
    lobe_dielectric_f32 f =
        lobe_dielectric_prepare_f32(options, i->wi, i->alpha_x, i->alpha_y, i->ior);
    lobe_dielectric_f64 d =
        lobe_dielectric_prepare_f64(options, widen(i->wi), i->alpha_x, i->alpha_y, i->ior);
    lobe_dielectric_draw_f32 a = lobe_dielectric_sample_f32(&f, i->u1, i->u2, i->u3);
    lobe_dielectric_draw_f64 b = lobe_dielectric_sample_f64(&d, i->u1, i->u2, i->u3);
    if (a.pdf == 0 || b.pdf == 0 || a.transmitted != b.transmitted) return;
    double x = a.wo.x - b.wo.x, y = a.wo.y - b.wo.y, z = a.wo.z - b.wo.z;
    keep(&w[0], sqrt(x * x + y * y + z * z), i);
    double exact = lobe_dielectric_pdf_f64(&d, widen(a.wo));
    if (exact > 0) keep(&w[1], fabs(a.pdf - exact) / rounding_of(&d, widen(a.wo)), i);
}

static void compare_beta(void) {
    double most = 0, at[2] = {0, 0};
    for (uint64_t k = 0; k < DRAWS / 10; ++k) {
        lobe_random4 r = lobe_random(19, 2, k);
        float a = powf(10, -4 + 11 * unit(r, 0)), b = powf(10, -4 + 11 * unit(r, 1));
        long double sum = lgammal(1 + (long double)a) + lgammal(1 + (long double)b);
        double exact = (double)expl(sum - lgammal(2 + (long double)a + (long double)b));
        if (exact * (1 + fmax(a, b)) < 1e-6) continue;
        double error = fabs(dielectric_beta(a, b) / exact - 1);
        if (!(error > most)) continue;
        most = error;
        at[0] = a;
        at[1] = b;
    }
    printf("beta      %.2g at %a, %a\n", most, at[0], at[1]);
}

int main(void) {
    static const char *const NAMES[2] = {"direction", "density"};
    worst w[2] = {{0, {{0, 0, 0}, 0, 0, 0, 0, 0, 0}}};
    for (uint64_t k = 0; k < DRAWS; ++k) {
        input i = input_at(k);
        compare(&i, w);
    }
    for (int k = 0; k < 2; ++k)
        printf("%-9s %.2g at wi (%a, %a, %a) alpha (%a, %a) ior %a u (%a, %a, %a)\n", NAMES[k],
               w[k].error, (double)w[k].at.wi.x, (double)w[k].at.wi.y, (double)w[k].at.wi.z,
               (double)w[k].at.alpha_x, (double)w[k].at.alpha_y, (double)w[k].at.ior,
               (double)w[k].at.u1, (double)w[k].at.u2, (double)w[k].at.u3);
    compare_beta();
    return 0;
}
