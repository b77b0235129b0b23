#include "environment.h"

#include <stdlib.h>

#include "circle.h"

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
    e->texels_per_turn = (float)count / (2.0f * LOBE_PI * LOBE_PI);
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

/* The direction at the point (x, y) of the picture, in texels; `sine` is that of the angle from +Y. */
static vec3 direction_at(const image *picture, float x, float y, float *sine) {
    float across, along, down;
    circle_at(x / (float)picture->width - 0.5f, &across, &along);
    circle_at(0.5f * y / (float)picture->height, sine, &down);
    return v3(*sine * along, down, *sine * across);
}

int lobe_environment_sky(image *picture) {
    if (!lobe_image_create(picture, 512, 256)) return 0;
    for (int y = 0; y < picture->height; y++)
        for (int x = 0; x < picture->width; x++) {
            float sine;
            const vec3 d = direction_at(picture, (float)x + 0.5f, (float)y + 0.5f, &sine);
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
    const float width = (float)e->picture.width, height = (float)e->picture.height;
    const float sine = sqrtf(d.x * d.x + d.z * d.z);
    const float x = (0.5f + circle_turns(d.z, d.x)) * width;
    const float y = 2.0f * circle_turns(sine, d.y) * height;
    return (sky_place){x < width ? x : width, y < height ? y : height, sine};
}

static vec3 radiance_at(const image *p, float x, float y) {
    const float left = x - 0.5f, top = y - 0.5f;
    const int i = (int)left - (left < 0.0f), j = (int)top - (top < 0.0f);
    const float right_share = left - (float)i, low_share = top - (float)j;
    vec3 upper, lower;
    if (i >= 0 && i + 1 < p->width && j >= 0 && j + 1 < p->height) {
        const vec3 *corner = p->pixels + (size_t)j * (size_t)p->width + i;
        upper = v3_lerp(corner[0], corner[1], right_share);
        lower = v3_lerp(corner[p->width], corner[p->width + 1], right_share);
    } else {
        upper = v3_lerp(texel_at(p, i, j), texel_at(p, i + 1, j), right_share);
        lower = v3_lerp(texel_at(p, i, j + 1), texel_at(p, i + 1, j + 1), right_share);
    }
    return v3_lerp(upper, lower, low_share);
}

static float density(const environment *e, float share, float sine) {
    return sine > 0.0f ? share * e->texels_per_turn / sine : 0.0f;
}

static float density_at(const environment *e, sky_place at) {
    if (!e->table.cells) return 0.0f;
    const int right = e->picture.width - 1, bottom = e->picture.height - 1;
    const int column = at.x < (float)right ? (int)at.x : right;
    const int row = at.y < (float)bottom ? (int)at.y : bottom;
    const size_t i = (size_t)row * (size_t)e->picture.width + (size_t)column;
    return density(e, e->table.cells[i].share, at.sine);
}

vec3 lobe_environment_at(const environment *e, vec3 direction) {
    const sky_place at = place_of(e, direction);
    return radiance_at(&e->picture, at.x, at.y);
}

float lobe_environment_pdf(const environment *e, vec3 direction) {
    return density_at(e, place_of(e, direction));
}

vec3 lobe_environment_meet(const environment *e, vec3 direction, float *pdf) {
    const sky_place at = place_of(e, direction);
    *pdf = density_at(e, at);
    return radiance_at(&e->picture, at.x, at.y);
}

sky_draw lobe_environment_draw(const environment *e, const uint32_t bits[3]) {
    const image *p = &e->picture;
    const uint64_t place = (uint64_t)bits[0] * e->table.count;
    const float rest = (float)((uint32_t)place >> 8) * 0x1p-24f;
    const alias_choice choice = alias_draw(&e->table, bits[0], rest);
    const uint32_t row = choice.index / (uint32_t)p->width;
    const uint32_t column = choice.index - row * (uint32_t)p->width;
    const float x = (float)column + (float)(bits[1] >> 8) * 0x1p-24f;
    const float y = (float)row + (float)(bits[2] >> 8) * 0x1p-24f;
    float sine;
    const vec3 d = direction_at(p, x, y, &sine);
    return (sky_draw){rotate(e, d, e->sine), radiance_at(p, x, y), density(e, choice.share, sine)};
}
