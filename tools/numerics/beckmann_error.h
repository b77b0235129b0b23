/* tools/numerics/beckmann_error.h: the samplers of kernel/beckmann*.h behind functions of doubles. */
#ifndef BECKMANN_ERROR_H
#define BECKMANN_ERROR_H

#define BECKMANN_SAMPLERS(X) X(0, ndf) X(1, slope) X(2, newton) X(3, newton_published) X(4, horizon)

enum { BECKMANN_SAMPLER_COUNT = 5 };

typedef struct shading {
    double wi[3], alpha_x, alpha_y;
} shading;

typedef struct drawn {
    double m[3], wo[3], pdf, c;
} drawn;

drawn draw_f32(int sampler, const shading *at, double u1, double u2);
drawn draw_f64(int sampler, const shading *at, double u1, double u2);
double density_f32(int sampler, const shading *at, const double m[3]);
double density_f64(int sampler, const shading *at, const double m[3]);

#endif
