/* tests/ssr/test_light.c: draws, weights and light: a furnace, the albedo of the lobe, the spread of the
 * random numbers, the bias, the history. */
#include "frames.h"

#include "ssr/pipeline.h"

static lobe_ssr_options rough(lobe_method method) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.method = method;
    o.fade_start = o.fade_end = 1.0f;
    o.bias = 0.0f;
    return o;
}

/* Constant light from the screen and from outside gives constant light, by every resolve and sampler. */
static void constant_light_stays_constant(void **state) {
    (void)state;
    const float white[3] = {1.0f, 1.0f, 1.0f};
    made_frame m = make_room(64, 36, 0.6f);
    m.frame.environment = (lobe_ssr_environment){1, 1, 1, white};
    for (int resolve = 0; resolve <= LOBE_SSR_OWN; resolve++)
        for (int row = 0; row < lobe_model_count(); row++) {
            const lobe_model model = lobe_model_at(row);
            if (model.ndf != LOBE_NDF_GGX || model.masking != LOBE_MASKING_SMITH) continue;
            lobe_ssr_options o = rough(model.method);
            o.resolve = (lobe_ssr_resolve)resolve;
            lobe_ssr *ssr = open_ssr(&m, o);
            for (int frame = 0; frame < 2; frame++) run_frame(ssr, &m);
            int reflecting = 0;
            for (int i = 0; i < 64 * 36; i++) {
                const float *r = lobe_ssr_reflection(ssr) + 4 * i;
                reflecting += r[3] > 0.1f;
                for (int k = 0; k < 3; k++) {
                    assert_true(fabsf(r[k] - r[3]) < 1e-5f);
                    assert_true(fabsf(lobe_ssr_radiance(ssr)[3 * i + k] - 1.0f) < 1e-5f);
                }
            }
            assert_true(reflecting > 600);
            lobe_ssr_free(ssr);
        }
    free_frame(&m);
}

/* Every pixel sees the same: the mean weight, drops as 0, is the albedo. 5 sigma of independent draws; the
 * draws are spread better than that. */
static void the_mean_weight_is_the_albedo(void **state) {
    (void)state;
    enum { SIZE = 64, FRAMES = 4 };
    made_frame m = make_frame(SIZE, SIZE, 0.01f);
    const lobe_vec3_f32 v = pixel_direction(&m, SIZE / 2, SIZE / 2);
    for (int i = 0; i < SIZE * SIZE; i++) {
        m.z[i] = 3.0f;
        m.normal[3 * i + 1] = 1.0f; /* seen at a flat angle */
        m.roughness[i] = 0.7f;
    }
    const float mu = -v.y / sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
    const lobe_method methods[] = {LOBE_METHOD_ELLIPSOID, LOBE_METHOD_BOUNDED, LOBE_METHOD_HORIZON,
                                   LOBE_METHOD_NDF};
    double expected = 0.0, last = 0.0;
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++) {
        lobe_ssr *ssr = open_ssr(&m, rough(methods[k]));
        double sum = 0.0, squares = 0.0, count = 0.0;
        for (int frame = 0; frame < FRAMES; frame++) {
            run_frame(ssr, &m);
            for (int i = 0; i < SIZE * SIZE; i++) {
                const lobe_ssr_ray *ray = &lobe_ssr_rays(ssr)[i];
                assert_true(ray->state != LOBE_SSR_NO_RAY);
                const double w = ray->state == LOBE_SSR_REJECTED ? 0.0 : (double)ray->weight;
                sum += w;
                squares += w * w;
                count += 1.0;
            }
        }
        const double mean = sum / count, sigma = sqrt((squares / count - mean * mean) / count);
        /* against draws of the same lobe made one by one */
        lobe_reflection_options options = lobe_reflection_default_options();
        options.model.method = LOBE_METHOD_BOUNDED;
        const lobe_reflection_f32 model = lobe_reflection_prepare_f32(
            options, (lobe_vec3_f32){sqrtf(1.0f - mu * mu), 0.0f, mu}, 0.49f, 0.49f);
        expected = last = 0.0;
        for (int i = 0; i < 40000; i++) {
            const lobe_random4 u = lobe_random(5, 0, (uint64_t)i);
            const float w = lobe_reflection_sample_f32(&model, lobe_random_unit_f32(u.word[0]),
                                                       lobe_random_unit_f32(u.word[1]), 0.0f)
                                .weight;
            expected += (double)w / 40000;
            last += (double)w * (double)w / 40000;
        }
        const double own = sqrt((last - expected * expected) / 40000);
        print_message("%s: %.4f, expected %.4f, sigma %.4f\n", lobe_method_name(methods[k]), mean,
                      expected, hypot(sigma, own));
        assert_true(fabs(mean - expected) < 5.0 * hypot(sigma, own) + 1e-3);
        lobe_ssr_free(ssr);
    }
    free_frame(&m);
}

/* In the first frame each number of an aligned 4 x 4 block lies in another sixteenth. */
static void neighbours_share_out_the_random_numbers(void **state) {
    (void)state;
    const ssr_noise_keys keys = lobe_ssr_noise_keys(0, 0);
    for (int block = 0; block < 128; block++) {
        unsigned seen[2] = {0, 0}, pairs = 0;
        for (int k = 0; k < 16; k++) {
            const ssr_noise n = ssr_noise_of(keys, (kword)(block % 16 * 4 + k % 4),
                                             (kword)(block / 16 * 4 + k / 4));
            const float u[3] = {n.u1, n.u2, n.u3};
            for (int d = 0; d < 3; d++) assert_true(u[d] >= 0.0f && u[d] < 1.0f);
            seen[0] |= 1u << (int)(16.0f * u[0]);
            seen[1] |= 1u << (int)(16.0f * u[1]);
            pairs |= 1u << ((int)(4.0f * u[0]) * 4 + (int)(4.0f * u[1]));
        }
        assert_true(seen[0] == 0xffffu && seen[1] == 0xffffu && pairs == 0xffffu);
    }
}

/* A bias draws nearer to the mirrored direction, by every method for which one is known. */
static void a_bias_shortens_the_lobe(void **state) {
    (void)state;
    made_frame m = make_room(96, 54, 0.7f);
    for (int row = 0; row < lobe_model_count(); row++) {
        const lobe_model model = lobe_model_at(row);
        if (model.ndf != LOBE_NDF_GGX || model.masking != LOBE_MASKING_SMITH) continue;
        if (!lobe_ssr_has_bias(model.method)) continue;
        double mean[2];
        for (int biased = 0; biased < 2; biased++) {
            lobe_ssr_options o = rough(model.method);
            o.mode = model.method == LOBE_METHOD_NDF ? LOBE_SSR_NDF : LOBE_SSR_VNDF;
            o.bias = biased ? 0.9f : 0.0f;
            lobe_ssr *ssr = open_ssr(&m, o);
            run_frame(ssr, &m);
            lobe_vec3_f32 sum = {0};
            double count = 0.0;
            for (int i = 0; i < 96 * 54; i++) {
                const lobe_ssr_ray *ray = &lobe_ssr_rays(ssr)[i];
                if (m.roughness[i] > 0.8f || ray->state == LOBE_SSR_NO_RAY || ray->pdf == 0.0f)
                    continue;
                sum.x += ray->direction.x;
                sum.y += ray->direction.y;
                sum.z += ray->direction.z;
                count += 1.0;
            }
            mean[biased] = sqrt((double)(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z)) / count;
            lobe_ssr_free(ssr);
        }
        print_message("%s: %.3f, biased %.3f\n", lobe_method_name(model.method), mean[0], mean[1]);
        assert_true(mean[1] > mean[0] + 0.1);
    }
    free_frame(&m);
}

static double noise_of(lobe_ssr *ssr, const made_frame *m) {
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (int i = 0; i < m->width * m->height; i++) {
        if (m->roughness[i] > 0.8f) continue;
        const double c = (double)lobe_ssr_radiance(ssr)[3 * i];
        sum += c;
        squares += c * c;
        count += 1.0;
    }
    return squares / count - sum / count * (sum / count);
}

/* Stripes on the wall: history lowers the variance while nothing moves, and ends where all is new. */
static void history_averages_and_is_dropped(void **state) {
    (void)state;
    made_frame m = make_room(192, 108, 0.6f);
    for (int i = 0; i < 192 * 108; i++)
        for (int k = 0; k < 3; k++) m.color[3 * i + k] = i % 192 / 4 % 2 ? 4.0f : 0.0f;
    lobe_ssr *ssr = open_ssr(&m, rough(LOBE_METHOD_BOUNDED));
    run_frame(ssr, &m);
    assert_memory_equal(lobe_ssr_reflection(ssr), lobe_ssr_resolved(ssr), 16 * 192 * 108);
    const double first = noise_of(ssr, &m);
    for (int frame = 0; frame < 12; frame++) run_frame(ssr, &m);
    const double later = noise_of(ssr, &m);
    print_message("variance %.4f, after 12 frames %.4f\n", first, later);
    assert_true(later < 0.8 * first);
    /* twenty pixels of motion a frame: speed 20 * 0.5 * 0.2 keeps no history */
    for (int i = 0; i < 192 * 108; i++) m.motion[2 * i] = 20.0f / 192.0f;
    run_frame(ssr, &m);
    assert_memory_equal(lobe_ssr_reflection(ssr), lobe_ssr_resolved(ssr), 16 * 192 * 108);
    /* another surface stands there now */
    memset(m.motion, 0, sizeof(float) * 2 * 192 * 108);
    for (int i = 0; i < 192 * 108; i++) m.z[i] *= 0.5f;
    run_frame(ssr, &m);
    assert_memory_equal(lobe_ssr_reflection(ssr), lobe_ssr_resolved(ssr), 16 * 192 * 108);
    lobe_ssr_free(ssr);
    free_frame(&m);
}

static void fades_end_where_they_should(void **state) {
    (void)state;
    assert_true(ssr_edge_fade(0.0f, 0.1f) == 0.0f && ssr_edge_fade(1.0f, 0.1f) == 0.0f);
    assert_true(ssr_edge_fade(0.5f, 0.1f) == 1.0f && ssr_edge_fade(0.05f, 0.1f) == 1.0f);
    assert_true(fabsf(ssr_edge_fade(0.025f, 0.1f) - 0.5f) < 1e-6f);
    assert_true(ssr_edge_fade(1.01f, 0.1f) == 0.0f && ssr_edge_fade(0.0f, 0.0f) == 1.0f);
    assert_true(ssr_roughness_fade(0.1f, 0.1f, 0.1f) == 1.0f);
    assert_true(ssr_roughness_fade(0.101f, 0.1f, 0.1f) == 0.0f);
    assert_true(fabsf(ssr_roughness_fade(0.3f, 0.2f, 0.4f) - 0.5f) < 1e-6f);
    assert_true(ssr_new_share(0.75f, 0.0f, 0.0f, 0.1f) == 0.25f);
    assert_true(ssr_new_share(0.75f, 5.0f, 5.0f, 0.1f) == 1.0f);
}

/* HDRP's weight does not see on which side of the world's plane z = 0 a direction is. */
static void the_weight_of_hdrp_is_even_in_z(void **state) {
    (void)state;
    ssr_resolved p = {.surface = {.alpha_x = 0.25f, .alpha_y = 0.25f}};
    for (int k = 0; k < 8; k++) {
        const float eye = k & 1 ? -0.6f : 0.6f, ray = k & 2 ? -0.28f : 0.28f;
        p.world_to_viewer = v3_of(0.8f, 0.0f, eye);
        const float seen = 1.0f + ggx_lambda(v3_of(0.8f, 0.0f, 0.6f), 0.25f, 0.25f);
        const float lit = ggx_lambda(v3_of(0.0f, 0.96f, 0.28f), 0.25f, 0.25f);
        const kint met = k & 4 ? SSR_HIT : SSR_MISS;
        const float weight = ssr_hdrp_weight(p, met, v3_of(0.0f, 0.96f, ray));
        assert_true(fabsf(weight - seen / (seen + lit)) < 1e-6f);
    }
    assert_true(ssr_hdrp_weight(p, SSR_REJECTED, v3_of(0.0f, 0.0f, -1.0f)) == 1.0f);
    assert_true(ssr_hdrp_weight(p, SSR_NO_RAY, v3_of(0.0f, 0.0f, 1.0f)) == 0.0f);
}

/* The ratio of a ray by how it ended: a hit whole, one that left the screen half, one that is lost 3 %. */
static void rays_weigh_by_what_they_tell(void **state) {
    (void)state;
    const ssr_surface surface = {.z = {0.0f, 1.0f, 0.0f},
                                 .x = {1.0f, 0.0f, 0.0f},
                                 .y = {0.0f, 0.0f, -1.0f},
                                 .to_viewer = {0.6f, 0.0f, 0.8f},
                                 .alpha_x = 0.25f,
                                 .alpha_y = 0.25f,
                                 .seen = 1};
    const ssr_resolved p = ssr_resolved_of(surface);
    const v3 ray = v3_of(-0.6f, 0.8f, 0.0f);
    const float whole = ssr_ray_weight(p, SSR_HIT, ray, 2.0f, false, false, SSR_CONFIDENCE);
    assert_true(whole > 0.0f);
    for (kint met = SSR_NO_RAY; met <= SSR_LOST; met++) {
        const float ratio =
            ssr_ray_weight(p, met, ray, 2.0f, false, false, SSR_NEIGHBOURHOOD_RATIO);
        const float sure = ssr_ray_weight(p, met, ray, 2.0f, false, false, SSR_CONFIDENCE);
        const float share = met == SSR_LOST ? 0.03f : met == SSR_MISS ? 0.5f : 1.0f;
        const bool traced = met != SSR_NO_RAY && met != SSR_REJECTED;
        assert_true(ratio == (traced ? whole : 0.0f));
        assert_true(fabsf(sure - share * ratio) <= 1e-6f * whole);
    }
}

/* A ray that leaves the screen finds the environment, one that is lost nothing. */
static void what_leaves_the_screen_finds_the_environment(void **state) {
    (void)state;
    const float red[3] = {3.0f, 0.0f, 0.0f};
    made_frame m = make_room(64, 36, 0.3f);
    m.frame.environment = (lobe_ssr_environment){1, 1, 1, red};
    lobe_ssr_options o = rough(LOBE_METHOD_BOUNDED);
    o.resolve = LOBE_SSR_CONFIDENCE;
    lobe_ssr *ssr = open_ssr(&m, o);
    run_frame(ssr, &m);
    int counts[SSR_LOST + 1] = {0};
    for (size_t i = 0; i < 64 * 36; i++) {
        const kint met = lobe_ssr_rays(ssr)[i].state;
        const float *found = ssr->found + 4 * i;
        counts[met]++;
        if (met == SSR_MISS) {
            assert_true(fabsf(found[0] - 3.0f) < 1e-5f);
            assert_true(found[1] == 0.0f && found[3] == 1.0f);
        }
        if (met == SSR_HIT) assert_true(found[0] <= 1.0f && found[0] == found[1]);
        if (met == SSR_LOST || met == SSR_REJECTED) assert_true(found[3] == 0.0f);
    }
    assert_true(counts[SSR_MISS] > 50 && counts[SSR_HIT] > 50 && counts[SSR_LOST] > 0);
    lobe_ssr_free(ssr);
    free_frame(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_light_stays_constant),
        cmocka_unit_test(the_mean_weight_is_the_albedo),
        cmocka_unit_test(neighbours_share_out_the_random_numbers),
        cmocka_unit_test(a_bias_shortens_the_lobe),
        cmocka_unit_test(history_averages_and_is_dropped),
        cmocka_unit_test(fades_end_where_they_should),
        cmocka_unit_test(rays_weigh_by_what_they_tell),
        cmocka_unit_test(what_leaves_the_screen_finds_the_environment),
        cmocka_unit_test(the_weight_of_hdrp_is_even_in_z)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
