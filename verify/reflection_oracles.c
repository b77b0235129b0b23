#include "reflection_oracles.h"

#include <math.h>

#include "cubature.h"

/* How a method covers the reflections that leave the surface; decides what is known of it. */
typedef enum coverage {
    COVERAGE_OTHER,
    COVERAGE_VISIBLE, /* every visible normal, by its area */
    COVERAGE_CAP,     /* a smaller cap: exact at normal incidence and where alpha = 1 */
    COVERAGE_GROOVE,  /* a side of a groove: from behind all of them leave */
    COVERAGE_ALL      /* exactly what leaves */
} coverage;

typedef struct method_facts {
    double weight_bound; /* 0: none */
    coverage coverage;
} method_facts;

/* The one place for facts about a model. A model without a row is verified all the same, without
 * independent closed forms. */
static const method_facts FACTS[LOBE_NDF_COUNT][LOBE_MASKING_COUNT][LOBE_METHOD_COUNT] = {
    [LOBE_NDF_GGX][LOBE_MASKING_SMITH] =
        {
            [LOBE_METHOD_SLOPE_PUBLISHED] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_SLOPE] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_ELLIPSOID] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_CAPS] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_BOUNDED] = {1, COVERAGE_CAP},
            [LOBE_METHOD_OPTIMAL] = {1, COVERAGE_CAP},
            [LOBE_METHOD_HORIZON_MIRROR] = {1, COVERAGE_ALL},
            [LOBE_METHOD_HORIZON_EXACT] = {1, COVERAGE_ALL},
            [LOBE_METHOD_HORIZON_UNIFORM] = {0, COVERAGE_ALL},
            [LOBE_METHOD_HORIZON] = {0, COVERAGE_ALL},
        },
    [LOBE_NDF_BECKMANN][LOBE_MASKING_SMITH] =
        {
            [LOBE_METHOD_SLOPE] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_NEWTON_PUBLISHED] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_NEWTON] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_HORIZON] = {0, COVERAGE_ALL},
        },
    [LOBE_NDF_GGX][LOBE_MASKING_VCAVITY] =
        {
            [LOBE_METHOD_VCAVITY] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_VCAVITY_VALID] = {1, COVERAGE_GROOVE},
        },
    [LOBE_NDF_BECKMANN][LOBE_MASKING_VCAVITY] =
        {
            [LOBE_METHOD_VCAVITY] = {1, COVERAGE_VISIBLE},
            [LOBE_METHOD_VCAVITY_VALID] = {1, COVERAGE_GROOVE},
        },
};

/* Methods that are published with an error: the tests that it makes fail, and the roughness up to
 * which 10^8 draws show it where there is no second plane. */
typedef struct published_bias {
    const char *tests;
    double most_alpha;
} published_bias;

static const published_bias BIASES[LOBE_METHOD_COUNT] = {
    [LOBE_METHOD_SLOPE_PUBLISHED] = {"chi2 rejected furnace", 1.5},
    /* three steps leave a residual from below; few configurations show it, none has to */
    [LOBE_METHOD_NEWTON_PUBLISHED] = {"chi2", -1},
};

static void set_known_bias(lobe_reflection_subject *subject, const published_bias *bias) {
    const lobe_reflection_parameters *p = &subject->parameters;
    subject->model.known_bias = bias->tests;
    subject->model.is_bias_due =
        bias->tests != NULL && p->tilt == 0 && fmax(p->alpha_x, p->alpha_y) <= bias->most_alpha;
}

static const double PI = 3.14159265358979323846;
static const double LN2 = 0.69314718055994530942;

typedef struct surface {
    lobe_model row;
    double alpha; /* 0: anisotropic */
    double mu;
    int is_separable;
} surface;

static surface surface_of(const lobe_reflection_subject *subject) {
    const lobe_reflection_parameters *p = &subject->parameters;
    return (surface){p->options.model, p->alpha_x == p->alpha_y ? p->alpha_x : 0,
                     subject->model.wi[2], p->options.g2 == LOBE_G2_SEPARABLE};
}

static int is_smith_ggx(const surface *s) {
    return s->row.ndf == LOBE_NDF_GGX && s->row.masking == LOBE_MASKING_SMITH;
}

/* Share of the visible normals that reflect upward. */
static double visible_share(const surface *s, const lobe_ggx_chart *chart) {
    if (s->mu <= 0) return 1;
    if (!is_smith_ggx(s)) return NAN;
    if (s->mu == 1 && s->alpha > 0) return 1 / (1 + s->alpha * s->alpha);
    if (s->alpha == 1) return 1 / (1 + s->mu);
    return lobe_ggx_chart_visible_share(chart);
}

static double accepted_share(const surface *s, coverage method, const lobe_ggx_chart *chart) {
    int is_exact = s->alpha == 1 || (s->mu == 1 && s->alpha > 0 && s->alpha < 1);
    if (method == COVERAGE_VISIBLE) return visible_share(s, chart);
    if (method == COVERAGE_ALL) return 1;
    if (method == COVERAGE_GROOVE && s->mu <= 0) return 1;
    if (method == COVERAGE_CAP && (is_exact || s->mu <= 0)) return 1;
    return NAN;
}

/* G1 of the reflection of the normal, seen about the microfacet of slope sqrt(s). */
static double masked(const surface *surface, double s) {
    double a = surface->alpha, up = 1 - s; /* o = (2 sqrt(s), 0, up)/(1 + s) */
    if (surface->row.masking == LOBE_MASKING_VCAVITY) return fmin(1, 2 * up / (1 + s));
    if (surface->row.ndf == LOBE_NDF_GGX) return 2 * up / (up + sqrt(up * up + 4 * a * a * s));
    double c = up / (2 * a * sqrt(s));
    double lambda = exp(-c * c) / (2 * c * sqrt(PI)) - erfc(c) / 2;
    return 1 / (1 + lambda);
}

/* At normal incidence, over s = tan^2 of the normal; the same for both G2. */
static void normal_albedo_integrand(const void *self, double s, double y,
                                    double values[LOBE_CUBATURE_VALUES]) {
    (void)y;
    const surface *surface = self;
    double a2 = surface->alpha * surface->alpha;
    double density =
        surface->row.ndf == LOBE_NDF_GGX ? a2 / ((a2 + s) * (a2 + s)) : exp(-s / a2) / a2;
    values[0] = density * masked(surface, s);
}

/* In two parts: at s = 1/3 a V-cavity begins to hide. */
static double normal_albedo(const surface *s) {
    lobe_integrand integrand = {
        .evaluate = normal_albedo_integrand, .self = s, .count = 1, .tolerance = {1e-13}};
    double sum[2][LOBE_CUBATURE_VALUES];
    lobe_cubature(&integrand, (lobe_box){{0, 0}, {1.0 / 3, 1}}, sum[0]);
    lobe_cubature(&integrand, (lobe_box){{1.0 / 3, 0}, {1, 1}}, sum[1]);
    return sum[0][0] + sum[1][0];
}

static double albedo(const surface *s) {
    if (s->mu <= 0) return NAN;
    if (s->mu == 1 && s->alpha > 0) return normal_albedo(s);
    if (s->alpha != 1 || !is_smith_ggx(s)) return NAN;
    return s->is_separable ? 2 * (1 - LN2) / (1 + s->mu) : 1 - s->mu * log1p(1 / s->mu);
}

void lobe_reflection_set_oracles(lobe_reflection_subject *subject) {
    lobe_verify_model *model = &subject->model;
    lobe_model row = subject->parameters.options.model;
    const method_facts *facts = &FACTS[row.ndf][row.masking][row.method];
    surface s = surface_of(subject);
    if (facts->weight_bound > 0) model->weight_bound = facts->weight_bound;
    set_known_bias(subject, &BIASES[row.method]);
    if (subject->parameters.tilt != 0) return; /* no closed form knows the second plane */
    model->accepted_oracle = accepted_share(&s, facts->coverage, &subject->chart);
    model->albedo_oracle = albedo(&s);
    if (facts->coverage == COVERAGE_CAP && s.alpha == 1 && s.mu > 0) {
        model->density_oracle = 1 / (2 * PI);
    }
}
