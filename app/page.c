#include "page.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <stb/stb_image_write.h>

/* ---- Files ----------------------------------------------------------------------------------- */

static lobe_app_status cannot_write(const char *path, int why) {
    lobe_app_report(path, "choose another file", "cannot write: %s", strerror(why));
    return LOBE_APP_FAILED;
}

lobe_app_status lobe_app_begin_file(lobe_app_file *file, const char *path) {
    *file = (lobe_app_file){.path = path};
    const int length = snprintf(file->part, sizeof file->part, "%s.part", path);
    errno = ENAMETOOLONG;
    if (length < (int)sizeof file->part) file->stream = fopen(file->part, "wb");
    return file->stream ? LOBE_APP_DONE : cannot_write(path, errno);
}

lobe_app_status lobe_app_finish_file(lobe_app_file *file, bool is_wanted, bool is_good) {
    is_good = !ferror(file->stream) && is_good;
    is_good = fclose(file->stream) == 0 && is_good;
    if (is_good && is_wanted && rename(file->part, file->path) == 0) return LOBE_APP_DONE;
    const int why = errno;
    remove(file->part);
    return is_good && !is_wanted ? LOBE_APP_DONE : cannot_write(file->path, why);
}

/* ---- Text ------------------------------------------------------------------------------------ */

static const char STYLE[] =
    ":root{color-scheme:light dark;--back:#fbfbfa;--text:#1c1c1e;--soft:#6b6b70;--line:#dddcd8;"
    "--card:#fff;--ok:#1f7a3d;--bad:#b3261e;--known:#8a5a00;--curve:#3c5fc4}"
    "@media(prefers-color-scheme:dark){:root{--back:#151517;--text:#ececee;--soft:#9b9ba3;"
    "--line:#34343a;--card:#1e1e22;--ok:#6fce8f;--bad:#ff8a80;--known:#e6b85c;--curve:#8fb0ff}}"
    "*{box-sizing:border-box}body{margin:0 auto;max-width:68rem;padding:1.2rem 1rem 4rem;"
    "background:var(--back);color:var(--text);font:16px/1.5 system-ui,sans-serif}"
    "h1{font-size:1.5rem;margin:.2rem 0}h2{font-size:1.2rem;margin:2.2rem 0 .6rem}"
    "h3{font-size:1rem;margin:0 0 .5rem;overflow-wrap:anywhere}p{margin:.4rem 0}"
    ".soft,figcaption{color:var(--soft);font-size:.86rem}"
    "figure{margin:0}.wide{overflow-x:auto}table{border-collapse:collapse;width:100%;"
    "font-size:.84rem;font-variant-numeric:tabular-nums}td,th{text-align:left;"
    "padding:.22rem .7rem .22rem 0;border-bottom:1px solid var(--line);vertical-align:top}"
    "td.n{white-space:nowrap}summary{cursor:pointer;padding:.3rem 0}"
    "svg text{fill:var(--soft);font-size:11px}svg .axis{stroke:var(--line)}"
    ".key{display:inline-block;height:.7rem;width:7rem;border-radius:.2rem;vertical-align:-.05rem}"
    ".amount{background:linear-gradient(90deg,#0e1030,#342676,#70308c,#b23e78,#e26456,#f89e46,"
    "#fcdc74,#fffcd8)}";

void lobe_app_begin_html(FILE *file, const char *title, const char *style) {
    fputs("<!DOCTYPE html>\n<html lang=en><meta charset=utf-8>"
          "<meta name=viewport content=\"width=device-width,initial-scale=1\"><title>",
          file);
    lobe_app_write_html(file, title);
    fprintf(file, "</title><style>%s%s</style>\n", STYLE, style);
}

char *lobe_app_command_line(const char *name, int argc, char **argv) {
    size_t size = sizeof "lobe " + strlen(name);
    for (int i = 0; i < argc; i++) size += strlen(argv[i]) + 1;
    char *line = malloc(size);
    if (!line) return NULL;
    size_t used = (size_t)snprintf(line, size, "lobe %s", name);
    for (int i = 0; i < argc; i++)
        used += (size_t)snprintf(line + used, size - used, " %s", argv[i]);
    return line;
}

void lobe_app_write_html(FILE *file, const char *text) {
    for (; *text; ++text) {
        switch (*text) {
        case '<':
            fputs("&lt;", file);
            break;
        case '>':
            fputs("&gt;", file);
            break;
        case '&':
            fputs("&amp;", file);
            break;
        case '"':
            fputs("&quot;", file);
            break;
        default:
            fputc(*text, file);
        }
    }
}

/* ---- Pictures -------------------------------------------------------------------------------- */

/* Three bytes become four letters, so up to two bytes wait for the next call. */
typedef struct base64 {
    FILE *file;
    uint8_t waiting[3];
    int count;
} base64;

static void write_letters(base64 *b) {
    static const char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const uint32_t word = (uint32_t)b->waiting[0] << 16 |
                          (uint32_t)(b->count > 1 ? b->waiting[1] : 0) << 8 |
                          (b->count > 2 ? b->waiting[2] : 0);
    const char letters[4] = {DIGITS[word >> 18], DIGITS[word >> 12 & 63],
                             b->count > 1 ? DIGITS[word >> 6 & 63] : '=',
                             b->count > 2 ? DIGITS[word & 63] : '='};
    fwrite(letters, 1, sizeof letters, b->file);
    b->count = 0;
}

static void write_base64(void *context, void *data, int size) {
    base64 *b = context;
    const uint8_t *bytes = data;
    for (int i = 0; i < size; ++i) {
        b->waiting[b->count++] = bytes[i];
        if (b->count == 3) write_letters(b);
    }
}

static bool finish_base64(base64 *b, int is_good) {
    if (b->count) write_letters(b);
    return is_good != 0;
}

bool lobe_app_write_png_uri(FILE *file, const uint8_t *pixels, int width, int height,
                            int channels) {
    base64 b = {.file = file};
    fputs("data:image/png;base64,", file);
    return finish_base64(&b, stbi_write_png_to_func(write_base64, &b, width, height, channels,
                                                    pixels, channels * width));
}

/* Above a quality of 90 colours keep their full resolution. */
bool lobe_app_write_jpeg_uri(FILE *file, const uint8_t *pixels, int width, int height) {
    base64 b = {.file = file};
    fputs("data:image/jpeg;base64,", file);
    return finish_base64(&b,
                         stbi_write_jpg_to_func(write_base64, &b, width, height, 3, pixels, 92));
}
