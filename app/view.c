#include "view.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "interrupt.h"
#include "metal.h"
#include "number.h"
#include "progress.h"

static const char *const heuristics[] = {"balance", "power", "bsdf-only", "light-only", NULL};
static const char *const multiscatters[] = {"none", "kulla-conty", "turquin", "walk", NULL};

static bool read_material(const lobe_app_option *option, const char *text, void *value) {
    if (lobe_app_read_numbers(text, 5, 5, value) == 5) return true;
    lobe_app_report(option->name, "give R,G,B,METALLIC,ROUGHNESS, each in [0, 1]",
                    "'%.60s' is not a material", text);
    return false;
}

/* "0.02" or "f/2.8" */
static bool read_aperture(const lobe_app_option *option, const char *text, void *value) {
    lobe_app_aperture *a = value;
    const bool is_f_number = strncmp(text, "f/", 2) == 0;
    double number;
    *a = (lobe_app_aperture){0};
    if (lobe_app_read_numbers(is_f_number ? text + 2 : text, 1, 1, &number) == 1 &&
        number <= 1e15 && number >= (is_f_number ? 1e-3 : 0)) {
        if (is_f_number)
            a->f_number = number;
        else
            a->radius = number;
        return true;
    }
    lobe_app_report(option->name, "give a radius, as 0.02, or an f-number, as f/2.8",
                    "'%.40s' is no aperture", text);
    return false;
}

#define AT(member) offsetof(lobe_app_view, member)

const lobe_app_option lobe_app_camera_options[] = {
    {"--size", "WxH", "960x540", "in pixels", lobe_app_read_size, AT(size), NULL},
    {"--camera", "NAME", "the first", "a camera of the file", lobe_app_read_name, AT(camera), NULL},
    {"--aperture", "R|f/N", "0",
     "radius of a thin lens in units of the scene, or the f-number of a camera of 24 mm, a unit "
     "being a metre; 0: all is sharp",
     read_aperture, AT(aperture), NULL},
    {"--focus", "DISTANCE", "what the middle of the picture shows",
     "where a lens is sharp, in units of the scene along the view", lobe_app_read_f64, AT(focus),
     NULL},
    {"--exposure", "EV", "0", "stops, for the written picture", lobe_app_read_f64, AT(exposure),
     NULL},
    {0}};

const lobe_app_option lobe_app_scene_options[] = {
    {"--env", "FILE", "the scene's own light, or a sky", "panorama to light with",
     lobe_app_read_name, AT(environment), NULL},
    {"--env-rotate", "DEG", "0", "degrees about +Y", lobe_app_read_f64, AT(rotation), NULL},
    {"--material", "R,G,B,M,R", "0.8,0.8,0.8,0,0.5",
     "colour, metallic and roughness of meshes that bring no material", read_material, AT(material),
     NULL},
    {"--ground", NULL, NULL, "put a large matte floor below a file's scene", NULL, AT(ground),
     NULL},
    {"--frame-time", "S", "none: nodes rest", "moment of the file's animation, in seconds",
     lobe_app_read_f64, AT(frame_time), NULL},
    {"--animation", "NAME", "the first", "which animation; all: all of them", lobe_app_read_name,
     AT(animation), NULL},
    {"--strict", NULL, NULL, "a warning is an error", NULL, AT(strict), NULL},
    {0}};

const lobe_app_option lobe_app_path_options[] = {
    {"--depth", "N", "8", "greatest number of surface scatterings on a path", lobe_app_read_u64,
     AT(depth), NULL},
    {"--seed", "S", "0", "of the random numbers, any whole number", lobe_app_read_u64, AT(seed),
     NULL},
    {"--threads", "N", "one a processor", "the picture does not depend on it", lobe_app_read_count,
     AT(threads), NULL},
    {"--ndf", "NAME", "ggx", "distribution of normals", lobe_app_read_choice, AT(ndf),
     lobe_app_ndfs},
    {"--masking", "NAME", "smith", "masking of the microsurface", lobe_app_read_choice, AT(masking),
     lobe_app_maskings},
    {"--floor", "D", "0.25", "method horizon: how much of the density ignores shadowing, in [0, 1]",
     lobe_app_read_floor, AT(floor), NULL},
    {"--g2", "NAME", "correlated", "masking and shadowing", lobe_app_read_choice, AT(g2),
     lobe_app_g2s},
    {"--normalization", "NAME", "unbiased", "of the densities behind a shading normal",
     lobe_app_read_choice, AT(normalization), lobe_app_normalizations},
    {"--multiscatter", "NAME", "none",
     "what metals and glass scatter more than once: an approximation, or random walks",
     lobe_app_read_choice, AT(multiscatter), multiscatters},
    {"--metal", "F", "schlick",
     "what all metals reflect: schlick, or f82:R,G,B with a tint by channel, of their base colour; "
     "conductor:NR,NG,NB,KR,KG,KB in its place, exact; or aluminium, chromium, copper, gold, iron, "
     "nickel, silver, titanium",
     lobe_app_read_metal, AT(metal), NULL},
    {"--heuristic", "NAME", "balance", "how light and surface samples are combined",
     lobe_app_read_choice, AT(heuristic), heuristics},
    {0}};

lobe_app_view lobe_app_default_view(void) {
    const lobe_render_options r = lobe_render_default_options();
    return (lobe_app_view){.size = {r.width, r.height},
                           .depth = (uint64_t)r.depth,
                           .floor = r.reflection.floor,
                           .frame_time = NAN,
                           .focus = NAN,
                           .heuristic = (int)r.heuristic,
                           .material = {0.8, 0.8, 0.8, 0, 0.5}};
}

lobe_app_status lobe_app_check_view(const lobe_app_view *v) {
    if (v->depth > 1000000) return lobe_app_reject("--depth", "use 0 to 1000000", "too deep");
    if (v->threads > 1024) return lobe_app_reject("--threads", "use 1 to 1024", "too many threads");
    if (!(fabs(v->exposure) <= 100))
        return lobe_app_reject("--exposure", "use -100 to 100", "out of range");
    if (!isnan(v->focus) && !(v->focus >= 1e-15 && v->focus <= 1e15))
        return lobe_app_reject("--focus", "give a distance above 0", "out of range");
    if (!isnan(v->focus) && !(v->aperture.radius > 0) && !(v->aperture.f_number > 0))
        return lobe_app_reject("--focus", "give --aperture too", "without a lens all is sharp");
    if (!(fabs(v->rotation) <= 36000))
        return lobe_app_reject("--env-rotate", "use degrees, at most 36000", "out of range");
    if (v->animation && isnan(v->frame_time))
        return lobe_app_reject("--animation", "give --frame-time S too", "no moment to show");
    for (int k = 0; k < 5; k++)
        if (!(v->material[k] >= 0 && v->material[k] <= 1))
            return lobe_app_reject("--material", "each number lies in [0, 1]", "out of range");
    if (v->size.width < 1 || v->size.width > LOBE_RENDER_SIZE_MAX || v->size.height < 1 ||
        v->size.height > LOBE_RENDER_SIZE_MAX)
        return lobe_app_reject("--size", "use 1x1 to 32768x32768", "out of range");
    return LOBE_APP_DONE;
}

lobe_app_status lobe_app_choose_render_model(const lobe_app_view *view, int method,
                                             lobe_model *model) {
    const lobe_app_status status = lobe_app_choose_model(view->ndf, view->masking, method, model);
    /* the choice by surface; any other distribution has one best method */
    const bool has_choice = view->ndf == LOBE_NDF_GGX && view->masking == LOBE_MASKING_SMITH;
    if (method == LOBE_METHOD_COUNT && has_choice) model->method = LOBE_METHOD_COUNT;
    return status;
}

static void print_warning(void *user, const char *message) {
    (void)user;
    lobe_app_report_line(message);
}

lobe_render_options lobe_app_view_render_options(const lobe_app_view *v) {
    lobe_render_options r = lobe_render_default_options();
    r.reflection.model =
        (lobe_model){(lobe_ndf)v->ndf, (lobe_masking)v->masking, LOBE_METHOD_COUNT};
    r.reflection.floor = v->floor;
    r.reflection.g2 = (lobe_g2)v->g2;
    r.reflection.normalization = (lobe_normalization)v->normalization;
    r.width = v->size.width;
    r.height = v->size.height;
    r.depth = (int)v->depth;
    r.seed = v->seed;
    r.threads = (int)v->threads;
    r.camera = v->camera;
    r.aperture = (float)v->aperture.radius;
    r.f_number = (float)v->aperture.f_number;
    r.focus = isnan(v->focus) ? 0.0f : (float)v->focus;
    r.heuristic = (lobe_heuristic)v->heuristic;
    r.multiscatter = (lobe_multiscatter)v->multiscatter;
    r.metal = v->metal;
    r.cancel = &lobe_app_interrupted;
    r.warning = print_warning;
    return r;
}

lobe_scene_options lobe_app_view_scene_options(const lobe_app_view *v) {
    lobe_scene_options s = lobe_scene_default_options();
    s.environment = v->environment;
    s.environment_rotation = (float)v->rotation;
    s.strict = v->strict;
    s.ground = v->ground;
    for (int c = 0; c < 3; c++) s.default_base_color[c] = (float)v->material[c];
    s.default_metallic = (float)v->material[3];
    s.default_roughness = (float)v->material[4];
    s.frame_time = v->frame_time;
    s.animation = v->animation;
    s.warning = print_warning;
    s.cancel = &lobe_app_interrupted;
    return s;
}

/* Of what takes no time nothing is shown, not even its end. */
static void show_build(void *user, double fraction) {
    if (fraction < 1) lobe_app_show_progress(user, fraction, 100 * fraction);
}

lobe_render_result lobe_app_load_scene(const lobe_app_view *view, int mode, const char *source,
                                       lobe_scene **scene) {
    lobe_app_progress progress = lobe_app_begin_progress(mode, "build", "%");
    lobe_scene_options options = lobe_app_view_scene_options(view);
    options.progress = show_build;
    options.progress_user = &progress;
    const lobe_render_result result = lobe_scene_load(source, options, scene);
    lobe_app_end_progress(&progress);
    return result;
}

lobe_app_status lobe_app_render_failed(lobe_render_result result) {
    lobe_app_report_line(lobe_render_error_message());
    if (result == LOBE_RENDER_INTERRUPTED) return LOBE_APP_INTERRUPTED;
    return result == LOBE_RENDER_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
}
