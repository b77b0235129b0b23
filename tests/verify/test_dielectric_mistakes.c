/* tests/verify/test_dielectric_mistakes.c: a textbook rough dielectric (Walter et al. 2007, drawn by visible
 * normals), from both sides: the engine accepts it, and finds the mistakes that renderers have made. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/verify/support.h"
#include "verify/bins.h"

static const double PI = 3.14159265358979323846;

typedef enum mistake {
    NONE,
    WITHOUT_ETA,       /* the index left out of the Jacobian of refraction */
    HALF_VECTOR_SIGN,  /* the refracted half vector on the wrong side for an index below 1 */
    BOUNDED_NORMALS,   /* normals bounded for reflection, taken for refraction too */
    RADIANCE_ONCE,     /* 1/eta^2 in the weight, not in the value */
    NO_TRANSMISSION,   /* an early way out for wo.z <= 0 */
    TOTAL_REFLECTION,  /* sqrt of a negative cosine */
    CHOICE_FORGOTTEN,  /* densities without the probability of the choice */
    FRESNEL_OF_NORMAL, /* Fresnel of wi.z instead of wi.m, in the value */
    WITHOUT_G1,        /* the density of all normals for that of the visible ones */
    INDEX_OF_OUTSIDE,  /* the index not turned around inside, in density and value */
    MASKED_BELOW,      /* masking is 0 for wo.z <= 0, in the value */
    MASKING_MIXED,     /* separable masking in the weight, correlated in the value */
    COSINE_OF_WI,      /* |wi.m| for |wo.m| in the Jacobian of refraction */
    RADIANCE_INVERTED, /* eta^2 for 1/eta^2, everywhere */
    JACOBIAN_CLAMPED,  /* the denominator kept from 0, against fireflies */
    DRAWN_AGAIN        /* a draw that does not leave is made again, the density does not know */
} mistake;

static mistake made;

typedef struct dielectric {
    double alpha, eta; /* index inside over outside */
} dielectric;

typedef struct prepared {
    double alpha;
    double eta; /* of the other side over that of wi */
    double wi[3];
    double side; /* of wi */
} prepared;

static const prepared *view(const lobe_verify_state *state) {
    return (const void *)state->bytes;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double fresnel(double c, double eta) {
    double g2 = 1 - (1 - c * c) / (eta * eta);
    if (g2 <= 0 && made != TOTAL_REFLECTION) return 1;
    double t = sqrt(g2);
    double s = (c - eta * t) / (c + eta * t), q = (eta * c - t) / (eta * c + t);
    return (s * s + q * q) / 2;
}

static double distribution(const prepared *p, const double m[3]) {
    double a2 = p->alpha * p->alpha;
    double s = (m[0] * m[0] + m[1] * m[1]) / a2 + m[2] * m[2];
    return 1 / (PI * a2 * s * s);
}

/* Smith's Lambda of the upper side of the microsurface, v.z != 0. */
static double lambda(const prepared *p, const double v[3]) {
    double tangent2 = (v[0] * v[0] + v[1] * v[1]) / (v[2] * v[2]);
    return (sqrt(1 + p->alpha * p->alpha * tangent2) - 1) / 2;
}

/* Everything is computed with wi above: a direction below is seen in a mirror. */
typedef struct event {
    double m[3], im, om;
    int is_reflection, is_valid;
} event;

static event event_of(const prepared *p, const double wo[3]) {
    event e = {{0, 0, 0}, 0, 0, wo[2] > 0, 0};
    double ratio = e.is_reflection ? 1 : p->eta;
    for (int k = 0; k < 3; ++k) e.m[k] = p->wi[k] + ratio * wo[k];
    double length = sqrt(dot(e.m, e.m));
    if (!(length > 0) || wo[2] == 0 || !(p->wi[2] > 0)) return e;
    double sign = e.m[2] < 0 || (made == HALF_VECTOR_SIGN && !e.is_reflection) ? -1 : 1;
    for (int k = 0; k < 3; ++k) e.m[k] *= sign / length;
    e.im = dot(p->wi, e.m);
    e.om = dot(wo, e.m);
    e.is_valid = e.im > 0 && (e.is_reflection ? e.om > 0 : e.om < 0) && e.m[2] > 0;
    if (made == NO_TRANSMISSION && !e.is_reflection) e.is_valid = 0;
    return e;
}

static double jacobian(const prepared *p, const event *e) {
    if (e->is_reflection) return 1 / (4 * e->im);
    double sum = e->im + p->eta * e->om;
    double scale = made == WITHOUT_ETA ? 1 : p->eta * p->eta;
    double square = made == JACOBIAN_CLAMPED ? fmax(sum * sum, 1e-2) : sum * sum;
    return scale * (made == COSINE_OF_WI ? e->im : fabs(e->om)) / square;
}

/* The share of wi that the bounded cap keeps of its lower part (Eto & Tokuyoshi 2023). */
static double cap_k(const prepared *p) {
    if (made != BOUNDED_NORMALS) return 1;
    double a2 = p->alpha * p->alpha, z2 = p->wi[2] * p->wi[2];
    double s = 1 + sqrt(fmax(1 - z2, 0));
    return (1 - a2) * s * s / (s * s + a2 * z2);
}

/* Height of the stretched reflection about m over the cap of BOUNDED_NORMALS: negative, never drawn. */
static double over_cap(const prepared *p, const double m[3]) {
    double i[3] = {p->alpha * p->wi[0], p->alpha * p->wi[1], p->wi[2]};
    double h[3] = {m[0] / p->alpha, m[1] / p->alpha, m[2]};
    double t = sqrt(dot(i, i));
    return 2 * dot(i, h) * h[2] / (dot(h, h) * t) - (1 - cap_k(p)) * p->wi[2] / t;
}

static double density_above(const prepared *p, const double wo[3]) {
    event e = event_of(p, wo);
    if (!e.is_valid || (made == BOUNDED_NORMALS && over_cap(p, e.m) < 0)) return 0;
    double x = p->alpha * p->wi[0], y = p->alpha * p->wi[1];
    double t = sqrt(x * x + y * y + p->wi[2] * p->wi[2]);
    double visible = e.im * distribution(p, e.m) * 2 / (cap_k(p) * p->wi[2] + t);
    if (made == WITHOUT_G1) visible = e.im * distribution(p, e.m) / p->wi[2];
    double f = fresnel(e.im, p->eta);
    double choice = made == CHOICE_FORGOTTEN ? 1 : e.is_reflection ? f : 1 - f;
    return choice * visible * jacobian(p, &e);
}

static double value_above(const prepared *p, const double wo[3], int is_weight) {
    event e = event_of(p, wo);
    if (!e.is_valid) return 0;
    double f = fresnel(made == FRESNEL_OF_NORMAL ? p->wi[2] : e.im, p->eta);
    double g2 = 1 / (1 + lambda(p, p->wi) + lambda(p, wo));
    if (made == MASKED_BELOW && !e.is_reflection) return 0;
    if (made == MASKING_MIXED && is_weight) g2 = 1 / (1 + lambda(p, p->wi)) / (1 + lambda(p, wo));
    double part = (e.is_reflection ? f : 1 - f) * e.im * distribution(p, e.m) * g2 / p->wi[2];
    int has_scale = made != RADIANCE_ONCE || is_weight;
    double radiance = e.is_reflection || !has_scale ? 1 : 1 / (p->eta * p->eta);
    if (made == RADIANCE_INVERTED) radiance = 1 / radiance;
    return part * jacobian(p, &e) * radiance;
}

static void mirrored(const prepared *p, const double wo[3], double up[3]) {
    up[0] = wo[0];
    up[1] = wo[1];
    up[2] = p->side * wo[2];
}

static double density(const lobe_verify_state *state, const double wo[3]) {
    double up[3];
    mirrored(view(state), wo, up);
    return density_above(view(state), up);
}

static double value(const lobe_verify_state *state, const double wo[3]) {
    double up[3];
    mirrored(view(state), wo, up);
    return value_above(view(state), up, 0);
}

/* Dupuy & Benyoub 2023. */
static void visible_normal(const prepared *p, const double u[3], double m[3]) {
    double i[3] = {p->alpha * p->wi[0], p->alpha * p->wi[1], p->wi[2]};
    double t = sqrt(dot(i, i));
    double z = 1 - u[1] * (1 + cap_k(p) * i[2] / t);
    double radius = sqrt(fmax(1 - z * z, 0));
    m[0] = p->alpha * (radius * cos(2 * PI * u[0]) + i[0] / t);
    m[1] = p->alpha * (radius * sin(2 * PI * u[0]) + i[1] / t);
    m[2] = fmax(z + i[2] / t, 0);
    double length = sqrt(dot(m, m));
    for (int k = 0; k < 3 && length > 0; ++k) m[k] /= length;
}

static void refract(const prepared *p, const double m[3], double im, double wo[3]) {
    double cosine = sqrt(1 - (1 - im * im) / (p->eta * p->eta));
    for (int k = 0; k < 3; ++k) wo[k] = (im / p->eta - cosine) * m[k] - p->wi[k] / p->eta;
}

static lobe_verify_draw sample_once(const prepared *p, const double u[3]) {
    lobe_verify_draw draw = {{0, 0, 0}, 0, 0};
    if (!(p->wi[2] > 0)) return draw;
    double m[3], wo[3];
    visible_normal(p, u, m);
    double im = dot(p->wi, m);
    if (!(im > 0)) return draw;
    int is_reflection = u[2] < fresnel(im, p->eta);
    if (is_reflection) {
        for (int k = 0; k < 3; ++k) wo[k] = 2 * im * m[k] - p->wi[k];
    } else {
        refract(p, m, im, wo);
    }
    mirrored(p, wo, draw.wo);
    if (is_reflection != (wo[2] > 0) && !isnan(wo[2])) return draw;
    draw.pdf = density_above(p, wo);
    draw.weight = draw.pdf > 0 ? value_above(p, wo, 1) / draw.pdf : 0;
    return draw;
}

static lobe_verify_draw sample(const lobe_verify_state *state, const double u[3]) {
    double v[3] = {u[0], u[1], u[2]};
    lobe_verify_draw draw = sample_once(view(state), v);
    for (int again = 0; made == DRAWN_AGAIN && draw.pdf == 0 && again < 32; ++again) {
        for (int k = 0; k < 3; ++k) v[k] = fmod(v[k] * 8191 + 0.377, 1);
        draw = sample_once(view(state), v);
    }
    return draw;
}

static void prepare(const void *self, const double wi[3], lobe_verify_state *state) {
    const dielectric *d = self;
    double side = wi[2] < 0 ? -1 : 1;
    double eta = side > 0 || made == INDEX_OF_OUTSIDE ? d->eta : 1 / d->eta;
    prepared p = {d->alpha, eta, {wi[0], wi[1], side * wi[2]}, side};
    memcpy(state->bytes, &p, sizeof p);
}

typedef struct trial {
    const char *name;
    mistake mistake;
    const char *test; /* that is meant to see it */
    double alpha, eta, theta;
} trial;

static const trial TRIALS[] = {
    {"no index in the Jacobian", WITHOUT_ETA, "chi2", 0.4, 1.5, 50},
    {"no index in the Jacobian, from inside", WITHOUT_ETA, "chi2", 0.2, 1.5, 150},
    {"half vector on the wrong side", HALF_VECTOR_SIGN, "albedo", 0.3, 1.5, 150},
    {"bounded normals refracted", BOUNDED_NORMALS, "coverage", 0.8, 1.5, 50},
    {"radiance scaled once", RADIANCE_ONCE, "weight", 0.3, 1.5, 40},
    {"radiance scaled once, furnace", RADIANCE_ONCE, "furnace", 0.3, 1.5, 40},
    {"no transmission", NO_TRANSMISSION, "albedo", 0.3, 1.5, 40},
    {"total reflection", TOTAL_REFLECTION, "chi2", 0.3, 1.5, 130},
    {"the choice forgotten", CHOICE_FORGOTTEN, "chi2", 0.3, 1.5, 40},
    {"Fresnel of the shading normal", FRESNEL_OF_NORMAL, "reciprocity", 0.5, 1.5, 60},
    {"density of all normals", WITHOUT_G1, "chi2", 0.5, 1.5, 70},
    {"index not turned around inside", INDEX_OF_OUTSIDE, "reciprocity", 0.3, 1.5, 150},
    {"masked below the surface", MASKED_BELOW, "albedo", 0.3, 1.5, 40},
    {"maskings mixed", MASKING_MIXED, "weight", 0.5, 1.5, 60},
    {"maskings mixed, furnace", MASKING_MIXED, "furnace", 0.5, 1.5, 60},
    {"the wrong cosine in the Jacobian", COSINE_OF_WI, "chi2", 0.4, 1.5, 50},
    {"the wrong cosine in the Jacobian, from inside", COSINE_OF_WI, "chi2", 0.2, 1.5, 150},
    {"radiance scaled inversely", RADIANCE_INVERTED, "reciprocity", 0.3, 1.5, 40},
    {"radiance scaled inversely, from inside", RADIANCE_INVERTED, "reciprocity", 0.3, 1.5, 150},
    {"the Jacobian clamped", JACOBIAN_CLAMPED, "chi2", 0.3, 1.05, 40},
    {"drawn again from inside", DRAWN_AGAIN, "rejected", 0.4, 1.5, 130},
};
enum { TRIAL_COUNT = sizeof TRIALS / sizeof *TRIALS };

/* Of the right model: what a consistent loss of light is held against. */
static double integral_of_value(const lobe_verify_model *model) {
    lobe_bins bins;
    assert_true(lobe_bins_make(&bins, model, 16, 16));
    double sum = bins.value;
    lobe_bins_free(&bins);
    return sum;
}

static void run_trial(const trial *t, mistake m, lobe_report *report) {
    dielectric self = {t->alpha, t->eta};
    lobe_verify_model model = lobe_verify_plain_model();
    double theta = t->theta * PI / 180, phi = 0.5;
    model.name = m == NONE ? "without" : t->name;
    model.configuration = m == NONE ? t->name : "";
    model.self = &self;
    model.wi[0] = sin(theta) * cos(phi);
    model.wi[1] = sin(theta) * sin(phi);
    model.wi[2] = cos(theta);
    model.prepare = prepare;
    model.sample = sample;
    model.density = density;
    model.value = value;
    model.is_reciprocal = 1;
    model.passing = 1 / (t->eta * t->eta);
    model.takes_legal_only = 1;
    model.below = lobe_lower_hemisphere_chart();
    if (strcmp(t->test, "albedo") == 0) model.albedo_oracle = integral_of_value(&model);
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.p_limit = LIST_P_LIMIT;
    made = m;
    run_engine(&model, &settings, report);
    made = NONE;
    print_failures(&model, report);
}

static void mistakes_are_found(void **state) {
    (void)state;
    for (int i = 0; i < TRIAL_COUNT; ++i) {
        lobe_report report;
        run_trial(&TRIALS[i], TRIALS[i].mistake, &report);
        const lobe_report_row *row = find_row(&report, TRIALS[i].test);
        assert_non_null(row);
        if (lobe_report_row_passed(row)) fail_msg("%s: %s saw nothing", TRIALS[i].name, row->test);
    }
}

static void the_textbook_without_them_is_accepted(void **state) {
    (void)state;
    for (int i = 0; i < TRIAL_COUNT; ++i) {
        lobe_report report;
        run_trial(&TRIALS[i], NONE, &report);
        assert_int_equal(count_failures(&report), 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(mistakes_are_found),
                                       cmocka_unit_test(the_textbook_without_them_is_accepted)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
