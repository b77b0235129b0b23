#include "work.h"

#include <lobe/batch.h>
#include <lobe/dielectric_batch.h>

#define REAL float
#define NAME(stem) stem##_f32
#include "work_glass.h"
#include "work_reflection.h"
#undef REAL
#undef NAME

#define REAL double
#define NAME(stem) stem##_f64
#include "work_glass.h"
#include "work_reflection.h"
#undef REAL
#undef NAME

/* The same loop of every kind and precision. */
#define CHOOSE(w, in, loop)                                                                        \
    ((w)->precision == PRECISION_F32                                                               \
         ? ((w)->is_glass ? glass_##loop##_f32 : loop##_f32)((w), &(in)->f32)                      \
         : ((w)->is_glass ? glass_##loop##_f64 : loop##_f64)((w), &(in)->f64))

double work_draw(const work *w, inputs *in) {
    return CHOOSE(w, in, draw);
}

double work_normal(const work *w, inputs *in) {
    return CHOOSE(w, in, batch_normal);
}

double work_pdf(const work *w, inputs *in) {
    return CHOOSE(w, in, pdf);
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
