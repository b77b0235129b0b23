#include "work.h"

#define REAL float
#define NAME(stem) stem##_f32
#include "work_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#include "work_template.h"

double work_draw(const work *w, const inputs *in) {
    return w->precision == PRECISION_F32 ? draw_f32(w, in) : draw_f64(w, in);
}

double work_pdf(const work *w, const inputs *in) {
    return w->precision == PRECISION_F32 ? pdf_f32(w, in) : pdf_f64(w, in);
}

double work_listing(listing *published, const inputs *in) {
    double sum = 0;
    for (int i = 0; i < INPUTS; ++i) {
        lobe_vec3_f32 wi = {(float)in->wi[i].x, (float)in->wi[i].y, (float)in->wi[i].z};
        listing_draw d = published(wi, (float)in->alpha_x[i], (float)in->alpha_y[i],
                                   (float)in->u1[i], (float)in->u2[i]);
        sum += d.wo.x + d.pdf + d.weight;
    }
    return sum;
}

double work_bytes(const work *w) {
    double numbers = w->is_shared ? 2 + 5 : 2 + 5 + 5;
    return numbers * (w->precision == PRECISION_F32 ? sizeof(float) : sizeof(double));
}
