#include "work.h"

#include <lobe/batch.h>
#include <lobe/dielectric_batch.h>

#define REAL float
#define NAME(stem) stem##_f32
#include "work_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#include "work_template.h"

static const double GLASS = 1.5;

#define REAL float
#define NAME(stem) stem##_f32
#include "dielectric_template.h"

#define REAL double
#define NAME(stem) stem##_f64
#include "dielectric_template.h"

double work_draw(const work *w, inputs *in) {
    if (w->is_glass)
        return w->precision == PRECISION_F32 ? glass_draw_f32(w, &in->f32)
                                             : glass_draw_f64(w, &in->f64);
    return w->precision == PRECISION_F32 ? draw_f32(w, &in->f32) : draw_f64(w, &in->f64);
}

double work_pdf(const work *w, inputs *in) {
    if (w->is_glass)
        return w->precision == PRECISION_F32 ? glass_pdf_f32(w, &in->f32)
                                             : glass_pdf_f64(w, &in->f64);
    return w->precision == PRECISION_F32 ? pdf_f32(w, &in->f32) : pdf_f64(w, &in->f64);
}

double work_listing(listing *published, const inputs *in) {
    const inputs_f32 *f = &in->f32;
    double sum = 0;
    for (int i = 0; i < INPUTS; ++i) {
        lobe_vec3_f32 wi = {f->wi[0][i], f->wi[1][i], f->wi[2][i]};
        listing_draw d =
            published(wi, f->alpha[0][i], f->alpha[1][i], f->u[0][i], f->u[1][i], f->u[2][i]);
        sum += d.wo.x + d.pdf + d.weight;
    }
    return sum;
}

double work_bytes(const work *w) {
    double numbers = w->is_shared ? 2 + 5 : 2 + 5 + 5;
    return numbers * (w->precision == PRECISION_F32 ? sizeof(float) : sizeof(double));
}
