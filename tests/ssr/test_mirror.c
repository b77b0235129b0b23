/* tests/ssr/test_mirror.c: a mirror floor before a wall, whose reflection is known exactly. */
#include "frames.h"

/* Where the mirrored ray of a floor pixel meets the wall, in pixels; 0: it leaves the screen. */
static int exact_meeting(const made_frame *m, int x, int y, float at[2]) {
    const lobe_ssr_camera *c = &m->frame.camera;
    const lobe_vec3_f32 d = pixel_direction(m, x, y);
    const float t = -c->eye.y / d.y;
    const lobe_vec3_f32 p = {c->eye.x + t * d.x, 0.0f, c->eye.z + t * d.z};
    const float u = (WALL_Z - p.z) / d.z;
    const lobe_vec3_f32 q = {p.x + u * d.x - c->eye.x, -u * d.y - c->eye.y, WALL_Z - c->eye.z};
    const float right = q.x * c->right.x + q.y * c->right.y + q.z * c->right.z;
    const float up = q.x * c->up.x + q.y * c->up.y + q.z * c->up.z;
    const float z = q.x * c->forward.x + q.y * c->forward.y + q.z * c->forward.z;
    at[0] = 0.5f * (float)m->width * (1.0f + right / (z * c->tan_x));
    at[1] = 0.5f * (float)m->height * (1.0f - up / (z * c->tan_y));
    return at[0] > 0.5f && at[0] < (float)m->width - 0.5f && at[1] > 0.5f &&
           at[1] < (float)m->height - 0.5f;
}

static void the_floor_mirrors_the_wall(void **state) {
    (void)state;
    made_frame m = make_room(320, 180, 0.0f);
    for (int y = 0; y < m.height; y++)
        for (int x = 0; x < m.width; x++) {
            float *color = m.color + 3 * (y * m.width + x);
            color[0] = (float)x / 320.0f;
            color[1] = (float)y / 180.0f;
        }
    lobe_ssr_options o = lobe_ssr_default_options();
    o.mode = LOBE_SSR_MIRROR;
    o.edge_fade = 0.0f;
    lobe_ssr *ssr = open_ssr(&m, o);
    run_frame(ssr, &m);
    int expected = 0, found = 0, false_hits = 0;
    for (int y = 0; y < m.height; y++)
        for (int x = 0; x < m.width; x++) {
            const int i = y * m.width + x;
            if (m.roughness[i] > 0.5f) continue;
            float at[2];
            const int on_screen = exact_meeting(&m, x, y, at);
            const lobe_ssr_ray *ray = &lobe_ssr_rays(ssr)[i];
            const int hit = ray->state == LOBE_SSR_HIT;
            expected += on_screen;
            false_hits += hit && !on_screen;
            if (!on_screen || !hit) continue;
            const float error =
                fmaxf(fabsf((float)ray->x + 0.5f - at[0]), fabsf((float)ray->y + 0.5f - at[1]));
            found += error < 1.5f;
            const float *c = lobe_ssr_reflection(ssr) + 4 * i;
            assert_true(c[3] == 1.0f);
            assert_true(fabsf(c[0] * 320.0f - (float)ray->x) < 0.01f);
            assert_true(fabsf(c[1] * 180.0f - (float)ray->y) < 0.01f);
        }
    print_message("on screen %d, found %d, false %d\n", expected, found, false_hits);
    assert_true(expected > 5000);
    assert_true((double)found >= 0.99 * expected);
    assert_true((double)false_hits <= 0.01 * expected);
    lobe_ssr_free(ssr);
    free_frame(&m);
}

static void the_length_of_a_ray_is_that_of_the_world(void **state) {
    (void)state;
    made_frame m = make_room(320, 180, 0.0f);
    lobe_ssr_options o = lobe_ssr_default_options();
    o.mode = LOBE_SSR_MIRROR;
    lobe_ssr *ssr = open_ssr(&m, o);
    run_frame(ssr, &m);
    int count = 0;
    for (int i = 0; i < 320 * 180; i++) {
        const lobe_ssr_ray *ray = &lobe_ssr_rays(ssr)[i];
        if (ray->state != LOBE_SSR_HIT || m.z[ray->y * 320 + ray->x] < 6.0f) continue;
        const lobe_vec3_f32 d = pixel_direction(&m, i % 320, i / 320);
        const float z = m.frame.camera.eye.z - d.z / d.y * m.frame.camera.eye.y;
        const float length = (WALL_Z - z) / ray->direction.z;
        if (fabsf(ray->length - length) < 0.05f * length + 0.1f)
            count++;
        else
            count -= 100;
    }
    assert_true(count > 3000);
    lobe_ssr_free(ssr);
    free_frame(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_floor_mirrors_the_wall),
                                       cmocka_unit_test(the_length_of_a_ray_is_that_of_the_world)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
