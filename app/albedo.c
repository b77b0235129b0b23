/* app/albedo.c: `lobe albedo`: how much a microsurface reflects, once and in all. */
#include <math.h>
#include <string.h>

#include <lobe/albedo.h>
#include <lobe/random.h>
#include <lobe/walk.h>

#include "albedo_dielectric.h"
#include "albedo_draws.h"
#include "commands.h"
#include "dielectric.h"
#include "interrupt.h"
#include "model.h"
#include "number.h"
#include "table.h"

/* From METHOD_DRAWS on, the samplers of lobe_method. */
typedef enum albedo_method {
    METHOD_QUADRATURE,
    METHOD_TABLE,
    METHOD_FIT,
    METHOD_DRAWS
} albedo_method;
typedef enum compensation { COMPENSATION_NONE, KULLA_CONTY, TURQUIN, WALK } compensation;

#define METHOD_NAME(ID, name, about) name,
static const char *const methods[] = {"quadrature", "table", "fit", LOBE_METHODS(METHOD_NAME) NULL};
#undef METHOD_NAME
static const char *const compensations[] = {"none", "kulla-conty", "turquin", "walk", NULL};
static const char *const formats[] = {"csv", "ndjson", NULL};

enum { COSINES_MAX = 256, LAWS_MAX = 16 };

typedef struct cosine_list {
    double value[COSINES_MAX];
    int count;
} cosine_list;

typedef struct law_list {
    lobe_reflectance law[LAWS_MAX];
    int count;
} law_list;

typedef struct albedo_values {
    lobe_app_model_values model;
    cosine_list mu;
    law_list fresnel;
    int method, compensation, format;
    uint64_t walks, samples, seed;
    bool json;
} albedo_values;

/* ---- Options --------------------------------------------------------------------------------- */

static bool read_cosines(const lobe_app_option *option, const char *text, void *value) {
    cosine_list *list = value;
    list->count = lobe_app_read_numbers(text, 1, COSINES_MAX, list->value);
    bool is_good = list->count > 0;
    for (int i = 0; i < list->count; i++)
        is_good &= list->value[i] != 0 && fabs(list->value[i]) <= 1;
    if (!is_good)
        lobe_app_report(option->name, "give up to 256 cosines above 0 and up to 1, as in 0.1,0.5,1",
                        "cannot use '%.60s'", text);
    return is_good;
}

static lobe_reflectance law_of(const lobe_app_fresnel *f) {
    static const lobe_reflectance_law laws[] = {
        [LOBE_APP_FRESNEL_NONE] = LOBE_REFLECTANCE_ONE,
        [LOBE_APP_FRESNEL_SCHLICK] = LOBE_REFLECTANCE_SCHLICK,
        [LOBE_APP_FRESNEL_F82] = LOBE_REFLECTANCE_F82,
        [LOBE_APP_FRESNEL_DIELECTRIC] = LOBE_REFLECTANCE_DIELECTRIC,
        [LOBE_APP_FRESNEL_CONDUCTOR] = LOBE_REFLECTANCE_CONDUCTOR};
    return (lobe_reflectance){laws[f->kind], f->parameter[0], f->parameter[1]};
}

/* One law, or one for each wavelength, with slashes between. */
static bool read_laws(const lobe_app_option *option, const char *text, void *value) {
    law_list *list = value;
    list->count = 0;
    for (const char *rest = text;; rest++) {
        char one[128];
        const size_t length = strcspn(rest, "/");
        if (length >= sizeof one || list->count == LAWS_MAX) {
            lobe_app_report(option->name, "give up to 16 laws with / between",
                            "'%.60s' is too long a list", text);
            return false;
        }
        memcpy(one, rest, length);
        one[length] = '\0';
        lobe_app_fresnel fresnel = {0};
        if (!lobe_app_read_fresnel(option, one, &fresnel)) return false;
        list->law[list->count++] = law_of(&fresnel);
        rest += length;
        if (!*rest) return true;
    }
}

#define MEMBER(name) offsetof(albedo_values, name)
static const lobe_app_option options[] = {
    {"--mu", "M[,M...]", "0.1,0.2,...,1",
     "cosines between the direction and the normal, toward +x; below 0 inside a dielectric",
     read_cosines, MEMBER(mu), NULL},
    {"--wi", "X,Y,Z", "none",
     "one direction above the surface (also below one of --bsdf dielectric), of any length, "
     "instead "
     "of --mu",
     lobe_app_read_direction, MEMBER(model.wi), NULL},
    {"--method", "NAME", "quadrature",
     "where E comes from; fit: Smith, equal roughnesses; the name of a sampler: the mean weight of "
     "its draws",
     lobe_app_read_choice, MEMBER(method), methods},
    {"--samples", "N", "65536", "draws a row by --method SAMPLER, from 1 to 1e9", lobe_app_read_u64,
     MEMBER(samples), NULL},
    {"--multiscatter", "NAME", "none",
     "what makes up for the scatterings after the first; walk: they themselves, by random walks",
     lobe_app_read_choice, MEMBER(compensation), compensations},
    {"--fresnel", "F[/F...]", "none",
     "reflectance of a microfacet: none (F = 1), F0 (Schlick), f82:F0,TINT, dielectric:IOR, "
     "conductor:N,K; several, one for each wavelength, give a row each",
     read_laws, MEMBER(fresnel), NULL},
    {"--walks", "N", "1000000", "random walks a row, from 1 to 1e9", lobe_app_read_u64,
     MEMBER(walks), NULL},
    {"--seed", "S", "1", "of the random walks and draws", lobe_app_read_u64, MEMBER(seed), NULL},
    {"--format", "NAME", "csv", "of the output", lobe_app_read_choice, MEMBER(format), formats},
    {"--json", NULL, NULL, "the same as --format ndjson", NULL, MEMBER(json), NULL},
    {0}};
#undef MEMBER

/* The model options that an integral knows. */
static void pick_model_options(lobe_app_option *picked) {
    static const char *const names[] = {"--ndf",  "--masking",   "--alpha", "--g2",
                                        "--bsdf", "--transport", "--floor", "--geometric-normal"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
        for (const lobe_app_option *o = lobe_app_model_options; o->name; o++)
            if (strcmp(o->name, names[k]) == 0) *picked++ = *o;
    *picked = (lobe_app_option){0};
}

/* ---- E by the chosen method ------------------------------------------------------------------ */

typedef struct source {
    lobe_microsurface surface;
    albedo_method method;
    lobe_vec3_f64 plane; /* geometric normal */
    bool is_tilted;      /* against the shading normal */
    lobe_app_draws draws;
    lobe_albedo_f32 table;
    double missing_average; /* 1 - E_avg as the method says it, */
    double missing;         /* and as it makes it: the average of its 1 - E */
} source;

static double quadrature(const source *s, lobe_reflectance f, lobe_vec3_f64 w) {
    return s->is_tilted ? lobe_albedo_above(s->surface, f, w, s->plane, LOBE_EFFORT_FINE)
                        : lobe_albedo(s->surface, f, w, LOBE_EFFORT_FINE);
}

/* 1 - E, but by draws */
static double missing_toward(const source *s, lobe_vec3_f64 w) {
    switch (s->method) {
    case METHOD_TABLE:
        return (double)lobe_albedo_missing_f32(&s->table,
                                               (lobe_vec3_f32){(float)w.x, (float)w.y, (float)w.z});
    case METHOD_FIT:
        return lobe_albedo_fit_missing_f64(s->surface.ndf, s->surface.g2, s->surface.alpha_x, w.z);
    case METHOD_QUADRATURE:
    case METHOD_DRAWS:
        break;
    }
    return 1 - quadrature(s, lobe_reflectance_one(), w);
}

/* 1/pi * integral of (1 - E) cosine: even steps of t, cosine = t^4; a quarter of the azimuths. */
static double missing_of(const source *s) {
    enum { STEPS = 256 };
    const int turns = s->surface.alpha_x == s->surface.alpha_y ? 1 : 48;
    double sum = 0;
    for (int j = 0; j < turns; j++) {
        const double angle = acos(0.0) * (j + 0.5) / turns;
        for (int i = 0; i < STEPS; i++) {
            const double t = (i + 0.5) / STEPS, t3 = t * t * t, z = t3 * t, plane = sqrt(1 - z * z);
            const lobe_vec3_f64 w = {plane * cos(angle), plane * sin(angle), z};
            sum += 8 * t3 * t3 * t * missing_toward(s, w);
        }
    }
    return sum / (STEPS * turns);
}

static lobe_app_draws draws_of(const albedo_values *v) {
    lobe_app_draws d = {.options = lobe_reflection_default_options(),
                        .alpha = {v->model.alpha[0], v->model.alpha[1]},
                        .plane = v->model.plane,
                        .count = v->samples,
                        .seed = v->seed};
    d.options.model = (lobe_model){(lobe_ndf)v->model.ndf, (lobe_masking)v->model.masking,
                                   (lobe_method)(v->method - METHOD_DRAWS)};
    d.options.g2 = (lobe_g2)v->model.g2;
    d.options.floor = v->model.floor;
    return d;
}

static source source_of(const albedo_values *v) {
    source s = {.method = v->method < METHOD_DRAWS ? (albedo_method)v->method : METHOD_DRAWS,
                .plane = v->model.plane,
                .is_tilted = v->model.plane.z < 1,
                .draws = draws_of(v)};
    s.surface = (lobe_microsurface){(lobe_ndf)v->model.ndf, (lobe_masking)v->model.masking,
                                    (lobe_g2)v->model.g2, v->model.alpha[0], v->model.alpha[1]};
    s.table = lobe_albedo_prepare_f32(s.surface.ndf, s.surface.masking, s.surface.g2,
                                      (float)s.surface.alpha_x, (float)s.surface.alpha_y);
    if (s.method == METHOD_TABLE)
        s.missing_average = (double)s.table.missing_average;
    else if (s.method == METHOD_FIT)
        s.missing_average =
            lobe_albedo_fit_missing_average_f64(s.surface.ndf, s.surface.g2, s.surface.alpha_x);
    else
        s.missing_average =
            fmax(1 - lobe_albedo_average(s.surface, lobe_reflectance_one(), LOBE_EFFORT_FINE), 0);
    const bool is_exact = s.method == METHOD_QUADRATURE || s.method == METHOD_DRAWS;
    s.missing = is_exact ? s.missing_average : missing_of(&s);
    return s;
}

/* ---- Rows ------------------------------------------------------------------------------------ */

/* One direction: 1 - E, and what the first scattering reflects by each law. */
typedef struct scattering {
    double lacks, first[LAWS_MAX];
} scattering;

/* false: interrupted. */
static bool scatter(const albedo_values *v, const source *s, lobe_vec3_f64 wi, scattering *once) {
    const law_list *laws = &v->fresnel;
    if (s->method == METHOD_DRAWS) {
        double e;
        if (!lobe_app_albedo_by_draws(&s->draws, wi, laws->law, laws->count, &e, once->first))
            return false;
        once->lacks = 1 - e;
        return true;
    }
    once->lacks = missing_toward(s, wi);
    for (int k = 0; k < laws->count; k++) once->first[k] = quadrature(s, laws->law[k], wi);
    return true;
}

/* All that leaves: the first scattering, the others as compensated. */
static double furnace_of(const source *s, lobe_reflectance f, compensation c, double first,
                         double lacks, double f_ms) {
    if (c == TURQUIN)
        return first * lobe_multiscatter_turquin_f64(lobe_reflectance_at(f, 1.0), lacks);
    if (c == KULLA_CONTY && s->missing_average > 0)
        return first + f_ms * lacks * s->missing / s->missing_average;
    return first;
}

/* What all scatterings toward one direction reflect by each law; false: interrupted. */
static bool walk(const albedo_values *v, lobe_microsurface s, lobe_vec3_f64 wi,
                 double furnace[LAWS_MAX]) {
    enum { MOST = 100000 };
    for (int k = 0; k < v->fresnel.count; k++) furnace[k] = 0;
    for (uint64_t i = 0; i < v->walks && !lobe_app_interrupted; i++) {
        double weight[LAWS_MAX];
        lobe_walk_sample(s, v->fresnel.law, v->fresnel.count, wi, v->seed, i, MOST, weight);
        for (int k = 0; k < v->fresnel.count; k++) furnace[k] += weight[k];
    }
    for (int k = 0; k < v->fresnel.count; k++) furnace[k] /= (double)v->walks;
    return !lobe_app_interrupted;
}

static const char *const columns[] = {"mu", "e", "e_avg", "f_avg", "f_ms", "furnace", NULL};

/* false: standard output is closed, or interrupted. */
static bool write_direction(const albedo_values *v, const source *s, const lobe_app_table *table,
                            lobe_vec3_f64 wi) {
    const compensation c = (compensation)v->compensation;
    double walked[LAWS_MAX];
    scattering once;
    if (c == WALK && !walk(v, s->surface, wi, walked)) return false;
    if (!scatter(v, s, wi, &once)) return false;
    const double lacks = once.lacks;
    for (int k = 0; k < v->fresnel.count; k++) {
        const lobe_reflectance f = v->fresnel.law[k];
        const double f_avg = lobe_reflectance_average(f);
        const double f_ms = c != WALK   ? lobe_multiscatter_fms_f64(f_avg, s->missing_average)
                            : lacks > 0 ? (walked[k] - once.first[k]) / lacks
                                        : 1;
        const double furnace =
            c == WALK ? walked[k] : furnace_of(s, f, c, once.first[k], lacks, f_ms);
        const double row[] = {wi.z, 1 - lacks, 1 - s->missing_average, f_avg, f_ms, furnace};
        if (!lobe_app_write_row(table, row)) return false;
    }
    return true;
}

/* The surface that --bsdf dielectric means. */
static lobe_app_dielectric_surface dielectric_of(const albedo_values *v) {
    lobe_app_dielectric_surface s = {.alpha = {v->model.alpha[0], v->model.alpha[1]},
                                     .ior = v->fresnel.law[0].a};
    s.options = lobe_dielectric_default_options();
    s.options.g2 = (lobe_g2)v->model.g2;
    s.options.transport = (lobe_transport)v->model.transport;
    s.options.compensate = v->compensation == TURQUIN;
    s.walks = v->compensation == WALK ? v->walks : 0;
    s.seed = v->seed;
    return s;
}

static lobe_app_status check_walks(const albedo_values *v) {
    if (v->compensation == WALK &&
        (v->model.masking != LOBE_MASKING_SMITH || v->model.g2 != LOBE_G2_CORRELATED))
        return lobe_app_reject("--multiscatter", "take another, or leave it out",
                               "walks are known for --masking smith --g2 correlated only");
    if (v->walks < 1 || v->walks > 1000000000)
        return lobe_app_reject("--walks", "give 1 to 1000000000", "out of range");
    return LOBE_APP_DONE;
}

static lobe_app_status check_dielectric(const albedo_values *v) {
    if (v->fresnel.count != 1 || v->fresnel.law[0].law != LOBE_REFLECTANCE_DIELECTRIC)
        return lobe_app_reject("--fresnel", "give one index, as in dielectric:1.5",
                               "--bsdf dielectric needs dielectric:IOR");
    if (v->method != METHOD_QUADRATURE)
        return lobe_app_reject("--method", "take --method quadrature",
                               "%s is known for --bsdf reflection only", methods[v->method]);
    if (v->compensation == KULLA_CONTY)
        return lobe_app_reject("--multiscatter", "take none, turquin or walk",
                               "kulla-conty is known for --bsdf reflection only");
    const lobe_app_dielectric_surface s = dielectric_of(v);
    if (!lobe_dielectric_prepare_f64(s.options, v->model.wi, s.alpha[0], s.alpha[1], s.ior)
             .is_valid)
        return lobe_app_reject("--alpha", "give a smaller roughness", "%g,%g is too large",
                               s.alpha[0], s.alpha[1]);
    return check_walks(v);
}

static lobe_vec3_f64 toward(double mu) {
    return (lobe_vec3_f64){sqrt(1 - mu * mu), 0, mu};
}

static lobe_app_status check_direction(const albedo_values *v, const char *option,
                                       lobe_vec3_f64 wi) {
    const lobe_vec3_f64 g = v->model.plane;
    if (!(wi.z > 0))
        return lobe_app_reject(option,
                               "tilt it above the surface; below goes with --bsdf dielectric",
                               "%g lies below the surface", wi.z);
    if (!(wi.x * g.x + wi.y * g.y + wi.z * g.z > 0))
        return lobe_app_reject("--geometric-normal", "turn it toward the direction",
                               "the direction %g,%g,%g lies below the geometric surface", wi.x,
                               wi.y, wi.z);
    return LOBE_APP_DONE;
}

static lobe_app_status check_directions(const albedo_values *v,
                                        const lobe_app_arguments *arguments) {
    if (lobe_app_is_given(arguments, "--wi")) return check_direction(v, "--wi", v->model.wi);
    lobe_app_status status = LOBE_APP_DONE;
    for (int i = 0; i < v->mu.count && !status; i++)
        status = check_direction(v, "--mu", toward(v->mu.value[i]));
    return status;
}

/* What goes with draws, and what with a geometric surface. */
static lobe_app_status check_sampler(const albedo_values *v, const lobe_app_arguments *arguments) {
    if (v->model.plane.z < 1 && (v->method == METHOD_TABLE || v->method == METHOD_FIT))
        return lobe_app_reject("--geometric-normal", "take --method quadrature or a sampler",
                               "--method %s knows no geometric surface", methods[v->method]);
    if (v->model.plane.z < 1 && v->compensation != COMPENSATION_NONE)
        return lobe_app_reject("--multiscatter", "leave it out",
                               "no compensation knows a geometric surface");
    if (v->method < METHOD_DRAWS) {
        if (lobe_app_is_given(arguments, "--floor"))
            return lobe_app_reject("--floor", "it goes with --ndf ggx --method horizon",
                                   "--method %s draws nothing", methods[v->method]);
        if (lobe_app_is_given(arguments, "--samples"))
            return lobe_app_reject("--samples", "name a sampler, as in --method horizon",
                                   "--method %s draws nothing", methods[v->method]);
        return LOBE_APP_DONE;
    }
    lobe_model model;
    const lobe_app_status status =
        lobe_app_choose_model(v->model.ndf, v->model.masking, v->method - METHOD_DRAWS, &model);
    if (status) return status;
    if (v->samples < 1 || v->samples > 1000000000)
        return lobe_app_reject("--samples", "give 1 to 1000000000", "out of range");
    return lobe_app_check_floor(arguments, model);
}

static lobe_app_status check(const albedo_values *v, const lobe_app_arguments *arguments) {
    lobe_app_status status;
    if ((status = lobe_app_exclude(arguments, "--json", "--format"))) return status;
    if ((status = lobe_app_exclude(arguments, "--wi", "--mu"))) return status;
    const double *alpha = v->model.alpha;
    const lobe_microsurface s = {(lobe_ndf)v->model.ndf, (lobe_masking)v->model.masking,
                                 (lobe_g2)v->model.g2, alpha[0], alpha[1]};
    if (!lobe_app_is_given(arguments, "--alpha"))
        return lobe_app_reject("--alpha", "give the roughness, as in --alpha 0.3", "missing");
    status = lobe_app_check_bsdf(&v->model, arguments);
    if (status || v->model.bsdf == LOBE_APP_DIELECTRIC)
        return status ? status : check_dielectric(v);
    if ((status = check_directions(v, arguments))) return status;
    if ((status = check_sampler(v, arguments))) return status;
    if (isnan(lobe_albedo(s, lobe_reflectance_one(), v->model.wi, LOBE_EFFORT_COARSE)))
        return lobe_app_reject("--alpha", "give a smaller roughness", "%g,%g is too large",
                               alpha[0], alpha[1]);
    if (v->method == METHOD_FIT &&
        (s.masking != LOBE_MASKING_SMITH || alpha[0] != alpha[1] || alpha[0] > 1))
        return lobe_app_reject("--method", "take --method table or quadrature",
                               "the fits hold for --masking smith, equal roughnesses up to 1");
    if (v->method == METHOD_TABLE && (alpha[0] > 2 || alpha[1] > 2))
        return lobe_app_reject("--method", "take --method quadrature",
                               "the table ends at a roughness of 2");
    return check_walks(v);
}

static lobe_app_status write_rows(const albedo_values *v, const lobe_app_arguments *arguments) {
    const bool is_dielectric = v->model.bsdf == LOBE_APP_DIELECTRIC;
    const lobe_app_dielectric_surface dielectric = dielectric_of(v);
    const source s = is_dielectric ? (source){0} : source_of(v);
    const lobe_app_table table = {v->json ? LOBE_APP_NDJSON : (lobe_app_format)v->format,
                                  LOBE_APP_F64,
                                  is_dielectric ? lobe_app_dielectric_columns : columns};
    lobe_app_catch_interrupt();
    const bool is_one = lobe_app_is_given(arguments, "--wi");
    bool goes_on = lobe_app_begin_table(&table);
    for (int i = 0; i < (is_one ? 1 : v->mu.count) && goes_on && !lobe_app_interrupted; i++) {
        const double mu = v->mu.value[i];
        const lobe_vec3_f64 wi = is_one ? v->model.wi : toward(mu);
        goes_on = is_dielectric ? lobe_app_write_dielectric(&dielectric, &table, wi)
                                : write_direction(v, &s, &table, wi);
    }
    return lobe_app_interrupted ? LOBE_APP_INTERRUPTED : LOBE_APP_DONE;
}

lobe_app_status lobe_app_albedo(int argc, char **argv) {
    albedo_values values = {
        .model = lobe_app_default_model(), .walks = 1000000, .samples = 65536, .seed = 1};
    values.model.wi.z = 1;
    values.mu.count = 10;
    for (int i = 0; i < 10; i++) values.mu.value[i] = (i + 1) / 10.0;
    values.fresnel = (law_list){{lobe_reflectance_one()}, 1};
    lobe_app_option model_options[16];
    pick_model_options(model_options);
    const lobe_app_group groups[] = {
        {"Microsurface", model_options, &values.model}, {"Albedo", options, &values}, {0}};
    const lobe_app_command command = {
        "albedo",
        "--alpha A[,AY] [OPTIONS]",
        "Integrates: e, the albedo of one scattering with F = 1 toward a direction; e_avg, its "
        "average;\n"
        "f_avg, the average of F; f_ms, the colour of the later scatterings (Hill 2018; as "
        "walked);\n"
        "furnace, what the surface reflects of even light, with F and with the chosen "
        "compensation.\n"
        "With --bsdf dielectric: r and t, what is reflected and transmitted of even light in one "
        "scattering;\n"
        "energy, their sum before transmission changes radiance; furnace, the same with the "
        "chosen\n"
        "compensation or by walks; all_r and all_t, r and t of that.\n"
        "With --geometric-normal, e and furnace count only what leaves above that plane too;\n"
        "e_avg and f_ms do not know it.",
        NULL,
        groups,
        "lobe albedo --alpha 0.5 --mu 0.2,0.9 --fresnel 0.9 --multiscatter kulla-conty"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if ((status = check(&values, &arguments))) return status;
    return write_rows(&values, &arguments);
}
