/* Many draws and densities at once. Draws come from a batch in vectors, or one after the other, with the
 * same bits; densities one after the other: loops for them would add a fifth to the size of the page. */
#include "page.h"

#if defined(LOBE_SMALL)

#include <lobe/batch.h>

static lobe_in_f32 in(const float *array, int first) {
    return (lobe_in_f32){array + first, 1};
}

static lobe_out_f32 out(float *array, int first) {
    return (lobe_out_f32){array + first, 1};
}

void page_draw_rows(int method, int first, int count) {
    rows *r = &page_rows[method];
    lobe_sample_batch_f32 b = {.count = (size_t)count, .prepared = &page_model[method]};
    for (int k = 0; k < 3; ++k) {
        b.u[k] = in(page_numbers[k], first);
        b.m[k] = out(r->m[k], first);
        b.wo[k] = out(r->wo[k], first);
    }
    b.cos_im = out(r->cos_im, first);
    b.pdf_m = out(r->pdf_m, first);
    b.pdf = out(r->pdf, first);
    b.weight = out(r->weight, first);
    lobe_reflection_sample_batch_f32(&b);
}

#else

void page_draw_rows(int method, int first, int count) {
    rows *r = &page_rows[method];
    for (int i = first; i < first + count; ++i) {
        const lobe_reflection_draw_f32 d = lobe_reflection_sample_f32(
            &page_model[method], page_numbers[0][i], page_numbers[1][i], page_numbers[2][i]);
        const float m[] = {d.m.x, d.m.y, d.m.z}, wo[] = {d.wo.x, d.wo.y, d.wo.z};
        for (int k = 0; k < 3; ++k) {
            r->m[k][i] = m[k];
            r->wo[k][i] = wo[k];
        }
        r->cos_im[i] = d.cos_im;
        r->pdf_m[i] = d.pdf_m;
        r->pdf[i] = d.pdf;
        r->weight[i] = d.weight;
    }
}

#endif

void page_eval_rows(int method, int count) {
    for (int i = 0; i < count; ++i) {
        const lobe_vec3_f32 wo = {page_query[0][i], page_query[1][i], page_query[2][i]};
        const lobe_reflection_eval_f32 e = lobe_reflection_eval_wo_f32(&page_model[method], wo);
        page_answer[0][i] = e.pdf;
        page_answer[1][i] = e.f_cos;
    }
}

EXPORT(draw) void page_draw(int method, int count);
void page_draw(int method, int count) {
    page_draw_rows(method, 0, count);
}

EXPORT(eval) void page_eval(int method, int count);
void page_eval(int method, int count) {
    page_eval_rows(method, count);
}
