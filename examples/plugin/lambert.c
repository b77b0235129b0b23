/* lambert.c: the smallest useful plugin: a diffuse reflector, drawn by the cosine.
 *
 *     cc -O2 -fPIC -shared -I include examples/plugin/lambert.c -o lambert.so -lm
 *     lobe verify --plugin ./lambert.so */
#include <lobe/plugin.h>

#include <math.h>

static const double PI = 3.14159265358979323846;

/* The one parameter. */
enum { ALBEDO };

static int sees(const lobe_plugin_block *block, const double wo[3]) {
    return block->wi[2] > 0 && wo[2] > 0;
}

static double lambert_density(const lobe_plugin_block *block, const double wo[3]) {
    return sees(block, wo) ? wo[2] / PI : 0;
}

static double lambert_value(const lobe_plugin_block *block, const double wo[3]) {
    return sees(block, wo) ? block->parameter[ALBEDO] * wo[2] / PI : 0;
}

static void lambert_sample(const lobe_plugin_block *block, const double u[3],
                           lobe_plugin_draw *draw) {
    double radius = sqrt(u[0]);
    draw->wo[0] = radius * cos(2 * PI * u[1]);
    draw->wo[1] = radius * sin(2 * PI * u[1]);
    draw->wo[2] = sqrt(1 - u[0]);
    draw->pdf = lambert_density(block, draw->wo);
    draw->weight = draw->pdf > 0 ? lambert_value(block, draw->wo) / draw->pdf : 0;
}

/* Facts that can be had in closed form are worth giving: they make tests sharper. */
static double lambert_accepted(const lobe_plugin_block *block) {
    return block->wi[2] > 0;
}

static double lambert_albedo(const lobe_plugin_block *block) {
    return block->wi[2] > 0 ? block->parameter[ALBEDO] : 0;
}

LOBE_PLUGIN_EXPORT const lobe_plugin *lobe_plugin_describe(void) {
    static const lobe_plugin plugin = {
        .version = LOBE_PLUGIN_VERSION,
        .name = "lambert",
        .sample = lambert_sample,
        .density = lambert_density,
        .value = lambert_value,
        .parameter_count = 1,
        .parameter = {{.name = "albedo", .least = 0, .most = 1, .typical = 0.8}},
        .flags = LOBE_PLUGIN_RECIPROCAL,
        .weight_bound = 1,
        .accepted = lambert_accepted,
        .albedo = lambert_albedo};
    return &plugin;
}
