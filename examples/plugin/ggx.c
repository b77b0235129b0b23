/* ggx.c: anisotropic GGX reflection with Smith's height-correlated masking, drawn by visible normals.
 * Plain C, the formulas as papers print them; it shares nothing with the library under test.
 *
 *     cc -O2 -fPIC -shared -I include examples/plugin/ggx.c -o ggx.so -lm
 *     lobe verify --plugin ./ggx.so
 *
 * Two files beside this one include it with one line of it wrong, as such lines have been wrong
 * before: ggx_without_jacobian.c, ggx_without_g1.c. */
#include <lobe/plugin.h>

#include <math.h>

#ifndef GGX_NAME
#define GGX_NAME "ggx"
#endif
#ifndef GGX_JACOBIAN /* from normals to reflected directions */
#define GGX_JACOBIAN(im) (4 * (im))
#endif
#ifndef GGX_G1_OF_DENSITY
#define GGX_G1_OF_DENSITY 1 / (1 + lambda(b, wi))
#endif

static const double PI = 3.14159265358979323846;

enum { ALPHA_X, ALPHA_Y };

typedef struct vector {
    double x, y, z;
} vector;

static vector vector_of(const double v[3]) {
    vector r = {v[0], v[1], v[2]};
    return r;
}

static vector normalized(vector v) {
    double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    vector r = {v.x / length, v.y / length, v.z / length};
    return r;
}

static double dot(vector a, vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Walter et al. 2007, anisotropic as in Heitz 2014. */
static double distribution(const lobe_plugin_block *b, vector m) {
    double x = m.x / b->parameter[ALPHA_X];
    double y = m.y / b->parameter[ALPHA_Y];
    double s = x * x + y * y + m.z * m.z;
    return 1 / (PI * b->parameter[ALPHA_X] * b->parameter[ALPHA_Y] * s * s);
}

/* Smith's Lambda; v.z > 0. */
static double lambda(const lobe_plugin_block *b, vector v) {
    double x = b->parameter[ALPHA_X] * v.x;
    double y = b->parameter[ALPHA_Y] * v.y;
    return (sqrt(1 + (x * x + y * y) / (v.z * v.z)) - 1) / 2;
}

static double density(const lobe_plugin_block *b, const double o[3]) {
    vector wi = vector_of(b->wi);
    vector wo = vector_of(o);
    if (!(wi.z > 0) || !(wo.z > 0)) return 0;
    vector sum = {wi.x + wo.x, wi.y + wo.y, wi.z + wo.z};
    vector m = normalized(sum);
    double im = dot(wi, m);
    if (!(im > 0)) return 0;
    double g1 = GGX_G1_OF_DENSITY;
    return g1 * im * distribution(b, m) / wi.z / GGX_JACOBIAN(im);
}

static double value(const lobe_plugin_block *b, const double o[3]) {
    vector wi = vector_of(b->wi);
    vector wo = vector_of(o);
    if (!(wi.z > 0) || !(wo.z > 0)) return 0;
    vector sum = {wi.x + wo.x, wi.y + wo.y, wi.z + wo.z};
    vector m = normalized(sum);
    double g2 = 1 / (1 + lambda(b, wi) + lambda(b, wo));
    return distribution(b, m) * g2 / (4 * wi.z);
}

/* Dupuy & Benyoub 2023: in the frame where the surface is a hemisphere, reflections fill a cap. */
static vector visible_normal(const lobe_plugin_block *b, double u1, double u2) {
    double ax = b->parameter[ALPHA_X];
    double ay = b->parameter[ALPHA_Y];
    vector stretched = {ax * b->wi[0], ay * b->wi[1], b->wi[2]};
    vector i = normalized(stretched);
    double z = (1 - u2) * (1 + i.z) - i.z;
    double radius = sqrt(fmax(1 - z * z, 0));
    vector h = {radius * cos(2 * PI * u1) + i.x, radius * sin(2 * PI * u1) + i.y, z + i.z};
    vector m = {ax * h.x, ay * h.y, h.z};
    return normalized(m);
}

static void sample(const lobe_plugin_block *b, const double u[3], lobe_plugin_draw *draw) {
    if (!(b->wi[2] > 0)) return; /* pdf and weight come as 0 */
    vector m = visible_normal(b, u[0], u[1]);
    double twice = 2 * dot(vector_of(b->wi), m);
    draw->wo[0] = twice * m.x - b->wi[0];
    draw->wo[1] = twice * m.y - b->wi[1];
    draw->wo[2] = twice * m.z - b->wi[2];
    draw->pdf = density(b, draw->wo);
    draw->weight = draw->pdf > 0 ? value(b, draw->wo) / draw->pdf : 0;
}

LOBE_PLUGIN_EXPORT const lobe_plugin *lobe_plugin_describe(void) {
    static const lobe_plugin plugin = {
        .version = LOBE_PLUGIN_VERSION,
        .name = GGX_NAME,
        .sample = sample,
        .density = density,
        .value = value,
        .parameter_count = 2,
        .parameter =
            {{.name = "alpha_x", .least = 0.02, .most = 1, .typical = 0.3, .is_logarithmic = 1},
             {.name = "alpha_y", .least = 0.02, .most = 1, .typical = 0.5, .is_logarithmic = 1}},
        .flags = LOBE_PLUGIN_RECIPROCAL};
    return &plugin;
}
