/* tests/render/test_lens.c: the picture of a small light out of focus is the disk that the thin-lens equation gives;
 * what stands where the lens is sharp looks as through a pinhole. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char scene_file[] = "render-lens.obj", material_file[] = "render-lens.mtl",
                  sky_file[] = "render-lens.pfm";

enum { SIZE = 40, SAMPLES = 1024 };

static const double radiance = 3, slope = 0.5; /* half the angle of view: its tangent */

/* A camera that looks neither along an axis nor level. */
typedef struct eye {
    double place[3], right[3], up[3], forward[3];
} eye;

static const eye tilted = {{1, -2, 3}, {0.6, 0, -0.8}, {0.48, 0.8, 0.36}, {-0.64, 0.6, -0.48}};

static lobe_view view_of(const eye *e) {
    const float degrees = (float)(2 * atan(slope) * 180 / 3.14159265358979323846);
    lobe_view v = {.vertical_degrees = degrees};
    float *place = &v.position.x, *target = &v.target.x, *up = &v.up.x;
    for (int i = 0; i < 3; ++i) {
        place[i] = (float)e->place[i];
        target[i] = (float)(e->place[i] + 8 * e->forward[i]);
        up[i] = (float)e->up[i];
    }
    return v;
}

/* A light across the view: its middle and half its side in pixels from the middle of the picture. */
typedef struct light {
    double distance, x, y, half;
} light;

static void write_scene(const light *lights, int count) {
    FILE *file = fopen(material_file, "w");
    assert_non_null(file);
    fprintf(file, "newmtl m\nKd 0 0 0\nKe %g %g %g\n", radiance, radiance, radiance);
    fclose(file);
    file = fopen(scene_file, "w");
    assert_non_null(file);
    fprintf(file, "mtllib %s\nusemtl m\n", material_file);
    for (int k = 0; k < count; ++k) {
        const light *l = &lights[k];
        const double pixel = 2 * slope / SIZE * l->distance;
        for (int c = 0; c < 4; ++c) {
            const double x = (l->x + (c == 1 || c == 2 ? l->half : -l->half)) * pixel;
            const double y = (l->y + (c >= 2 ? l->half : -l->half)) * pixel;
            fprintf(file, "v");
            for (int i = 0; i < 3; ++i)
                fprintf(file, " %.9g",
                        tilted.place[i] + x * tilted.right[i] + y * tilted.up[i] +
                            l->distance * tilted.forward[i]);
            fprintf(file, "\n");
        }
        fprintf(file, "f %d %d %d %d\n", 4 * k + 1, 4 * k + 2, 4 * k + 3, 4 * k + 4);
    }
    fclose(file);
}

static lobe_scene *scene_of(const light *lights, int count) {
    write_even_light(sky_file, 0.0f);
    write_scene(lights, count);
    lobe_scene_options options = lobe_scene_default_options();
    options.environment = sky_file;
    lobe_scene *scene = NULL;
    if (lobe_scene_load(scene_file, options, &scene) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    unlink(scene_file);
    unlink(material_file);
    unlink(sky_file);
    return scene;
}

static float *picture(const lobe_scene *scene, float aperture, float focus) {
    const lobe_view view = view_of(&tilted);
    lobe_render_options o = small(SIZE, SIZE, SAMPLES);
    o.view = &view;
    o.depth = 0;
    o.aperture = aperture;
    o.focus = focus;
    lobe_film *film = render(scene, o, NULL);
    float *rgb = colors(film);
    lobe_film_free(film);
    return rgb;
}

/* Light over the picture, in pixels: sum, middle, mean squared distance from it, and what of that is not round. */
typedef struct blob {
    double sum, x, y, spread, wide, slanted;
} blob;

/* Pixels from the middle of the picture, to the right and up. */
static double across(int pixel) {
    return pixel % SIZE + 0.5 - SIZE / 2.0;
}

static double above(int pixel) {
    return SIZE / 2.0 - 0.5 - pixel / SIZE;
}

static blob measure_blob(const float *rgb) {
    blob b = {0};
    for (int i = 0; i < SIZE * SIZE; ++i) {
        b.sum += rgb[3 * i];
        b.x += rgb[3 * i] * across(i);
        b.y += rgb[3 * i] * above(i);
    }
    b.x /= b.sum;
    b.y /= b.sum;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        const double x = across(i) - b.x, y = above(i) - b.y, share = rgb[3 * i] / b.sum;
        b.spread += share * (x * x + y * y);
        b.wide += share * (x * x - y * y);
        b.slanted += share * 2 * x * y;
    }
    return b;
}

static void assert_near(const char *what, double value, double expected, double room) {
    if (!(fabs(value - expected) <= room))
        fail_msg("%s: %g, not %g within %g", what, value, expected, room);
}

/* Even inside, nothing outside: the filter reaches 1.5 pixels to each side. */
static void assert_disk(const float *rgb, const light *l, double circle, double count) {
    const double reach = sqrt(2) * (l->half + 1.5), flat = circle - reach;
    double inside = 0, pixels = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        const double r = hypot(across(i) - l->x, above(i) - l->y);
        if (r > circle + reach + 0.01) assert_near("beyond the circle", rgb[3 * i], 0, 0);
        if (r > flat / 2) continue;
        inside += rgb[3 * i];
        pixels++;
    }
    const double share = pixels / (3.14159265358979323846 * circle * circle);
    const double expected = share * 4 * l->half * l->half * radiance;
    assert_near("in the middle", inside, expected, 4 * expected / sqrt(share * count));
}

/* Samples are stratified: the room is four standard errors of independent ones. */
static void assert_circle(light l, float aperture, float focus) {
    lobe_scene *scene = scene_of(&l, 1);
    float *sharp = picture(scene, 0, 0), *blurred = picture(scene, aperture, focus);
    const blob a = measure_blob(sharp), b = measure_blob(blurred);
    const double area = 4 * l.half * l.half, count = area * SAMPLES;
    const double circle =
        (double)aperture * fabs(1 / l.distance - 1 / (double)focus) * SIZE / (2 * slope);
    const double room = 4 / sqrt(count);
    assert_near("energy, pinhole", a.sum, area * radiance, room * area * radiance);
    assert_near("energy", b.sum, area * radiance, room * area * radiance);
    assert_near("x", b.x, l.x, room * circle / 2);
    assert_near("y", b.y, l.y, room * circle / 2);
    assert_near("circle of confusion", b.spread - a.spread, circle * circle / 2,
                room * circle * circle * (sqrt(1 / 12.0) + 0.05));
    /* r^2 times the cosine or sine of twice an even angle: a mean square of R^4/6 */
    assert_near("wider than high", b.wide, 0, room * circle * circle * sqrt(1 / 6.0));
    assert_near("slanted", b.slanted, 0, room * circle * circle * sqrt(1 / 6.0));
    assert_disk(blurred, &l, circle, count);
    free(sharp);
    free(blurred);
    lobe_scene_free(scene);
}

static void blur_is_that_of_the_lens_equation(void **state) {
    (void)state;
    assert_circle((light){2, 0, 0, 1.5}, 1.2f, 4);       /* nearer than the focus: 12 pixels */
    assert_circle((light){8, 3, -4, 1.5}, 1.8f, 4);      /* farther: 9, aside */
    assert_circle((light){5, -3, 2, 1.5}, 1.25f, 1e15f); /* focus on the stars: 10 */
}

/* The plane across the view, not the sphere around the lens. */
static void focus_is_as_through_a_pinhole(void **state) {
    (void)state;
    const light lights[] = {{4, 0, 0, 3}, {4, 14, 14, 2.5}, {4, -15, 3, 2}};
    lobe_scene *scene = scene_of(lights, 3);
    float *sharp = picture(scene, 0, 0), *lens = picture(scene, 1.2f, 4),
          *moved = picture(scene, 1.2f, 4.2f);
    double sum = 0, difference = 0, blur = 0;
    for (int i = 0; i < SIZE * SIZE; ++i) {
        sum += sharp[3 * i];
        difference += fabs(sharp[3 * i] - lens[3 * i]);
        blur += fabs(sharp[3 * i] - moved[3 * i]);
    }
    assert_near("in focus", difference / sum, 0, 1e-3); /* rays that touch an edge */
    assert_true(blur / sum > 0.05);
    free(sharp);
    free(lens);
    free(moved);
    lobe_scene_free(scene);
}

static void assert_same(const lobe_scene *scene, lobe_render_options a, lobe_render_options b) {
    lobe_film *films[2] = {render(scene, a, NULL), render(scene, b, NULL)};
    float *rgb[2] = {colors(films[0]), colors(films[1])};
    assert_memory_equal(rgb[0], rgb[1], sizeof(float) * 3 * (size_t)a.width * (size_t)a.height);
    for (int k = 0; k < 2; ++k) {
        free(rgb[k]);
        lobe_film_free(films[k]);
    }
}

/* Focus is on what the middle shows; an f-number is that of a picture 24 mm high. */
static void what_is_not_said_follows(void **state) {
    (void)state;
    const light lights[] = {{3, 0, 0, 2}, {5, 9, 0, 2}};
    lobe_scene *scene = scene_of(lights, 2);
    lobe_view view = view_of(&tilted);
    lobe_render_options asked = small(SIZE, SIZE, 16), given;
    asked.view = &view;
    asked.aperture = 0.5f;
    given = asked;
    given.focus = lobe_scene_focus(scene, &view);
    assert_near("focus", given.focus, 3, 1e-5);
    assert_same(scene, asked, given);
    assert_near("radius", lobe_lens_radius(0.02f, view.vertical_degrees),
                0.012 / (2 * 0.02 * slope), 1e-6);
    asked.aperture = 0;
    asked.f_number = 0.02f;
    given.aperture = lobe_lens_radius(asked.f_number, view.vertical_degrees);
    assert_same(scene, asked, given);
    view.target.y += 100; /* nothing is there */
    lobe_film *film = NULL;
    assert_true(lobe_scene_focus(scene, &view) == 0);
    assert_int_equal(lobe_render(scene, asked, &film, NULL), LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "nothing to focus on"));
    asked.f_number = 0; /* a pinhole does not ask */
    lobe_film_free(render(scene, asked, NULL));
    lobe_scene_free(scene);
}

static void what_is_no_lens_is_refused(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    const float bad[] = {-1, NAN, INFINITY, 1e16f};
    for (int k = 0; k < 4; ++k)
        for (int which = 0; which < 4; ++which) {
            lobe_view view = view_of(&tilted);
            lobe_render_options o = small(8, 8, 1);
            lobe_film *film = NULL;
            if (which == 0) o.aperture = bad[k];
            if (which == 1) o.f_number = bad[k];
            if (which == 2) o.focus = bad[k];
            if (which == 3) o.view = &view;
            if (which == 3) view.vertical_degrees = bad[k];
            assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
        }
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blur_is_that_of_the_lens_equation),
        cmocka_unit_test(focus_is_as_through_a_pinhole),
        cmocka_unit_test(what_is_not_said_follows),
        cmocka_unit_test(what_is_no_lens_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
