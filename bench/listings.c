#include "listings.h"

#include <math.h>
#include <stddef.h>

static const float PI = 3.14159265358979f;

typedef lobe_vec3_f32 vec3;

static vec3 normalize(vec3 v) {
    float length = sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
    return (vec3){v.x / length, v.y / length, v.z / length};
}

static float dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vec3 cross(vec3 a, vec3 b) {
    return (vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static float distribution(vec3 m, float ax, float ay) {
    float x = m.x / ax, y = m.y / ay, e = x * x + y * y + m.z * m.z;
    return 1.0f / (PI * ax * ay * e * e);
}

static float lambda(vec3 v, float ax, float ay) {
    float x = ax * v.x, y = ay * v.y;
    return 0.5f * (sqrtf(1.0f + (x * x + y * y) / (v.z * v.z)) - 1.0f);
}

/* The end of every listing: reflect, G2, and the density of o for that of m. */
static listing_draw finish(vec3 wi, float ax, float ay, vec3 m, float pdf) {
    float im = dot(wi, m);
    vec3 wo = {2.0f * im * m.x - wi.x, 2.0f * im * m.y - wi.y, 2.0f * im * m.z - wi.z};
    if (wo.z <= 0.0f) return (listing_draw){wo, 0.0f, 0.0f};
    float g2 = 1.0f / (1.0f + lambda(wi, ax, ay) + lambda(wo, ax, ay));
    float f_cos = distribution(m, ax, ay) * g2 / (4.0f * wi.z);
    return (listing_draw){wo, pdf, f_cos / pdf};
}

/* Density of o where the visible normals are all drawn. */
static listing_draw finish_visible(vec3 wi, float ax, float ay, vec3 m) {
    float g1 = 1.0f / (1.0f + lambda(wi, ax, ay));
    return finish(wi, ax, ay, m, g1 * distribution(m, ax, ay) / (4.0f * wi.z));
}

/* Walter et al. 2007 */
static listing_draw ndf(vec3 wi, float ax, float ay, float u1, float u2, float u3) {
    (void)u3;
    float phi = 2.0f * PI * u1, t = sqrtf(u2 / (1.0f - u2));
    vec3 m = normalize((vec3){ax * t * cosf(phi), ay * t * sinf(phi), 1.0f});
    return finish(wi, ax, ay, m, distribution(m, ax, ay) * m.z / (4.0f * fabsf(dot(wi, m))));
}

/* Heitz & d'Eon 2014, supplement */
static listing_draw slope(vec3 wi, float ax, float ay, float u1, float u2, float u3) {
    (void)u3;
    vec3 s = normalize((vec3){ax * wi.x, ay * wi.y, wi.z});
    float theta = 0.0f, phi = 0.0f;
    if (s.z < 0.99999f) {
        theta = acosf(s.z);
        phi = atan2f(s.y, s.x);
    }
    float slope_x, slope_y;
    if (theta < 0.0001f) {
        float r = sqrtf(u1 / (1.0f - u1));
        slope_x = r * cosf(2.0f * PI * u2);
        slope_y = r * sinf(2.0f * PI * u2);
    } else {
        float b = tanf(theta), a0 = 1.0f / b;
        float g1 = 2.0f / (1.0f + sqrtf(1.0f + 1.0f / (a0 * a0)));
        float a = 2.0f * u1 / g1 - 1.0f, tmp = 1.0f / (a * a - 1.0f);
        float d = sqrtf(fmaxf(b * b * tmp * tmp - (a * a - b * b) * tmp, 0.0f));
        float x1 = b * tmp - d, x2 = b * tmp + d;
        slope_x = a < 0.0f || x2 > 1.0f / b ? x1 : x2;
        float sign = u2 > 0.5f ? 1.0f : -1.0f;
        float v = 2.0f * fabsf(u2 - 0.5f);
        float z = (v * (v * (v * 0.27385f - 0.73369f) + 0.46341f)) /
                  (v * (v * (v * 0.093073f + 0.309420f) - 1.0f) + 0.597999f);
        slope_y = sign * z * sqrtf(1.0f + slope_x * slope_x);
    }
    float c = cosf(phi), sn = sinf(phi);
    float x = ax * (c * slope_x - sn * slope_y), y = ay * (sn * slope_x + c * slope_y);
    return finish_visible(wi, ax, ay, normalize((vec3){-x, -y, 1.0f}));
}

/* Heitz 2018 */
static listing_draw ellipsoid(vec3 wi, float ax, float ay, float u1, float u2, float u3) {
    (void)u3;
    vec3 v = normalize((vec3){ax * wi.x, ay * wi.y, wi.z});
    float length2 = v.x * v.x + v.y * v.y;
    vec3 t1 = {1.0f, 0.0f, 0.0f};
    if (length2 > 0.0f) t1 = (vec3){-v.y / sqrtf(length2), v.x / sqrtf(length2), 0.0f};
    vec3 t2 = cross(v, t1);
    float r = sqrtf(u1), phi = 2.0f * PI * u2;
    float p1 = r * cosf(phi), p2 = r * sinf(phi), s = 0.5f * (1.0f + v.z);
    p2 = (1.0f - s) * sqrtf(1.0f - p1 * p1) + s * p2;
    float p3 = sqrtf(fmaxf(0.0f, 1.0f - p1 * p1 - p2 * p2));
    vec3 n = {p1 * t1.x + p2 * t2.x + p3 * v.x, p1 * t1.y + p2 * t2.y + p3 * v.y,
              p1 * t1.z + p2 * t2.z + p3 * v.z};
    return finish_visible(wi, ax, ay, normalize((vec3){ax * n.x, ay * n.y, fmaxf(0.0f, n.z)}));
}

/* o uniform on the cap z >= -k i_z of the stretched sphere */
static vec3 cap_normal(vec3 v, float ax, float ay, float lower, float u1, float u2) {
    float phi = 2.0f * PI * u1, z = (1.0f - u2) * (1.0f - lower) + lower;
    float r = sqrtf(fmaxf(0.0f, 1.0f - z * z));
    vec3 h = {r * cosf(phi) + v.x, r * sinf(phi) + v.y, z + v.z};
    return normalize((vec3){ax * h.x, ay * h.y, h.z});
}

/* Dupuy & Benyoub 2023 */
static listing_draw caps(vec3 wi, float ax, float ay, float u1, float u2, float u3) {
    (void)u3;
    vec3 v = normalize((vec3){ax * wi.x, ay * wi.y, wi.z});
    return finish_visible(wi, ax, ay, cap_normal(v, ax, ay, -v.z, u1, u2));
}

/* Eto & Tokuyoshi 2023 */
static listing_draw bounded(vec3 wi, float ax, float ay, float u1, float u2, float u3) {
    (void)u3;
    vec3 stretched = {ax * wi.x, ay * wi.y, wi.z};
    float t = sqrtf(dot(stretched, stretched));
    vec3 v = {stretched.x / t, stretched.y / t, stretched.z / t};
    float a = fminf(fminf(ax, ay), 1.0f), s = 1.0f + sqrtf(wi.x * wi.x + wi.y * wi.y);
    float a2 = a * a, s2 = s * s;
    float k = (1.0f - a2) * s2 / (s2 + a2 * wi.z * wi.z);
    if (wi.z <= 0.0f) k = 1.0f;
    vec3 m = cap_normal(v, ax, ay, -k * v.z, u1, u2);
    return finish(wi, ax, ay, m, distribution(m, ax, ay) / (2.0f * (k * wi.z + t)));
}

/* V-cavities: Heitz & d'Eon 2014. A normal by its area, or its mirror image where more of that is seen. */
static listing_draw vcavity(vec3 wi, float ax, float ay, float u1, float u2, float u3) {
    float phi = 2.0f * PI * u1, t = sqrtf(u2 / (1.0f - u2));
    vec3 m = normalize((vec3){ax * t * cosf(phi), ay * t * sinf(phi), 1.0f});
    vec3 mirrored = {-m.x, -m.y, m.z};
    float seen = fmaxf(dot(wi, m), 0.0f), other = fmaxf(dot(wi, mirrored), 0.0f);
    if (u3 * (seen + other) > seen) m = mirrored;
    float im = dot(wi, m);
    vec3 wo = {2.0f * im * m.x - wi.x, 2.0f * im * m.y - wi.y, 2.0f * im * m.z - wi.z};
    if (wo.z <= 0.0f) return (listing_draw){wo, 0.0f, 0.0f};
    float g1_i = fminf(1.0f, 2.0f * m.z * wi.z / im), g1_o = fminf(1.0f, 2.0f * m.z * wo.z / im);
    float pdf = distribution(m, ax, ay) * g1_i / (4.0f * wi.z);
    return (listing_draw){wo, pdf, fminf(g1_i, g1_o) / g1_i};
}

/* Giles 2010, single precision */
static float erfinv(float x) {
    float w = -logf((1.0f - x) * (1.0f + x)), p;
    if (w < 5.0f) {
        static const float c[] = {3.43273939e-07f, -3.5233877e-06f, -4.39150654e-06f,
                                  0.00021858087f,  -0.00125372503f, -0.00417768164f,
                                  0.246640727f,    1.50140941f};
        w -= 2.5f;
        p = 2.81022636e-08f;
        for (int k = 0; k < 8; ++k) p = p * w + c[k];
    } else {
        static const float c[] = {0.000100950558f, 0.00134934322f, -0.00367342844f, 0.00573950773f,
                                  -0.0076224613f,  0.00943887047f, 1.00167406f,     2.83297682f};
        w = sqrtf(w) - 3.0f;
        p = -0.000200214257f;
        for (int k = 0; k < 8; ++k) p = p * w + c[k];
    }
    return p * x;
}

static float beckmann_distribution(vec3 m, float ax, float ay) {
    float x = m.x / (ax * m.z), y = m.y / (ay * m.z), z2 = m.z * m.z;
    return expf(-(x * x + y * y)) / (PI * ax * ay * z2 * z2);
}

static float beckmann_lambda(vec3 v, float ax, float ay) {
    float x = ax * v.x, y = ay * v.y, a = fabsf(v.z) / sqrtf(x * x + y * y);
    return 0.5f * (erff(a) - 1.0f + expf(-a * a) / (a * sqrtf(PI)));
}

/* Jakob 2014: three steps of Newton's method in the error function of the slope */
static listing_draw newton(vec3 wi, float ax, float ay, float u1, float u2, float u3) {
    (void)u3;
    vec3 s = normalize((vec3){ax * wi.x, ay * wi.y, wi.z});
    float phi = atan2f(s.y, s.x), theta = acosf(s.z), tangent = tanf(theta);
    float erf_max = erff(1.0f / tangent);
    float scale = 1.0f / (1.0f + erf_max + tangent * expf(-1.0f / (tangent * tangent)) / sqrtf(PI));
    float fit = 1.0f + theta * (-0.876f + theta * (0.4265f - 0.0594f * theta));
    float u = fmaxf(u1, 1e-6f), b = erf_max - (1.0f + erf_max) * powf(1.0f - u, fit);
    for (int step = 0; step < 3; ++step) {
        float x = erfinv(b);
        float value = scale * (1.0f + b + tangent * expf(-x * x) / sqrtf(PI)) - u;
        b -= value / (scale * (1.0f - x * tangent));
    }
    float along = erfinv(b), across = erfinv(2.0f * fmaxf(u2, 1e-6f) - 1.0f);
    float c = cosf(phi), sn = sinf(phi);
    float x = ax * (c * along - sn * across), y = ay * (sn * along + c * across);
    vec3 m = normalize((vec3){-x, -y, 1.0f});
    float im = dot(wi, m);
    vec3 wo = {2.0f * im * m.x - wi.x, 2.0f * im * m.y - wi.y, 2.0f * im * m.z - wi.z};
    if (wo.z <= 0.0f) return (listing_draw){wo, 0.0f, 0.0f};
    float lambda_i = beckmann_lambda(wi, ax, ay), lambda_o = beckmann_lambda(wo, ax, ay);
    float pdf = beckmann_distribution(m, ax, ay) / ((1.0f + lambda_i) * 4.0f * wi.z);
    return (listing_draw){wo, pdf, (1.0f + lambda_i) / (1.0f + lambda_i + lambda_o)};
}

listing *lobe_listing_of(lobe_model model) {
    static listing *const smith_ggx[LOBE_METHOD_COUNT] = {
        [LOBE_METHOD_NDF] = ndf,     [LOBE_METHOD_SLOPE_PUBLISHED] = slope,
        [LOBE_METHOD_SLOPE] = slope, [LOBE_METHOD_ELLIPSOID] = ellipsoid,
        [LOBE_METHOD_CAPS] = caps,   [LOBE_METHOD_BOUNDED] = bounded,
    };
    const int is_ggx = model.ndf == LOBE_NDF_GGX, is_smith = model.masking == LOBE_MASKING_SMITH;
    if (is_smith && is_ggx) return smith_ggx[model.method];
    if (is_smith && model.method == LOBE_METHOD_NEWTON) return newton;
    if (is_ggx && model.method == LOBE_METHOD_VCAVITY) return vcavity;
    return NULL;
}
