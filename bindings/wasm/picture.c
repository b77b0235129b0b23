/* A brushed metal sphere in a studio, by both methods at equal samples and with the same random numbers.
 * Rows of pixels are made one call at a time, so that whoever asks can stop between them. */
#include "host.h"
#include "page.h"

#include <math.h>

enum { SIDE = 256, MOST = 256 };

typedef lobe_vec3_f32 vec3;

static unsigned char pixels[METHODS][SIDE * SIDE * 4];
static double noise[METHODS]; /* sums over the pixels of the variance of their mean */

EXPORT(picture_side) int page_picture_side(void);
int page_picture_side(void) {
    return SIDE;
}

EXPORT(picture_at) unsigned char *page_picture_at(int method);
/* RGBA, rows from the top; transparent around the sphere. */
unsigned char *page_picture_at(int method) {
    return pixels[method];
}

EXPORT(picture_noise) double page_picture_noise(int method);
/* The mean variance of the pixels of the rows since row 0. */
double page_picture_noise(int method) {
    return noise[method] / (0.7853981633974483 * SIDE * SIDE);
}

static float within(float x, float edge, float soft) {
    const float t = (edge - fabsf(x)) / soft;
    return t < 0 ? 0 : t > 1 ? 1 : t;
}

/* A window of light: square to `axis`, with half sides w and h. */
static float window(vec3 d, vec3 axis, float w, float h) {
    const float along = page_dot(d, axis);
    if (along <= 0.05f) return 0;
    const vec3 right = page_unit((vec3){axis.z, 0, -axis.x});
    const vec3 up = {axis.y * right.z - axis.z * right.y, axis.z * right.x - axis.x * right.z,
                     axis.x * right.y - axis.y * right.x};
    return within(page_dot(d, right) / along, w, 0.05f) * within(page_dot(d, up) / along, h, 0.05f);
}

/* y up: a dim room with a large window, a long lamp and a small bright one. */
static vec3 radiance(vec3 d) {
    const float room = d.y > 0 ? 0.12f + 0.2f * d.y : 0.12f * (1 + 0.6f * d.y);
    const float left = 4 * window(d, (vec3){-0.64f, 0.48f, 0.6f}, 0.45f, 0.6f);
    const float right = 5 * window(d, (vec3){0.8f, 0.36f, 0.48f}, 0.12f, 0.8f);
    const float back = 14 * window(d, (vec3){0.28f, 0.6f, -0.7491f}, 0.25f, 0.12f);
    return (vec3){room + 0.9f * left + right + back, room + left + 0.94f * right + 0.9f * back,
                  1.15f * room + 1.1f * left + 0.85f * right + 0.75f * back};
}

static unsigned char shown(float x) {
    const float mapped = x / (1 + 0.55f * x); /* lights burn out softly */
    const float y = mapped <= 0.0031308f
                        ? 12.92f * mapped
                        : 1.055f * (float)host_pow((double)page_min(mapped, 1), 1 / 2.4) - 0.055f;
    return (unsigned char)(255 * y + 0.5f);
}

static void put(int method, int at, vec3 c, float alpha) {
    unsigned char *p = pixels[method] + 4 * at;
    p[0] = shown(c.x);
    p[1] = shown(c.y);
    p[2] = shown(c.z);
    p[3] = (unsigned char)(255 * alpha + 0.5f);
}

/* The mean of what the draws of the pixel see; the reflectance is gold's, by Schlick. */
static vec3 seen(int method, vec3 x, vec3 y, vec3 n, int samples) {
    page_draw_rows(method, 0, samples);
    const rows *r = &page_rows[method];
    vec3 sum = {0, 0, 0};
    double first = 0, second = 0;
    for (int k = 0; k < samples; ++k) {
        float green = 0;
        if (r->pdf[k] > 0) {
            const float a = r->wo[0][k], b = r->wo[1][k], c = r->wo[2][k];
            const vec3 light =
                radiance((vec3){a * x.x + b * y.x + c * n.x, a * x.y + b * y.y + c * n.y,
                                a * x.z + b * y.z + c * n.z});
            const float cosine = r->cos_im[k], w = r->weight[k];
            green = w * light.y * lobe_fresnel_schlick_f32(0.78f, cosine);
            sum.x += w * light.x * lobe_fresnel_schlick_f32(0.94f, cosine);
            sum.y += green;
            sum.z += w * light.z * lobe_fresnel_schlick_f32(0.5f, cosine);
        }
        first += (double)green;
        second += (double)(green * green);
    }
    if (samples > 1)
        noise[method] += (second - first * first / samples) / ((double)samples * (samples - 1));
    return page_scaled(sum, 1 / (float)samples);
}

static void numbers_of_pixel(uint64_t seed, int pixel, int samples) {
    for (int k = 0; k < samples; ++k) {
        const lobe_random4 words = lobe_random(seed, (uint64_t)pixel + 2, (uint64_t)k);
        for (int j = 0; j < 3; ++j) page_numbers[j][k] = lobe_random_unit_f32(words.word[j]);
    }
}

static void make_pixel(int at, float px, float py, uint64_t seed, int samples) {
    const vec3 n = {px, py, sqrtf(page_max(1 - px * px - py * py, 0))}, view = {0, 0, 1};
    /* brushed around the axis of a lathe that stands upright */
    const float length = sqrtf(n.x * n.x + n.z * n.z);
    const vec3 x = length > 1e-4f ? (vec3){n.z / length, 0, -n.x / length} : (vec3){1, 0, 0};
    const vec3 y = {n.y * x.z - n.z * x.y, n.z * x.x - n.x * x.z, n.x * x.y - n.y * x.x};
    const vec3 wi = {page_dot(view, x), page_dot(view, y), page_dot(view, n)};
    numbers_of_pixel(seed, at, samples);
    for (int method = 0; method < METHODS; ++method) {
        const scene *s = &page_scene[method];
        page_model[method] = lobe_reflection_prepare_f32(s->options, wi, s->alpha[0], s->alpha[1]);
        put(method, at, seen(method, x, y, n, samples), 1);
    }
}

EXPORT(picture_rows) void page_picture_rows(int first, int count, int seed, int samples);
/* The rows from `first` on, of the methods and the roughness that were prepared last. Uses the arrays of draws
 * and numbers, and leaves both models as those of a pixel. */
void page_picture_rows(int first, int count, int seed, int samples) {
    const int n = samples < MOST ? samples : MOST;
    if (first == 0) noise[0] = noise[1] = 0;
    for (int at = first * SIDE; at < (first + count) * SIDE; ++at) {
        const float px = 1.02f * (2 * ((float)(at % SIDE) + 0.5f) / SIDE - 1);
        const float py = 1.02f * (1 - 2 * ((float)(at / SIDE) + 0.5f) / SIDE);
        if (px * px + py * py < 0.999f)
            make_pixel(at, px, py, (uint64_t)seed, n);
        else
            for (int method = 0; method < METHODS; ++method) put(method, at, (vec3){0, 0, 0}, 0);
    }
}
