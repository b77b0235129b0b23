/* tests/ssr/frames.h: frames made by hand: a floor, a wall behind it, or noise. */
#ifndef LOBE_TESTS_SSR_FRAMES_H
#define LOBE_TESTS_SSR_FRAMES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "lobe/random.h"
#include "lobe/ssr.h"

typedef struct made_frame {
    int width, height;
    float *z, *normal, *roughness, *color, *motion, *motion_z; /* motion_z: of no frame at first */
    lobe_ssr_frame frame;
} made_frame;

static inline made_frame make_frame(int width, int height, float degrees) {
    const size_t count = (size_t)width * (size_t)height;
    made_frame m = {.width = width, .height = height};
    m.z = calloc(count, sizeof(float));
    m.normal = calloc(3 * count, sizeof(float));
    m.roughness = calloc(count, sizeof(float));
    m.color = calloc(3 * count, sizeof(float));
    m.motion = calloc(2 * count, sizeof(float));
    m.motion_z = calloc(count, sizeof(float));
    assert_true(m.z && m.normal && m.roughness && m.color && m.motion && m.motion_z);
    m.frame = (lobe_ssr_frame){.z = m.z,
                               .normal = m.normal,
                               .roughness = m.roughness,
                               .motion = m.motion,
                               .previous_color = m.color};
    m.frame.camera = lobe_ssr_look_at((lobe_vec3_f32){0, 1, 0}, (lobe_vec3_f32){0, 0.6f, -3},
                                      (lobe_vec3_f32){0, 1, 0}, degrees,
                                      (float)width / (float)height, 0.05f, 50.0f);
    m.frame.previous_camera = m.frame.camera;
    return m;
}

static inline void free_frame(made_frame *m) {
    free(m->z);
    free(m->normal);
    free(m->roughness);
    free(m->color);
    free(m->motion);
    free(m->motion_z);
}

static inline float unit_random(uint64_t stream, uint64_t counter) {
    return lobe_random_unit_f32(lobe_random(11, stream, counter).word[0]);
}

/* From the eye through the centre of a pixel, with length 1 along the axis. */
static inline lobe_vec3_f32 pixel_direction(const made_frame *m, int x, int y) {
    const lobe_ssr_camera *c = &m->frame.camera;
    const float a = (2.0f * ((float)x + 0.5f) / (float)m->width - 1.0f) * c->tan_x;
    const float b = (1.0f - 2.0f * ((float)y + 0.5f) / (float)m->height) * c->tan_y;
    return (lobe_vec3_f32){c->forward.x + a * c->right.x + b * c->up.x,
                           c->forward.y + a * c->right.y + b * c->up.y,
                           c->forward.z + a * c->right.z + b * c->up.z};
}

enum { WALL_Z = -6 };

/* A floor y = 0 up to a wall z = -6 of its colours, roughness of the floor only. */
static inline made_frame make_room(int width, int height, float roughness) {
    made_frame m = make_frame(width, height, 50.0f);
    const lobe_vec3_f32 eye = m.frame.camera.eye;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const size_t i = (size_t)y * (size_t)width + (size_t)x;
            const lobe_vec3_f32 d = pixel_direction(&m, x, y);
            const float floor_t = d.y < 0.0f ? -eye.y / d.y : INFINITY;
            const float wall_t = (WALL_Z - eye.z) / d.z;
            const int is_floor = floor_t < wall_t;
            m.z[i] = is_floor ? floor_t : wall_t;
            m.normal[3 * i + (is_floor ? 1 : 2)] = 1.0f;
            m.roughness[i] = is_floor ? roughness : 1.0f;
            for (size_t k = 0; k < 3; k++) m.color[3 * i + k] = 1.0f;
        }
    return m;
}

static inline lobe_ssr *open_ssr(const made_frame *m, lobe_ssr_options options) {
    lobe_ssr *ssr = NULL;
    assert_int_equal(lobe_ssr_create(m->width, m->height, options, &ssr), LOBE_SSR_OK);
    return ssr;
}

static inline lobe_ssr_statistics run_frame(lobe_ssr *ssr, const made_frame *m) {
    lobe_ssr_statistics st;
    assert_int_equal(lobe_ssr_run(ssr, &m->frame, &st), LOBE_SSR_OK);
    return st;
}

/* No number of a result is out of the range that the header promises. */
static inline void check_finite(const lobe_ssr *ssr, const made_frame *m) {
    for (int i = 0; i < m->width * m->height; i++) {
        const lobe_ssr_ray *ray = &lobe_ssr_rays(ssr)[i];
        assert_true(ray->x >= -1 && ray->x < m->width && ray->y >= -1 && ray->y < m->height);
        assert_true(isfinite(ray->length) && ray->length >= 0.0f);
        for (int k = 0; k < 4; k++) assert_true(isfinite(lobe_ssr_reflection(ssr)[4 * i + k]));
        for (int k = 0; k < 3; k++) {
            assert_true(lobe_ssr_radiance(ssr)[3 * i + k] >= 0.0f);
            assert_true(isfinite(lobe_ssr_composite(ssr)[3 * i + k]));
        }
    }
}

/* Some of what a file may hold by mistake. */
static inline float odd_number(uint64_t stream, uint64_t i) {
    static const float odd[] = {NAN, INFINITY, -INFINITY, 0.0f, -1.0f, 3e38f, 1e-42f, 1.0f};
    return unit_random(stream, 2 * i) < 0.2f ? odd[(int)(8.0f * unit_random(stream, 2 * i + 1))]
                                             : 4.0f * unit_random(stream, 2 * i + 1);
}

static inline void fill_with_odd_numbers(made_frame *m, uint64_t stream) {
    const size_t count = (size_t)m->width * (size_t)m->height;
    m->frame.motion_z = m->motion_z;
    for (size_t i = 0; i < count; i++) {
        m->z[i] = odd_number(stream, i);
        m->motion_z[i] = odd_number(stream + 5, i);
        m->roughness[i] = 0.3f * odd_number(stream + 1, i);
        for (size_t k = 0; k < 3; k++) {
            m->normal[3 * i + k] = odd_number(stream + 2, 3 * i + k) - 1.0f;
            m->color[3 * i + k] = odd_number(stream + 3, 3 * i + k);
        }
        for (size_t k = 0; k < 2; k++)
            m->motion[2 * i + k] = 0.1f * odd_number(stream + 4, 2 * i + k);
    }
}

#endif
