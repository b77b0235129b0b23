/* tests/render/test_closed_forms.c: light on plates that have an answer on paper: Lambert's cosine law, a
 * polygon and a sphere that glow, a sky that grows brighter upward; and what KHR_materials_specular and
 * KHR_materials_clearcoat make of even light. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "gltf_square.h"
#include "pictures.h"

#include <unistd.h>

static const char name[] = "render-closed.glb", sky_name[] = "render-closed.pfm";
static const double PI = 3.14159265358979323846;

/* No reflection but that of the base: Lambert. */
#define LAMBERT                                                                                    \
    "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"baseColorFactor\":[0.5,0.5,0.5,1]},"        \
    "\"extensions\":{\"KHR_materials_specular\":{\"specularFactor\":0}}}"
static const double ALBEDO = 0.5;

static const char second_mesh[] =
    ",{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":8,\"material\":1}]}";

enum { SIZE = 16, RUNS = 6 };

/* Mean of the red of a picture, and its standard error over independent ones; in `first` the first picture. */
typedef struct estimate {
    double mean, error;
    float first[SIZE][SIZE][3];
} estimate;

static estimate look(square_file f, const char *environment, uint32_t samples) {
    write_square_file(name, f);
    lobe_scene_options options = lobe_scene_default_options();
    options.strict = 1;
    if (environment) options.environment = environment;
    lobe_scene *scene = NULL;
    if (lobe_scene_load(name, options, &scene) != LOBE_RENDER_OK)
        fail_msg("%s", lobe_render_error_message());
    unlink(name);
    lobe_render_options o = small(SIZE, SIZE, samples);
    o.threads = 1; /* there is too little to share */
    o.depth = 1;
    estimate e = {0};
    double squares = 0;
    for (int run = 0; run < RUNS; ++run) {
        float color[SIZE][SIZE][3];
        o.seed = (uint64_t)run;
        lobe_film *film = render(scene, o, NULL);
        assert_true(lobe_film_copy_rgb(film, &color[0][0][0]));
        lobe_film_free(film);
        double mean = 0;
        for (int k = 0; k < SIZE * SIZE; ++k) mean += (double)color[k / SIZE][k % SIZE][0];
        mean /= SIZE * SIZE;
        e.mean += mean / RUNS;
        squares += mean * mean / RUNS;
        if (run == 0) memcpy(e.first, color, sizeof color);
    }
    lobe_scene_free(scene);
    e.error = sqrt(fmax(squares - e.mean * e.mean, 0) / (RUNS - 1));
    return e;
}

static void assert_mean(const estimate *e, double expected, double room, const char *what) {
    if (!(fabs(e->mean - expected) < 5 * e->error + room * expected))
        fail_msg("%s: %.7g +- %.2g is not %.7g", what, e->mean, e->error, expected);
}

/* ---- Lambert ------------------------------------------------------------------------------------- */

/* radiance = albedo/pi * irradiance * cosine, at every pixel */
static void a_plate_follows_the_cosine(void **state) {
    (void)state;
    for (int k = 0; k < 8; ++k) {
        const double angle = 0.19 * k;
        char nodes[300];
        snprintf(nodes, sizeof nodes,
                 "{\"mesh\":0},{\"rotation\":[%.9g,0,0,%.9g],\"extensions\":{"
                 "\"KHR_lights_punctual\":{\"light\":0}}}",
                 -sin(angle / 2), cos(angle / 2));
        const estimate e =
            look((square_file){.material = LAMBERT,
                               .nodes = nodes,
                               .children = "0,1,2",
                               .more = ",\"extensions\":{\"KHR_lights_punctual\":{\"lights\":["
                                       "{\"type\":\"directional\",\"intensity\":3}]}}"},
                 NULL, 1);
        const double expected = ALBEDO / PI * 3 * cos(angle);
        for (int i = 0; i < SIZE * SIZE; ++i)
            if (!(fabs((double)e.first[i / SIZE][i % SIZE][0] - expected) < 1e-6 + 1e-5 * expected))
                fail_msg("%g radians: %g is not %g", angle, (double)e.first[i / SIZE][i % SIZE][0],
                         expected);
    }
}

typedef struct point {
    double x, y, z;
} point;

static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double length_of(point a) {
    return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

/* Irradiance at (x, y, 0), facing +z, of a square of side 2 scale that glows with 1, turned about y and moved
 * to `at`: Lambert's sum over its edges. */
static double irradiance(double x, double y, point at, double scale, double turn) {
    point corner[4];
    for (int k = 0; k < 4; ++k) {
        const double u = scale * (k == 1 || k == 2 ? 1 : -1), v = scale * (k >= 2 ? 1 : -1);
        corner[k] = (point){at.x + u * cos(turn) - x, at.y + v - y, at.z - u * sin(turn)};
    }
    double sum = 0;
    for (int k = 0; k < 4; ++k) {
        const point a = corner[k], b = corner[(k + 1) % 4], n = cross(a, b);
        const double dot = a.x * b.x + a.y * b.y + a.z * b.z;
        sum += atan2(length_of(n), dot) * n.z / length_of(n);
    }
    return fabs(sum) / 2;
}

/* Over the pixels of the camera at z = 4, which sees so far to each side. */
static double mean_irradiance(point at, double scale, double turn) {
    enum { STEPS = 4 * SIZE };
    const double half = 4 * tan(0.2);
    double sum = 0;
    for (int i = 0; i < STEPS; ++i)
        for (int k = 0; k < STEPS; ++k)
            sum += irradiance(half * (2 * (i + 0.5) / STEPS - 1),
                              half * (2 * (k + 0.5) / STEPS - 1), at, scale, turn);
    return sum / (STEPS * STEPS);
}

/* Before the plate and across from it: form factors of parallel and of perpendicular squares too. */
static void a_square_that_glows(void **state) {
    (void)state;
    static const struct {
        point at;
        double scale, turn;
    } lamp[] = {{{0, 0, 6}, 1, 0}, {{1.5, 0.5, 5}, 1.2, 0.4}, {{2.5, 0, 2.5}, 2.4, PI / 2}};
    for (int k = 0; k < 3; ++k) {
        char nodes[300];
        const double turn = lamp[k].turn, scale = lamp[k].scale;
        snprintf(nodes, sizeof nodes,
                 "{\"mesh\":0},{\"mesh\":1,\"translation\":[%g,%g,%g],"
                 "\"rotation\":[0,%.9g,0,%.9g],\"scale\":[%g,%g,1]}",
                 lamp[k].at.x, lamp[k].at.y, lamp[k].at.z, sin(turn / 2), cos(turn / 2), scale,
                 scale);
        const estimate e = look((square_file){.material = LAMBERT
                                              ",{\"pbrMetallicRoughness\":{\"baseColorFactor\":"
                                              "[0,0,0,1]},\"emissiveFactor\":[1,1,1]}",
                                              .nodes = nodes,
                                              .children = "0,1,2",
                                              .meshes = second_mesh},
                                NULL, 64);
        assert_true(e.error < 4e-3 * e.mean);
        assert_mean(&e, ALBEDO / PI * mean_irradiance(lamp[k].at, scale, turn), 2e-4, "square");
    }
}

/* ---- A sphere that glows ------------------------------------------------------------------------- */

/* Irradiance of a sphere that glows with 1 on a plane, its middle at `distance` in units of its radius and at this
 * cosine to the normal: pi (what is above the horizon of a disk that wide). Above the horizon as a whole, it is
 * pi cos/distance^2; across it, what its outline and the horizon enclose (Snyder 1996, area light sources for real-time
 * graphics). */
static double irradiance_of_sphere(double distance, double cosine) {
    const double d2 = distance * distance, sine = sqrt(1 - cosine * cosine);
    if (distance * cosine >= 1) return PI * cosine / d2;
    if (distance * cosine <= -1) return 0;
    const double over = sqrt(1 - d2 * cosine * cosine), tangent = sqrt(d2 - 1);
    return (cosine * acos(-cosine / sine * tangent) - over * tangent) / d2 + atan(over / tangent);
}

/* The same by adding up directions, in double: what the closed form is held to. */
static double irradiance_by_directions(double distance, double cosine) {
    enum { STEPS = 300 };
    const double edge = sqrt(1 - 1 / (distance * distance)), sine = sqrt(1 - cosine * cosine);
    double sum = 0;
    for (int i = 0; i < STEPS; ++i)
        for (int k = 0; k < STEPS; ++k) {
            const double z = 1 - (1 - edge) * (i + 0.5) / STEPS, turn = 2 * PI * (k + 0.5) / STEPS;
            sum += fmax(z * cosine + sqrt(1 - z * z) * cos(turn) * sine, 0);
        }
    return sum * 2 * PI * (1 - edge) / STEPS / STEPS;
}

enum { ROWS = 96, TURNS = 192, SPHERE_VERTICES = (ROWS + 1) * TURNS };
enum { SPHERE_INDICES = 6 * (ROWS - 1) * TURNS };

/* Of radius 1, and as much more as makes a polygon of TURNS sides as large as its circle. */
typedef struct ball {
    float positions[SPHERE_VERTICES][3];
    uint32_t indices[SPHERE_INDICES];
} ball;

static void make_ball(ball *b) {
    const double radius = 1 + (PI / ROWS) * (PI / ROWS) / 12;
    uint32_t *index = b->indices;
    for (int i = 0; i <= ROWS; ++i)
        for (int k = 0; k < TURNS; ++k) {
            const double polar = PI * i / ROWS, turn = 2 * PI * k / TURNS;
            float *p = b->positions[i * TURNS + k];
            p[0] = (float)(radius * sin(polar) * cos(turn));
            p[1] = (float)(radius * cos(polar));
            p[2] = (float)(radius * sin(polar) * sin(turn));
        }
    for (uint32_t i = 0; i < ROWS; ++i)
        for (uint32_t k = 0; k < TURNS; ++k) {
            const uint32_t a = i * TURNS + k, c = i * TURNS + (k + 1) % TURNS;
            const uint32_t corners[6] = {a, c, a + TURNS, c, c + TURNS, a + TURNS};
            /* at a pole one of the two is nothing */
            const int first = i == 0 ? 3 : 0, count = i == 0 || i == ROWS - 1 ? 3 : 6;
            memcpy(index, corners + first, (size_t)count * sizeof *index);
            index += count;
        }
}

/* Over the pixels, as that of the square. */
static double mean_irradiance_of_sphere(point at, double radius) {
    enum { STEPS = 4 * SIZE };
    const double half = 4 * tan(0.2);
    double sum = 0;
    for (int i = 0; i < STEPS; ++i)
        for (int k = 0; k < STEPS; ++k) {
            const point to = {at.x - half * (2 * (i + 0.5) / STEPS - 1),
                              at.y - half * (2 * (k + 0.5) / STEPS - 1), at.z};
            sum += irradiance_of_sphere(length_of(to) / radius, to.z / length_of(to));
        }
    return sum / (STEPS * STEPS);
}

/* Above the horizon, cut by it with the middle above, on it and below; behind the plate there is nothing. */
static void a_sphere_that_glows(void **state) {
    (void)state;
    static const struct {
        point at;
        double radius;
    } lamps[] = {{{0.5, 0.3, 6}, 1.5}, {{2.4, 0, 0.4}, 1}, {{2.3, 0.4, 0}, 1}, {{2.1, 0, -0.5}, 1}};
    static ball b;
    make_ball(&b);
    for (double distance = 1.05; distance < 8; distance *= 1.5)
        for (double cosine = -0.95; cosine < 1; cosine += 0.19)
            assert_true(fabs(irradiance_of_sphere(distance, cosine) -
                             irradiance_by_directions(distance, cosine)) < 1e-4);
    for (int k = 0; k < 4; ++k) {
        char nodes[200], views[300], accessors[300], meshes[100];
        const double radius = lamps[k].radius;
        snprintf(nodes, sizeof nodes,
                 "{\"mesh\":0},{\"mesh\":1,\"translation\":[%g,%g,%g],\"scale\":[%g,%g,%g]}",
                 lamps[k].at.x, lamps[k].at.y, lamps[k].at.z, radius, radius, radius);
        snprintf(views, sizeof views,
                 ",{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu},"
                 "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
                 sizeof square_arrays, sizeof b.positions,
                 sizeof square_arrays + sizeof b.positions, sizeof b.indices);
        snprintf(accessors, sizeof accessors,
                 ",{\"bufferView\":%d,\"componentType\":5126,\"type\":\"VEC3\",\"count\":%d},"
                 "{\"bufferView\":%d,\"componentType\":5125,\"type\":\"SCALAR\",\"count\":%d}",
                 VIEWS, SPHERE_VERTICES, VIEWS + 1, SPHERE_INDICES);
        snprintf(
            meshes, sizeof meshes,
            ",{\"primitives\":[{\"attributes\":{\"POSITION\":%d},\"indices\":%d,\"material\":1}]}",
            ACCESSORS, ACCESSORS + 1);
        const estimate e = look((square_file){.material = LAMBERT
                                              ",{\"pbrMetallicRoughness\":{\"baseColorFactor\":"
                                              "[0,0,0,1]},\"emissiveFactor\":[1,1,1]}",
                                              .nodes = nodes,
                                              .children = "0,1,2",
                                              .views = views,
                                              .accessors = accessors,
                                              .meshes = meshes,
                                              .binary = &b,
                                              .binary_size = sizeof b},
                                NULL, 256);
        assert_true(e.error < 8e-3 * e.mean);
        /* room, for six runs do not tell their standard error well. Without a horizon the last three would be off by
           more than a quarter */
        assert_mean(&e, ALBEDO / PI * mean_irradiance_of_sphere(lamps[k].at, radius), 3e-3,
                    "sphere");
    }
}

/* A panorama of 1 + d.y; the plate faces +z, or is turned toward +y: pi (1 + 2/3 n.y). */
static void a_sky_brighter_above(void **state) {
    (void)state;
    enum { WIDTH = 256, HEIGHT = 128 };
    FILE *file = fopen(sky_name, "wb");
    assert_non_null(file);
    fprintf(file, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    for (int y = 0; y < HEIGHT; ++y) /* from the lowest row */
        for (int x = 0; x < WIDTH; ++x) {
            const float value = (float)(1 - cos(PI * (y + 0.5) / HEIGHT));
            const float rgb[3] = {value, value, value};
            fwrite(rgb, sizeof rgb, 1, file);
        }
    fclose(file);
    for (int k = -2; k <= 2; ++k) {
        const double angle = 0.5 * k;
        char nodes[200];
        snprintf(nodes, sizeof nodes, "{\"mesh\":0,\"rotation\":[%.9g,0,0,%.9g],\"scale\":[3,3,3]}",
                 -sin(angle / 2), cos(angle / 2));
        const estimate e = look((square_file){.material = LAMBERT, .nodes = nodes}, sky_name, 64);
        assert_true(e.error < 4e-3);
        assert_mean(&e, ALBEDO * (1 + 2.0 / 3 * sin(angle)), 2e-4, "sky");
    }
    unlink(sky_name);
}

/* ---- KHR_materials_specular ---------------------------------------------------------------------- */

static void write_even_sky(void) {
    FILE *file = fopen(sky_name, "wb");
    assert_non_null(file);
    fputs("PF\n2 1\n-1.0\n", file);
    const float texels[6] = {1, 1, 1, 1, 1, 1};
    fwrite(texels, sizeof texels, 1, file);
    fclose(file);
}

static double fresnel(double index, double cosine) {
    const double sine2 = (1 - cosine * cosine) / (index * index), inside = sqrt(1 - sine2);
    const double s = (cosine - index * inside) / (cosine + index * inside);
    const double p = (index * cosine - inside) / (index * cosine + inside);
    return (s * s + p * p) / 2;
}

/* A black mirror in even light shows F itself: share (t + (1 - t) (F - f0)/(1 - f0)), t = f0 color. */
static void a_black_mirror_shows_its_tint(void **state) {
    (void)state;
    static const struct {
        double share, color[3], angle;
    } mirror[] = {{1, {1, 1, 1}, 0.0},
                  {0.5, {1, 1, 1}, 0.9},
                  {1, {2, 0.5, 0}, 0.0},
                  {0.7, {3, 1, 0.25}, 1.1},
                  {1, {40, 25, 1}, 0.5}};
    const double f0 = 0.04;
    write_even_sky();
    for (int k = 0; k < 5; ++k) {
        const double *color = mirror[k].color, angle = mirror[k].angle;
        char nodes[200], material[500];
        snprintf(nodes, sizeof nodes, "{\"mesh\":0,\"rotation\":[%.9g,0,0,%.9g]}", -sin(angle / 2),
                 cos(angle / 2));
        snprintf(material, sizeof material,
                 "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0,"
                 "\"baseColorFactor\":[0,0,0,1]},\"extensions\":{\"KHR_materials_specular\":{"
                 "\"specularFactor\":%g,\"specularColorFactor\":[%g,%g,%g]}}}",
                 mirror[k].share, color[0], color[1], color[2]);
        const estimate e = look((square_file){.material = material, .nodes = nodes}, sky_name, 16);
        for (int c = 0; c < 3; ++c) {
            /* the pixels beside the middle see it from both sides of `angle` */
            const double tinted = fmin(f0 * color[c], 1), f = fresnel(1.5, cos(angle));
            const double expected = mirror[k].share * (tinted + (1 - tinted) * (f - f0) / (1 - f0));
            double seen = 0;
            for (int i = 0; i < 4; ++i)
                seen += (double)e.first[SIZE / 2 - i / 2][SIZE / 2 - i % 2][c] / 4;
            if (!(fabs(seen - expected) < 2e-5 + 8e-3 * expected))
                fail_msg("mirror %d, channel %d: %g is not %g", k, c, seen, expected);
        }
    }
    unlink(sky_name);
}

/* The alpha of the texture is the share: none at its left texels; its colour tints: red, green, blue, white. */
static void share_and_tint_have_textures(void **state) {
    (void)state;
    static const char *const textures[] = {"\"specularTexture\":{\"index\":0}",
                                           "\"specularColorTexture\":{\"index\":0}"};
    write_even_sky();
    estimate e[2];
    for (int k = 0; k < 2; ++k) {
        char material[500];
        snprintf(material, sizeof material,
                 "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0,"
                 "\"baseColorFactor\":[0,0,0,1]},\"extensions\":{\"KHR_materials_specular\":{%s}}}",
                 textures[k]);
        e[k] = look((square_file){.material = material}, sky_name, 16);
    }
    unlink(sky_name);
    for (int y = 3; y < SIZE; y += 9)
        for (int x = 3; x < SIZE; x += 9) {
            const int right = x > SIZE / 2, below = y > SIZE / 2;
            const int shines[3] = {right == below, right, below};
            for (int c = 0; c < 3; ++c) {
                const double share = (double)e[0].first[y][x][c],
                             tint = (double)e[1].first[y][x][c];
                assert_true(fabs(share - 0.04 * right) < 1e-3);
                assert_true(fabs(tint - 0.04 * shines[c]) < 2e-3);
            }
        }
}

/* Over a white base all light comes back in the channel that reflects most, less what the table of the coat
 * lacks (render/coat.h), and never more; the others lack what is absorbed. */
static void a_white_base_loses_nothing(void **state) {
    (void)state;
    static const char *const specular[] = {
        "\"specularFactor\":0", "\"specularFactor\":0.5", "\"specularColorFactor\":[1,0.2,0]",
        "\"specularColorFactor\":[8,2,0]",
        "\"specularFactor\":0.6,\"specularColorFactor\":[20,20,1]"};
    write_even_sky();
    for (int k = 0; k < 5; ++k)
        for (int r = 0; r < 3; ++r) {
            char material[500];
            snprintf(material, sizeof material,
                     "{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":%g},"
                     "\"extensions\":{\"KHR_materials_specular\":{%s}}}",
                     0.1 + 0.4 * r, specular[k]);
            const estimate e = look((square_file){.material = material,
                                                  .nodes = "{\"mesh\":0,\"rotation\":"
                                                           "[-0.5,0,0,0.8660254]}"},
                                    sky_name, 32);
            if (!(e.mean < 1.001 + 5 * e.error && e.mean > 0.985 - 5 * e.error))
                fail_msg("%s, roughness %g: %g +- %g is not 1", specular[k], 0.1 + 0.4 * r, e.mean,
                         e.error);
        }
    unlink(sky_name);
}

/* ---- KHR_materials_clearcoat --------------------------------------------------------------------- */

static void print_coated(char *text, size_t room, const char *base, const char *coat) {
    snprintf(text, room,
             "{\"pbrMetallicRoughness\":{%s},\"extensions\":{\"KHR_materials_specular\":{"
             "\"specularFactor\":0},\"KHR_materials_clearcoat\":{%s}}}",
             base, coat);
}

static double seen_in_the_middle(const estimate *e) {
    double seen = 0;
    for (int i = 0; i < 4; ++i) seen += (double)e->first[SIZE / 2 - i / 2][SIZE / 2 - i % 2][0] / 4;
    return seen;
}

/* A smooth coat over black shows share * F; over grey and white the rest of the light is as grey. */
static void a_smooth_coat_shows_its_share(void **state) {
    (void)state;
    static const struct {
        double base, share, angle;
    } plate[] = {{0, 1, 0}, {0, 0.5, 0.9}, {0, 1, 1.2}, {0.5, 1, 0.6}, {1, 0.8, 1.1}};
    write_even_sky();
    for (int k = 0; k < 5; ++k)
        for (int metal = 0; metal < 2; ++metal) {
            const double base = plate[k].base, share = plate[k].share, angle = plate[k].angle;
            char nodes[200], below[200], coat[100], material[600];
            snprintf(nodes, sizeof nodes, "{\"mesh\":0,\"rotation\":[%.9g,0,0,%.9g]}",
                     -sin(angle / 2), cos(angle / 2));
            snprintf(below, sizeof below,
                     "\"metallicFactor\":%d,\"roughnessFactor\":0,"
                     "\"baseColorFactor\":[%g,0,0,1]",
                     metal, base);
            snprintf(coat, sizeof coat, "\"clearcoatFactor\":%g", share);
            print_coated(material, sizeof material, below, coat);
            const estimate e =
                look((square_file){.material = material, .nodes = nodes}, sky_name, 64);
            /* the mirror below turns pale toward the horizon by itself */
            const double pale = metal ? pow(1 - cos(angle), 5) : 0;
            const double reflected = share * fresnel(1.5, cos(angle));
            const double expected = reflected + (1 - reflected) * (base + (1 - base) * pale);
            const double seen = seen_in_the_middle(&e);
            if (!(fabs(seen - expected) < 0.01 * expected + 0.02 * base * (1 - base) + 1e-4))
                fail_msg("plate %d, metal %d: %g is not %g", k, metal, seen, expected);
        }
    unlink(sky_name);
}

/* Any coat over white reflects all light, less what the table of its albedo has too much. */
static void a_coat_over_white_loses_nothing(void **state) {
    (void)state;
    static const char *const coats[] = {"\"clearcoatFactor\":1,\"clearcoatRoughnessFactor\":0.1",
                                        "\"clearcoatFactor\":0.5,\"clearcoatRoughnessFactor\":0.4",
                                        "\"clearcoatFactor\":1,\"clearcoatRoughnessFactor\":1"};
    write_even_sky();
    for (int k = 0; k < 3; ++k) {
        char material[600];
        print_coated(material, sizeof material, "\"metallicFactor\":0", coats[k]);
        const estimate e = look((square_file){.material = material,
                                              .nodes = "{\"mesh\":0,\"rotation\":"
                                                       "[-0.5,0,0,0.8660254]}"},
                                sky_name, 64);
        if (!(e.mean < 1.001 + 5 * e.error && e.mean > 0.99 - 5 * e.error))
            fail_msg("%s: %g +- %g is not 1", coats[k], e.mean, e.error);
    }
    unlink(sky_name);
}

/* Red is the share, green the roughness: the red and the white texel are coated; a map of its own tilts the coat,
 * and nothing below. */
static void a_coat_has_its_textures(void **state) {
    (void)state;
    char material[600];
    const char black[] = "\"metallicFactor\":0,\"baseColorFactor\":[0,0,0,1]";
    write_even_sky();
    print_coated(material, sizeof material, black,
                 "\"clearcoatFactor\":1,\"clearcoatTexture\":{\"index\":0}");
    estimate e = look((square_file){.material = material}, sky_name, 64);
    for (int y = 3; y < SIZE; y += 9)
        for (int x = 3; x < SIZE; x += 9) {
            const int is_coated = (x > SIZE / 2) == (y > SIZE / 2);
            assert_true(fabs((double)e.first[y][x][0] - 0.04 * is_coated) < 4e-3);
        }
    print_coated(material, sizeof material, black,
                 "\"clearcoatFactor\":1,\"clearcoatNormalTexture\":{\"index\":1}");
    e = look((square_file){.material = material}, sky_name, 64);
    /* (1, 1, 1) * 145/255 of each: 54.7 degrees off, so that the mirror shows what is behind the plate */
    assert_true(seen_in_the_middle(&e) < 0.3);
    assert_true(fabs(seen_in_the_middle(&e) - 0.04) > 4e-3);
    unlink(sky_name);
}

/* A rough and a smooth coat over a rough metal, below a lamp. */
static void estimators_agree_on_a_coat(void **state) {
    (void)state;
    static const char *const coats[] = {"\"clearcoatFactor\":1",
                                        "\"clearcoatFactor\":0.7,\"clearcoatRoughnessFactor\":0.3"};
    const lobe_heuristic others[] = {LOBE_HEURISTIC_BSDF_ONLY, LOBE_HEURISTIC_LIGHT_ONLY};
    for (int k = 0; k < 2; ++k) {
        char material[1000];
        print_coated(material, sizeof material, "\"metallicFactor\":0.5,\"roughnessFactor\":0.4",
                     coats[k]);
        strcat(material, ",{\"emissiveFactor\":[1,1,1]}");
        write_square_file(name,
                          (square_file){.material = material,
                                        .meshes = second_mesh,
                                        .children = "0,1,2",
                                        .nodes = "{\"mesh\":0,\"rotation\":[-0.38,0,0,0.925]},"
                                                 "{\"mesh\":1,\"translation\":[0,4,0],"
                                                 "\"rotation\":[0.7071,0,0,0.7071],"
                                                 "\"scale\":[2,2,2]}"});
        lobe_scene *scene = load(name);
        unlink(name);
        lobe_render_options o = small(32, 32, 24);
        o.depth = 1;
        assert_estimators_agree(scene, o, others, 2, 40);
        lobe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_plate_follows_the_cosine),
                                       cmocka_unit_test(a_square_that_glows),
                                       cmocka_unit_test(a_sphere_that_glows),
                                       cmocka_unit_test(a_sky_brighter_above),
                                       cmocka_unit_test(a_black_mirror_shows_its_tint),
                                       cmocka_unit_test(share_and_tint_have_textures),
                                       cmocka_unit_test(a_white_base_loses_nothing),
                                       cmocka_unit_test(a_smooth_coat_shows_its_share),
                                       cmocka_unit_test(a_coat_over_white_loses_nothing),
                                       cmocka_unit_test(a_coat_has_its_textures),
                                       cmocka_unit_test(estimators_agree_on_a_coat)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
