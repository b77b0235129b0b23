/* bench/listings.h: the published samplers as a user would copy them from the papers: plain C, float,
 * libm. Each draws a normal, reflects, and gives density and weight (height-correlated G2). What the
 * library is compared to; never used for anything else. */
#ifndef LOBE_BENCH_LISTINGS_H
#define LOBE_BENCH_LISTINGS_H

#include <lobe/reflection.h>

typedef struct listing_draw {
    lobe_vec3_f32 wo;
    float pdf, weight;
} listing_draw;

typedef listing_draw listing(lobe_vec3_f32 wi, float ax, float ay, float u1, float u2, float u3);

/* NULL: none is published for the model. */
listing *lobe_listing_of(lobe_model model);

#endif
