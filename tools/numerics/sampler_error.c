/* tools/numerics/sampler_error.c: the worst difference between a draw in float and the same draw in
 * double, with the input that causes it, over random inputs.
 *
 *     cc -O2 -ffp-contract=off -Iinclude tools/numerics/sampler_error.c build/liblobe.a -lm \
 *         -o sampler_error && ./sampler_error
 *
 * Roughness 0.01 to 2, any direction down to 175 degrees from the normal, u2 up to 0.98: beyond, in
 * the tail of the lobe, the half vector itself is lost to rounding. "direction" is |wo - wo'|,
 * "density" the relative error of pdf against double at the normal that was drawn. The figures stand
 * at the foot of the kernel files. */
#include <lobe/lobe.h>

#include <math.h>
#include <stdio.h>

enum { DRAWS = 20000000 };

typedef struct input {
    lobe_vec3_f32 wi;
    float alpha_x, alpha_y, u1, u2;
} input;

static float unit(lobe_random4 r, int word) {
    return lobe_random_unit_f32(r.word[word]);
}

static input input_at(uint64_t k) {
    lobe_random4 a = lobe_random(9, 0, k), b = lobe_random(9, 1, k);
    float z = 1.0f - 1.9962f * unit(a, 0), turn = 6.2831853f * unit(a, 1);
    float s = sqrtf(1.0f - z * z);
    input i = {{s * cosf(turn), s * sinf(turn), z}, 0.01f * powf(200.0f, unit(a, 2)), 0, 0, 0};
    i.alpha_y = k % 4 == 0 ? i.alpha_x : 0.01f * powf(200.0f, unit(a, 3));
    i.u1 = unit(b, 0);
    i.u2 = 0.98f * unit(b, 1);
    return i;
}

typedef struct worst {
    double error;
    input at;
} worst;

static void keep(worst *w, double error, const input *i) {
    if (error > w->error) *w = (worst){error, *i};
}

static void compare(lobe_model row, const input *i, worst *direction, worst *density) {
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = row;
    lobe_vec3_f64 wi = {i->wi.x, i->wi.y, i->wi.z};
    lobe_reflection_f32 f = lobe_reflection_prepare_f32(options, i->wi, i->alpha_x, i->alpha_y);
    lobe_reflection_f64 d = lobe_reflection_prepare_f64(options, wi, i->alpha_x, i->alpha_y);
    lobe_reflection_draw_f32 a = lobe_reflection_sample_f32(&f, i->u1, i->u2, 0);
    lobe_reflection_draw_f64 b = lobe_reflection_sample_f64(&d, i->u1, i->u2, 0);
    if (a.pdf == 0 || b.pdf == 0) return;
    double x = a.wo.x - b.wo.x, y = a.wo.y - b.wo.y, z = a.wo.z - b.wo.z;
    keep(direction, sqrt(x * x + y * y + z * z), i);
    lobe_vec3_f64 m = {a.m.x, a.m.y, a.m.z};
    double exact = lobe_reflection_eval_m_f64(&d, m).pdf;
    if (exact > 0) keep(density, fabs(a.pdf / exact - 1), i);
}

static void print(lobe_model row, const char *what, const worst *w) {
    printf("%-16s %-9s %.2g at wi (%a, %a, %a) alpha (%a, %a) u (%a, %a)\n",
           lobe_method_name(row.method), what, w->error, (double)w->at.wi.x, (double)w->at.wi.y,
           (double)w->at.wi.z, (double)w->at.alpha_x, (double)w->at.alpha_y, (double)w->at.u1,
           (double)w->at.u2);
}

int main(void) {
    for (int m = 0; m < lobe_model_count(); ++m) {
        worst direction = {0}, density = {0};
        for (uint64_t k = 0; k < DRAWS; ++k) {
            input i = input_at(k);
            compare(lobe_model_at(m), &i, &direction, &density);
        }
        print(lobe_model_at(m), "direction", &direction);
        print(lobe_model_at(m), "density", &density);
    }
    return 0;
}
