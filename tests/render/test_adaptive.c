/* tests/render/test_adaptive.c: adaptive sampling keeps the expectation, which weighing all samples alike does not; it
 * lowers the error; the bits do not depend on threads. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "pictures.h"

#include <string.h>

#include "lobe/random.h"
#include "render/adaptive.h"
#include "render/crew.h"

/* ---- Samples whose distribution is known ------------------------------------------------------ */

enum { ACROSS = 4, TILES = ACROSS * ACROSS, SIDE = ACROSS * TILE };

/* Of 8 samples one may be a flash: rare and bright, as fireflies are. The mean is 1 everywhere. */
typedef struct flashes {
    double probability[TILES];
    uint64_t seed;
    double sums[TILES]; /* of all samples alike: what must not be done */
    uint64_t counts[TILES];
} flashes;

static void render_flashes(const void *user, const unit *u, lobe_film *tile, uint64_t *rays) {
    flashes *f = (flashes *)(uintptr_t)user;
    const double probability = f->probability[u->tile];
    assert_int_equal(u->count, 16);
    for (uint64_t i = 0; i < TILE * TILE; i++) {
        const lobe_random4 r =
            lobe_random(f->seed, u->tile * 256u + i, (uint64_t)u->round << 32 | u->first);
        film_pixel *p = &tile->pixels[i];
        p->half = r.word[0] < probability * 0x1p32 ? 8.0 / probability : 0.0;
        const double value = p->half + (r.word[1] < probability * 0x1p32 ? 8.0 / probability : 0.0);
        for (int c = 0; c < 3; c++) p->rgb[c] = value;
        p->samples += u->count;
        f->sums[u->tile] += value;
        f->counts[u->tile] += u->count;
    }
    *rays += u->count;
}

static double mean_of_tile(const lobe_film *film, int t) {
    double sum = 0;
    for (int i = 0; i < TILE * TILE; i++) {
        const int x = t % ACROSS * TILE + i % TILE, y = t / ACROSS * TILE + i / TILE;
        sum += film->pixels[y * SIDE + x].rgb[0] / film->weights[y * SIDE + x];
    }
    return sum / (TILE * TILE);
}

/* One picture; the means of its tiles, and those of all samples alike. */
static void run_flashes(flashes *f, uint64_t seed, uint32_t samples, double right[TILES],
                        double wrong[TILES]) {
    lobe_render_options o = small(SIDE, SIDE, samples);
    o.is_adaptive = 1;
    crew c = {.options = &o, .render = render_flashes, .user = f, .threads = 1};
    memset(f->sums, 0, sizeof f->sums);
    memset(f->counts, 0, sizeof f->counts);
    f->seed = seed;
    c.start = lobe_clock();
    c.film = lobe_film_create(SIDE, SIDE, 0);
    assert_true(lobe_adaptive_begin(c.film, samples));
    omp_init_lock(&c.lock);
    assert_int_equal(lobe_crew_run(&c), LOBE_RENDER_OK);
    omp_destroy_lock(&c.lock);
    for (int t = 0; t < TILES; t++) {
        right[t] = mean_of_tile(c.film, t);
        wrong[t] = f->sums[t] / (double)f->counts[t];
    }
    /* the budget, but for one step a picture that rounding leaves */
    assert_true(fabs((double)c.samples / (SIDE * SIDE) - samples) < 16.0);
    lobe_film_free(c.film);
}

typedef struct mean_and_error {
    double sum, squares;
} mean_and_error;

static void add(mean_and_error *m, double x) {
    m->sum += x;
    m->squares += x * x;
}

/* How many standard errors the mean is above 1. */
static double z_of(const mean_and_error *m, int count) {
    const double mean = m->sum / count;
    return (mean - 1.0) / sqrt((m->squares / count - mean * mean) / (count - 1));
}

/* z of a normal distribution exceeds 4.5 with a probability of 7e-6, of 34 numbers once in 4000. Sums of rare flashes
 * are skew, but over 300 pictures of 256 pixels little is left of it. The same samples, weighed alike, are off by
 * far more: what has flashed early gets more samples, which then dilute the flash. */
static void flashes_keep_their_mean(void **state) {
    (void)state;
    enum { PICTURES = 300 };
    flashes f = {0};
    for (int t = 0; t < TILES; t++) f.probability[t] = 0.0005 * (1 + t % 4);
    mean_and_error right[TILES + 1] = {0}, wrong[TILES + 1] = {0};
    for (int i = 0; i < PICTURES; i++) {
        double a[TILES], b[TILES], sum_a = 0, sum_b = 0;
        run_flashes(&f, (uint64_t)i, 96, a, b);
        for (int t = 0; t < TILES; t++) {
            add(&right[t], a[t]);
            add(&wrong[t], b[t]);
            sum_a += a[t] / TILES;
            sum_b += b[t] / TILES;
        }
        add(&right[TILES], sum_a);
        add(&wrong[TILES], sum_b);
    }
    for (int t = 0; t <= TILES; t++)
        if (!(fabs(z_of(&right[t], PICTURES)) < 4.5))
            fail_msg("tile %d is off by %g standard errors", t, z_of(&right[t], PICTURES));
    if (!(z_of(&wrong[TILES], PICTURES) < -10.0))
        fail_msg("the wrong mean is off by %g only", z_of(&wrong[TILES], PICTURES));
}

/* One tile of 16 is noisy: its share of samples rises to 16 - 15 / 4, and the error falls. The first round has 1/16 of
 * the samples. */
static void samples_go_where_noise_is(void **state) {
    (void)state;
    enum { PICTURES = 40, SAMPLES = 512 };
    flashes f = {0};
    for (int t = 0; t < TILES; t++) f.probability[t] = t == 5 ? 0.2 : 1.0;
    double square = 0;
    for (int i = 0; i < PICTURES; i++) {
        double right[TILES], wrong[TILES];
        run_flashes(&f, (uint64_t)i, SAMPLES, right, wrong);
        square += (right[5] - 1) * (right[5] - 1) / PICTURES;
        assert_true(f.counts[5] > 6u * SAMPLES * TILE * TILE);
        assert_true(f.counts[6] < SAMPLES * TILE * TILE);
    }
    /* of as many blocks of 8 samples as an even picture has, each 1 / 0.2 or 0 */
    const double even = (1.0 / 0.2 - 1.0) / (SAMPLES / 8.0 * TILE * TILE);
    /* chi-square of 40 degrees of freedom: below 2 times its mean with a probability above 0.999 */
    if (!(square < even / 6.0 * 2.0)) fail_msg("error falls by %g only", even / square);
}

static void every_sample_once(void **state) {
    (void)state;
    enum { HANDS = 5 };
    for (int stepwise = 0; stepwise < 2; stepwise++) {
        static const uint32_t planned[] = {16, 32, 48, 80, 112, 1024, 16};
        enum { COUNT = sizeof planned / sizeof *planned };
        schedule s;
        uint32_t done[COUNT] = {0}, random = 5;
        unit held[HANDS] = {0};
        assert_true(lobe_schedule_create(&s, COUNT, 1, 1, 1) && lobe_schedule_add_rounds(&s));
        memcpy(s.planned, planned, sizeof planned);
        s.is_stepwise = stepwise;
        lobe_schedule_begin_round(&s, 3, 90);
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
            if (answer == SCHEDULE_PASS) assert_true(lobe_schedule_is_even(&s));
            if (answer != SCHEDULE_UNIT) continue;
            assert_int_equal(hand->first, done[hand->tile]);
            assert_int_equal(hand->round, 3);
            assert_true(hand->weight == 90.0 / planned[hand->tile]);
            assert_int_equal(hand->of, planned[hand->tile]);
        }
        assert_memory_equal(done, planned, sizeof planned);
        lobe_schedule_free(&s);
    }
}

static void rounds_make_up_the_samples(void **state) {
    (void)state;
    static const uint32_t samples[] = {64, 100, 130, 200, 512, 1000, LOBE_RENDER_SAMPLES_MAX};
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        uint32_t before = 0;
        for (uint32_t round = 1; before < samples[i]; round++) {
            const uint32_t end = lobe_adaptive_before(round, samples[i]);
            assert_true(end >= before + 16 && end <= samples[i]);
            before = end;
        }
        assert_int_equal(lobe_adaptive_before(16, samples[i]), samples[i]);
    }
}

/* ---- Pictures --------------------------------------------------------------------------------- */

static void scenes_keep_their_mean(void **state) {
    (void)state;
    lobe_scene *scene = load("cornell");
    lobe_render_options o = small(32, 32, 64);
    const block_means even = measure(scene, o);
    o.is_adaptive = 1;
    o.seed = 7;
    const block_means adaptive = measure(scene, o);
    const double z = disagreement(&adaptive, &even);
    if (!(z < 2.2)) fail_msg("off by %g standard errors", z);
    lobe_scene_free(scene);
}

static void same_bits_on_any_number_of_threads(void **state) {
    (void)state;
    enum { WIDTH = 67, HEIGHT = 41, PIXELS = WIDTH * HEIGHT };
    lobe_scene *scene = load("gallery");
    for (int stepwise = 0; stepwise < 2; stepwise++) {
        lobe_render_options o = small(WIDTH, HEIGHT, stepwise ? 4096 : 70);
        o.is_adaptive = 1;
        o.aovs = LOBE_AOV_BIT(LOBE_AOV_NORMAL);
        o.noise = stepwise ? 0.07 : 0.0;
        lobe_film *films[2];
        for (int i = 0; i < 2; i++) {
            lobe_render_statistics statistics;
            o.threads = 1 + 3 * i;
            films[i] = render(scene, o, &statistics);
            if (stepwise) assert_true(statistics.noise <= o.noise);
        }
        assert_memory_equal(films[0]->pixels, films[1]->pixels, PIXELS * sizeof(film_pixel));
        assert_memory_equal(films[0]->weights, films[1]->weights, PIXELS * sizeof(double));
        assert_memory_equal(films[0]->first_hit, films[1]->first_hit,
                            PIXELS * FILM_FIRST_HIT_VALUES * sizeof(double));
        const double weight = films[0]->weights[0];
        for (int i = 0; i < PIXELS; i++)
            assert_true(fabs(films[0]->weights[i] - weight) < (stepwise ? 300.0 : 1e-9));
        if (!stepwise) assert_true(fabs(weight - 70.0) < 1e-9);
        for (int i = 0; i < 2; i++) lobe_film_free(films[i]);
    }
    lobe_scene_free(scene);
}

static void refused(void **state) {
    (void)state;
    lobe_scene *scene = load("furnace");
    lobe_render_options o = small(20, 20, 63);
    lobe_film *film;
    o.is_adaptive = 1;
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
    o.samples = 64;
    o.parts = 2;
    assert_int_equal(lobe_render(scene, o, &film, NULL), LOBE_RENDER_BAD_INPUT);
    lobe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(flashes_keep_their_mean),
                                       cmocka_unit_test(samples_go_where_noise_is),
                                       cmocka_unit_test(every_sample_once),
                                       cmocka_unit_test(rounds_make_up_the_samples),
                                       cmocka_unit_test(scenes_keep_their_mean),
                                       cmocka_unit_test(same_bits_on_any_number_of_threads),
                                       cmocka_unit_test(refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
