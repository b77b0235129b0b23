/* tests/render/test_checkpoint.c: a damaged, foreign or unfitting checkpoint is refused in one line; a good one is gone on
 * with to the same bits. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "render/checkpoint.h"
#include "render/schedule.h"

typedef struct bytes {
    unsigned char *data;
    size_t size;
} bytes;

static char path[64];

static bytes read_file(void) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    bytes b = {NULL, (size_t)ftell(file)};
    b.data = malloc(b.size + 1);
    rewind(file);
    assert_int_equal(fread(b.data, 1, b.size, file), b.size);
    fclose(file);
    return b;
}

static void write_file(const void *data, size_t size) {
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

static int set_up(void **state) {
    (void)state;
    snprintf(path, sizeof path, "/tmp/lobe-checkpoint-%ld", (long)getpid());
    return 0;
}

static int tear_down(void **state) {
    (void)state;
    remove(path);
    return 0;
}

static void expect_refused(const char *what, size_t where) {
    lobe_film *film;
    checkpoint_cost cost;
    const lobe_render_result result = lobe_checkpoint_read(path, &film, &cost);
    if (result != LOBE_RENDER_BAD_INPUT || film != NULL)
        fail_msg("%s at %zu is taken", what, where);
    const char *message = lobe_render_error_message();
    assert_int_equal(strncmp(message, path, strlen(path)), 0);
    assert_null(strchr(message, '\n'));
}

static lobe_render_options options_of_small_one(void) {
    lobe_render_options o = small(5, 3, 2);
    o.checkpoint = path;
    return o;
}

static bytes small_checkpoint(void) {
    lobe_scene *scene = load("furnace");
    lobe_film_free(render(scene, options_of_small_one(), NULL));
    lobe_scene_free(scene);
    return read_file();
}

static void every_cut_is_noticed(void **state) {
    (void)state;
    const bytes whole = small_checkpoint();
    for (size_t size = 0; size < whole.size; size++) {
        write_file(whole.data, size);
        expect_refused("a cut", size);
    }
    whole.data[whole.size] = 0;
    write_file(whole.data, whole.size + 1);
    expect_refused("a byte too much", whole.size);
    write_file(whole.data, whole.size);
    lobe_film *film;
    checkpoint_cost cost;
    assert_int_equal(lobe_checkpoint_read(path, &film, &cost), LOBE_RENDER_OK);
    lobe_film_free(film);
    free(whole.data);
}

static void every_changed_byte_is_noticed(void **state) {
    (void)state;
    const bytes whole = small_checkpoint();
    uint32_t random = 1;
    for (size_t i = 0; i < whole.size; i++) {
        random = random * 1664525u + 1013904223u;
        const unsigned char bit = (unsigned char)(1u << (random >> 29));
        whole.data[i] ^= bit;
        write_file(whole.data, whole.size);
        expect_refused("a changed bit", i);
        whole.data[i] ^= bit;
    }
    free(whole.data);
}

static void foreign_files_are_refused_and_kept(void **state) {
    (void)state;
    static const char *const foreign[] = {"", "PF\n1 1\n-1.0\n", "lobe checkpoin",
                                          "lobe checkpoint and more"};
    lobe_scene *scene = load("furnace");
    for (size_t i = 0; i < sizeof foreign / sizeof *foreign; i++) {
        write_file(foreign[i], strlen(foreign[i]));
        expect_refused("a foreign file", i);
    }
    write_file(foreign[1], strlen(foreign[1]));
    lobe_film *film;
    assert_int_equal(lobe_render(scene, options_of_small_one(), &film, NULL),
                     LOBE_RENDER_BAD_INPUT);
    const bytes kept = read_file();
    assert_memory_equal(kept.data, foreign[1], kept.size);
    free(kept.data);
    lobe_scene_free(scene);
}

/* A right hash over sums that no render can have left. */
static void impossible_counts_are_refused(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_render_options o = options_of_small_one();
    o.samples = 40;
    lobe_film *film = render(scene, o, NULL), *other = NULL;
    static const uint32_t counts[] = {3, 41, 24, UINT32_MAX, 8};
    o.resume = path;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        film->pixels[7].samples = counts[i]; /* 8 is a step, but not that of the other pixels */
        assert_int_equal(lobe_checkpoint_write(path, film, (checkpoint_cost){0}), LOBE_RENDER_OK);
        assert_int_equal(lobe_render(scene, o, &other, NULL), LOBE_RENDER_BAD_INPUT);
        assert_null(other);
    }
    lobe_film_free(film);
    lobe_scene_free(scene);
}

static void other_options_are_named(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace"), *another = load("cornell");
    lobe_render_options good = options_of_small_one();
    lobe_film_free(render(scene, good, NULL));
    good.checkpoint = NULL;
    good.resume = path;
    lobe_render_options o[14];
    static const char *const names[] = {"spp",      "depth", "size",   "seed",         "part",
                                        "roulette", "aov",   "method", "multiscatter", "heuristic",
                                        "g2",       "floor", "metal",  "adaptive"};
    for (int i = 0; i < 14; i++) o[i] = good;
    o[0].samples++;
    o[1].depth++;
    o[2].height++;
    o[3].seed++;
    o[4].parts = 2;
    o[5].roulette_depth++;
    o[6].aovs = 1;
    o[7].reflection.model.method = LOBE_METHOD_CAPS;
    o[8].multiscatter = LOBE_MULTISCATTER_TURQUIN;
    o[9].heuristic = LOBE_HEURISTIC_POWER;
    o[10].reflection.g2 = LOBE_G2_SEPARABLE;
    o[11].reflection.floor = 0.5;
    assert_true(lobe_metal_from_name("gold", &o[12].metal));
    o[13].is_adaptive = 1;
    o[13].samples = 64;
    lobe_film *film;
    for (int i = 0; i < 14; i++) {
        char expected[32];
        snprintf(expected, sizeof expected, "its %s is ", names[i]);
        assert_int_equal(lobe_render(scene, o[i], &film, NULL), LOBE_RENDER_BAD_INPUT);
        if (!strstr(lobe_render_error_message(), expected))
            fail_msg("%s is not named: %s", names[i], lobe_render_error_message());
    }
    assert_int_equal(lobe_render(another, good, &film, NULL), LOBE_RENDER_BAD_INPUT);
    assert_non_null(strstr(lobe_render_error_message(), "its triangles is "));
    good.threads = 3; /* what does not decide the bits may be another */
    good.time_limit = 100.0;
    lobe_film_free(render(scene, good, NULL));
    lobe_scene_free(another);
    lobe_scene_free(scene);
}

/* Stopped after so many progress reports. */
typedef struct stop {
    volatile sig_atomic_t cancel;
    int after;
} stop;

static void count_down(void *user, const lobe_render_progress *progress) {
    (void)progress;
    stop *s = user;
    if (--s->after <= 0) s->cancel = 1;
}

static void interrupt_anywhere(const lobe_scene *scene, lobe_render_options o) {
    o.aovs = LOBE_AOV_BIT(LOBE_AOV_NORMAL) | LOBE_AOV_BIT(LOBE_AOV_REJECTED);
    lobe_film *whole = render(scene, o, NULL);
    o.checkpoint = path;
    remove(path);
    int runs = 0;
    for (lobe_render_result result = LOBE_RENDER_INTERRUPTED; result != LOBE_RENDER_OK; runs++) {
        stop s = {0, 1 + runs * 7 % 9};
        o.progress = count_down;
        o.progress_user = &s;
        o.cancel = &s.cancel;
        o.threads = 1 + runs % 3;
        o.resume = path;
        lobe_film *film = NULL;
        result = lobe_render(scene, o, &film, NULL);
        assert_non_null(film);
        if (result == LOBE_RENDER_OK) {
            const size_t pixels = 50 * 35;
            assert_memory_equal(film->pixels, whole->pixels, pixels * sizeof *film->pixels);
            if (o.is_adaptive)
                assert_memory_equal(film->weights, whole->weights, pixels * sizeof(double));
            assert_memory_equal(film->first_hit, whole->first_hit,
                                pixels * FILM_FIRST_HIT_VALUES * sizeof *film->first_hit);
        }
        lobe_film_free(film);
        assert_true(runs < 1000);
    }
    assert_true(runs > 2);
    lobe_film_free(whole);
}

static void interrupted_anywhere_the_bits_are_the_same(void **state) {
    (void)state;
    lobe_scene *scene = load("gallery");
    lobe_render_options o = small(50, 35, 37);
    interrupt_anywhere(scene, o);
    o.samples = 160;
    o.is_adaptive = 1;
    interrupt_anywhere(scene, o);
    o.samples = 1000;
    o.noise = 0.1;
    interrupt_anywhere(scene, o);
    lobe_scene_free(scene);
}

/* A right hash over a plan that cannot be. */
static void impossible_plans_are_refused(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_render_options o = small(20, 17, 64);
    o.checkpoint = path;
    o.is_adaptive = 1;
    lobe_film *film = render(scene, o, NULL), *other = NULL;
    const film_tile good = film->tiles[2];
    film_tile bad[7];
    for (int i = 0; i < 7; i++) bad[i] = good;
    bad[0].done = 8;
    bad[1].done = good.planned + 16;
    bad[2].planned = 0;
    bad[3].planned += 8;
    bad[4].before = 0;
    bad[5].squares = NAN;
    bad[6].planned = UINT32_MAX - 15;
    o.resume = path;
    for (int i = 0; i < 7; i++) {
        film->tiles[2] = bad[i];
        assert_int_equal(lobe_checkpoint_write(path, film, (checkpoint_cost){0}), LOBE_RENDER_OK);
        if (lobe_render(scene, o, &other, NULL) != LOBE_RENDER_BAD_INPUT)
            fail_msg("plan %d is taken", i);
    }
    film->tiles[2] = good;
    for (uint32_t round = 0; round < 40; round += round == 1 ? 2 : 1) { /* 2: the right one */
        film->round = round;
        assert_int_equal(lobe_checkpoint_write(path, film, (checkpoint_cost){0}), LOBE_RENDER_OK);
        if (round != 2)
            assert_int_equal(lobe_render(scene, o, &other, NULL), LOBE_RENDER_BAD_INPUT);
    }
    lobe_film_free(film);
    lobe_scene_free(scene);
}

/* Every sample once, in order, whoever takes the units and however late they come back. */
static void schedule_gives_every_sample_once(void **state) {
    (void)state;
    enum { TILES = 7, SAMPLES = 77, HANDS = 5 };
    for (int stepwise = 0; stepwise < 2; stepwise++) {
        schedule s;
        uint32_t done[TILES] = {0}, random = 5;
        unit held[HANDS] = {0};
        assert_true(lobe_schedule_create(&s, TILES, SAMPLES, 1, 1));
        s.is_stepwise = stepwise;
        for (int is_over = 0; !is_over;) {
            random = random * 1664525u + 1013904223u;
            unit *hand = &held[(random >> 16) % HANDS];
            if (hand->count) {
                lobe_schedule_deliver(&s, hand);
                done[hand->tile] += hand->count;
                *hand = (unit){0};
                continue;
            }
            const schedule_answer answer = lobe_schedule_next(&s, hand);
            is_over = answer == SCHEDULE_END;
            if (answer == SCHEDULE_UNIT) assert_int_equal(hand->first, done[hand->tile]);
            if (answer == SCHEDULE_PASS)
                for (int t = 0; t < TILES; t++) assert_int_equal(done[t], s.passed);
        }
        for (int t = 0; t < TILES; t++) assert_int_equal(done[t], SAMPLES);
        lobe_schedule_free(&s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_cut_is_noticed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(every_changed_byte_is_noticed, set_up, tear_down),
        cmocka_unit_test_setup_teardown(foreign_files_are_refused_and_kept, set_up, tear_down),
        cmocka_unit_test_setup_teardown(impossible_counts_are_refused, set_up, tear_down),
        cmocka_unit_test_setup_teardown(other_options_are_named, set_up, tear_down),
        cmocka_unit_test_setup_teardown(interrupted_anywhere_the_bits_are_the_same, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(impossible_plans_are_refused, set_up, tear_down),
        cmocka_unit_test(schedule_gives_every_sample_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
