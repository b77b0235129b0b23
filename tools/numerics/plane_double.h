/* tools/numerics/plane_double.h: the samplers of two planes in double, for those who include the kernels in
 * float: a source file knows one precision. */
#ifndef TOOLS_NUMERICS_PLANE_DOUBLE_H
#define TOOLS_NUMERICS_PLANE_DOUBLE_H

typedef struct plane_input {
    float wi[3], plane[3], alpha_x, alpha_y, u1, u2, u3, floor_share;
} plane_input;

typedef struct plane_output {
    double m[3], wo[3], pdf, weight;
} plane_output;

typedef enum plane_sampler {
    PLANE_TABLE,
    PLANE_ELLIPSE,
    PLANE_UNIFORM,
    PLANE_SAMPLERS
} plane_sampler;

/* The draw. */
plane_output plane_draw_double(plane_sampler sampler, const plane_input *input);
/* The density of the reflection about m. */
double plane_pdf_double(plane_sampler sampler, const plane_input *input, const double m[3]);

#endif
