#include "compare_report.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/version.h>
#include <stb/stb_image_write.h>

#include "chart.h"
#include "compare_judge.h"
#include "false_colour.h"
#include "page.h"
#include "stage.h"

enum { CROPS = 3 };

/* ---- Pictures -------------------------------------------------------------------------------- */

typedef enum map_kind { MAP_RELATIVE, MAP_FLIP } map_kind;

static uint8_t screen_byte(float linear) {
    const float c = fminf(fmaxf(linear, 0), 1);
    const float code = c <= 0.0031308f ? 12.92f * c : 1.055f * powf(c, 1 / 2.4f) - 0.055f;
    return (uint8_t)(255 * code + 0.5f);
}

/* What a screen shows of a part of a picture; to be freed. NULL: out of memory. */
static uint8_t *screen_pixels(const lobe_app_comparison *c, const float *rgb, int left, int top,
                              int width, int height) {
    uint8_t *bytes = malloc(3 * (size_t)width * (size_t)height);
    const float scale = exp2f((float)c->exposure);
    for (int y = 0; bytes && y < height; y++)
        for (int x = 0; x < 3 * width; x++)
            bytes[3 * (size_t)y * (size_t)width + (size_t)x] = screen_byte(
                scale * rgb[3 * ((size_t)(top + y) * (size_t)c->width + (size_t)left) + (size_t)x]);
    return bytes;
}

static bool write_whole(FILE *file, const lobe_app_comparison *c, const float *rgb) {
    uint8_t *bytes = screen_pixels(c, rgb, 0, 0, c->width, c->height);
    const bool is_good = bytes && lobe_app_write_jpeg_uri(file, bytes, c->width, c->height);
    free(bytes);
    return is_good;
}

/* Where the ramp of relative errors ends, one for all contenders of a size: what 99.5 % of the pixels of the
 * worst one stay below. */
static float relative_most(const lobe_app_comparison *c, int size) {
    const size_t pixels = (size_t)c->width * (size_t)c->height;
    float most = 0;
    for (int m = 0; m < c->contenders; m++) {
        const lobe_app_cell *cell = &c->cell[m][size];
        if (cell->count)
            most =
                fmaxf(most, lobe_app_quantile(cell->relative, pixels, 0.995) / (float)cell->count);
    }
    return most > 0 && isfinite(most) ? most : 1;
}

/* Three bytes a pixel; to be freed. NULL: out of memory. */
static uint8_t *map_pixels(const lobe_app_comparison *c, const lobe_app_cell *cell, map_kind kind,
                           float most) {
    const size_t pixels = (size_t)c->width * (size_t)c->height;
    const bool is_flip = kind == MAP_FLIP;
    uint8_t *colours =
        lobe_app_false_colour(is_flip ? cell->flip : cell->relative, c->width, c->height,
                              LOBE_APP_RAMP_AMOUNT, is_flip ? 1 : most * (float)cell->count);
    for (size_t i = 0; colours && i < pixels; i++) memmove(colours + 3 * i, colours + 4 * i, 3);
    return colours;
}

static void write_bytes(void *file, void *data, int size) {
    fwrite(data, 1, (size_t)size, file);
}

static lobe_app_status save_map(const lobe_app_comparison *c, int m, int n, map_kind kind,
                                float most, const char *folder) {
    char path[4096];
    lobe_app_file file;
    lobe_app_picture_path(c, m, n, folder, kind == MAP_FLIP ? "-flip.png" : "-relative.png", path,
                          sizeof path);
    const lobe_app_status status = lobe_app_begin_file(&file, path);
    if (status) return status;
    uint8_t *bytes = map_pixels(c, &c->cell[m][n], kind, most);
    errno = bytes ? 0 : ENOMEM;
    const bool is_good = bytes && stbi_write_png_to_func(write_bytes, file.stream, c->width,
                                                         c->height, 3, bytes, 3 * c->width);
    free(bytes);
    return lobe_app_finish_file(&file, true, is_good);
}

static lobe_app_status save_maps(const lobe_app_comparison *c, const char *folder) {
    for (int n = 0; n < c->sizes; n++) {
        const float most = relative_most(c, n);
        for (int m = 0; m < c->contenders; m++)
            for (int kind = MAP_RELATIVE; kind <= MAP_FLIP; kind++) {
                if (!c->cell[m][n].count) continue;
                const lobe_app_status status = save_map(c, m, n, (map_kind)kind, most, folder);
                if (status) return status;
            }
    }
    return LOBE_APP_DONE;
}

/* ---- Head ------------------------------------------------------------------------------------ */

/* Scaled, with `decimals` behind the point. */
static void write_estimate(FILE *file, lobe_app_estimate e, int decimals, double scale) {
    fprintf(file, "%.*f", decimals, scale * e.value);
    if (isfinite(e.error)) fprintf(file, "&nbsp;&plusmn;&nbsp;%.*f", decimals, scale * e.error);
}

/* In percent, with a decimal where the error asks for it. */
static void write_percent(FILE *file, lobe_app_estimate e) {
    write_estimate(file, e, e.error < 0.0095 ? 1 : 0, 100);
}

/* An error: three digits, its own error one. */
static void write_error(FILE *file, lobe_app_estimate e) {
    fprintf(file, "%.3g", e.value);
    if (isfinite(e.error)) fprintf(file, "&nbsp;&plusmn;&nbsp;%.1g", e.error);
}

static void write_needs(FILE *file, const lobe_app_comparison *c, int base) {
    fputs("<ul>", file);
    for (int m = 0; m < c->contenders; m++) {
        const lobe_app_floor floor = lobe_app_find_floor(c, m);
        const lobe_app_estimate samples = lobe_app_need(c, m, base, LOBE_APP_AXIS_SAMPLES);
        if (m == base || !isfinite(samples.value)) continue;
        fputs("<li><b>", file);
        lobe_app_write_html(file, c->contender[m].name);
        fputs("</b> ", file);
        if (floor.is_biased) {
            fprintf(file,
                    "does not reach the reference: its relMSE does not fall below %.2g "
                    "(%.0f standard deviations)",
                    floor.relmse, floor.deviations);
            continue;
        }
        fputs("needs ", file);
        write_percent(file, samples);
        fputs("&nbsp;% of the samples and ", file);
        write_percent(file, lobe_app_need(c, m, base, LOBE_APP_AXIS_TIME));
        fputs("&nbsp;% of the time of ", file);
        lobe_app_write_html(file, c->contender[base].name);
    }
    fputs("</ul>", file);
}

static void write_conditions(FILE *file, const lobe_app_comparison *c) {
    fprintf(file, "<p class=soft>%d &times; %d pixels", c->width, c->height);
    if (!c->is_of_files)
        fprintf(file, ", %d independent seed%s each, &plusmn; one standard error", c->seeds,
                c->seeds == 1 ? "" : "s");
    fputs(". Reference: ", file);
    if (c->reference_name)
        lobe_app_write_html(file, c->reference_name);
    else
        fprintf(file,
                "%u samples a pixel in two independent halves, whose noise (RMSE %.2g) is taken "
                "out of RMSE and relMSE",
                c->reference_spp, lobe_app_reference_noise(c));
    fputs(". lobe " LOBE_VERSION_STRING ".<br><code>", file);
    lobe_app_write_html(file, c->command);
    fputs("</code></p>\n", file);
}

static void write_head(FILE *file, const lobe_app_comparison *c) {
    char text[512];
    snprintf(text, sizeof text, "lobe compare: %s", c->title);
    lobe_app_begin_stage_html(file, text);
    const char *slash = strrchr(c->title, '/');
    fputs("<h1>", file);
    lobe_app_write_html(file, slash && slash[1] ? slash + 1 : c->title);
    fputs("</h1><p class=head>", file);
    lobe_app_headline(c, text, sizeof text);
    lobe_app_write_html(file, text);
    fputs(".</p>", file);
    if (c->is_interrupted)
        fputs("<p class=warn>Interrupted: what was finished until then.</p>", file);
    const int best = lobe_app_best_contender(c, c->equal);
    if (!c->is_of_files && c->contenders > 1)
        write_needs(file, c,
                    best < 0                                ? 0
                    : lobe_app_rival(c, best, c->equal) < 0 ? 0
                                                            : lobe_app_rival(c, best, c->equal));
    write_conditions(file, c);
}

/* ---- The stage ------------------------------------------------------------------------------- */

static void write_buttons(FILE *file, const lobe_app_comparison *c) {
    static const char *const kinds[] = {"p", "r", "f"};
    static const char *const titles[] = {"picture", "relative error", "FLIP"};
    char value[16];
    fputs("<div class=bars><div class=bar3>", file);
    for (int m = 0; m < c->contenders && c->contenders > 1; m++) {
        snprintf(value, sizeof value, "%d", m);
        lobe_app_begin_stage_button(file, 'm', value, m == 0);
        lobe_app_write_html(file, c->contender[m].name);
        fputs("</button>", file);
    }
    fputs("</div><div class=bar3>", file);
    for (int n = 0; n < c->sizes && c->sizes > 1; n++) {
        snprintf(value, sizeof value, "%d", n);
        lobe_app_begin_stage_button(file, 'n', value, n == 0);
        fprintf(file, "%u samples</button>", c->cell[0][n].spp);
    }
    fputs("</div><div class=bar3>", file);
    for (int k = 0; k < 3; k++) {
        lobe_app_begin_stage_button(file, 'k', kinds[k], k == 0);
        fprintf(file, "%s</button>", titles[k]);
    }
    fputs("</div></div>", file);
}

static void write_stage(FILE *file, const lobe_app_comparison *c) {
    fputs("<h2 id=pictures>Pictures</h2>", file);
    write_buttons(file, c);
    lobe_app_write_stage(file, 0, c->width, c->height, "reference");
}

/* ---- Curves and tables ----------------------------------------------------------------------- */

static void write_curve(FILE *file, const lobe_app_comparison *c, lobe_app_axis axis) {
    lobe_app_series series[LOBE_APP_CONTENDERS_MAX] = {0};
    for (int m = 0; m < c->contenders; m++) {
        lobe_app_series *s = &series[m];
        s->name = c->contender[m].name;
        s->slope = lobe_app_slope(c, m, axis).value;
        for (int n = 0; n < c->sizes; n++) {
            const lobe_app_cell *cell = &c->cell[m][n];
            const lobe_app_estimate e = lobe_app_relmse(cell);
            const double x = axis == LOBE_APP_AXIS_SAMPLES ? cell->spp : lobe_app_cpu_seconds(cell);
            if (!cell->count || !(e.value > 0) || !(x > 0)) continue;
            s->x[s->count] = x;
            s->y[s->count] = e.value;
            s->error[s->count++] = e.error;
        }
    }
    const bool is_of_samples = axis == LOBE_APP_AXIS_SAMPLES;
    const lobe_app_chart chart = {.x_title =
                                      is_of_samples ? "samples a pixel" : "processor seconds",
                                  .y_title = "relMSE",
                                  .has_ticks_at_points = is_of_samples,
                                  .count = c->contenders,
                                  .series = series};
    lobe_app_write_chart(file, &chart);
}

static void write_dot(FILE *file, const lobe_app_comparison *c, int m) {
    fprintf(file, "<td><span class=\"dot s%d\"></span>", m % LOBE_APP_CHART_COLOURS);
    lobe_app_write_html(file, c->contender[m].name);
}

static void write_slopes(FILE *file, const lobe_app_comparison *c) {
    fputs("<div class=wide><table><tr><th>method<th class=n>slope over samples<th class=n>slope "
          "over time<th class=n>floor of relMSE<th class=n>standard deviations",
          file);
    for (int m = 0; m < c->contenders; m++) {
        const lobe_app_floor floor = lobe_app_find_floor(c, m);
        fputs("<tr>", file);
        write_dot(file, c, m);
        for (int axis = LOBE_APP_AXIS_SAMPLES; axis <= LOBE_APP_AXIS_TIME; axis++) {
            const lobe_app_estimate slope = lobe_app_slope(c, m, (lobe_app_axis)axis);
            fputs("<td class=n>", file);
            if (isfinite(slope.value))
                write_estimate(file, slope, 2, 1);
            else
                fputs("&ndash;", file);
        }
        if (!floor.is_known)
            fputs("<td class=n>&ndash;<td class=n>&ndash;", file);
        else if (floor.is_biased)
            fprintf(file, "<td class=\"n warn\">%.2g<td class=\"n warn\">%.1f", floor.relmse,
                    floor.deviations);
        else
            fprintf(file, "<td class=n>none seen<td class=n>%.1f", floor.deviations);
    }
    fputs("</table></div>", file);
}

static void write_curves(FILE *file, const lobe_app_comparison *c) {
    if (c->is_of_files) return;
    fputs("<h2>Curves</h2><div class=two>", file);
    write_curve(file, c, LOBE_APP_AXIS_SAMPLES);
    write_curve(file, c, LOBE_APP_AXIS_TIME);
    fputs("</div><p class=soft>Dashed: the fitted slope. Without bias it is near &minus;1: twice "
          "the samples, half the relMSE. A curve that bends toward a floor is biased.</p>",
          file);
    write_slopes(file, c);
}

static void write_row(FILE *file, const lobe_app_comparison *c, int m, int n) {
    const lobe_app_cell *cell = &c->cell[m][n];
    fputs("<tr>", file);
    write_dot(file, c, m);
    if (!c->is_of_files) fprintf(file, "<td class=n>%u", cell->spp);
    fputs("<td class=n>", file);
    write_error(file, lobe_app_rmse(cell));
    fputs("<td class=n>", file);
    write_error(file, lobe_app_relmse(cell));
    fputs("<td class=n>", file);
    write_estimate(file, lobe_app_flip(cell), 4, 1);
    fprintf(file, "<td class=n>%.4f", cell->flip_hdr);
    if (!c->is_of_files)
        fprintf(file, "<td class=n>%.2f&nbsp;%%<td class=n>%.3g<td class=n>%.3g\n",
                100 * lobe_app_rejected_share(cell), lobe_app_median_seconds(cell),
                1e-6 * lobe_app_rays_per_second(cell));
}

static void write_table(FILE *file, const lobe_app_comparison *c) {
    fprintf(file,
            "<h2>Numbers</h2><div class=wide><table><tr><th>%s<th class=n>RMSE<th class=n>relMSE"
            "<th class=n>FLIP<th class=n>HDR-FLIP%s\n",
            c->is_of_files ? "picture" : "method<th class=n>samples",
            c->is_of_files ? "" : "<th class=n>rejected<th class=n>seconds<th class=n>Mrays/s");
    for (int n = 0; n < c->sizes; n++)
        for (int m = 0; m < c->contenders; m++)
            if (c->cell[m][n].count) write_row(file, c, m, n);
    fputs("</table></div>\n", file);
}

/* ---- Crops ----------------------------------------------------------------------------------- */

static bool write_crop(FILE *file, const lobe_app_comparison *c, lobe_app_crop crop,
                       const float *rgb, const char *name) {
    uint8_t *bytes = screen_pixels(c, rgb, crop.x, crop.y, crop.size, crop.size);
    fputs("<figure><img alt=\"", file);
    lobe_app_write_html(file, name);
    fputs("\" src=\"", file);
    const bool is_good = bytes && lobe_app_write_png_uri(file, bytes, crop.size, crop.size, 3);
    fputs("\"><figcaption>", file);
    lobe_app_write_html(file, name);
    fputs("</figcaption></figure>", file);
    free(bytes);
    return is_good;
}

/* The last size that every contender has. */
static int last_whole_size(const lobe_app_comparison *c) {
    int size = 0;
    for (int n = 0; n < c->sizes; n++) {
        bool is_whole = true;
        for (int m = 0; m < c->contenders; m++) is_whole = is_whole && c->cell[m][n].count;
        if (is_whole) size = n;
    }
    return size;
}

/* Where all pictures are shown, few samples differ more than many. */
static bool write_crops(FILE *file, const lobe_app_comparison *c, const lobe_app_crop *crops,
                        int count) {
    bool is_good = true;
    if (!count) return true;
    fprintf(file, "<h2>Where %s most</h2>",
            c->contenders > 1 ? "the methods differ" : "it differs");
    if (!c->is_of_files)
        fprintf(file,
                "<p class=soft>Of the pictures of %u samples, first seed; chosen by the "
                "squared relative errors at %u samples.</p>",
                c->cell[0][0].spp, c->cell[0][last_whole_size(c)].spp);
    for (int i = 0; i < count; i++) {
        fprintf(file, "<h3>%d: %d pixels at (%d, %d)</h3><div class=crops>", i + 1, crops[i].size,
                crops[i].x, crops[i].y);
        is_good = write_crop(file, c, crops[i], c->reference, "reference") && is_good;
        for (int m = 0; m < c->contenders; m++)
            if (c->cell[m][0].count)
                is_good = write_crop(file, c, crops[i], c->cell[m][0].rgb, c->contender[m].name) &&
                          is_good;
        fputs("</div>", file);
    }
    return is_good;
}

/* ---- All pictures ---------------------------------------------------------------------------- */

static void begin_figure(FILE *file, const lobe_app_comparison *c, int m, int n, char kind) {
    static const char *const what[] = {"", ", relative error", ", FLIP"};
    const char *const suffix = what[kind == 'p' ? 0 : kind == 'r' ? 1 : 2];
    char name[160];
    snprintf(name, sizeof name, c->is_of_files ? "%s%s" : "%s%s, %u samples", c->contender[m].name,
             suffix, c->cell[m][n].spp);
    fprintf(file, "<figure><figcaption>");
    lobe_app_write_html(file, name);
    fprintf(file,
            "</figcaption><img class=pick loading=lazy id=i-%d-%d-%c width=%d height=%d alt=\"", m,
            n, kind, c->width, c->height);
    lobe_app_write_html(file, name);
    fputs("\" src=\"", file);
}

static bool write_cell(FILE *file, const lobe_app_comparison *c, int m, int n, char kind,
                       float most) {
    const lobe_app_cell *cell = &c->cell[m][n];
    bool is_good;
    if (!cell->count) return true;
    begin_figure(file, c, m, n, kind);
    if (kind == 'p') {
        is_good = write_whole(file, c, cell->rgb);
    } else {
        uint8_t *bytes = map_pixels(c, cell, kind == 'r' ? MAP_RELATIVE : MAP_FLIP, most);
        is_good = bytes && lobe_app_write_jpeg_uri(file, bytes, c->width, c->height);
        free(bytes);
    }
    fputs("\"></figure>", file);
    return is_good;
}

static bool write_reference(FILE *file, const lobe_app_comparison *c, const lobe_app_crop *crops,
                            int count) {
    fputs("<h3>Reference</h3><div class=grid><figure><div class=places><img id=i-ref "
          "alt=reference src=\"",
          file);
    const bool is_good = write_whole(file, c, c->reference);
    fputs("\">", file);
    for (int i = 0; i < count; i++)
        fprintf(file, "<i style=\"left:%.2f%%;top:%.2f%%;width:%.2f%%;height:%.2f%%\">%d</i>",
                100.0 * crops[i].x / c->width, 100.0 * crops[i].y / c->height,
                100.0 * crops[i].size / c->width, 100.0 * crops[i].size / c->height, i + 1);
    fputs("</div></figure></div>", file);
    return is_good;
}

static bool write_gallery(FILE *file, const lobe_app_comparison *c, const lobe_app_crop *crops,
                          int count) {
    static const char kinds[] = "prf";
    fputs("<h2>All pictures and error maps</h2>", file);
    bool is_good = write_reference(file, c, crops, count);
    for (int n = 0; n < c->sizes; n++) {
        const float most = relative_most(c, n);
        if (!c->is_of_files) fprintf(file, "<h3>%u samples</h3>", c->cell[0][n].spp);
        for (const char *kind = kinds; *kind; kind++) {
            if (*kind == 'r')
                fprintf(file,
                        "<p class=soft>Squared relative error%s: 0 <span class=\"key amount\">"
                        "</span> %.2g, by the square root</p>",
                        c->is_of_files ? "" : ", mean over the seeds", (double)most);
            if (*kind == 'f')
                fputs("<p class=soft>FLIP: 0 <span class=\"key amount\"></span> 1, by the square "
                      "root</p>",
                      file);
            fputs("<div class=grid>", file);
            for (int m = 0; m < c->contenders; m++)
                is_good = write_cell(file, c, m, n, *kind, most) && is_good;
            fputs("</div>", file);
        }
    }
    return is_good;
}

static void write_legend(FILE *file, const lobe_app_comparison *c) {
    fputs(
        "<h2>What the numbers mean</h2><ul class=soft>"
        "<li><b>RMSE</b>: root of the mean squared difference from the reference, in linear "
        "light: bright places count most."
        "<li><b>relMSE</b>: mean of (picture &minus; reference)&sup2; / (reference&sup2; + 0.01): "
        "dark places count as much as bright ones."
        "<li><b>FLIP</b>: what a person sees who flips between the pictures on a screen, 0 to 1 "
        "(Andersson et al. 2020, 67 pixels a degree); <b>HDR-FLIP</b>: the worst of it over all "
        "exposures (2021).",
        file);
    if (!c->is_of_files)
        fputs("<li><b>rejected</b>: share of the drawn directions that lie below the surface and "
              "carry no light."
              "<li><b>floor</b>: the squared bias, estimated from pairs of different seeds; it is "
              "called a bias above 5 standard deviations."
              "<li><b>seconds</b>: of the wall clock, median; shares of time are of processor "
              "time, and so is the curve.",
              file);
    fputs("</ul>", file);
}

static bool write_page(FILE *file, const lobe_app_comparison *c) {
    lobe_app_crop crops[CROPS];
    const int count = lobe_app_find_crops(c, last_whole_size(c), crops, CROPS);
    write_head(file, c);
    write_stage(file, c);
    write_curves(file, c);
    write_table(file, c);
    bool is_good = write_crops(file, c, crops, count);
    is_good = write_gallery(file, c, crops, count) && is_good;
    write_legend(file, c);
    lobe_app_write_stage_script(file);
    fputs("</html>\n", file);
    return is_good;
}

lobe_app_status lobe_app_write_report(const lobe_app_comparison *c, const char *folder) {
    char path[4096];
    lobe_app_file file;
    lobe_app_status status = save_maps(c, folder);
    if (status) return status;
    snprintf(path, sizeof path, "%s/report.html", folder);
    if ((status = lobe_app_begin_file(&file, path))) return status;
    errno = ENOMEM;
    const bool is_good = write_page(file.stream, c);
    return lobe_app_finish_file(&file, true, is_good);
}
