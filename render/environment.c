#include "environment.h"

#include <stdlib.h>

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
            weights[i] = (double)v3_luminance(picture.pixels[i]) * sine;
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

/* The texel that a direction (world) falls into. */
static size_t texel_of(const environment *e, vec3 world, float *sine) {
    vec3 d = rotate(e, world, -e->sine);
    const image *p = &e->picture;
    float u = 0.5f + atan2f(d.z, d.x) / (2.0f * LOBE_PI);
    float v = acosf(clampf(d.y, -1.0f, 1.0f)) / LOBE_PI;
    int x = (int)(u * (float)p->width), y = (int)(v * (float)p->height);
    x = x < 0 ? 0 : x >= p->width ? p->width - 1 : x;
    y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
    *sine = sinf(LOBE_PI * v);
    return (size_t)y * (size_t)p->width + (size_t)x;
}

vec3 lobe_environment_at(const environment *e, vec3 direction) {
    float sine;
    return e->picture.pixels[texel_of(e, direction, &sine)];
}

static float density(const environment *e, float share, float sine) {
    float texels = (float)e->picture.width * (float)e->picture.height;
    return sine > 0.0f ? share * texels / (2.0f * LOBE_PI * LOBE_PI * sine) : 0.0f;
}

float lobe_environment_pdf(const environment *e, vec3 direction) {
    if (!e->table.cells) return 0.0f;
    float sine;
    size_t i = texel_of(e, direction, &sine);
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
