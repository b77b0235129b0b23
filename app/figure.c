/* app/figure.c: `lobe figure`: the papers' figures. */
#include <string.h>

#include <lobe/figure.h>
#include <lobe/render.h>

#include "commands.h"
#include "interrupt.h"
#include "model.h"
#include "number.h"
#include "options.h"
#include "output.h"
#include "progress.h"

typedef struct figure_values {
    const char *picture, *table;
    double alpha[2], dpi;
    lobe_vec3_f64 wi;
    uint64_t samples, spp, seed;
    int theme, progress;
    bool optimal, list;
} figure_values;

static const char *const themes[] = {"light", "dark", NULL};

static bool read_alpha(const lobe_app_option *option, const char *text, void *value) {
    double *alpha = value;
    const int count = lobe_app_read_numbers(text, 1, 2, alpha);
    if (count == 1) alpha[1] = alpha[0];
    if (count && alpha[0] >= LOBE_ALPHA_MIN && alpha[1] >= LOBE_ALPHA_MIN && alpha[0] <= 10 &&
        alpha[1] <= 10)
        return true;
    lobe_app_report(option->name, "give A or AX,AY, each from 0.0001 to 10",
                    "'%.60s' is not a roughness", text);
    return false;
}

#define AT(member) offsetof(figure_values, member)

static const lobe_app_option output_options[] = {
    {"-o", "FILE", NULL, "the picture: .svg, .pdf or .png", lobe_app_read_name, AT(picture), NULL},
    {"--csv", "FILE", NULL, "the numbers of the picture", lobe_app_read_name, AT(table), NULL},
    {"--theme", "NAME", "light", "of the background", lobe_app_read_choice, AT(theme), themes},
    {"--dpi", "N", "216", "dots an inch of a .png, 36 to 1200", lobe_app_read_f64, AT(dpi), NULL},
    {"--list", NULL, NULL, "print the figures and stop", NULL, AT(list), NULL},
    LOBE_APP_PROGRESS_OPTION(figure_values, progress),
    {0}};

static const lobe_app_option parameter_options[] = {
    {"--alpha", "A[,AY]", "the figure's own", "roughness along x and y", read_alpha, AT(alpha),
     NULL},
    {"--wi", "X,Y,Z", "the figure's own",
     "direction toward the viewer, of any length, above the surface", lobe_app_read_direction,
     AT(wi), NULL},
    {"--optimal", NULL, NULL, "bound: also the trace of the optimal cap", NULL, AT(optimal), NULL},
    {"--samples", "N", "the figure's own", "draws or walks for each number, at most 100000000",
     lobe_app_read_count, AT(samples), NULL},
    {"--spp", "N", "the figure's own", "camera paths a pixel, at most 65536", lobe_app_read_count,
     AT(spp), NULL},
    {"--seed", "S", "1", "of the random numbers, any whole number", lobe_app_read_u64, AT(seed),
     NULL},
    {0}};

static const struct {
    const char *name;
    uint32_t bit;
} parameters[] = {
    {"--alpha", LOBE_FIGURE_READS_ALPHA},     {"--wi", LOBE_FIGURE_READS_WI},
    {"--optimal", LOBE_FIGURE_READS_OPTIMAL}, {"--samples", LOBE_FIGURE_READS_SAMPLES},
    {"--spp", LOBE_FIGURE_READS_SPP},         {"--seed", LOBE_FIGURE_READS_SEED}};

enum { PARAMETERS = sizeof parameters / sizeof parameters[0] };

static lobe_app_status list_figures(void) {
    for (int i = 0; i < lobe_figure_count(); i++) {
        const lobe_figure_info f = lobe_figure_at(i);
        lobe_app_print("%-24s%s (%s)", f.name, f.about, f.source);
        const char *before = "; reads ";
        for (int k = 0; k < PARAMETERS; k++)
            if (f.reads & parameters[k].bit) {
                lobe_app_print("%s%s", before, parameters[k].name);
                before = ", ";
            }
        lobe_app_print("\n");
    }
    return LOBE_APP_DONE;
}

/* The index of the figure; reports an unknown name. */
static lobe_app_status find_figure(const char *name, lobe_figure_info *figure) {
    const char *names[64] = {0}, *nearest;
    for (int i = 0; i < lobe_figure_count() && i < 63; i++) {
        *figure = lobe_figure_at(i);
        if (strcmp(figure->name, name) == 0) return LOBE_APP_DONE;
        names[i] = figure->name;
    }
    if ((nearest = lobe_app_nearest(name, names)))
        return lobe_app_reject(name, "see lobe figure --list", "unknown figure, perhaps %s",
                               nearest);
    return lobe_app_reject(name, "see lobe figure --list", "unknown figure");
}

static lobe_app_status check_parameters(const lobe_app_arguments *arguments,
                                        lobe_figure_info figure) {
    for (int k = 0; k < PARAMETERS; k++)
        if (lobe_app_is_given(arguments, parameters[k].name) && !(figure.reads & parameters[k].bit))
            return lobe_app_reject(parameters[k].name, "lobe figure --list says what it reads",
                                   "the figure %s does not read it", figure.name);
    return LOBE_APP_DONE;
}

static lobe_app_status check(const figure_values *v) {
    if (!v->picture && !v->table)
        return lobe_app_reject("-o", "give a file name, as -o bound.svg", "no picture to write");
    if (v->picture && !lobe_figure_can_write(v->picture))
        return lobe_app_reject(v->picture, "end the name with .svg, .pdf or .png",
                               "unknown picture format");
    if (v->picture && v->table && strcmp(v->picture, v->table) == 0)
        return lobe_app_reject("--csv", "give another name", "the same file as -o");
    if (!(v->dpi >= 36 && v->dpi <= 1200))
        return lobe_app_reject("--dpi", "use 36 to 1200", "out of range");
    if (v->samples > 100000000)
        return lobe_app_reject("--samples", "use 1 to 100000000", "too many");
    if (v->spp > 65536) return lobe_app_reject("--spp", "use 1 to 65536", "too many");
    if ((v->wi.x != 0 || v->wi.y != 0 || v->wi.z != 0) && !(v->wi.z > 1e-6))
        return lobe_app_reject("--wi", "give a direction with z > 0", "not above the surface");
    return LOBE_APP_DONE;
}

static void show_progress(void *user, double share) {
    lobe_app_show_progress(user, share, 100 * share);
}

static lobe_app_status draw(const figure_values *v, const char *name) {
    lobe_app_progress progress = lobe_app_begin_progress(v->progress, "figure", "%");
    lobe_figure_options o = lobe_figure_default_options();
    o.name = name;
    o.picture = v->picture;
    o.table = v->table;
    o.theme = (lobe_figure_theme)v->theme;
    o.dpi = v->dpi;
    memcpy(o.alpha, v->alpha, sizeof o.alpha);
    o.wi = v->wi;
    o.samples = v->samples;
    o.spp = (uint32_t)v->spp;
    o.seed = v->seed;
    o.optimal = v->optimal;
    o.cancel = &lobe_app_interrupted;
    o.progress = show_progress;
    o.user = &progress;
    lobe_app_catch_interrupt();
    const lobe_figure_result result = lobe_figure_make(&o);
    lobe_app_end_progress(&progress);
    if (result == LOBE_FIGURE_OK) return LOBE_APP_DONE;
    if (result == LOBE_FIGURE_INTERRUPTED) return LOBE_APP_INTERRUPTED;
    lobe_app_report_line(lobe_figure_error_message());
    return result == LOBE_FIGURE_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
}

lobe_app_status lobe_app_figure(int argc, char **argv) {
    figure_values values = {.dpi = 216, .seed = 1};
    const lobe_app_group groups[] = {
        {"Output", output_options, &values}, {"Parameters", parameter_options, &values}, {0}};
    const lobe_app_command command = {"figure",
                                      "NAME -o FILE [OPTIONS]",
                                      "Draws a figure of the papers from the library's own "
                                      "numbers. --list has the names, and the\n"
                                      "parameters that each of them reads.",
                                      "NAME",
                                      groups,
                                      "lobe figure bound -o bound.svg --csv bound.csv"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if (values.list) return list_figures();
    if (!arguments.operand)
        return lobe_app_reject("figure", "give a name of lobe figure --list", "no figure");
    lobe_figure_info figure = {0};
    if ((status = find_figure(arguments.operand, &figure))) return status;
    if ((status = check(&values)) || (status = check_parameters(&arguments, figure))) return status;
    return draw(&values, figure.name);
}
