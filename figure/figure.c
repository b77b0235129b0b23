#include <lobe/figure.h>

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "figures.h"

static const struct {
    lobe_figure_info info;
    figure_function *draw;
} figures[] = {
#define FIGURE_ROW(ID, name, about, source, reads) {{name, about, source, reads}, lobe_figure_##ID},
    LOBE_FIGURES(FIGURE_ROW)};

enum { FIGURES = sizeof figures / sizeof figures[0] };

static _Thread_local char last_message[1024];

lobe_figure_result lobe_figure_fail(lobe_figure_result result, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(last_message, sizeof last_message, format, arguments);
    va_end(arguments);
    return result;
}

lobe_figure_result lobe_figure_fail_memory(void) {
    return lobe_figure_fail(LOBE_FIGURE_FAILED, "figure: out of memory; free some");
}

const char *lobe_figure_error_message(void) {
    return last_message;
}

int lobe_figure_count(void) {
    return FIGURES;
}

lobe_figure_info lobe_figure_at(int index) {
    return index >= 0 && index < FIGURES ? figures[index].info : (lobe_figure_info){0};
}

int lobe_figure_can_write(const char *path) {
    return lobe_picture_format_of(path) != PICTURE_NONE;
}

lobe_figure_options lobe_figure_default_options(void) {
    return (lobe_figure_options){.dpi = 216, .seed = 1};
}

int lobe_run_is_over(const run *r, uint64_t index) {
    return index % 1024 == 0 && r->options->cancel && *r->options->cancel;
}

int lobe_run_goes_on(const run *r, double share) {
    if (r->options->progress) r->options->progress(r->options->user, share);
    return !lobe_run_is_over(r, 0);
}

static int is_given(vec3 v) {
    return v.x != 0 || v.y != 0 || v.z != 0;
}

view lobe_run_view(const run *r, view own) {
    const lobe_figure_options *o = r->options;
    view v = own;
    if (o->alpha[0] > 0) memcpy(v.alpha, o->alpha, sizeof v.alpha);
    if (is_given(o->wi)) v.wi = o->wi;
    return v;
}

uint64_t lobe_run_samples(const run *r, uint64_t own) {
    return r->options->samples ? r->options->samples : own;
}

static lobe_figure_result refuse(const char *where, const char *what, const char *hint) {
    return lobe_figure_fail(LOBE_FIGURE_BAD_INPUT, "%s: %s; %s", where, what, hint);
}

static lobe_figure_result check(const lobe_figure_options *o) {
    if (o->picture && !lobe_figure_can_write(o->picture))
        return refuse(o->picture, "unknown picture format", "end the name with .svg, .pdf or .png");
    if (!(o->dpi >= 36 && o->dpi <= 1200)) return refuse("dpi", "out of range", "use 36 to 1200");
    const int has_alpha = o->alpha[0] != 0 || o->alpha[1] != 0;
    for (int k = 0; k < 2; k++)
        if (has_alpha && !(o->alpha[k] >= LOBE_ALPHA_MIN && o->alpha[k] <= 10))
            return refuse("alpha", "out of range", "use 0.0001 to 10");
    const double length = sqrt(lobe_dot3(o->wi, o->wi));
    if (is_given(o->wi) && !(fabs(length - 1) < 1e-6 && o->wi.z > 1e-6))
        return refuse("wi", "not above the surface", "give a direction with z > 0");
    if (o->samples > 100000000) return refuse("samples", "too many", "use 1 to 100000000");
    if (o->spp > 65536) return refuse("spp", "too many", "use 1 to 65536");
    return LOBE_FIGURE_OK;
}

static lobe_figure_result save(const bytes *b, const char *path) {
    const int error = path ? lobe_bytes_save(b, path) : 0;
    return error ? lobe_figure_fail(LOBE_FIGURE_FAILED,
                                    "%s: cannot be written (%s); choose another place", path,
                                    strerror(error))
                 : LOBE_FIGURE_OK;
}

static lobe_figure_result draw(run *r, figure_function *function) {
    lobe_figure_result result = function(r);
    if (!lobe_canvas_end(&r->canvas) || r->table.failed)
        result = result ? result : lobe_figure_fail_memory();
    if (!result && !lobe_run_goes_on(r, 1)) result = LOBE_FIGURE_INTERRUPTED;
    if (!result) result = save(&r->canvas.file, r->options->picture);
    if (!result) result = save(&r->table, r->options->table);
    lobe_bytes_free(&r->canvas.file);
    lobe_bytes_free(&r->table);
    return result;
}

lobe_figure_result lobe_figure_make(const lobe_figure_options *options) {
    const lobe_figure_result result = check(options);
    if (result) return result;
    run r = {.options = options};
    r.canvas.format = options->picture ? lobe_picture_format_of(options->picture) : PICTURE_NONE;
    r.canvas.dpi = options->dpi;
    r.canvas.theme = lobe_theme_of(options->theme);
    for (int i = 0; i < FIGURES; i++)
        if (strcmp(figures[i].info.name, options->name) == 0) return draw(&r, figures[i].draw);
    return refuse(options->name, "there is no such figure", "see lobe_figure_at");
}
