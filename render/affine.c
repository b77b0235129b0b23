#include "affine.h"

affine lobe_affine_identity(void) {
    return (affine){{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};
}

affine lobe_affine_product(const affine *a, const affine *b) {
    affine p;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++) {
            double sum = column == 3 ? a->m[row][3] : 0.0;
            for (int k = 0; k < 3; k++) sum += a->m[row][k] * b->m[k][column];
            p.m[row][column] = sum;
        }
    return p;
}

/* Of a quaternion (x, y, z, w); one without length turns nothing. */
static void rotation_of(const double q[4], double r[3][3]) {
    const double length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const double s = length2 > 0.0 ? 2.0 / length2 : 0.0;
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    r[0][0] = 1.0 - s * (y * y + z * z);
    r[0][1] = s * (x * y - z * w);
    r[0][2] = s * (x * z + y * w);
    r[1][0] = s * (x * y + z * w);
    r[1][1] = 1.0 - s * (x * x + z * z);
    r[1][2] = s * (y * z - x * w);
    r[2][0] = s * (x * z - y * w);
    r[2][1] = s * (y * z + x * w);
    r[2][2] = 1.0 - s * (x * x + y * y);
}

affine lobe_affine_of(const double translation[3], const double rotation[4],
                      const double scale[3]) {
    affine t;
    double r[3][3];
    rotation_of(rotation, r);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            t.m[row][column] = r[row][column] * scale[column];
        t.m[row][3] = translation[row];
    }
    return t;
}

vec3 lobe_affine_direction(const affine *t, vec3 d) {
    const double x = (double)d.x, y = (double)d.y, z = (double)d.z;
    return v3((float)(t->m[0][0] * x + t->m[0][1] * y + t->m[0][2] * z),
              (float)(t->m[1][0] * x + t->m[1][1] * y + t->m[1][2] * z),
              (float)(t->m[2][0] * x + t->m[2][1] * y + t->m[2][2] * z));
}

vec3 lobe_affine_point(const affine *t, vec3 p) {
    const double x = (double)p.x, y = (double)p.y, z = (double)p.z;
    return v3((float)(t->m[0][0] * x + t->m[0][1] * y + t->m[0][2] * z + t->m[0][3]),
              (float)(t->m[1][0] * x + t->m[1][1] * y + t->m[1][2] * z + t->m[1][3]),
              (float)(t->m[2][0] * x + t->m[2][1] * y + t->m[2][2] * z + t->m[2][3]));
}

int lobe_affine_is_finite(const affine *t) {
    for (int i = 0; i < 12; i++)
        if (!isfinite((float)t->m[i / 4][i % 4])) return 0;
    return 1;
}

normal_transform lobe_affine_normals(const affine *t) {
    normal_transform n = {lobe_affine_identity(), 0.0, 1.0};
    double determinant = 0.0;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            const int r1 = (row + 1) % 3, r2 = (row + 2) % 3;
            const int c1 = (column + 1) % 3, c2 = (column + 2) % 3;
            const double cofactor = t->m[r1][c1] * t->m[r2][c2] - t->m[r1][c2] * t->m[r2][c1];
            n.cofactors.m[row][column] = cofactor;
            if (row == 0) determinant += t->m[0][column] * cofactor;
        }
    n.determinant = fabs(determinant);
    n.sign = determinant < 0.0 ? -1.0 : 1.0;
    /* the scale is of no matter, but must not leave the range of float */
    double largest = 0.0;
    for (int i = 0; i < 9; i++) largest = fmax(largest, fabs(n.cofactors.m[i / 3][i % 3]));
    for (int i = 0; i < 9; i++)
        n.cofactors.m[i / 3][i % 3] *= largest > 0.0 ? n.sign / largest : 0.0;
    return n;
}
