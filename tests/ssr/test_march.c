/* tests/ssr/test_march.c: the pyramid against brute force, the hierarchical march against the linear one, and
 * both against a march in double that sorts all crossings of texels. */
#include "frames.h"

#include "ssr/pipeline.h"

static void a_cell_holds_the_extremes_of_its_pixels(void **state) {
    (void)state;
    made_frame m = make_frame(37, 21, 60.0f);
    for (size_t i = 0; i < 37 * 21; i++) m.z[i] = 60.0f * unit_random(1, i);
    lobe_ssr *ssr = open_ssr(&m, lobe_ssr_default_options());
    run_frame(ssr, &m);
    const pyramid *p = &ssr->pyramid;
    assert_int_equal(p->levels, 7);
    for (int level = 0; level < p->levels; level++)
        for (int y = 0; y < p->height[level]; y++)
            for (int x = 0; x < p->width[level]; x++) {
                float nearest = 0.0f, farthest = 1.0f;
                for (int py = 0; py < 21; py++)
                    for (int px = 0; px < 37; px++) {
                        if (px >> level != x || py >> level != y) continue;
                        const float d = p->depth[0][py * 37 + px].nearest;
                        nearest = fmaxf(nearest, d);
                        farthest = fminf(farthest, d);
                    }
                const ssr_cell cell = p->depth[level][y * p->width[level] + x];
                assert_true(cell.nearest == nearest && cell.farthest == farthest);
            }
    lobe_ssr_free(ssr);
    free_frame(&m);
}

/* Steps at several scales: objects before objects. */
static made_frame make_noise(int width, int height, uint64_t stream) {
    made_frame m = make_frame(width, height, 60.0f);
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            const size_t i = (size_t)y * (size_t)width + (size_t)x;
            const uint64_t block = (uint64_t)(y / 13) * 100 + (uint64_t)(x / 17);
            const float depth = 1.0f + 6.0f * unit_random(stream, block);
            m.z[i] = depth + 0.05f * unit_random(stream + 1, i);
            if (unit_random(stream + 2, block) < 0.1f) m.z[i] = 0.0f;
            for (size_t k = 0; k < 3; k++)
                m.normal[3 * i + k] = unit_random(stream + 3, 3 * (block + i / 7) + k) - 0.5f;
            m.roughness[i] = 0.0f;
        }
    return m;
}

static lobe_ssr_options marching(int linear) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.mode = LOBE_SSR_MIRROR;
    o.max_iterations = 1000000;
    o.thickness = 0.05f;
    o.linear_march = linear;
    return o;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Pixel (index) that the ray meets, -1: none. Texel by texel between sorted crossings. */
static int met_by_sorting(const lobe_ssr *s, ssr_ray r, ssr_slab slab) {
    double walls[2048];
    int count = 0, below = 0;
    if (!r.valid || r.end <= 0.5f) return -1;
    const double end = (double)r.end;
    const double origin[2] = {r.origin.x, r.origin.y}, along[2] = {r.direction.x, r.direction.y};
    walls[count++] = 0.5;
    walls[count++] = end;
    for (int axis = 0; axis < 2; axis++)
        for (int wall = 1; wall < (axis ? s->height : s->width); wall++) {
            const double q = (wall - origin[axis]) / along[axis];
            if (q > 0.5 && q < end) walls[count++] = q;
        }
    qsort(walls, (size_t)count, sizeof *walls, by_value);
    for (int i = 0; i + 1 < count; i++) {
        const double in = walls[i], out = walls[i + 1], middle = 0.5 * (in + out);
        if (out - in < 1e-3) continue; /* of rounding: the march looks that far beyond a wall */
        const int x = (int)floor(origin[0] + middle * along[0]);
        const int y = (int)floor(origin[1] + middle * along[1]);
        const double d = (double)s->pyramid.depth[0][y * s->width + x].nearest;
        const double base = (double)slab.scale * d - (double)slab.offset;
        const double z_in = (double)r.origin.z + in * (double)r.direction.z;
        const double z_out = (double)r.origin.z + out * (double)r.direction.z;
        const double low = fmin(z_in, z_out), high = fmax(z_in, z_out);
        if (low > d)
            below = 0;
        else if (high < base)
            below = 1;
        else
            return below && z_in <= d ? -1 : y * s->width + x;
    }
    return -1;
}

static int met(const lobe_ssr_ray *ray, int width) {
    return ray->state == LOBE_SSR_HIT ? ray->y * width + ray->x : -1;
}

static void the_pyramid_finds_what_the_linear_march_finds(void **state) {
    (void)state;
    enum { WIDTH = 211, HEIGHT = 137 };
    size_t rays = 0, hits = 0, same = 0, right = 0;
    uint64_t steps = 0, linear_steps = 0;
    for (uint64_t seed = 0; seed < 8; seed++) {
        made_frame m = make_noise(WIDTH, HEIGHT, 10 * seed);
        lobe_ssr *fast = open_ssr(&m, marching(0)), *slow = open_ssr(&m, marching(1));
        steps += run_frame(fast, &m).steps;
        linear_steps += run_frame(slow, &m).steps;
        const ssr_camera c = lobe_ssr_kernel_camera(fast, &m.frame.camera);
        const ssr_slab slab = ssr_slab_of(c, 0.05f);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const lobe_ssr_ray *a = &lobe_ssr_rays(fast)[i], *b = &lobe_ssr_rays(slow)[i];
            assert_int_equal(a->state == LOBE_SSR_NO_RAY, b->state == LOBE_SSR_NO_RAY);
            if (a->state == LOBE_SSR_NO_RAY || a->state == LOBE_SSR_REJECTED) continue;
            ssr_surface surface;
            assert_true(lobe_ssr_surface_at(&c, &m.frame, i % WIDTH, i / WIDTH, &surface));
            const float pull = 1.0f - 0.001f / k_max(surface.to_viewer.z, 1e-3f);
            const v3 direction = v3_of(a->direction.x, a->direction.y, a->direction.z);
            const ssr_ray r =
                ssr_ray_of(c, (float)(i % WIDTH) + 0.5f, (float)(i / WIDTH) + 0.5f,
                           lobe_ssr_z_at(&m.frame, (size_t)i) * k_max(pull, 1e-3f), direction);
            const int expected = met_by_sorting(fast, r, slab);
            rays++;
            hits += expected >= 0;
            same += a->state == b->state && met(a, WIDTH) == met(b, WIDTH);
            right += met(a, WIDTH) == expected;
        }
        lobe_ssr_free(fast);
        lobe_ssr_free(slow);
        free_frame(&m);
    }
    print_message("rays %zu, hits %zu, as linear %zu, as sorted %zu, steps %llu of %llu\n", rays,
                  hits, same, right, (unsigned long long)steps, (unsigned long long)linear_steps);
    assert_true(hits > rays / 20);
    assert_true((double)same >= 0.999 * (double)rays);
    assert_true((double)right >= 0.999 * (double)rays);
}

static void the_pyramid_saves_steps(void **state) {
    (void)state;
    made_frame m = make_room(640, 360, 0.0f);
    lobe_ssr *fast = open_ssr(&m, marching(0)), *slow = open_ssr(&m, marching(1));
    const lobe_ssr_statistics a = run_frame(fast, &m), b = run_frame(slow, &m);
    print_message("steps a ray %.1f of %.1f\n", (double)a.steps / (double)a.rays,
                  (double)b.steps / (double)b.rays);
    assert_int_equal(a.rays, b.rays);
    assert_true(4 * a.steps <= b.steps);
    lobe_ssr_free(fast);
    lobe_ssr_free(slow);
    free_frame(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cell_holds_the_extremes_of_its_pixels),
        cmocka_unit_test(the_pyramid_finds_what_the_linear_march_finds),
        cmocka_unit_test(the_pyramid_saves_steps)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
