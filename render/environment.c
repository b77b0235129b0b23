#include "environment.h"

#include <stdlib.h>

/* Radiance between texels is interpolated; beyond the poles it stays what it is. */
static vec3 texel_at(const image *p, int x, int y) {
    x = x < 0 ? x + p->width : x >= p->width ? x - p->width : x;
    y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
    return p->pixels[(size_t)y * (size_t)p->width + (size_t)x];
}

/* Mean luminance of the interpolated radiance over a texel: never 0 where light comes from. */
static double texel_power(const image *p, int x, int y) {
    static const double share[3] = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++)
            sum +=
                share[dx + 1] * share[dy + 1] * (double)v3_luminance(texel_at(p, x + dx, y + dy));
    return sum;
}

int lobe_environment_create(environment *e, image picture, float rotation_degrees) {
    float radians = rotation_degrees * (LOBE_PI / 180.0f);
    *e = (environment){.picture = picture, .sine = sinf(radians), .cosine = cosf(radians)};
    size_t count = (size_t)picture.width * (size_t)picture.height;
    double *weights = malloc(count * sizeof *weights);
    if (!weights) return 0;
    for (int y = 0; y < picture.height; y++) {
        double sine = sin(3.14159265358979323846 * (y + 0.5) / picture.height);
        for (int x = 0; x < picture.width; x++) {
            size_t i = (size_t)y * (size_t)picture.width + (size_t)x;
            weights[i] = texel_power(&picture, x, y) * sine;
        }
    }
    int ok = lobe_alias_create(&e->table, weights, (uint32_t)count);
    free(weights);
    return ok;
}

void lobe_environment_free(environment *e) {
    lobe_image_free(&e->picture);
    lobe_alias_free(&e->table);
}

int lobe_environment_constant(image *picture, vec3 radiance) {
    if (!lobe_image_create(picture, 4, 2)) return 0;
    for (int i = 0; i < 8; i++) picture->pixels[i] = radiance;
    return 1;
}

static vec3 sky_radiance(vec3 d) {
    const vec3 zenith = {0.09f, 0.19f, 0.42f}, horizon = {0.40f, 0.47f, 0.56f};
    const vec3 ground = {0.16f, 0.15f, 0.14f}, sun = {0.45f, 0.62f, 0.64f};
    float toward_sun = v3_dot(d, v3_normalize_or(sun, sun));
    float glow =
        powf(fmaxf(toward_sun, 0.0f), 60.0f) * 3.0f + (toward_sun > 0.9985f ? 20.0f : 0.0f);
    vec3 sky = v3_lerp(horizon, zenith, powf(fmaxf(d.y, 0.0f), 0.45f));
    sky = v3_add(sky, v3_scale(v3(1.0f, 0.9f, 0.72f), glow));
    return v3_lerp(ground, sky, clampf(d.y * 150.0f + 0.5f, 0.0f, 1.0f));
}

/* The direction at the point (x, y) of the picture, in texels. */
static vec3 direction_at(const image *picture, float x, float y) {
    float azimuth = 2.0f * LOBE_PI * (x / (float)picture->width - 0.5f);
    float polar = LOBE_PI * y / (float)picture->height;
    return v3(sinf(polar) * cosf(azimuth), cosf(polar), sinf(polar) * sinf(azimuth));
}

int lobe_environment_sky(image *picture) {
    if (!lobe_image_create(picture, 512, 256)) return 0;
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++)
            picture->pixels[y * picture->width + x] =
                sky_radiance(direction_at(picture, (float)x + 0.5f, (float)y + 0.5f));
    return 1;
}

static vec3 rotate(const environment *e, vec3 d, float sine) {
    return v3(d.x * e->cosine + d.z * sine, d.y, d.z * e->cosine - d.x * sine);
}

/* Where a direction (world) lies on the picture, in texels, each within the picture. */
static void place_of(const environment *e, vec3 world, float *x, float *y, float *sine) {
    vec3 d = rotate(e, world, -e->sine);
    float u = 0.5f + atan2f(d.z, d.x) / (2.0f * LOBE_PI);
    float v = acosf(clampf(d.y, -1.0f, 1.0f)) / LOBE_PI;
    *x = clampf(u * (float)e->picture.width, 0.0f, (float)e->picture.width);
    *y = clampf(v * (float)e->picture.height, 0.0f, (float)e->picture.height);
    *sine = sinf(LOBE_PI * v);
}

vec3 lobe_environment_at(const environment *e, vec3 direction) {
    float x, y, sine;
    place_of(e, direction, &x, &y, &sine);
    float left = floorf(x - 0.5f), top = floorf(y - 0.5f);
    float right_share = x - 0.5f - left, low_share = y - 0.5f - top;
    int i = (int)left, j = (int)top;
    const image *p = &e->picture;
    vec3 upper = v3_lerp(texel_at(p, i, j), texel_at(p, i + 1, j), right_share);
    vec3 lower = v3_lerp(texel_at(p, i, j + 1), texel_at(p, i + 1, j + 1), right_share);
    return v3_lerp(upper, lower, low_share);
}

static float density(const environment *e, float share, float sine) {
    float texels = (float)e->picture.width * (float)e->picture.height;
    return sine > 0.0f ? share * texels / (2.0f * LOBE_PI * LOBE_PI * sine) : 0.0f;
}

float lobe_environment_pdf(const environment *e, vec3 direction) {
    if (!e->table.cells) return 0.0f;
    float x, y, sine;
    place_of(e, direction, &x, &y, &sine);
    int column = (int)fminf(x, (float)(e->picture.width - 1));
    int row = (int)fminf(y, (float)(e->picture.height - 1));
    size_t i = (size_t)row * (size_t)e->picture.width + (size_t)column;
    return density(e, e->table.cells[i].share, sine);
}

vec3 lobe_environment_draw(const environment *e, const uint32_t bits[3], float *pdf) {
    const image *p = &e->picture;
    uint64_t place = (uint64_t)bits[0] * e->table.count;
    float rest = (float)((uint32_t)place >> 8) * 0x1p-24f;
    uint32_t i = alias_draw(&e->table, bits[0], rest);
    float x = (float)(i % (uint32_t)p->width) + (float)(bits[1] >> 8) * 0x1p-24f;
    float y = (float)(i / (uint32_t)p->width) + (float)(bits[2] >> 8) * 0x1p-24f;
    vec3 d = direction_at(p, x, y);
    *pdf = density(e, e->table.cells[i].share, sinf(LOBE_PI * y / (float)p->height));
    return rotate(e, d, e->sine);
}
