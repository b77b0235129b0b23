#include "ssr_report.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/version.h>

#include "chart.h"
#include "false_colour.h"
#include "page.h"
#include "stage.h"

/* ---- Numbers over the frames ----------------------------------------------------------------- */

typedef double number_of(const lobe_app_ssr_row *row); /* negative or NaN: there is none */

static double rays_of(const lobe_app_ssr_row *r) {
    return fmax(1, (double)r->statistics.rays);
}

static double rejected_of(const lobe_app_ssr_row *r) {
    return 100 * (double)r->statistics.rejected / rays_of(r);
}

static double hits_of(const lobe_app_ssr_row *r) {
    return 100 * (double)r->statistics.hits / rays_of(r);
}

static double steps_of(const lobe_app_ssr_row *r) {
    return (double)r->statistics.steps / rays_of(r);
}

static double relmse_of(const lobe_app_ssr_row *r) {
    return r->judgement.pixels ? r->judgement.relmse : -1;
}

static double onscreen_of(const lobe_app_ssr_row *r) {
    return r->judgement.pixels_onscreen ? r->judgement.relmse_onscreen : -1;
}

static double flip_of(const lobe_app_ssr_row *r) {
    return r->flip;
}

static double temporal_of(const lobe_app_ssr_row *r) {
    return r->temporal;
}

static double false_hits_of(const lobe_app_ssr_row *r) {
    return 100 * r->judgement.false_hits;
}

static double false_misses_of(const lobe_app_ssr_row *r) {
    return 100 * r->judgement.false_misses;
}

static double distance_of(const lobe_app_ssr_row *r) {
    return r->judgement.hit_distance;
}

static double milliseconds_of(const lobe_app_ssr_row *r) {
    double sum = 0;
    for (int pass = 0; pass < LOBE_SSR_PASS_COUNT; pass++) sum += r->statistics.milliseconds[pass];
    return sum;
}

static const struct {
    const char *name;
    number_of *of;
    int decimals;
} columns[] = {{"rejected, %", rejected_of, 1},
               {"hits, %", hits_of, 1},
               {"steps a ray", steps_of, 1},
               {"relMSE", relmse_of, 3},
               {"on screen", onscreen_of, 3},
               {"FLIP", flip_of, 4},
               {"temporal", temporal_of, 3},
               {"false hits, %", false_hits_of, 2},
               {"false misses, %", false_misses_of, 2},
               {"hit off, pixels", distance_of, 2},
               {"ms", milliseconds_of, 1}};
enum { COLUMNS = sizeof columns / sizeof *columns };

/* Mean over the frames, NAN where there is none, and its standard error, NAN for a single frame. */
static double mean_of(const lobe_app_ssr_contest *c, int m, number_of *of, double *error) {
    double sum = 0, squares = 0, count = 0;
    for (int i = 0; i < c->done; i++) {
        const double value = of(&c->contender[m].rows[i]);
        if (!(value >= 0)) continue;
        sum += value;
        squares += value * value;
        count++;
    }
    const double mean = count > 0 ? sum / count : NAN;
    *error = count > 1 ? sqrt(fmax(0, squares / count - mean * mean) / (count - 1)) : NAN;
    return mean;
}

/* ---- Parts of the page ----------------------------------------------------------------------- */

static void write_head(FILE *file, const lobe_app_ssr_contest *c, const char *title,
                       const char *command, bool is_interrupted) {
    char text[512];
    snprintf(text, sizeof text, "lobe ssr: %.400s", title);
    lobe_app_begin_stage_html(file, text);
    const char *slash = strrchr(title, '/');
    fputs("<h1>Reflections on the screen: ", file);
    lobe_app_write_html(file, slash && slash[1] ? slash + 1 : title);
    fputs("</h1><p class=head>relMSE where the screen shows what is reflected: ", file);
    for (int m = 0; m < c->contenders; m++) {
        double error;
        fputs(m ? ", " : "", file);
        lobe_app_write_html(file, c->contender[m].name);
        fprintf(file, " %.3g", mean_of(c, m, onscreen_of, &error));
        if (isfinite(error)) fprintf(file, "&nbsp;&plusmn;&nbsp;%.1g", error);
    }
    fputs(".</p>", file);
    if (is_interrupted) fputs("<p class=warn>Interrupted: what was finished until then.</p>", file);
    fprintf(
        file,
        "<p class=soft>%d &times; %d pixels, %d frame%s, &plusmn; one standard error from their "
        "spread (frames with history are not independent: the true one is larger). Pictures: "
        "the reflection before Fresnel, black where none was traced. lobe " LOBE_VERSION_STRING
        ".<br><code>",
        c->width, c->height, c->done, c->done == 1 ? "" : "s");
    lobe_app_write_html(file, command);
    fputs("</code></p>\n", file);
}

static bool has_shot(const lobe_app_ssr_contest *c, int shot) {
    return c->truth_shots[shot] != NULL && c->contender[c->contenders - 1].shots[shot].rgb != NULL;
}

static int first_shot(const lobe_app_ssr_contest *c) {
    int shot = LOBE_APP_SSR_SHOTS - 1;
    while (shot > 0 && !has_shot(c, shot)) shot--;
    return shot;
}

static void write_stage(FILE *file, const lobe_app_ssr_contest *c) {
    static const char *const kinds[] = {"p", "r", "f"};
    static const char *const titles[] = {"picture", "relative error", "FLIP"};
    char value[16];
    fputs("<h2 id=pictures>Pictures</h2><div class=bars><div class=bar3>", file);
    for (int m = 0; m < c->contenders && c->contenders > 1; m++) {
        snprintf(value, sizeof value, "%d", m);
        lobe_app_begin_stage_button(file, 'm', value, m == 0);
        lobe_app_write_html(file, c->contender[m].name);
        fputs("</button>", file);
    }
    fputs("</div><div class=bar3>", file);
    for (int k = 0; k < LOBE_APP_SSR_SHOTS && c->done > 1; k++) {
        if (!has_shot(c, k)) continue;
        snprintf(value, sizeof value, "%d", k);
        lobe_app_begin_stage_button(file, 'n', value, k == first_shot(c));
        fprintf(file, "frame %d</button>", lobe_app_ssr_shot_frame(c, k));
    }
    fputs("</div><div class=bar3>", file);
    for (int k = 0; k < 3; k++) {
        lobe_app_begin_stage_button(file, 'k', kinds[k], k == 0);
        fprintf(file, "%s</button>", titles[k]);
    }
    fputs("</div></div>", file);
    lobe_app_write_stage(file, first_shot(c), c->width, c->height, "real rays");
}

/* Of many frames as many as the chart takes, evenly. */
static void write_curve(FILE *file, const lobe_app_ssr_contest *c, const char *title,
                        number_of *of) {
    lobe_app_series *series = calloc((size_t)c->contenders, sizeof *series);
    const int step = (c->done + LOBE_APP_CHART_POINTS - 1) / LOBE_APP_CHART_POINTS;
    for (int m = 0; series && m < c->contenders; m++) {
        lobe_app_series *s = &series[m];
        s->name = c->contender[m].name;
        s->slope = NAN;
        for (int i = 0; i < c->done; i += step) {
            const double value = of(&c->contender[m].rows[i]);
            if (!(value > 0)) continue;
            s->x[s->count] = i;
            s->y[s->count] = value;
            s->error[s->count++] = NAN;
        }
    }
    const lobe_app_chart chart = {.x_title = "frame",
                                  .y_title = title,
                                  .is_linear_in_x = true,
                                  .has_ticks_at_points = true,
                                  .count = c->contenders,
                                  .series = series};
    if (series) lobe_app_write_chart(file, &chart);
    free(series);
}

static void write_curves(FILE *file, const lobe_app_ssr_contest *c) {
    if (c->done < 2) return;
    fputs("<h2>Frame by frame</h2><div class=two>", file);
    write_curve(file, c, "relMSE", relmse_of);
    write_curve(file, c, "relMSE where the screen shows it", onscreen_of);
    write_curve(file, c, "temporal error", temporal_of);
    write_curve(file, c, "FLIP", flip_of);
    fputs("</div>", file);
}

static void write_name(FILE *file, const lobe_app_ssr_contest *c, int m) {
    fprintf(file, "<tr><td><span class=\"dot s%d\"></span>", m % LOBE_APP_CHART_COLOURS);
    lobe_app_write_html(file, c->contender[m].name);
}

static void write_table(FILE *file, const lobe_app_ssr_contest *c) {
    fputs("<h2>Numbers</h2><div class=wide><table><tr><th>sampler", file);
    for (int k = 0; k < COLUMNS; k++) fprintf(file, "<th class=n>%s", columns[k].name);
    for (int m = 0; m < c->contenders; m++) {
        write_name(file, c, m);
        for (int k = 0; k < COLUMNS; k++) {
            double error;
            const double mean = mean_of(c, m, columns[k].of, &error);
            fputs("<td class=n>", file);
            if (!isfinite(mean)) {
                fputs("&ndash;", file);
                continue;
            }
            fprintf(file, "%.*f", columns[k].decimals, mean);
            if (isfinite(error))
                fprintf(file, "&nbsp;&plusmn;&nbsp;%.*f", columns[k].decimals, error);
        }
    }
    fputs("</table></div><h2>Milliseconds a pass</h2><div class=wide><table><tr><th>sampler", file);
    for (int pass = 0; pass < LOBE_SSR_PASS_COUNT; pass++)
        fprintf(file, "<th class=n>%s", lobe_ssr_pass_name((lobe_ssr_pass)pass));
    for (int m = 0; m < c->contenders; m++) {
        write_name(file, c, m);
        for (int pass = 0; pass < LOBE_SSR_PASS_COUNT; pass++) {
            double sum = 0;
            for (int i = 0; i < c->done; i++)
                sum += c->contender[m].rows[i].statistics.milliseconds[pass];
            fprintf(file, "<td class=n>%.2f", sum / fmax(1, c->done));
        }
    }
    fputs("</table></div>\n", file);
}

/* ---- Pictures -------------------------------------------------------------------------------- */

static uint8_t screen_byte(float linear) {
    const float x = fminf(fmaxf(linear, 0), 1);
    const float code = x <= 0.0031308f ? 12.92f * x : 1.055f * powf(x, 1 / 2.4f) - 0.055f;
    return (uint8_t)(255 * code + 0.5f);
}

static bool write_picture(FILE *file, const lobe_app_ssr_contest *c, const float *rgb) {
    const size_t values = 3 * (size_t)c->width * (size_t)c->height;
    uint8_t *bytes = malloc(values);
    for (size_t i = 0; bytes && i < values; i++) bytes[i] = screen_byte(rgb[i]);
    const bool is_good = bytes && lobe_app_write_jpeg_uri(file, bytes, c->width, c->height);
    free(bytes);
    return is_good;
}

static bool write_map(FILE *file, const lobe_app_ssr_contest *c, const float *values) {
    uint8_t *bytes = lobe_app_false_colour(values, c->width, c->height, LOBE_APP_RAMP_AMOUNT, 1);
    for (size_t i = 0; bytes && i < (size_t)c->width * (size_t)c->height; i++)
        memmove(bytes + 3 * i, bytes + 4 * i, 3);
    const bool is_good = bytes && lobe_app_write_jpeg_uri(file, bytes, c->width, c->height);
    free(bytes);
    return is_good;
}

static bool write_shot(FILE *file, const lobe_app_ssr_contest *c, int m, int k, char kind) {
    const lobe_app_ssr_shot *shot = &c->contender[m].shots[k];
    const char *what = kind == 'p' ? "" : kind == 'r' ? ", relative error" : ", FLIP";
    char name[128];
    snprintf(name, sizeof name, "%s, frame %d%s", c->contender[m].name,
             lobe_app_ssr_shot_frame(c, k), what);
    fputs("<figure><figcaption>", file);
    lobe_app_write_html(file, name);
    fprintf(file,
            "</figcaption><img class=pick loading=lazy id=i-%d-%d-%c width=%d height=%d alt=\"", m,
            k, kind, c->width, c->height);
    lobe_app_write_html(file, name);
    fputs("\" src=\"", file);
    const bool is_good = kind == 'p'   ? write_picture(file, c, shot->rgb)
                         : kind == 'r' ? write_map(file, c, shot->relative)
                                       : write_map(file, c, shot->flip);
    fputs("\"></figure>", file);
    return is_good;
}

static bool write_shots(FILE *file, const lobe_app_ssr_contest *c) {
    bool is_good = true;
    fputs("<h2>All pictures and error maps</h2><p class=soft>Relative error and FLIP: 0 <span "
          "class=\"key amount\"></span> 1, by the square root</p>",
          file);
    for (int k = 0; k < LOBE_APP_SSR_SHOTS; k++) {
        if (!has_shot(c, k)) continue;
        fprintf(file,
                "<h3>Frame %d</h3><div class=grid><figure><figcaption>real rays</figcaption><img "
                "id=i-ref-%d width=%d height=%d alt=\"real rays\" src=\"",
                lobe_app_ssr_shot_frame(c, k), k, c->width, c->height);
        is_good = write_picture(file, c, c->truth_shots[k]) && is_good;
        fputs("\"></figure>", file);
        for (int m = 0; m < c->contenders; m++)
            for (const char *kind = "prf"; *kind; kind++)
                is_good = write_shot(file, c, m, k, *kind) && is_good;
        fputs("</div>", file);
    }
    return is_good;
}

static void write_legend(FILE *file) {
    fputs(
        "<h2>What the numbers mean</h2><ul class=soft>"
        "<li><b>rejected</b>: share of the rays that were drawn and not traced, for they go below "
        "the surface: wasted pixels."
        "<li><b>relMSE</b>: mean of (picture &minus; truth)&sup2; / (truth&sup2; + 0.01) over the "
        "pixels with a ray; <b>on screen</b>: over those of them of whose true reflection half "
        "or more was on the screen."
        "<li><b>FLIP</b>: what a person sees who flips between the pictures, 0 to 1."
        "<li><b>temporal</b>: of the change from frame to frame, against the change of the truth, "
        "relative as relMSE: flicker and lag."
        "<li><b>false hits</b>: rays that claim to meet what real rays do not meet within three "
        "pixels; <b>false misses</b>: rays that miss what real rays meet on the screen; <b>hit "
        "off</b>: of right hits, the distance from the real place."
        "</ul>",
        file);
}

lobe_app_status lobe_app_write_ssr_report(const lobe_app_ssr_contest *c, const char *title,
                                          const char *command, bool is_interrupted,
                                          const char *folder) {
    char path[PATH_MAX];
    lobe_app_file file;
    snprintf(path, sizeof path, "%s/report.html", folder);
    const lobe_app_status status = lobe_app_begin_file(&file, path);
    if (status) return status;
    errno = ENOMEM;
    write_head(file.stream, c, title, command, is_interrupted);
    if (has_shot(c, first_shot(c))) write_stage(file.stream, c);
    write_curves(file.stream, c);
    write_table(file.stream, c);
    const bool is_good = write_shots(file.stream, c);
    write_legend(file.stream);
    if (has_shot(c, first_shot(c))) lobe_app_write_stage_script(file.stream);
    fputs("</html>\n", file.stream);
    return lobe_app_finish_file(&file, true, is_good);
}
