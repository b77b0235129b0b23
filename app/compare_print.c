#include "compare_print.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <lobe/version.h>

#include "json.h"
#include "output.h"

/* ---- Table ----------------------------------------------------------------------------------- */

static void print_estimate(lobe_app_estimate e, int digits) {
    char text[64];
    if (isfinite(e.error))
        snprintf(text, sizeof text, "%.*g +- %.1g", digits, e.value, e.error);
    else
        snprintf(text, sizeof text, "%.*g", digits, e.value);
    lobe_app_print("  %-18s", text);
}

/* Of the column of names. */
static int name_width(const lobe_app_comparison *c) {
    int width = 6;
    for (int m = 0; m < c->contenders; m++) {
        const int length = (int)strlen(c->contender[m].name);
        if (length > width) width = length;
    }
    return width;
}

static void print_row(const lobe_app_comparison *c, int m, int n) {
    const lobe_app_cell *cell = &c->cell[m][n];
    lobe_app_print("%-*s%9u", name_width(c), c->contender[m].name, cell->spp);
    print_estimate(lobe_app_rmse(cell), 4);
    print_estimate(lobe_app_relmse(cell), 4);
    print_estimate(lobe_app_flip(cell), 4);
    lobe_app_print("  %8.4f%8.2f %%%9.3g%10.3g\n", cell->flip_hdr,
                   100 * lobe_app_rejected_share(cell), lobe_app_median_seconds(cell),
                   1e-6 * lobe_app_rays_per_second(cell));
}

static void print_needs(const lobe_app_comparison *c) {
    for (int m = 0; m < c->contenders; m++) {
        const lobe_app_floor floor = lobe_app_find_floor(c, m);
        if (floor.is_biased)
            lobe_app_print("%s is biased: its relMSE does not fall below %.2g (%.0f standard "
                           "deviations)\n",
                           c->contender[m].name, floor.relmse, floor.deviations);
    }
}

void lobe_app_print_comparison(const lobe_app_comparison *c) {
    char headline[512];
    if (c->is_of_files) {
        const lobe_app_cell *cell = &c->cell[0][0];
        lobe_app_print("RMSE %.6g, relMSE %.6g, FLIP %.6f, HDR-FLIP %.6f\n",
                       lobe_app_rmse(cell).value, cell->runs[0].relmse, cell->runs[0].flip,
                       cell->flip_hdr);
        return;
    }
    lobe_app_print("%-*s%9s  %-18s  %-18s  %-18s  %8s%10s%9s%10s\n", name_width(c), "method",
                   "samples", "RMSE", "relMSE", "FLIP", "HDR-FLIP", "rejected", "seconds",
                   "Mrays/s");
    for (int n = 0; n < c->sizes; n++)
        for (int m = 0; m < c->contenders; m++)
            if (c->cell[m][n].count) print_row(c, m, n);
    print_needs(c);
    lobe_app_headline(c, headline, sizeof headline);
    lobe_app_print("%s.\n", headline);
}

/* ---- JSON ------------------------------------------------------------------------------------ */

static json_t *json_row(const lobe_app_comparison *c, int m, int n) {
    const lobe_app_cell *cell = &c->cell[m][n];
    const lobe_app_estimate rmse = lobe_app_rmse(cell), relmse = lobe_app_relmse(cell),
                            flip = lobe_app_flip(cell);
    return json_pack("{so sI si so so so so so so so so so so so}", "method",
                     lobe_app_json_text(c->contender[m].name), "spp", (json_int_t)cell->spp,
                     "seeds", cell->count, "rmse", lobe_app_json_number(rmse.value), "rmse_error",
                     lobe_app_json_number(rmse.error), "relmse", lobe_app_json_number(relmse.value),
                     "relmse_error", lobe_app_json_number(relmse.error), "flip",
                     lobe_app_json_number(flip.value), "flip_error",
                     lobe_app_json_number(flip.error), "flip_hdr",
                     lobe_app_json_number(cell->flip_hdr), "rejected_share",
                     lobe_app_json_number(lobe_app_rejected_share(cell)), "seconds",
                     lobe_app_json_number(lobe_app_median_seconds(cell)), "cpu_seconds",
                     lobe_app_json_number(lobe_app_cpu_seconds(cell)), "rays_per_second",
                     lobe_app_json_number(lobe_app_rays_per_second(cell)));
}

static json_t *json_method(const lobe_app_comparison *c, int m, int base) {
    const lobe_app_estimate slope = lobe_app_slope(c, m, LOBE_APP_AXIS_SAMPLES),
                            samples = lobe_app_need(c, m, base, LOBE_APP_AXIS_SAMPLES),
                            time = lobe_app_need(c, m, base, LOBE_APP_AXIS_TIME);
    const lobe_app_floor floor = lobe_app_find_floor(c, m);
    return json_pack(
        "{so so so so so so so so sb so so}", "method", lobe_app_json_text(c->contender[m].name),
        "against", lobe_app_json_text(c->contender[base].name), "slope",
        lobe_app_json_number(slope.value), "slope_error", lobe_app_json_number(slope.error),
        "samples_share", lobe_app_json_number(samples.value), "samples_share_error",
        lobe_app_json_number(samples.error), "time_share", lobe_app_json_number(time.value),
        "time_share_error", lobe_app_json_number(time.error), "is_biased", floor.is_biased, "floor",
        lobe_app_json_number(floor.is_known ? floor.relmse : NAN), "floor_deviations",
        lobe_app_json_number(floor.is_known ? floor.deviations : NAN));
}

static json_t *json_of_scene(const lobe_app_comparison *c) {
    json_t *rows = json_array(), *methods = json_array();
    char headline[512];
    for (int n = 0; n < c->sizes; n++)
        for (int m = 0; m < c->contenders; m++)
            if (c->cell[m][n].count) json_array_append_new(rows, json_row(c, m, n));
    for (int m = 0; m < c->contenders; m++) json_array_append_new(methods, json_method(c, m, 0));
    lobe_app_headline(c, headline, sizeof headline);
    return json_pack("{so ss so si si ss si sI so sb so so so}", "scene",
                     lobe_app_json_text(c->title), "version", LOBE_VERSION_STRING, "command",
                     lobe_app_json_text(c->command), "width", c->width, "height", c->height,
                     "equal", c->equal == LOBE_APP_AXIS_SAMPLES ? "samples" : "time", "seeds",
                     c->seeds, "reference_spp", (json_int_t)c->reference_spp, "reference_noise",
                     lobe_app_json_number(lobe_app_reference_noise(c)), "interrupted",
                     c->is_interrupted, "headline", lobe_app_json_text(headline), "rows", rows,
                     "methods", methods);
}

static json_t *json_of_files(const lobe_app_comparison *c) {
    const lobe_app_cell *cell = &c->cell[0][0];
    return json_pack("{so so si si so so so so}", "picture", lobe_app_json_text(c->title),
                     "reference", lobe_app_json_text(c->reference_name), "width", c->width,
                     "height", c->height, "rmse", lobe_app_json_number(lobe_app_rmse(cell).value),
                     "relmse", lobe_app_json_number(cell->runs[0].relmse), "flip",
                     lobe_app_json_number(cell->runs[0].flip), "flip_hdr",
                     lobe_app_json_number(cell->flip_hdr));
}

json_t *lobe_app_json_comparison(const lobe_app_comparison *c) {
    return c->is_of_files ? json_of_files(c) : json_of_scene(c);
}
