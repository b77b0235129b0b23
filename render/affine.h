/* Affine transforms, in double. */
#ifndef LOBE_RENDER_AFFINE_H
#define LOBE_RENDER_AFFINE_H

#include "vector.h"

/* Rows; applied to a column (x, y, z, 1). */
typedef struct affine {
    double m[3][4];
} affine;

affine lobe_affine_identity(void);
affine lobe_affine_product(const affine *a, const affine *b);

/* Translation, then rotation by the quaternion (x, y, z, w), then scale, seen from the parent. */
affine lobe_affine_of(const double translation[3], const double rotation[4], const double scale[3]);

vec3 lobe_affine_point(const affine *t, vec3 p);
vec3 lobe_affine_direction(const affine *t, vec3 d);

/* 0 unless all is finite. */
int lobe_affine_is_finite(const affine *t);

/* How normals turn: by the cofactors of the matrix, whose columns are cross products of its own, with
 * the sign of its determinant, so that they stay on their side under a reflection. Their length is of no meaning. */
typedef struct normal_transform {
    affine cofactors;
    double determinant; /* without its sign, */
    double sign;        /* which is 1 where it is 0 */
} normal_transform;

normal_transform lobe_affine_normals(const affine *t);

#endif
