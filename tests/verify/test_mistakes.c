/* tests/verify/test_mistakes.c: mistakes that renderers have made, each in a textbook GGX of the test's
 * own: without the mistake the engine accepts it, with it the named test of `--quick` fails. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "tests/verify/support.h"

static const double PI = 3.14159265358979323846;

typedef enum mistake {
    NONE,
    /* sampler and density */
    K_FROM_BEHIND,    /* the bounded cap also for wi below, by the sampler only */
    K_UNCLAMPED,      /* k of an alpha above 1, as if it were below */
    ONE_NUMBER_TWICE, /* u1 for radius and azimuth */
    HALF_TURN,        /* azimuth pi u */
    SWAPPED,          /* density of wi given wo */
    NOT_COVERED,      /* the sampler leaves out the last 2 % of its cap, and the density knows */
    COSINE_CLAMPED,   /* wi.z at least 1e-3 in the masking, against fireflies */
    WEIGHT_CLAMPED,   /* weights at most 1 of a method that has larger ones */
    G2_OF_THE_OTHER,  /* separable, where the correlated one is promised */
    /* numbers */
    HALF_VECTOR_ZERO,   /* wi + wo = 0 normalised */
    BASIS_AT_THE_POLE,  /* frame about wi divided by its length across z */
    BASIS_BEHIND,       /* frame about wi divided by 1 + wi.z */
    ALPHA_ZERO,         /* 1/alpha */
    U_IS_ONE,           /* tan^2 = alpha^2 u/(1 - u) */
    D_OF_ONE_COSINE,    /* (c^2 (a^2 - 1) + 1) in single precision */
    D_OF_ITS_SINE,      /* 1 - m_z^2 for the sine, in single precision */
    NOT_OF_UNIT_LENGTH, /* a normal of a quick normalisation */
    RARELY_NAN,         /* one draw in ten thousand */
    WEIGHT_OF_REJECTED  /* a weight where nothing was drawn */
} mistake;

static mistake made;

typedef struct textbook {
    double alpha[2];
    int is_polar;  /* all normals (D cos) instead of visible ones */
    int is_single; /* D in float */
} textbook;

typedef struct prepared {
    double alpha[2];
    double wi[3];
    int is_polar, is_single;
} prepared;

static const prepared *view(const lobe_verify_state *state) {
    return (const void *)state->bytes;
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* ---- Numbers --------------------------------------------------------------------------------- */

/* Walter et al. 2007 in components; in float the rounding unit is that of the model. */
static double distribution(const prepared *p, const double m[3]) {
    double ax = p->alpha[0], ay = p->alpha[1];
    if (made == D_OF_ONE_COSINE && p->is_single) {
        float c = (float)m[2], a2 = (float)(ax * ax);
        float d = c * c * (a2 - 1) + 1;
        return a2 / (PI * d * d);
    }
    if (made == D_OF_ITS_SINE && p->is_single) {
        float c = (float)m[2], sine2 = 1 - c * c;
        double s = sine2 / (ax * ax) + c * c;
        return 1 / (PI * ax * ax * s * s);
    }
    double s = m[0] * m[0] / (ax * ax) + m[1] * m[1] / (ay * ay) + m[2] * m[2];
    return 1 / (PI * ax * ay * s * s);
}

/* |A v|, the length of the stretched direction. */
static double stretched(const prepared *p, const double v[3]) {
    double x = p->alpha[0] * v[0], y = p->alpha[1] * v[1];
    return sqrt(x * x + y * y + v[2] * v[2]);
}

/* Normaliser of the visible normals: valid from behind too (Tokuyoshi 2021), and without
 * cancellation there. */
static double visible_area(const prepared *p, const double v[3]) {
    double z = made == COSINE_CLAMPED ? fmax(v[2], 1e-3) : v[2];
    double x = p->alpha[0] * v[0], y = p->alpha[1] * v[1];
    double rough2 = x * x + y * y;
    double t = sqrt(rough2 + z * z);
    return z < 0 ? rough2 / (t - z) / 2 : (t + z) / 2;
}

static int half_vector(const prepared *p, const double wo[3], double m[3]) {
    for (int k = 0; k < 3; ++k) m[k] = p->wi[k] + wo[k];
    double length = sqrt(dot(m, m));
    if (!(length > 0) && made != HALF_VECTOR_ZERO) return 0;
    for (int k = 0; k < 3; ++k) m[k] /= length;
    return !(m[2] < 0);
}

/* What this textbook promises to take: finite numbers, directions of about unit length, rough
 * surfaces. */
static int is_usable(const prepared *p, const double v[3]) {
    double length2 = dot(v, v), wi2 = dot(p->wi, p->wi);
    int is_rough = (p->alpha[0] > 0 && p->alpha[1] > 0) || made == ALPHA_ZERO;
    int is_not_down = !(p->wi[2] <= 0 && p->wi[0] == 0 && p->wi[1] == 0);
    return is_rough && length2 > 0.9 && length2 < 1.1 && wi2 > 0.9 && wi2 < 1.1 &&
           (is_not_down || made == BASIS_BEHIND);
}

/* ---- The three functions --------------------------------------------------------------------- */

/* Of the bounded cap (Eto & Tokuyoshi 2023): how much of the height below wi it keeps. */
static double cap_k(const prepared *p, int is_sampler) {
    double a = fmin(p->alpha[0], p->alpha[1]);
    double z = p->wi[2];
    if (z <= 0 && !(made == K_FROM_BEHIND && is_sampler)) return 1;
    if (made != K_UNCLAMPED) a = fmin(a, 1);
    double s = 1 + sqrt(p->wi[0] * p->wi[0] + p->wi[1] * p->wi[1]);
    return (1 - a * a) * s * s / (s * s + a * a * z * z);
}

static double density_of(const prepared *p, const double wo[3]) {
    double m[3];
    if (!is_usable(p, wo) || !(wo[2] > 0) || !half_vector(p, wo, m)) return 0;
    double d = distribution(p, m);
    double im = dot(p->wi, m);
    if (p->is_polar) return im > 1e-200 ? d * m[2] / (4 * im) : 0;
    double area = visible_area(p, p->wi);
    double t = stretched(p, p->wi);
    double cap = area - (1 - cap_k(p, 0)) * fmax(p->wi[2], 0) / 2;
    if (made == K_UNCLAMPED) cap = (t + cap_k(p, 0) * p->wi[2]) / 2;
    return d / (4 * cap);
}

static double density(const lobe_verify_state *state, const double wo[3]) {
    const prepared *p = view(state);
    if (made == SWAPPED) {
        prepared other = *p;
        for (int k = 0; k < 3; ++k) other.wi[k] = wo[k];
        return wo[2] > 0 ? density_of(&other, p->wi) : 0;
    }
    return density_of(p, wo);
}

static double lambda(const prepared *p, const double v[3]) {
    double z = made == COSINE_CLAMPED ? fmax(v[2], 1e-3) : v[2];
    double x = p->alpha[0] * v[0], y = p->alpha[1] * v[1];
    return (sqrt(1 + (x * x + y * y) / (z * z)) - 1) / 2;
}

static double value(const lobe_verify_state *state, const double wo[3]) {
    const prepared *p = view(state);
    double m[3];
    if (!is_usable(p, wo) || !(wo[2] > 0) || !half_vector(p, wo, m)) return 0;
    if (!(p->wi[2] > 0)) return made == HALF_VECTOR_ZERO && isnan(m[0]) ? m[0] : 0;
    double li = lambda(p, p->wi), lo = lambda(p, wo);
    double g2 = made == G2_OF_THE_OTHER ? 1 / ((1 + li) * (1 + lo)) : 1 / (1 + li + lo);
    return distribution(p, m) * g2 / (4 * p->wi[2]);
}

static void visible_normal(const prepared *p, const double u[3], double m[3]) {
    double t = stretched(p, p->wi);
    double i[3] = {p->alpha[0] * p->wi[0] / t, p->alpha[1] * p->wi[1] / t, p->wi[2] / t};
    double radius_u = made == NOT_COVERED ? 0.98 * u[1] : u[1];
    double azimuth_u = made == ONE_NUMBER_TWICE ? u[1] : u[0];
    double low = -cap_k(p, 1) * i[2];
    double z = 1 - radius_u * (1 - low);
    double radius = sqrt(fmax(1 - z * z, 0));
    double angle = (made == HALF_TURN ? 1 : 2) * PI * azimuth_u;
    m[0] = p->alpha[0] * (radius * cos(angle) + i[0]);
    m[1] = p->alpha[1] * (radius * sin(angle) + i[1]);
    m[2] = fmax(z + i[2], 0);
}

static void polar_normal(const prepared *p, const double u[3], double m[3]) {
    double most = made == U_IS_ONE ? 2 : 1 - 0x1p-53;
    double v = fmin(u[0], most);
    double tangent = sqrt(v / (1 - v));
    m[0] = p->alpha[0] * tangent * cos(2 * PI * u[1]);
    m[1] = p->alpha[1] * tangent * sin(2 * PI * u[1]);
    m[2] = 1;
}

/* Frames about wi, as samplers need that turn the disk towards it. They leave no trace but where they
 * divide by zero. */
static double trace_of_basis(const prepared *p) {
    double x = p->wi[0], y = p->wi[1];
    if (made == BASIS_AT_THE_POLE) return 0 * (1 / sqrt(x * x + y * y));
    if (made == BASIS_BEHIND) return 0 * (x * y / (1 + p->wi[2]));
    return 0;
}

static int is_unit(double u) {
    return u >= 0 && (u < 1 || (made == U_IS_ONE && u == 1));
}

static lobe_verify_draw sample(const lobe_verify_state *state, const double u[3]) {
    const prepared *p = view(state);
    lobe_verify_draw draw = {{0, 0, 0}, 0, 0};
    if (!is_usable(p, p->wi) || !is_unit(u[0]) || !is_unit(u[1])) return draw;
    double m[3];
    if (p->is_polar) {
        polar_normal(p, u, m);
    } else {
        visible_normal(p, u, m);
    }
    double length = sqrt(dot(m, m)) * (made == NOT_OF_UNIT_LENGTH ? 1 + 1e-7 : 1);
    if (!(length > 0)) return draw;
    double im = dot(p->wi, m) / length;
    for (int k = 0; k < 3; ++k) {
        draw.wo[k] = 2 * im * m[k] / length - p->wi[k] + trace_of_basis(p);
    }
    draw.pdf = density(state, draw.wo);
    draw.weight = draw.pdf > 0 ? value(state, draw.wo) / draw.pdf : 0;
    if (made == U_IS_ONE && isnan(draw.wo[0])) draw.pdf = draw.wo[0];
    if (made == WEIGHT_CLAMPED) draw.weight = fmin(draw.weight, 1);
    if (made == WEIGHT_OF_REJECTED && !(draw.pdf > 0)) draw.weight = 1;
    if (made == RARELY_NAN && u[0] < 1e-4) draw.weight = NAN;
    return draw;
}

/* The density of NOT_COVERED: nothing in the last part of the cap, more elsewhere. */
static double density_without_the_rest(const lobe_verify_state *state, const double wo[3]) {
    const prepared *p = view(state);
    double m[3], d = density_of(p, wo);
    if (made != NOT_COVERED || !(d > 0) || !half_vector(p, wo, m)) return density(state, wo);
    double t = stretched(p, p->wi);
    double i[3] = {p->alpha[0] * p->wi[0] / t, p->alpha[1] * p->wi[1] / t, p->wi[2] / t};
    double h[3] = {m[0] / p->alpha[0], m[1] / p->alpha[1], m[2]};
    double length2 = dot(h, h);
    double z = 2 * dot(i, h) * h[2] / length2 - i[2]; /* of the reflection in the stretched frame */
    double low = -cap_k(p, 0) * i[2];
    return z < 1 - 0.98 * (1 - low) ? 0 : d / 0.98;
}

static void prepare(const void *self, const double wi[3], lobe_verify_state *state) {
    const textbook *t = self;
    prepared p = {{t->alpha[0], t->alpha[1]}, {wi[0], wi[1], wi[2]}, t->is_polar, t->is_single};
    memcpy(state->bytes, &p, sizeof p);
}

static int prepare_special(const void *self, const double wi[3], size_t index,
                           lobe_verify_state *state) {
    textbook t = *(const textbook *)self;
    t.alpha[0] = 0;
    if (index == 0) prepare(&t, wi, state);
    return index == 0;
}

/* ---- The list -------------------------------------------------------------------------------- */

typedef struct trial {
    const char *name;
    mistake mistake;
    const char *test; /* that is meant to see it */
    double alpha_x, alpha_y, theta, phi;
    int is_polar, is_single;
} trial;

static const trial TRIALS[] = {
    {"k from behind in the sampler", K_FROM_BEHIND, "chi2", 0.5, 0.5, 110, 20, 0, 0},
    {"k of a roughness above 1", K_UNCLAMPED, "chi2", 2, 2, 30, 0, 0, 0},
    {"one random number for two", ONE_NUMBER_TWICE, "chi2", 0.4, 0.4, 40, 20, 0, 0},
    {"half a turn", HALF_TURN, "chi2", 0.4, 0.4, 40, 20, 0, 0},
    {"wi and wo exchanged in the density", SWAPPED, "chi2", 0.4, 0.4, 60, 20, 0, 0},
    {"a part of the cap left out", NOT_COVERED, "coverage", 0.8, 0.8, 40, 20, 0, 0},
    {"cosines clamped", COSINE_CLAMPED, "rejected", 0.01, 0.01, 89.99, 0, 0, 0},
    {"weights clamped", WEIGHT_CLAMPED, "weight", 0.5, 0.5, 60, 0, 1, 0},
    {"weights clamped, furnace", WEIGHT_CLAMPED, "furnace", 0.5, 0.5, 60, 0, 1, 0},
    {"G2 of the other form", G2_OF_THE_OTHER, "albedo", 1, 1, 60, 30, 0, 0},
    {"half vector of wi = -wo", HALF_VECTOR_ZERO, "extreme", 0.4, 0.4, 60, 30, 0, 0},
    {"basis at normal incidence", BASIS_AT_THE_POLE, "sound", 0.4, 0.4, 0, 0, 0, 0},
    {"basis at normal incidence, elsewhere", BASIS_AT_THE_POLE, "extreme", 0.4, 0.4, 50, 0, 0, 0},
    {"basis at -z", BASIS_BEHIND, "extreme", 0.4, 0.4, 60, 30, 0, 0},
    {"alpha = 0", ALPHA_ZERO, "extreme", 0.4, 0.4, 60, 30, 0, 0},
    {"u = 1", U_IS_ONE, "extreme", 0.4, 0.4, 60, 30, 1, 0},
    {"D of one cosine", D_OF_ONE_COSINE, "precision", 0.01, 0.01, 40, 0, 0, 1},
    {"D of its sine", D_OF_ITS_SINE, "precision", 0.01, 0.01, 40, 0, 0, 1},
    {"not of unit length", NOT_OF_UNIT_LENGTH, "length", 0.4, 0.4, 60, 30, 0, 0},
    {"rarely NaN", RARELY_NAN, "sound", 0.4, 0.4, 60, 30, 0, 0},
    {"weight of a rejected draw", WEIGHT_OF_REJECTED, "sound", 0.8, 0.8, 40, 0, 0, 0},
};
enum { TRIAL_COUNT = sizeof TRIALS / sizeof *TRIALS };

static lobe_ggx_chart chart;
static lobe_verify_model twin;

static lobe_verify_model model_of(const trial *t, textbook *self) {
    *self = (textbook){{t->alpha_x, t->alpha_y}, t->is_polar, t->is_single};
    lobe_verify_model model = lobe_verify_plain_model();
    double theta = t->theta * PI / 180, phi = t->phi * PI / 180;
    model.name = t->name;
    model.configuration = "";
    model.self = self;
    model.wi[0] = sin(theta) * cos(phi);
    model.wi[1] = sin(theta) * sin(phi);
    model.wi[2] = cos(theta);
    model.prepare = prepare;
    model.prepare_special = prepare_special;
    model.sample = sample;
    model.density = t->mistake == NOT_COVERED ? density_without_the_rest : density;
    model.value = value;
    model.is_reciprocal = 1;
    chart = lobe_ggx_chart_prepare(model.wi, t->alpha_x, t->alpha_y);
    model.chart = lobe_ggx_chart_view(&chart);
    if (t->alpha_x == 1) model.albedo_oracle = 1 - model.wi[2] * log1p(1 / model.wi[2]);
    return model;
}

static void run_trial(const trial *t, mistake m, lobe_report *report) {
    textbook self, exact;
    lobe_verify_model model = model_of(t, &self);
    if (t->is_single) {
        twin = model;
        exact = self;
        exact.is_single = 0;
        twin.self = &exact;
        model.twin = &twin;
        model.rounding = FLT_EPSILON;
    }
    lobe_settings settings = lobe_level_settings(LOBE_VERIFY_QUICK);
    settings.p_limit = LIST_P_LIMIT;
    made = m;
    run_engine(&model, &settings, report);
    made = NONE;
    print_message("%s", m == NONE ? "without: " : "");
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
