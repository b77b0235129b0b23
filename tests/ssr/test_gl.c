/* tests/ssr/test_gl.c: the passes on OpenGL give what they give on the processor; on whatever driver there is,
 * Mesa's llvmpipe at least. */
#include "frames.h"

#include <stdio.h>

#include "ssr/gl/driver_state.h"
#include "ssr/pipeline.h"

/* ---- One frame on both ----------------------------------------------------------------------- */

typedef struct both {
    lobe_ssr *cpu, *gl;
    int width, height;
    unsigned char *differ; /* the ray of a pixel, now or in the history */
    uint64_t rays, other_hits;
} both;

static both open_both(const made_frame *m, lobe_ssr_options o) {
    both b = {.width = m->width, .height = m->height};
    o.backend = LOBE_SSR_CPU;
    b.cpu = open_ssr(m, o);
    o.backend = LOBE_SSR_GL;
    b.gl = open_ssr(m, o);
    assert_int_equal(lobe_ssr_backend_of(b.gl), LOBE_SSR_GL);
    b.differ = calloc((size_t)m->width * (size_t)m->height, 1);
    assert_non_null(b.differ);
    return b;
}

static void close_both(both *b) {
    lobe_ssr_free(b->cpu);
    lobe_ssr_free(b->gl);
    free(b->differ);
}

/* What the GPU holds, `count` numbers. */
static float *read_buffer(const both *b, gl_buffer buffer, size_t count) {
    const gl_state *g = b->gl->driver_state;
    float *values = malloc(count * sizeof *values);
    assert_non_null(values);
    assert_int_equal(lobe_ssr_gl_take(&g->context), LOBE_SSR_OK);
    glGetNamedBufferSubData(g->buffer[buffer], 0, (GLsizeiptr)(count * sizeof *values), values);
    assert_int_equal(lobe_ssr_gl_check("test"), LOBE_SSR_OK);
    lobe_ssr_gl_release(&g->context);
    return values;
}

/* |a - b| as a share of 1 + |b|: what the tolerances in ssr/shaders are of. */
static double difference(float a, float b) {
    assert_true(isfinite(a) && isfinite(b));
    return fabs((double)a - (double)b) / (1.0 + fabs((double)b));
}

static double worst_pyramid(const both *b) {
    const pyramid *p = &b->cpu->pyramid;
    size_t cells = 0, at = 0;
    for (int k = 0; k < p->levels; k++) cells += (size_t)p->width[k] * (size_t)p->height[k];
    float *depth = read_buffer(b, BUFFER_DEPTH, 2 * cells);
    double worst = 0.0;
    for (int k = 0; k < p->levels; k++)
        for (int i = 0; i < p->width[k] * p->height[k]; i++, at += 2) {
            worst = fmax(worst, difference(depth[at], p->depth[k][i].nearest));
            worst = fmax(worst, difference(depth[at + 1], p->depth[k][i].farthest));
        }
    free(depth);
    return worst;
}

/* Marks pixels whose rays end elsewhere, and those around them, for what comes after looks there: two pixels far
 * to resolve, one more to accumulate. */
static void mark_rays(both *b) {
    for (int y = 0; y < b->height; y++)
        for (int x = 0; x < b->width; x++) {
            const int i = y * b->width + x;
            const lobe_ssr_ray *c = lobe_ssr_rays(b->cpu) + i, *g = lobe_ssr_rays(b->gl) + i;
            b->rays += c->state != LOBE_SSR_NO_RAY;
            if (c->state == g->state && c->x == g->x && c->y == g->y) continue;
            b->other_hits++;
            for (int ny = y - 3; ny <= y + 3; ny++)
                for (int nx = x - 3; nx <= x + 3; nx++)
                    if (nx >= 0 && ny >= 0 && nx < b->width && ny < b->height)
                        b->differ[ny * b->width + nx] = 1;
        }
}

typedef struct differences {
    double pyramid, direction, density, weight, length, found, resolved, reflection, radiance;
} differences;

static void widen(double *worst, float a, float b) {
    *worst = fmax(*worst, difference(a, b));
}

static void compare_rays(const both *b, differences *d) {
    for (int i = 0; i < b->width * b->height; i++) {
        const lobe_ssr_ray *c = lobe_ssr_rays(b->cpu) + i, *g = lobe_ssr_rays(b->gl) + i;
        if (b->differ[i]) continue;
        widen(&d->direction, g->direction.x, c->direction.x);
        widen(&d->direction, g->direction.y, c->direction.y);
        widen(&d->direction, g->direction.z, c->direction.z);
        widen(&d->density, g->pdf, c->pdf);
        widen(&d->weight, g->weight, c->weight);
        widen(&d->length, g->length, c->length);
    }
}

static void compare_pictures(const both *b, const float *gl, const float *cpu, int channels,
                             double *worst) {
    for (int i = 0; i < b->width * b->height; i++)
        for (int k = 0; k < channels; k++)
            if (!b->differ[i]) widen(worst, gl[channels * i + k], cpu[channels * i + k]);
}

static void run_both(both *b, const made_frame *m, differences *d) {
    const size_t pixels = (size_t)b->width * (size_t)b->height;
    run_frame(b->cpu, m);
    run_frame(b->gl, m);
    mark_rays(b);
    d->pyramid = fmax(d->pyramid, worst_pyramid(b));
    compare_rays(b, d);
    float *found = read_buffer(b, BUFFER_FOUND, 4 * pixels);
    compare_pictures(b, found, b->cpu->found, 4, &d->found);
    free(found);
    compare_pictures(b, lobe_ssr_resolved(b->gl), lobe_ssr_resolved(b->cpu), 4, &d->resolved);
    compare_pictures(b, lobe_ssr_reflection(b->gl), lobe_ssr_reflection(b->cpu), 4, &d->reflection);
    compare_pictures(b, lobe_ssr_radiance(b->gl), lobe_ssr_radiance(b->cpu), 3, &d->radiance);
    compare_pictures(b, lobe_ssr_composite(b->gl), lobe_ssr_composite(b->cpu), 3, &d->radiance);
}

/* ---- Tests ----------------------------------------------------------------------------------- */

/* At most, of each pass: what its file says. */
static void check(const both *b, const differences *d, const char *name) {
    print_message(
        "%s: %d of %d rays elsewhere; direction %.1e density %.1e weight %.1e length %.1e "
        "found %.1e resolved %.1e reflection %.1e radiance %.1e\n",
        name, (int)b->other_hits, (int)b->rays, d->direction, d->density, d->weight, d->length,
        d->found, d->resolved, d->reflection, d->radiance);
    assert_true(1000 * b->other_hits <= b->rays);
    assert_true(d->pyramid <= 1e-6);
    assert_true(d->direction <= 2e-4 && d->density <= 5e-4 && d->weight <= 2e-4);
    assert_true(d->length <= 1e-3);
    assert_true(d->found <= fmax(1e-5, d->direction)); /* the environment is looked up by it */
    assert_true(d->resolved <= 2e-4);
    assert_true(d->reflection <= 2e-4);
    assert_true(d->radiance <= 2e-4);
}

/* A room of which everything varies from pixel to pixel that may. */
typedef struct varied_frame {
    made_frame made;
    float *anisotropy, *tangent, *f0, *environment;
    unsigned char *mask;
} varied_frame;

enum { WIDTH = 97, HEIGHT = 55, ENVIRONMENT_TEXELS = 8 * 4 * 3 };

static float signed_random(uint64_t stream, uint64_t counter) {
    return 2.0f * unit_random(stream, counter) - 1.0f;
}

static varied_frame make_varied(void) {
    const size_t pixels = (size_t)WIDTH * HEIGHT;
    varied_frame v = {.made = make_room(WIDTH, HEIGHT, 0.5f)};
    made_frame *m = &v.made;
    v.anisotropy = malloc(pixels * sizeof(float));
    v.tangent = malloc(3 * pixels * sizeof(float));
    v.f0 = malloc(3 * pixels * sizeof(float));
    v.environment = malloc(3 * ENVIRONMENT_TEXELS * sizeof(float));
    v.mask = malloc(pixels);
    assert_true(v.anisotropy && v.tangent && v.f0 && v.environment && v.mask);
    for (size_t i = 0; i < pixels; i++) {
        m->roughness[i] = unit_random(1, i);
        m->motion[2 * i] = 0.03f * signed_random(2, i);
        m->motion[2 * i + 1] = 0.03f * signed_random(3, i);
        m->motion_z[i] = 0.1f * m->z[i] * signed_random(11, i);
        v.anisotropy[i] = signed_random(4, i);
        v.mask[i] = unit_random(5, i) < 0.95f;
        for (size_t k = 0; k < 3; k++) {
            m->normal[3 * i + k] += 0.2f * signed_random(6, 3 * i + k);
            m->color[3 * i + k] = unit_random(7, 3 * i + k);
            v.tangent[3 * i + k] = signed_random(8, 3 * i + k);
            v.f0[3 * i + k] = unit_random(9, 3 * i + k);
        }
    }
    for (size_t i = 0; i < 3 * ENVIRONMENT_TEXELS; i++) v.environment[i] = unit_random(10, i);
    m->frame.anisotropy = v.anisotropy;
    m->frame.tangent = v.tangent;
    m->frame.f0 = v.f0;
    m->frame.mask = v.mask;
    m->frame.environment = (lobe_ssr_environment){8, 4, 3, v.environment};
    return v;
}

static void free_varied(varied_frame *v) {
    free(v->anisotropy);
    free(v->tangent);
    free(v->f0);
    free(v->environment);
    free(v->mask);
    free_frame(&v->made);
}

static lobe_ssr_options whole_options(void) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.fade_start = 0.5f;
    o.fade_end = 1.0f;
    o.bias = 0.0f;
    return o;
}

static void compare(const varied_frame *v, lobe_ssr_options o, const char *name) {
    enum { FRAMES = 3 };
    both b = open_both(&v->made, o);
    differences d = {0};
    for (int frame = 0; frame < FRAMES; frame++) run_both(&b, &v->made, &d);
    assert_true(b.rays > (uint64_t)FRAMES * WIDTH * HEIGHT / 2);
    check(&b, &d, name);
    close_both(&b);
}

static void every_sampler_agrees(void **state) {
    (void)state;
    varied_frame v = make_varied();
    int compared = 0;
    for (int row = 0; row < lobe_model_count(); row++) {
        const lobe_model model = lobe_model_at(row);
        if (model.ndf != LOBE_NDF_GGX || model.masking != LOBE_MASKING_SMITH) continue;
        lobe_ssr_options o = whole_options();
        o.mode = model.method == LOBE_METHOD_NDF ? LOBE_SSR_NDF : LOBE_SSR_VNDF;
        o.method = model.method;
        compare(&v, o, lobe_method_name(model.method));
        compared++;
    }
    assert_true(compared >= 11);
    free_varied(&v);
}

static void every_way_agrees(void **state) {
    (void)state;
    varied_frame v = make_varied();
    lobe_ssr_options o = whole_options();
    o.mode = LOBE_SSR_MIRROR;
    compare(&v, o, "mirror");
    o.mode = LOBE_SSR_VNDF;
    o.bias = 0.5f;
    o.resolve = LOBE_SSR_APPROX;
    compare(&v, o, "approx");
    o.resolve = LOBE_SSR_OWN;
    compare(&v, o, "own");
    o.resolve = LOBE_SSR_NEIGHBOURHOOD;
    o.reflect_sky = 0;
    compare(&v, o, "neighbourhood");
    o.as_hdrp = 1;
    compare(&v, o, "as hdrp");
    v.made.frame.motion_z = v.made.motion_z;
    o.as_hdrp = 0;
    o.resolve = LOBE_SSR_CONFIDENCE;
    compare(&v, o, "confidence");
    o.linear_march = 1;
    o.max_iterations = 1000;
    compare(&v, o, "linear, objects in motion");
    free_varied(&v);
}

/* No number of a picture is out of range, whatever the frame holds; and the processor says the same. */
static void broken_frames_agree(void **state) {
    (void)state;
    static const int sizes[][2] = {{1, 1}, {2, 1}, {1, 3}, {67, 41}, {16384, 1}, {1, 4097}};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        made_frame m = make_frame(sizes[k][0], sizes[k][1], 60.0f);
        lobe_ssr_options o = whole_options();
        o.resolve = (lobe_ssr_resolve)(k % 4);
        both b = open_both(&m, o);
        differences d = {0};
        for (uint64_t frame = 0; frame < 3; frame++) {
            fill_with_odd_numbers(&m, 100 * k + 10 * frame);
            run_both(&b, &m, &d);
            check_finite(b.gl, &m);
        }
        char name[32];
        snprintf(name, sizeof name, "broken, %d x %d", m.width, m.height);
        check(&b, &d, name);
        close_both(&b);
        free_frame(&m);
    }
}

/* Contexts of one thread do not disturb each other. */
static void two_handles_take_turns(void **state) {
    (void)state;
    varied_frame v = make_varied();
    lobe_ssr_options o = whole_options();
    o.backend = LOBE_SSR_GL;
    lobe_ssr *first = open_ssr(&v.made, o), *second = open_ssr(&v.made, o);
    for (int frame = 0; frame < 2; frame++) {
        run_frame(first, &v.made);
        run_frame(second, &v.made);
    }
    assert_memory_equal(lobe_ssr_composite(first), lobe_ssr_composite(second),
                        3 * WIDTH * HEIGHT * sizeof(float));
    lobe_ssr_free(first);
    run_frame(second, &v.made);
    lobe_ssr_free(second);
    free_varied(&v);
}

static void what_does_not_fit_is_refused(void **state) {
    (void)state;
    lobe_ssr *ssr = NULL;
    lobe_ssr_options o = lobe_ssr_default_options();
    o.backend = LOBE_SSR_GL;
    assert_int_equal(lobe_ssr_create(32768, 32768, o, &ssr), LOBE_SSR_FAILED);
    assert_null(ssr);
    assert_non_null(strstr(lobe_ssr_error_message(), "use a smaller --size"));
    /* what a driver may say at any time */
    assert_int_equal(lobe_ssr_gl_result("passes", GL_OUT_OF_MEMORY, GL_NO_ERROR), LOBE_SSR_FAILED);
    assert_non_null(strstr(lobe_ssr_error_message(), "out of memory; "));
    assert_int_equal(lobe_ssr_gl_result("passes", GL_NO_ERROR, GL_GUILTY_CONTEXT_RESET),
                     LOBE_SSR_FAILED);
    assert_non_null(strstr(lobe_ssr_error_message(), "the device was lost"));
    assert_int_equal(lobe_ssr_gl_result("passes", GL_CONTEXT_LOST, GL_NO_ERROR), LOBE_SSR_FAILED);
    assert_int_equal(lobe_ssr_gl_result("passes", GL_NO_ERROR, GL_NO_ERROR), LOBE_SSR_OK);
}

/* A processor that plays a GPU is not what LOBE_SSR_AUTO looks for. */
static void auto_takes_a_gpu_or_the_processor(void **state) {
    (void)state;
    made_frame m = make_room(8, 8, 0.1f);
    lobe_ssr_options o = lobe_ssr_default_options();
    o.backend = LOBE_SSR_GL;
    lobe_ssr *gl = open_ssr(&m, o);
    const int is_software = ((const gl_state *)gl->driver_state)->context.is_software;
    o.backend = LOBE_SSR_AUTO;
    lobe_ssr *chosen = open_ssr(&m, o);
    assert_int_equal(lobe_ssr_backend_of(chosen), is_software ? LOBE_SSR_CPU : LOBE_SSR_GL);
    if (is_software) assert_non_null(strstr(lobe_ssr_device(chosen), "is no GPU"));
    run_frame(chosen, &m);
    lobe_ssr_free(gl);
    lobe_ssr_free(chosen);
    free_frame(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_sampler_agrees),
                                       cmocka_unit_test(every_way_agrees),
                                       cmocka_unit_test(broken_frames_agree),
                                       cmocka_unit_test(two_handles_take_turns),
                                       cmocka_unit_test(what_does_not_fit_is_refused),
                                       cmocka_unit_test(auto_takes_a_gpu_or_the_processor)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
