#include "bench_page.h"

#include <math.h>
#include <string.h>

#include "output.h"

/* Colours follow the reader's choice of light or dark; on a narrow screen the name stands above its bar. */
static const char style[] =
    "<style>\n"
    ":root{color-scheme:light dark;--ink:#1c1c1e;--dim:#6a6a70;--paper:#fff;--track:#ececf0}\n"
    "@media(prefers-color-scheme:dark){:root{--ink:#ececf0;--dim:#9a9aa2;--paper:#161618;"
    "--track:#2a2a2e}}\n"
    "body{font:15px/1.4 system-ui,sans-serif;color:var(--ink);background:var(--paper);"
    "max-width:62rem;margin:1rem auto;padding:0 1rem}\n"
    "h1{font-size:1.4rem}h2{font-size:1.1rem;margin:1.6rem 0 .4rem}h3{font-size:1rem;margin:.8rem "
    "0 "
    ".1rem}p{color:var(--dim)}\n"
    ".row{display:grid;grid-template-columns:5rem 1fr 15rem;gap:.6rem;align-items:center}\n"
    ".track{background:var(--track);border-radius:3px;height:.8rem}\n"
    ".bar{border-radius:3px;height:100%}\n"
    ".n{font-variant-numeric:tabular-nums;color:var(--dim);font-size:.85rem}\n"
    ".call{background:#8a8a92}.scalar{background:#c48a2c}.sse{background:#4b8f5b}"
    ".avx{background:#2f7fc4}.wide{background:#8455c7}\n"
    "@media(max-width:40rem){.row{grid-template-columns:4rem 1fr}.n{grid-column:1/3}}\n"
    "</style>\n";

static const char *text_of(const json_t *row, const char *key) {
    return json_string_value(json_object_get(row, key));
}

static double number_of(const json_t *row, const char *key) {
    return json_number_value(json_object_get(row, key));
}

static int is_same(const json_t *a, const json_t *b, const char *key) {
    return a != NULL && strcmp(text_of(a, key), text_of(b, key)) == 0;
}

static const char *colour_of(const char *isa) {
    static const char *const known[][2] = {
        {"call", "call"}, {"scalar", "scalar"}, {"avx2", "avx"}, {"avx512", "wide"}};
    for (size_t i = 0; i < sizeof known / sizeof *known; ++i)
        if (strcmp(isa, known[i][0]) == 0) return known[i][1];
    return "sse";
}

static double longest_of(const json_t *rows) {
    double longest = 1;
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row) longest = fmax(longest, number_of(row, "ns"));
    return longest;
}

static void print_bar(const json_t *row, double longest) {
    /* by the logarithm, from a quarter of a nanosecond: a vector unit is an order faster than a call */
    const double share = log(4 * fmax(number_of(row, "ns"), 0.25)) / log(4 * longest);
    const char *isa = text_of(row, "isa");
    lobe_app_print("<div class=row><span>%s</span><div class=track><div class=\"bar %s\" "
                   "style=\"width:%.1f%%\"></div></div><span class=n>%.2f ns, density %.2f ns",
                   isa, colour_of(isa), 100 * share, number_of(row, "ns"),
                   number_of(row, "ns_pdf"));
    if (number_of(row, "ns_normal") > 0)
        lobe_app_print(", normal alone %.2f ns", number_of(row, "ns_normal"));
    if (number_of(row, "listing") > 0)
        lobe_app_print(", listing &times;%.1f", number_of(row, "listing"));
    lobe_app_print("</span></div>\n");
}

/* The rows of one precision that are prepared alike. */
static void print_part(const json_t *rows, const char *precision, const char *prepared,
                       double longest) {
    const json_t *last = NULL;
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row) {
        if (strcmp(text_of(row, "precision"), precision) != 0 ||
            strcmp(text_of(row, "prepared"), prepared) != 0)
            continue;
        if (last == NULL)
            lobe_app_print("<h2>%s, prepared %s</h2>\n", precision,
                           strcmp(prepared, "each") == 0 ? "for each draw" : "once");
        if (!is_same(last, row, "ndf") || !is_same(last, row, "masking") ||
            !is_same(last, row, "method"))
            lobe_app_print("<h3>%s %s %s</h3>\n", text_of(row, "ndf"), text_of(row, "masking"),
                           text_of(row, "method"));
        print_bar(row, longest);
        last = row;
    }
}

/* The only text that is not ours. */
static void print_escaped(const char *text) {
    for (; *text != '\0'; ++text) {
        if (*text == '<' || *text == '&')
            lobe_app_print("&#%d;", *text);
        else
            lobe_app_write(text, 1);
    }
}

void lobe_app_print_bench_page(const char *cpu, double copy_bytes_per_second, const json_t *rows) {
    lobe_app_print("<!doctype html>\n<html lang=en>\n<meta charset=utf-8>\n<meta name=viewport "
                   "content=\"width=device-width\">\n<title>lobe bench</title>\n");
    lobe_app_write(style, sizeof style - 1);
    lobe_app_print("<h1>What a draw costs</h1>\n<p>");
    print_escaped(cpu);
    lobe_app_print(
        ", one thread; copies %.1f GB/s. Nanoseconds of a draw with density and weight "
        "(bars, logarithmic) and of the density of a direction; listing: times faster than "
        "the published listing in plain C.</p>\n",
        1e-9 * copy_bytes_per_second);
    static const char *const precisions[] = {"f32", "f64"}, *const prepared[] = {"each", "shared"};
    const double longest = longest_of(rows);
    for (int k = 0; k < 4; ++k) print_part(rows, precisions[k / 2], prepared[k % 2], longest);
    lobe_app_print("</html>\n");
}
