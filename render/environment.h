/* Light from everywhere: a panorama, drawn from in proportion to its brightness. Direction d lies at
 * u = 1/2 + atan2(d.z, d.x)/(2 pi), v = acos(d.y)/pi from the top row. */
#ifndef LOBE_RENDER_ENVIRONMENT_H
#define LOBE_RENDER_ENVIRONMENT_H

#include "alias.h"
#include "image.h"

typedef struct sky_texel {
    vec3 radiance;
    float share; /* probability of drawing it: of one line of the cache with what it shines */
} sky_texel;

typedef struct environment {
    int width, height;
    sky_texel *texels; /* rows from the top */
    alias_table table;
    float sine, cosine;    /* of the rotation about +Y */
    float texels_per_turn; /* their number over 2 pi^2: makes a density of a share */
} environment;

/* Takes the picture over. 0: no memory. */
int lobe_environment_create(environment *e, image picture, float rotation_degrees);
void lobe_environment_free(environment *e);

/* A clear sky over a grey ground, or light of one colour. 0: no memory. */
int lobe_environment_sky(image *picture);
int lobe_environment_constant(image *picture, vec3 radiance);

vec3 lobe_environment_at(const environment *e, vec3 direction);

/* Density over directions of lobe_environment_draw; 0 where it draws nothing. */
float lobe_environment_pdf(const environment *e, vec3 direction);

/* Both at once. */
vec3 lobe_environment_meet(const environment *e, vec3 direction, float *pdf);

typedef struct sky_draw {
    vec3 direction, radiance;
    float pdf;
} sky_draw;

/* Asks for the memory that a draw begins with. */
void lobe_environment_prefetch(const environment *e, const uint32_t bits[3]);
sky_draw lobe_environment_draw(const environment *e, const uint32_t bits[3]);

#endif
