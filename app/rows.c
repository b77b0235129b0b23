#include "rows.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "interrupt.h"
#include "number.h"
#include "output.h"

lobe_app_status lobe_app_open_rows(lobe_app_rows *rows, const char *path, const char *columns,
                                   int least, int most) {
    const int is_standard_input = strcmp(path, "-") == 0;
    rows->name = is_standard_input ? "standard input" : path;
    rows->columns = columns;
    rows->least = least;
    rows->most = most;
    rows->ended = 0;
    rows->line = 0;
    rows->begin = rows->end = 0;
    rows->file = is_standard_input ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    if (rows->file >= 0) return LOBE_APP_DONE;
    return lobe_app_reject(path, "give a file that exists and may be read, or -", "cannot open: %s",
                           strerror(errno));
}

void lobe_app_close_rows(lobe_app_rows *rows) {
    if (rows->file > STDIN_FILENO) close(rows->file);
}

lobe_app_status lobe_app_reject_row(const lobe_app_rows *rows, const char *hint, const char *what) {
    char where[256];
    snprintf(where, sizeof where, "%.200s:%" PRIu64, rows->name, rows->line);
    return lobe_app_reject(where, hint, "%s", what);
}

/* Reads more behind what is not used yet, which moves to the front. */
static lobe_app_status fill(lobe_app_rows *rows) {
    memmove(rows->bytes, rows->bytes + rows->begin, rows->end - rows->begin);
    rows->end -= rows->begin;
    rows->begin = 0;
    lobe_app_flush();
    const size_t room = sizeof rows->bytes - 1 - rows->end; /* one for the end of the last line */
    const ssize_t count = read(rows->file, rows->bytes + rows->end, room);
    if (count > 0)
        rows->end += (size_t)count;
    else if (count == 0)
        rows->ended = 1;
    else if (errno == EINTR)
        return lobe_app_interrupted ? LOBE_APP_INTERRUPTED : LOBE_APP_DONE;
    else {
        lobe_app_report(rows->name, "give a file of numbers", "cannot read: %s", strerror(errno));
        return LOBE_APP_FAILED;
    }
    return LOBE_APP_DONE;
}

/* The next line, with a 0 in place of its end; NULL at the end of the file. */
static lobe_app_status next_line(lobe_app_rows *rows, char **line) {
    for (;;) {
        char *begin = rows->bytes + rows->begin;
        const size_t length = rows->end - rows->begin;
        char *newline = memchr(begin, '\n', length);
        if (newline || (rows->ended && length)) {
            char *end = newline ? newline : begin + length;
            rows->line++;
            rows->begin += (size_t)(end - begin) + (newline != NULL);
            if (memchr(begin, '\0', (size_t)(end - begin)))
                return lobe_app_reject_row(rows, "give text", "the line holds a zero byte");
            if (end > begin && end[-1] == '\r') end--;
            *end = '\0';
            *line = begin;
            return LOBE_APP_DONE;
        }
        *line = NULL;
        if (rows->ended) return LOBE_APP_DONE;
        if (length == sizeof rows->bytes - 1) {
            rows->line++;
            return lobe_app_reject_row(rows, "give one row a line", "the line is too long");
        }
        const lobe_app_status status = fill(rows);
        if (status) return status;
    }
}

/* A first line such as "ox,oy,oz" names the columns. */
static int is_header(const lobe_app_rows *rows, const char *line) {
    if (rows->line != 1) return 0;
    const char *column = rows->columns;
    for (; *line && *column; line++, column++)
        if (*line != (*column == ' ' ? ',' : *column)) return 0;
    return *line == '\0';
}

/* How many numbers stand in `line`, up to `most`; -1: something else stands there. */
static int scan_row(const char *line, int most, double *numbers) {
    int count = 0;
    while (*line && count < most) {
        if (!lobe_app_scan_number(line, &line, &numbers[count++])) return -1;
        const char *gap = line;
        line += strspn(line, " \t");
        if (*line == ',') line++;
        line += strspn(line, " \t");
        if (*line && line == gap) return -1;
    }
    return *line ? -1 : count;
}

lobe_app_status lobe_app_next_row(lobe_app_rows *rows, double *numbers, int *count) {
    *count = 0;
    char *line = NULL;
    do {
        const lobe_app_status status = next_line(rows, &line);
        if (status || !line) return status;
        line += strspn(line, " \t");
    } while (*line == '\0' || is_header(rows, line));

    *count = scan_row(line, rows->most, numbers);
    if (*count >= rows->least) return LOBE_APP_DONE;
    char what[128], hint[64];
    snprintf(what, sizeof what, "'%.60s' is not a row of finite numbers", line);
    snprintf(hint, sizeof hint, "a row is %s", rows->columns);
    return lobe_app_reject_row(rows, hint, what);
}
