/* inputs: what the library of this processor makes of 10^4 inputs a model: written to standard output as raw
 * numbers, to be compared with WebAssembly bit for bit (bits.mjs). Blocks of ROWS rows share a direction, a
 * roughness and a geometric normal; some lie behind the surface, some are mirrors, some are unusable. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>

#include <lobe/batch.h>
#include <lobe/random.h>
#include <lobe/reflection.h>

enum { ROWS = 250, BLOCKS = 40, COLUMNS = 18 };

/* u1 u2 u3, a direction; then the draw: m, wo, cos_im, pdf_m, pdf, weight; pdf and f cos at the direction. */
static float columns[COLUMNS][ROWS];

static float number(uint32_t word) {
    return lobe_random_unit_f32(word);
}

/* Evenly over the sphere, or its upper half. */
static lobe_vec3_f32 direction(lobe_random4 r, int is_above) {
    const float z = is_above ? number(r.word[0]) : 2 * number(r.word[0]) - 1;
    const float phi = 6.2831853f * number(r.word[1]), s = sqrtf(1 - z * z);
    return (lobe_vec3_f32){s * cosf(phi), s * sinf(phi), z};
}

static float roughness(uint32_t word) {
    return powf(10, 3.7f * number(word) - 3.3f); /* 5e-4 to 2.5 */
}

static lobe_in_f32 in(int column) {
    return (lobe_in_f32){columns[column], 1};
}

static lobe_out_f32 out(int column) {
    return (lobe_out_f32){columns[column], 1};
}

static void fill(const lobe_reflection_f32 *model) {
    lobe_sample_batch_f32 s = {.count = ROWS, .prepared = model};
    lobe_eval_batch_f32 e = {.count = ROWS, .prepared = model};
    for (int k = 0; k < 3; ++k) {
        s.u[k] = in(k);
        e.wo[k] = in(3 + k);
        s.m[k] = out(6 + k);
        s.wo[k] = out(9 + k);
    }
    s.cos_im = out(12);
    s.pdf_m = out(13);
    s.pdf = out(14);
    s.weight = out(15);
    e.pdf = out(16);
    e.f_cos = out(17);
    lobe_reflection_sample_batch_f32(&s);
    lobe_reflection_eval_batch_f32(&e);
}

static int block_of(lobe_model model, int index, int block) {
    const uint64_t stream = (uint64_t)(index * BLOCKS + block);
    const lobe_random4 r = lobe_random(7, stream, 0), t = lobe_random(7, stream, 1);
    const int is_flat = block % 3 != 0;
    lobe_reflection_options options = lobe_reflection_default_options();
    options.model = model;
    const lobe_vec3_f32 wi = direction(r, block % 4 != 3),
                        plane = is_flat ? (lobe_vec3_f32){0, 0, 1} : direction(t, 1);
    const float alpha_x = block == 5 ? 1e-5f : roughness(r.word[2]);
    const float alpha_y = block % 5 == 0 ? alpha_x : roughness(r.word[3]);
    const lobe_reflection_f32 prepared =
        lobe_reflection_prepare_above_f32(options, wi, alpha_x, alpha_y, plane);
    for (int i = 0; i < ROWS; ++i) {
        const lobe_random4 u = lobe_random(8, stream, (uint64_t)i);
        const lobe_vec3_f32 o = direction(lobe_random(9, stream, (uint64_t)i), i % 8 != 0);
        for (int k = 0; k < 3; ++k) columns[k][i] = number(u.word[k]);
        columns[3][i] = o.x;
        columns[4][i] = o.y;
        columns[5][i] = o.z;
    }
    fill(&prepared);
    const int32_t head[] = {(int32_t)model.ndf, (int32_t)model.masking, (int32_t)model.method,
                            ROWS};
    const float scene[] = {alpha_x, alpha_y, wi.x, wi.y, wi.z, plane.x, plane.y, plane.z};
    return fwrite(head, sizeof head, 1, stdout) == 1 &&
           fwrite(scene, sizeof scene, 1, stdout) == 1 &&
           fwrite(columns, sizeof columns, 1, stdout) == 1;
}

int main(void) {
    for (int index = 0; index < lobe_model_count(); ++index)
        for (int block = 0; block < BLOCKS; ++block)
            if (!block_of(lobe_model_at(index), index, block)) return 1;
    return fflush(stdout) == 0 ? 0 : 1;
}
