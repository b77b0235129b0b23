#include "environment.h"

#include <stdlib.h>

#include "circle.h"

/* Radiance between texels is interpolated; beyond the poles it stays what it is. */
static sky_texel texel_at(const environment *e, int x, int y) {
    x = x < 0 ? x + e->width : x >= e->width ? x - e->width : x;
    y = y < 0 ? 0 : y >= e->height ? e->height - 1 : y;
    return e->texels[(size_t)y * (size_t)e->width + (size_t)x];
}

/* Mean luminance of the interpolated radiance over a texel: never 0 where light comes from. */
static double texel_power(const environment *e, int x, int y) {
    static const double share[3] = {0.125, 0.75, 0.125};
    double sum = 0.0;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++)
            sum += share[dx + 1] * share[dy + 1] *
                   (double)v3_luminance(texel_at(e, x + dx, y + dy).radiance);
    return sum;
}

static int make_table(environment *e, double *weights) {
    const uint32_t width = (uint32_t)e->width, count = width * (uint32_t)e->height;
    for (uint32_t i = 0; i < count; i++) {
        const int x = (int)(i % width), y = (int)(i / width);
        weights[i] = texel_power(e, x, y) * sin(3.14159265358979323846 * (y + 0.5) / e->height);
    }
    if (!lobe_alias_create(&e->table, weights, count)) return 0;
    for (uint32_t i = 0; e->table.cells && i < count; i++) e->texels[i].share = e->table.shares[i];
    return 1;
}

int lobe_environment_create(environment *e, image picture, float rotation_degrees) {
    const float radians = rotation_degrees * (LOBE_PI / 180.0f);
    const size_t count = (size_t)picture.width * (size_t)picture.height;
    *e = (environment){.width = picture.width,
                       .height = picture.height,
                       .sine = sinf(radians),
                       .cosine = cosf(radians),
                       .texels_per_turn = (float)count / (2.0f * LOBE_PI * LOBE_PI)};
    e->texels = malloc(count * sizeof *e->texels);
    double *weights = malloc(count * sizeof *weights);
    for (size_t i = 0; e->texels && i < count; i++)
        e->texels[i] = (sky_texel){picture.pixels[i], 0.0f};
    lobe_image_free(&picture);
    const int ok = e->texels && weights && make_table(e, weights);
    free(weights);
    return ok;
}

void lobe_environment_free(environment *e) {
    free(e->texels);
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

/* The direction at a point of a picture, (x, y) from 0 to 1; `sine` is that of the angle from +Y. */
static vec3 direction_at(float x, float y, float *sine) {
    float across, along, down;
    circle_at(x - 0.5f, &across, &along);
    circle_at(0.5f * y, sine, &down);
    return v3(*sine * along, down, *sine * across);
}

int lobe_environment_sky(image *picture) {
    if (!lobe_image_create(picture, 512, 256)) return 0;
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++) {
            float sine;
            const vec3 d = direction_at(((float)x + 0.5f) / (float)picture->width,
                                        ((float)y + 0.5f) / (float)picture->height, &sine);
            picture->pixels[y * picture->width + x] = sky_radiance(d);
        }
    return 1;
}

static vec3 rotate(const environment *e, vec3 d, float sine) {
    return v3(d.x * e->cosine + d.z * sine, d.y, d.z * e->cosine - d.x * sine);
}

/* A point of the picture, in texels, within it; `sine` of the angle from +Y. */
typedef struct sky_place {
    float x, y, sine;
} sky_place;

static sky_place place_of(const environment *e, vec3 world) {
    const vec3 d = rotate(e, world, -e->sine);
    const float width = (float)e->width, height = (float)e->height;
    const float sine = sqrtf(d.x * d.x + d.z * d.z);
    const float x = (0.5f + circle_turns(d.z, d.x)) * width;
    const float y = 2.0f * circle_turns(sine, d.y) * height;
    return (sky_place){x < width ? x : width, y < height ? y : height, sine};
}

static vec3 radiance_at(const environment *e, float x, float y) {
    const float left = x - 0.5f, top = y - 0.5f;
    const int i = (int)left - (left < 0.0f), j = (int)top - (top < 0.0f);
    const float right_share = left - (float)i, low_share = top - (float)j;
    vec3 upper, lower;
    if (i >= 0 && i + 1 < e->width && j >= 0 && j + 1 < e->height) {
        const sky_texel *up = e->texels + (size_t)j * (size_t)e->width + i, *low = up + e->width;
        upper = v3_lerp(up[0].radiance, up[1].radiance, right_share);
        lower = v3_lerp(low[0].radiance, low[1].radiance, right_share);
    } else {
        upper = v3_lerp(texel_at(e, i, j).radiance, texel_at(e, i + 1, j).radiance, right_share);
        lower = v3_lerp(texel_at(e, i, j + 1).radiance, texel_at(e, i + 1, j + 1).radiance,
                        right_share);
    }
    return v3_lerp(upper, lower, low_share);
}

static float density(const environment *e, float share, float sine) {
    return sine > 0.0f ? share * e->texels_per_turn / sine : 0.0f;
}

static float density_at(const environment *e, sky_place at) {
    const int right = e->width - 1, bottom = e->height - 1;
    const int column = at.x < (float)right ? (int)at.x : right;
    const int row = at.y < (float)bottom ? (int)at.y : bottom;
    return density(e, e->texels[(size_t)row * (size_t)e->width + (size_t)column].share, at.sine);
}

vec3 lobe_environment_at(const environment *e, vec3 direction) {
    const sky_place at = place_of(e, direction);
    return radiance_at(e, at.x, at.y);
}

float lobe_environment_pdf(const environment *e, vec3 direction) {
    return density_at(e, place_of(e, direction));
}

vec3 lobe_environment_meet(const environment *e, vec3 direction, float *pdf) {
    const sky_place at = place_of(e, direction);
    *pdf = density_at(e, at);
    return radiance_at(e, at.x, at.y);
}

void lobe_environment_prefetch(const environment *e, const uint32_t bits[3]) {
    alias_prefetch(&e->table, bits[0]);
}

sky_draw lobe_environment_draw(const environment *e, const uint32_t bits[3]) {
    const uint32_t i = alias_draw(&e->table, bits[0]), width = (uint32_t)e->width;
    const uint32_t row = i / width, column = i - row * width;
    const float x = (float)column + (float)(bits[1] >> 8) * 0x1p-24f;
    const float y = (float)row + (float)(bits[2] >> 8) * 0x1p-24f;
    /* the texels are far away: ask for the upper and the lower ones before the sines are computed */
    const sky_texel *texel = &e->texels[i];
    __builtin_prefetch(texel);
    if (row > 0) __builtin_prefetch(texel - width);
    if (row + 1 < (uint32_t)e->height) __builtin_prefetch(texel + width);
    float sine;
    const vec3 d = direction_at(x / (float)e->width, y / (float)e->height, &sine);
    return (sky_draw){rotate(e, d, e->sine), radiance_at(e, x, y), density(e, texel->share, sine)};
}
