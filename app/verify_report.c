#include "verify_report.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/version.h>

#include "false_colour.h"

/* A page of more pictures is no help to anybody. */
enum { MOST_PICTURES = 48 };

/* Of the difference, in standard deviations. */
static const float MOST_DEVIATIONS = 5;

static const char STYLE[] =
    ".ok{color:var(--ok)}.FAILED{color:var(--bad);font-weight:600}"
    ".known{color:var(--known);font-weight:600}"
    ".sum{display:flex;flex-wrap:wrap;gap:.6rem;margin:1rem 0}.sum span{border:1px solid "
    "var(--line);"
    "border-radius:.5rem;padding:.3rem .8rem;background:var(--card)}"
    ".case{border:1px solid var(--line);border-radius:.6rem;background:var(--card);padding:.9rem;"
    "margin:1rem 0}.row{display:grid;grid-template-columns:repeat(auto-fit,minmax(5.6rem,1fr));"
    "gap:.7rem;margin-bottom:.5rem}.pair{display:grid;grid-template-columns:repeat(auto-fit,minmax("
    "min(20rem,100%),"
    "1fr));gap:.8rem}figure img{width:100%;max-width:20rem;display:block;"
    "image-rendering:pixelated}figure svg{width:100%;max-width:26rem;height:auto;display:block}"
    "svg .curve{stroke:var(--curve);fill:none;stroke-width:2}"
    "svg .dot{fill:var(--text)}svg .bar{stroke:var(--text)}"
    ".sign{background:linear-gradient(90deg,#0a3678,#4084c6,#a0c8e2,#f6f6f6,#f4b696,#d45846,"
    "#7c0c24)}";

static const char *verdict(const lobe_verify_test *test) {
    return test->passed ? "ok" : test->is_known ? "known" : "FAILED";
}

/* ---- While the run goes on ------------------------------------------------------------------- */

static void begin_text(lobe_app_text *text) {
    text->stream = open_memstream(&text->bytes, &text->size);
}

/* false: out of memory. */
static bool end_text(lobe_app_text *text) {
    return text->stream && fclose(text->stream) == 0;
}

static void free_text(lobe_app_text *text) {
    free(text->bytes);
    *text = (lobe_app_text){0};
}

lobe_app_status lobe_app_begin_page(lobe_app_page *page, const char *path) {
    *page = (lobe_app_page){.path = path};
    if (!path) return LOBE_APP_DONE;
    const lobe_app_status status = lobe_app_begin_file(&page->file, path);
    if (status) return status;
    begin_text(&page->rows);
    begin_text(&page->failures);
    begin_text(&page->cases);
    begin_text(&page->tests);
    return LOBE_APP_DONE;
}

/* The last columns of a row. */
static void write_result(FILE *file, const lobe_verify_test *test) {
    fputs("<td class=n>", file);
    lobe_app_write_html(file, test->test);
    fprintf(file, "<td class=n>%s %.3g<td class=n>%s %.3g<td>",
            test->kind == LOBE_VERIFY_P_VALUE ? "p" : "error", test->value,
            test->kind == LOBE_VERIFY_P_VALUE ? "&ge;" : "&le;", test->limit);
    lobe_app_write_html(file, test->detail);
    fputc('\n', file);
}

static void write_row(FILE *file, const lobe_verify_test *test) {
    fprintf(file, "<tr><td class=%s>%s<td class=n>", verdict(test), verdict(test));
    lobe_app_write_html(file, test->configuration);
    write_result(file, test);
}

static void begin_model(lobe_app_page *page, const char *model) {
    FILE *file = page->rows.stream;
    const bool is_first = !*page->model;
    fprintf(file, "%s<details%s><summary>", is_first ? "" : "</table></div></details>",
            is_first ? " open" : "");
    lobe_app_write_html(file, model);
    fputs("</summary><div class=wide><table><tr><th>verdict<th>configuration<th>test<th>value"
          "<th>limit<th>what was compared",
          file);
    snprintf(page->model, sizeof page->model, "%s", model);
}

/* For the picture of its case, which comes after its tests. */
static void keep_for_case(lobe_app_page *page, const lobe_verify_test *test, bool is_new_model) {
    if (is_new_model || strcmp(page->configuration, test->configuration) != 0) {
        rewind(page->tests.stream);
        snprintf(page->configuration, sizeof page->configuration, "%s", test->configuration);
    }
    if (test->passed && test->kind != LOBE_VERIFY_P_VALUE) return;
    fprintf(page->tests.stream, "<tr><td class=%s>%s", verdict(test), verdict(test));
    write_result(page->tests.stream, test);
}

static bool has_texts(const lobe_app_page *page) {
    return page->rows.stream && page->failures.stream && page->cases.stream && page->tests.stream;
}

void lobe_app_add_test(lobe_app_page *page, const lobe_verify_test *test) {
    if (!has_texts(page)) return;
    const bool is_new_model = strcmp(page->model, test->model) != 0;
    if (is_new_model) begin_model(page, test->model);
    write_row(page->rows.stream, test);
    keep_for_case(page, test, is_new_model);
    if (test->passed) return;
    FILE *file = page->failures.stream;
    fprintf(file, "<tr><td class=%s>%s<td>", verdict(test), verdict(test));
    lobe_app_write_html(file, test->model);
    fputs("<td class=n>", file);
    lobe_app_write_html(file, test->configuration);
    write_result(file, test);
}

/* What the ramp ends at: all but the brightest two hundredth of what is expected. */
static int compare_floats(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

static float brightest(const lobe_verify_picture *picture) {
    const int pixels = picture->size * picture->size;
    float *values = malloc((size_t)pixels * sizeof *values);
    float most = 0;
    for (int sheet = 0; values && sheet < picture->sheets; ++sheet) {
        size_t count = 0;
        for (int i = 0; i < pixels; ++i)
            if (isfinite(picture->expected[sheet][i]))
                values[count++] = picture->expected[sheet][i];
        if (count == 0) continue;
        qsort(values, count, sizeof *values, compare_floats);
        most = fmaxf(most, values[count - 1 - count / 200]);
    }
    free(values);
    return most > 0 ? 1.25f * most : 1;
}

static void write_figure(FILE *file, const lobe_verify_picture *picture,
                         const float *const values[2], lobe_app_ramp ramp, float most,
                         const char *caption) {
    for (int sheet = 0; sheet < picture->sheets; ++sheet) {
        const char *side = picture->sheets < 2 ? "" : sheet == 0 ? ", reflected" : ", transmitted";
        fprintf(file, "<figure><img alt=\"%s%s\" src=\"", caption, side);
        lobe_app_write_false_colour(file, values[sheet], picture->size, ramp, most);
        fprintf(file, "\"><figcaption>%s%s</figcaption></figure>", caption, side);
    }
}

/* ---- The furnace ------------------------------------------------------------------------------ */

enum { PLOT_WIDTH = 380, PLOT_HEIGHT = 190, PLOT_LEFT = 34, PLOT_BOTTOM = 24, PLOT_TOP = 8 };

typedef struct plot {
    double first, last; /* angles */
    double most;
} plot;

static double plot_x(const plot *p, double theta) {
    const double width = PLOT_WIDTH - PLOT_LEFT - 8;
    return PLOT_LEFT + width * (theta - p->first) / (p->last - p->first);
}

static double plot_y(const plot *p, double y) {
    const double height = PLOT_HEIGHT - PLOT_BOTTOM - PLOT_TOP;
    return PLOT_TOP + height * (1 - fmin(fmax(y / p->most, -0.02), 1.02));
}

static plot plot_of(const lobe_verify_picture *picture) {
    const double last = picture->curve[picture->curve_points - 1].theta;
    plot p = {last < 90 ? 0 : 90, last < 90 ? 90 : 180, 1.1};
    for (int i = 0; i < picture->curve_points; ++i) {
        const lobe_verify_furnace *f = &picture->curve[i];
        const double high = fmax(f->integral, f->sampled);
        if (isfinite(high)) p.most = fmax(p.most, fmin(1.1 * high, 10));
    }
    return p;
}

static void write_axes(FILE *file, const plot *p) {
    const double step = p->most > 2.5 ? 1 : 0.5;
    for (double y = 0; y <= p->most; y += step)
        fprintf(file, "<line class=axis x1=%d x2=%d y1=%.1f y2=%.1f /><text x=2 y=%.1f>%.1f</text>",
                PLOT_LEFT, PLOT_WIDTH - 8, plot_y(p, y), plot_y(p, y), plot_y(p, y) + 4, y);
    for (double x = p->first; x <= p->last; x += 30)
        fprintf(file, "<text x=%.1f y=%d text-anchor=middle>%.0f&deg;</text>", plot_x(p, x) - 4,
                PLOT_HEIGHT - 6, x);
}

static void write_curve(FILE *file, const lobe_verify_picture *picture) {
    const plot p = plot_of(picture);
    fprintf(file, "<figure><svg viewBox=\"0 0 %d %d\" role=img aria-label=furnace>", PLOT_WIDTH,
            PLOT_HEIGHT);
    write_axes(file, &p);
    fputs("<polyline class=curve points=\"", file);
    for (int i = 0; i < picture->curve_points; ++i) {
        const lobe_verify_furnace *f = &picture->curve[i];
        if (isfinite(f->integral))
            fprintf(file, "%.1f,%.1f ", plot_x(&p, f->theta), plot_y(&p, f->integral));
    }
    fputs("\"/>", file);
    for (int i = 0; i < picture->curve_points; ++i) {
        const lobe_verify_furnace *f = &picture->curve[i];
        if (!isfinite(f->sampled) || !isfinite(f->error)) continue;
        const double x = plot_x(&p, f->theta);
        fprintf(file,
                "<line class=bar x1=%.1f x2=%.1f y1=%.1f y2=%.1f />"
                "<circle class=dot cx=%.1f cy=%.1f r=2.4 />",
                x, x, plot_y(&p, f->sampled - 2 * f->error), plot_y(&p, f->sampled + 2 * f->error),
                x, plot_y(&p, f->sampled));
    }
    fputs("</svg><figcaption>White furnace over the angle of wi: line, integral of f |cos|; dots, "
          "mean "
          "weight of draws &plusmn; 2 standard deviations</figcaption></figure>",
          file);
}

void lobe_app_add_picture(lobe_app_page *page, const lobe_verify_picture *picture) {
    if (!has_texts(page)) return;
    FILE *file = page->cases.stream;
    if (page->pictures == MOST_PICTURES) {
        page->left_out += 1;
        return;
    }
    page->pictures += 1;
    const float most = brightest(picture);
    fputs("<section class=case><h3>", file);
    lobe_app_write_html(file, picture->model);
    fputs("<br><span class=soft>", file);
    lobe_app_write_html(file, picture->configuration);
    fputs("</span></h3><div class=row>", file);
    write_figure(file, picture, picture->observed, LOBE_APP_RAMP_AMOUNT, most, "observed");
    write_figure(file, picture, picture->expected, LOBE_APP_RAMP_AMOUNT, most, "expected");
    write_figure(file, picture, picture->difference, LOBE_APP_RAMP_DIFFERENCE, MOST_DEVIATIONS,
                 "difference");
    fprintf(file,
            "</div><p class=soft>0 <span class=\"key amount\"></span> %.3g times the mean, by the "
            "square root &ensp; &minus;5 <span class=\"key sign\"></span> +5 standard "
            "deviations of the bin</p>",
            (double)most);
    fputs("<div class=pair>", file);
    write_curve(file, picture);
    fputs("<div class=wide><table>", file);
    fflush(page->tests.stream);
    fwrite(page->tests.bytes, 1, (size_t)ftell(page->tests.stream), file);
    fputs("</table></div></div></section>\n", file);
}

/* ---- The page --------------------------------------------------------------------------------- */

static void write_head(FILE *file, const lobe_app_page_head *head,
                       const lobe_verify_summary *summary) {
    lobe_app_begin_html(file, "lobe verify", STYLE);
    fputs("<h1>lobe verify", file);
    if (head->plugin) {
        fputs(": ", file);
        lobe_app_write_html(file, head->plugin);
    }
    fprintf(file, "</h1><p class=soft>lobe %s, %s, ", LOBE_VERSION_STRING, head->level);
    if (head->draws) fprintf(file, "%" PRIu64 " draws a case, ", head->draws);
    fprintf(file, "seed %" PRIu64, head->seed);
    if (head->only) {
        fputs(", only ", file);
        lobe_app_write_html(file, head->only);
    }
    fprintf(file,
            "</p><div class=sum><span><b>%" PRIu64 "</b> cases</span><span class=ok><b>%" PRIu64
            "</b> passed</span><span class=%s><b>%" PRIu64 "</b> failed</span>",
            summary->cases, summary->tests_passed, summary->tests_failed ? "FAILED" : "soft",
            summary->tests_failed);
    if (summary->tests_known)
        fprintf(file, "<span class=known><b>%" PRIu64 "</b> failed as documented</span>",
                summary->tests_known);
    fputs("</div>\n", file);
}

static void write_body(FILE *file, const lobe_app_page *page, const lobe_verify_summary *summary) {
    if (page->failures.size) {
        fputs("<h2>What failed</h2><div class=wide><table><tr><th>verdict<th>model"
              "<th>configuration<th>test<th>value<th>limit<th>what was compared",
              file);
        fwrite(page->failures.bytes, 1, page->failures.size, file);
        fputs("</table></div>\n", file);
    }
    if (page->pictures) {
        fputs(
            "<h2>Draws and expectations</h2><p class=soft>Directions on the disk on which the "
            "model's lobe is spread out; for a plugin the hemisphere seen from above. Every pixel "
            "shows the bin that it lies in.</p>\n",
            file);
        fwrite(page->cases.bytes, 1, page->cases.size, file);
    }
    if (page->left_out)
        fprintf(file, "<p>%d more cases are not shown; choose them with --only.</p>\n",
                page->left_out);
    if (summary->resumed)
        fprintf(file,
                "<p>%" PRIu64
                " cases were finished by an earlier run, which kept no pictures.</p>\n",
                summary->resumed);
    fputs(
        "<h2>Tests</h2><p class=soft>p: a p-value, passes at or above its limit. error: passes at "
        "or below.</p>\n",
        file);
    fwrite(page->rows.bytes, 1, page->rows.size, file);
    if (*page->model) fputs("</table></div></details>", file);
    fputs("\n</html>\n", file);
}

/* false: out of memory. */
static bool end_texts(lobe_app_page *page) {
    lobe_app_text *texts[] = {&page->rows, &page->failures, &page->cases, &page->tests};
    bool is_good = true;
    for (int i = 0; i < 4; ++i) is_good = end_text(texts[i]) && is_good;
    return is_good;
}

static void release(lobe_app_page *page) {
    free_text(&page->rows);
    free_text(&page->failures);
    free_text(&page->cases);
    free_text(&page->tests);
}

lobe_app_status lobe_app_finish_page(lobe_app_page *page, const lobe_app_page_head *head,
                                     const lobe_verify_summary *summary) {
    if (!page->path) return LOBE_APP_DONE;
    errno = ENOMEM;
    const bool is_good = end_texts(page);
    if (is_good && summary) {
        write_head(page->file.stream, head, summary);
        write_body(page->file.stream, page, summary);
    }
    release(page);
    return lobe_app_finish_file(&page->file, summary != NULL, is_good);
}
