#include "compare_methods.h"

#include <stdio.h>
#include <string.h>

#include "number.h"

static lobe_app_status choose_model(const char *name, const lobe_app_view *view,
                                    lobe_app_contender *k) {
    int method = LOBE_METHOD_COUNT;
    if (strcmp(name, "default") != 0) {
        method = (int)lobe_method_from_name(name);
        if (method == LOBE_METHOD_COUNT) {
            const char *nearest = lobe_app_nearest(name, lobe_app_methods);
            char hint[96];
            snprintf(hint, sizeof hint, nearest ? "did you mean %s?" : "see lobe compare --help",
                     nearest);
            return lobe_app_reject("--methods", hint, "there is no method '%.40s'", name);
        }
    }
    return lobe_app_choose_render_model(view, method, &k->model);
}

static lobe_app_status read_floor(const char *text, lobe_app_contender *k) {
    if (k->model.method != LOBE_METHOD_HORIZON || k->model.ndf != LOBE_NDF_GGX)
        return lobe_app_reject("--methods", "it goes with --ndf ggx and horizon", "%s has no floor",
                               k->name);
    if (lobe_app_read_number(text, &k->floor) && k->floor >= 0 && k->floor <= 1)
        return LOBE_APP_DONE;
    return lobe_app_reject("--methods", "give a number in [0, 1], as horizon:floor=0.5",
                           "'%.40s' is no floor", text);
}

static lobe_app_status read_normalization(const char *text, lobe_app_contender *k) {
    for (int i = 0; lobe_app_normalizations[i]; i++)
        if (strcmp(lobe_app_normalizations[i], text) == 0) {
            k->normalization = (lobe_normalization)i;
            return LOBE_APP_DONE;
        }
    return lobe_app_reject("--methods", "choose unbiased or previous",
                           "there is no normalization '%.40s'", text);
}

static lobe_app_status read_setting(const char *text, lobe_app_contender *k) {
    static const char floor[] = "floor=", normalization[] = "normalization=";
    if (strncmp(text, floor, sizeof floor - 1) == 0) return read_floor(text + sizeof floor - 1, k);
    if (strncmp(text, normalization, sizeof normalization - 1) == 0)
        return read_normalization(text + sizeof normalization - 1, k);
    return lobe_app_reject("--methods", "known are :floor=D and :normalization=NAME",
                           "'%.40s' is no setting of a method", text);
}

/* What a file's name may hold on any system. */
static void make_file_name(lobe_app_contender *k) {
    static const char good[] = "abcdefghijklmnopqrstuvwxyz0123456789.-";
    for (size_t i = 0; i == 0 || k->name[i - 1]; i++)
        k->file[i] = !k->name[i] || strchr(good, k->name[i]) ? k->name[i] : '-';
}

/* Ends `text` at its first colon; what follows it, or NULL. */
static char *split(char *text) {
    char *colon = strchr(text, ':');
    if (!colon) return NULL;
    *colon = '\0';
    return colon + 1;
}

/* One name with its settings. */
static lobe_app_status read_method(const char *text, size_t length, const lobe_app_view *view,
                                   lobe_app_contender *k) {
    *k = (lobe_app_contender){.floor = view->floor,
                              .normalization = (lobe_normalization)view->normalization};
    if (length == 0 || length >= sizeof k->name)
        return lobe_app_reject("--methods", "write them as ellipsoid,bounded,horizon",
                               "'%.40s' holds no method", text);
    memcpy(k->name, text, length);
    char parts[sizeof k->name];
    memcpy(parts, k->name, sizeof parts);
    char *part = parts, *next = split(part);
    lobe_app_status status = choose_model(part, view, k);
    for (part = next; part && !status; part = next) {
        next = split(part);
        status = read_setting(part, k);
    }
    make_file_name(k);
    return status;
}

lobe_app_status lobe_app_read_methods(const char *list, const lobe_app_view *view,
                                      lobe_app_comparison *c) {
    for (const char *text = list;; text++) {
        const size_t length = strcspn(text, ",");
        if (c->contenders == LOBE_APP_CONTENDERS_MAX)
            return lobe_app_reject("--methods", "use fewer", "more than %d",
                                   LOBE_APP_CONTENDERS_MAX);
        lobe_app_contender *k = &c->contender[c->contenders++];
        const lobe_app_status status = read_method(text, length, view, k);
        if (status) return status;
        for (int i = 0; i + 1 < c->contenders; i++)
            if (strcmp(c->contender[i].name, k->name) == 0)
                return lobe_app_reject("--methods", "name each once", "%s stands there twice",
                                       k->name);
        text += length;
        if (!*text) return LOBE_APP_DONE;
    }
}
