#include "plugin.h"

#include <ctype.h>
#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "child.h"
#include "rounded.h"

enum { PILOT_DRAWS = 65536 };

static const double LOAD_SECONDS = 10;

/* ---- Loading, in the process that may die ---------------------------------------------------- */

/* Letters, digits and what `extra` has, `most` at most: names stand in tables and patterns. */
static int is_name(const char *text, size_t most, const char *extra) {
    if (text == NULL || *text == '\0') return 0;
    for (size_t i = 0; text[i] != '\0'; ++i) {
        if (i >= most || !(isalnum((unsigned char)text[i]) || strchr(extra, text[i]))) return 0;
    }
    return 1;
}

static const char *parameter_fault(const lobe_plugin_parameter *p) {
    if (!is_name(p->name, 15, "_")) return "the name of a parameter is missing or no name";
    if (!isfinite(p->least) || !isfinite(p->most)) return "the range of a parameter is not finite";
    if (!(p->least <= p->typical && p->typical <= p->most)) {
        return "the typical value of a parameter lies outside its range";
    }
    if (p->is_logarithmic && !(p->least > 0)) {
        return "a logarithmic parameter has a least value that is not above 0";
    }
    if (p->special_count < 0 || p->special_count > LOBE_PLUGIN_SPECIALS) {
        return "the number of special values of a parameter is out of range";
    }
    return NULL;
}

/* What is wrong with a description. NULL: nothing. */
static const char *fault(const lobe_plugin *p) {
    if (!is_name(p->name, 31, "_-")) return "its name is missing, too long or no name";
    if (p->sample == NULL || p->density == NULL || p->value == NULL) {
        return "one of the three functions is missing";
    }
    if (p->parameter_count < 0 || p->parameter_count > LOBE_PLUGIN_PARAMETERS) {
        return "the number of parameters is out of range";
    }
    if (!(p->rounding >= 0 && p->rounding < 1)) return "its rounding is out of range";
    if (!(p->weight_bound >= 0)) return "its weight bound is out of range";
    for (int i = 0; i < p->parameter_count; ++i) {
        const char *why = parameter_fault(&p->parameter[i]);
        if (why != NULL) return why;
    }
    return NULL;
}

const lobe_plugin *lobe_plugin_load(const char *path, char *message, size_t room) {
    /* Without a slash the loader would search its own directories. */
    char name[4096];
    snprintf(name, sizeof name, "%s%s", strchr(path, '/') != NULL ? "" : "./", path);
    void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        snprintf(message, room, "%.200s: cannot be loaded: %.200s; build it with -shared -fPIC",
                 path, dlerror());
        return NULL;
    }
    const lobe_plugin *(*describe)(void) = NULL;
    void *symbol = dlsym(library, "lobe_plugin_describe");
    memcpy(&describe, &symbol, sizeof describe); /* a data pointer is no function to ISO C */
    if (describe == NULL) {
        snprintf(message, room,
                 "%.200s: no lobe_plugin_describe in it; define it with LOBE_PLUGIN_EXPORT", path);
        return NULL;
    }
    const lobe_plugin *plugin = describe();
    if (plugin == NULL || plugin->version != LOBE_PLUGIN_VERSION) {
        snprintf(message, room,
                 "%.200s: version %d of lobe/plugin.h, this program has %d; compile it again", path,
                 plugin != NULL ? plugin->version : 0, LOBE_PLUGIN_VERSION);
        return NULL;
    }
    const char *why = fault(plugin);
    if (why == NULL) return plugin;
    snprintf(message, room, "%.200s: %s; see lobe/plugin.h", path, why);
    return NULL;
}

/* ---- What it says of itself ------------------------------------------------------------------ */

typedef struct description {
    const char *path;
    char message[512];
    lobe_plugin_facts facts;
    int is_complete;
} description;

static void describe_plugin(void *task) {
    description *d = task;
    const lobe_plugin *plugin = lobe_plugin_load(d->path, d->message, sizeof d->message);
    if (plugin == NULL) return;
    d->facts.plugin = *plugin;
    snprintf(d->facts.name, sizeof d->facts.name, "%s", plugin->name);
    for (int i = 0; i < plugin->parameter_count; ++i) {
        snprintf(d->facts.parameter_name[i], sizeof d->facts.parameter_name[i], "%s",
                 plugin->parameter[i].name);
    }
    d->is_complete = 1;
}

/* Names as this process has them. */
static void own_names(lobe_plugin_facts *facts) {
    facts->name[sizeof facts->name - 1] = '\0';
    facts->plugin.name = facts->name;
    for (int i = 0; i < LOBE_PLUGIN_PARAMETERS; ++i) {
        facts->parameter_name[i][sizeof facts->parameter_name[i] - 1] = '\0';
        facts->plugin.parameter[i].name = facts->parameter_name[i];
    }
}

/* The process above can have been disturbed at any point: trust nothing that it left. */
static int take_description(description *d, lobe_plugin_file *file, const char *cause,
                            char *message, size_t room) {
    d->message[sizeof d->message - 1] = '\0';
    file->facts = d->facts;
    own_names(&file->facts);
    if (d->is_complete && *cause == '\0' && fault(&file->facts.plugin) == NULL) return 1;
    if (*d->message != '\0') {
        snprintf(message, room, "%s", d->message);
    } else {
        snprintf(message, room, "%.200s: it %s while it was loaded; run its start alone",
                 file->path, *cause != '\0' ? cause : "exited");
    }
    return 0;
}

static int hash_file(lobe_plugin_file *file) {
    FILE *stream = fopen(file->path, "rb");
    if (stream == NULL) return 0;
    static unsigned char bytes[65536];
    file->hash = LOBE_HASH_SEED;
    for (size_t count; (count = fread(bytes, 1, sizeof bytes, stream)) > 0;) {
        file->hash = lobe_hash(file->hash, bytes, count);
    }
    int is_good = !ferror(stream);
    fclose(stream);
    return is_good;
}

int lobe_plugin_read(lobe_plugin_file *file, const char *path, char *message, size_t room) {
    *file = (lobe_plugin_file){.path = path};
    if (!hash_file(file)) {
        snprintf(message, room, "%.200s: cannot be read: %s; give the path of a shared library",
                 path, strerror(errno));
        return 0;
    }
    description *d = lobe_shared_make(sizeof *d);
    lobe_child child;
    char cause[64] = "";
    int is_good = d != NULL;
    if (is_good) {
        d->path = path;
        is_good = lobe_child_start(&child, describe_plugin, d, LOAD_SECONDS);
    }
    if (is_good) {
        while (!lobe_child_has_ended(&child, cause, sizeof cause)) lobe_child_pause();
        is_good = take_description(d, file, cause, message, room);
    } else {
        snprintf(message, room, "%.200s: no process for it: %s; close other programs", path,
                 strerror(errno));
    }
    lobe_shared_free(d, sizeof *d);
    return is_good;
}

/* ---- Cases ----------------------------------------------------------------------------------- */

typedef struct incidence {
    double theta, phi;
} incidence;

/* The first of them for reflection, all where there is a below. */
static const incidence INCIDENCES[] = {{0, 0},    {30, 60},  {60, 200}, {75, 10},
                                       {88, 300}, {120, 40}, {165, 250}};
enum { INCIDENCES_ABOVE = 5, INCIDENCES_IN_ALL = 7 };

/* Points of the parameters: typical, all least, all most, and others between. */
enum { TYPICAL, LEAST, MOST, POINTS = 6 };

static size_t incidence_count(const lobe_plugin *plugin) {
    return plugin->flags & LOBE_PLUGIN_SPHERE ? INCIDENCES_IN_ALL : INCIDENCES_ABOVE;
}

/* To what a title shows, so that the case can be had again from it. */
static double four_digits(double x) {
    char text[32];
    snprintf(text, sizeof text, "%.4g", x);
    return strtod(text, NULL);
}

/* Between: Kronecker's sequence by the roots of 2, 3, 5, ... */
static double parameter_at(const lobe_plugin_parameter *p, int index, int point) {
    static const double PRIME[LOBE_PLUGIN_PARAMETERS] = {2, 3, 5, 7, 11, 13, 17, 19};
    if (point == TYPICAL) return p->typical;
    if (point == LEAST) return p->least;
    if (point == MOST) return p->most;
    double at = fmod(point * sqrt(PRIME[index]), 1);
    double x = p->is_logarithmic ? p->least * pow(p->most / p->least, at)
                                 : p->least + (p->most - p->least) * at;
    return fmin(fmax(four_digits(x), p->least), p->most);
}

static void make_block(const lobe_plugin *plugin, size_t index, lobe_plugin_block *block,
                       incidence *angle) {
    const double degree = 0.01745329251994329577;
    int point = (int)(index / incidence_count(plugin));
    *angle = INCIDENCES[index % incidence_count(plugin)];
    *block = (lobe_plugin_block){.wi = {0, 0, 1}};
    if (angle->theta > 0) {
        block->wi[0] = sin(angle->theta * degree) * cos(angle->phi * degree);
        block->wi[1] = sin(angle->theta * degree) * sin(angle->phi * degree);
        block->wi[2] = cos(angle->theta * degree);
    }
    for (int i = 0; i < plugin->parameter_count; ++i) {
        block->parameter[i] = parameter_at(&plugin->parameter[i], i, point);
    }
}

static void make_title(lobe_case_title *title, const lobe_plugin *plugin, size_t index) {
    lobe_plugin_block block;
    incidence angle;
    make_block(plugin, index, &block, &angle);
    snprintf(title->model, sizeof title->model, "%s", plugin->name);
    size_t used = 0, room = sizeof title->configuration;
    for (int i = 0; i < plugin->parameter_count; ++i) {
        used += (size_t)snprintf(title->configuration + used, room - used, "%s=%.10g ",
                                 plugin->parameter[i].name, block.parameter[i]);
    }
    snprintf(title->configuration + used, room - used, "theta=%g phi=%g", angle.theta, angle.phi);
}

int lobe_plugin_suite(lobe_suite *suite, const lobe_plugin_file *file) {
    const lobe_plugin *plugin = &file->facts.plugin;
    size_t points = plugin->parameter_count > 0 ? POINTS : 1;
    *suite = (lobe_suite){.count = points * incidence_count(plugin)};
    suite->titles = malloc(suite->count * sizeof *suite->titles);
    if (suite->titles == NULL) return 0;
    for (size_t i = 0; i < suite->count; ++i) make_title(&suite->titles[i], plugin, i);
    return 1;
}

/* ---- The model ------------------------------------------------------------------------------- */

/* What lies in a lobe_verify_state. */
typedef struct prepared {
    const lobe_plugin *plugin;
    lobe_plugin_block block;
} prepared;

static const prepared *view(const lobe_verify_state *state) {
    return (const void *)state->bytes;
}

static void put(lobe_verify_state *state, const lobe_plugin_subject *subject,
                const lobe_plugin_block *block, const double wi[3]) {
    prepared p = {subject->plugin, *block};
    _Static_assert(sizeof p <= sizeof state->bytes, "lobe_verify_state is too small");
    memcpy(p.block.wi, wi, sizeof p.block.wi);
    memcpy(state->bytes, &p, sizeof p);
}

static void prepare(const void *self, const double wi[3], lobe_verify_state *state) {
    const lobe_plugin_subject *subject = self;
    put(state, subject, &subject->block, wi);
}

static int prepare_special(const void *self, const double wi[3], size_t index,
                           lobe_verify_state *state) {
    const lobe_plugin_subject *subject = self;
    lobe_plugin_block block = subject->block;
    for (int i = 0; i < subject->plugin->parameter_count; ++i) {
        const lobe_plugin_parameter *p = &subject->plugin->parameter[i];
        if (index < (size_t)p->special_count) {
            block.parameter[i] = p->special[index];
            put(state, subject, &block, wi);
            return 1;
        }
        index -= (size_t)p->special_count;
    }
    return 0;
}

static lobe_verify_draw sample(const lobe_verify_state *state, const double u[3]) {
    const prepared *p = view(state);
    lobe_plugin_draw draw = {{0, 0, 0}, 0, 0};
    p->plugin->sample(&p->block, u, &draw);
    return (lobe_verify_draw){{draw.wo[0], draw.wo[1], draw.wo[2]}, draw.pdf, draw.weight};
}

static double density(const lobe_verify_state *state, const double wo[3]) {
    return view(state)->plugin->density(&view(state)->block, wo);
}

static double value(const lobe_verify_state *state, const double wo[3]) {
    return view(state)->plugin->value(&view(state)->block, wo);
}

static void set_facts(lobe_verify_model *model, const lobe_plugin_subject *subject) {
    const lobe_plugin *plugin = subject->plugin;
    if (plugin->rounding > 0) model->rounding = plugin->rounding;
    model->random_bits = model->rounding > 0x1p-50 ? 24 : 53;
    if (plugin->flags & LOBE_PLUGIN_SPHERE) model->below = lobe_lower_hemisphere_chart();
    model->is_reciprocal = (plugin->flags & LOBE_PLUGIN_RECIPROCAL) != 0;
    model->takes_legal_only = (plugin->flags & LOBE_PLUGIN_ANY_INPUT) == 0;
    if (plugin->weight_bound > 0) model->weight_bound = plugin->weight_bound;
    if (plugin->accepted != NULL) model->accepted = plugin->accepted(&subject->block);
    if (plugin->albedo != NULL) model->albedo_oracle = plugin->albedo(&subject->block);
}

void lobe_plugin_subject_make(lobe_plugin_subject *subject, const lobe_plugin *plugin,
                              size_t index) {
    incidence angle;
    *subject = (lobe_plugin_subject){.plugin = plugin};
    make_block(plugin, index, &subject->block, &angle);
    lobe_verify_model *model = &subject->model;
    *model = lobe_verify_plain_model();
    model->self = subject;
    model->pilot_draws = PILOT_DRAWS;
    model->prepare = prepare;
    model->prepare_special = prepare_special;
    model->sample = sample;
    model->density = density;
    model->value = value;
    set_facts(model, subject);
    /* A model in single precision is asked about what it can represent. */
    for (int k = 0; k < 3 && model->random_bits == 24; ++k) {
        subject->block.wi[k] = lobe_rounded_to_float(subject->block.wi[k]);
    }
    memcpy(model->wi, subject->block.wi, sizeof model->wi);
}
