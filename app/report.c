#include "report.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* A part may quote a long argument; the line still has room for the other parts. */
enum { PART_SIZE = 400, LINE_SIZE = 1600, NAME_SIZE = 32 };

/* Quoted input may hold anything: control characters would break the line or the terminal. */
static void replace_unprintable(char *text) {
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c < 0x20 || c > 0x7e) *text = '?';
    }
}

void lobe_app_report_line(const char *message) {
    char line[LINE_SIZE];
    snprintf(line, sizeof line, "%s", message);
    replace_unprintable(line);
    fprintf(stderr, "lobe: %s\n", line);
}

static void report(const char *where, const char *hint, const char *what, va_list arguments) {
    char event[PART_SIZE], line[LINE_SIZE];
    vsnprintf(event, sizeof event, what, arguments);
    snprintf(line, sizeof line, "%.*s: %s; %s", PART_SIZE, *where ? where : "''", event, hint);
    lobe_app_report_line(line);
}

void lobe_app_report(const char *where, const char *hint, const char *what, ...) {
    va_list arguments;
    va_start(arguments, what);
    report(where, hint, what, arguments);
    va_end(arguments);
}

lobe_app_status lobe_app_reject(const char *where, const char *hint, const char *what, ...) {
    va_list arguments;
    va_start(arguments, what);
    report(where, hint, what, arguments);
    va_end(arguments);
    return LOBE_APP_BAD_INPUT;
}

/* Levenshtein distance: insertions, deletions and substitutions. */
static size_t edit_distance(const char *a, const char *b) {
    const size_t length = strlen(b);
    size_t row[NAME_SIZE];
    for (size_t j = 0; j <= length; j++) row[j] = j;
    for (size_t i = 0; a[i]; i++) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < length; j++) {
            const size_t substitute = diagonal + (a[i] != b[j]);
            const size_t insert = (row[j] < row[j + 1] ? row[j] : row[j + 1]) + 1;
            diagonal = row[j + 1];
            row[j + 1] = substitute < insert ? substitute : insert;
        }
    }
    return row[length];
}

const char *lobe_app_nearest(const char *name, const char *const *names) {
    const char *nearest = NULL;
    size_t least = strlen(name) / 2 + 1; /* beyond half the letters a suggestion only misleads */
    for (; *names; names++) {
        if (strlen(*names) >= NAME_SIZE) continue;
        const size_t distance = edit_distance(name, *names);
        if (distance < least) {
            least = distance;
            nearest = *names;
        }
    }
    return nearest;
}
