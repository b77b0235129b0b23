/* Text: a header with everything that the results depend on, the cases, a hash over all of it. */
#define _POSIX_C_SOURCE 200809L

#include "state.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/version.h>

enum { PATH_ROOM = 4096, LINE_ROOM = 1024, MOST_BYTES = 1 << 28 };

/* ---- Writing --------------------------------------------------------------------------------- */

static uint64_t hash_of_titles(const lobe_run *run) {
    uint64_t hash = LOBE_HASH_SEED;
    for (size_t i = 0; i < run->suite.chosen_count; ++i) {
        uint64_t stream = lobe_title_stream(lobe_run_title(run, i));
        hash = lobe_hash(hash, &stream, sizeof stream);
    }
    return hash;
}

static void write_header(const lobe_run *run, FILE *file) {
    const lobe_verify_options *o = run->options;
    fprintf(file, "lobe verify state 1\n");
    fprintf(file, "version %s\n", LOBE_VERSION_STRING);
    fprintf(file, "level %s\n", o->level == LOBE_VERIFY_FULL ? "full" : "quick");
    fprintf(file, "draws %" PRIu64 "\n", run->settings.draws);
    fprintf(file, "seed %" PRIu64 "\n", o->seed);
    fprintf(file, "plugin %016" PRIx64 "\n", o->plugin != NULL ? run->plugin.hash : 0);
    fprintf(file, "cases %016" PRIx64 "\n", hash_of_titles(run));
}

static void write_case(const lobe_run *run, size_t position, FILE *file) {
    const lobe_report *report = &run->outcomes[position].report;
    fprintf(file, "case\t%zu\t%d\n", position, (int)report->count);
    for (int i = 0; i < report->count; ++i) {
        const lobe_report_row *row = &report->rows[i];
        fprintf(file, "%s\t%d\t%d\t%a\t%a\t%a\t%s\n", row->test, (int)row->kind, (int)row->is_known,
                row->statistic, row->value, row->limit, row->detail);
    }
}

/* The whole file in memory, for its hash. NULL without memory. */
static char *compose(const lobe_run *run, int with_cases, size_t *size) {
    char *text = NULL;
    FILE *file = open_memstream(&text, size);
    if (file == NULL) return NULL;
    write_header(run, file);
    for (size_t i = 0; i < run->suite.chosen_count && with_cases; ++i) {
        if (run->outcomes[i].is_done) write_case(run, i, file);
    }
    int is_good = !ferror(file);
    is_good = fclose(file) == 0 && is_good;
    if (is_good) return text;
    free(text);
    return NULL;
}

static int write_file(const char *path, const char *text, size_t size) {
    FILE *file = fopen(path, "wb");
    if (file == NULL) return 0;
    int is_good = fwrite(text, 1, size, file) == size;
    is_good = fprintf(file, "hash %016" PRIx64 "\n", lobe_hash(LOBE_HASH_SEED, text, size)) > 0 &&
              is_good;
    return fclose(file) == 0 && is_good;
}

void lobe_state_save(lobe_run *run) {
    char part[PATH_ROOM];
    const char *path = run->options->state;
    int length = snprintf(part, sizeof part, "%s.part", path);
    size_t size;
    char *text = compose(run, 1, &size);
    errno = text == NULL ? ENOMEM : 0;
    int is_good = text != NULL && length < (int)sizeof part && write_file(part, text, size) &&
                  rename(part, path) == 0;
    if (!is_good) {
        int why = length < (int)sizeof part ? errno : ENAMETOOLONG;
        remove(part);
        lobe_run_stop(run, LOBE_VERIFY_NOT_SAVED, "%.300s: cannot write the state: %s; %s", path,
                      strerror(why), "choose another file");
    }
    free(text);
}

/* ---- Reading --------------------------------------------------------------------------------- */

/* The whole file, terminated. NULL: errno says why; 0: there is none. */
static char *read_file(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        if (errno == ENOENT) errno = 0;
        return NULL;
    }
    size_t room = 1 << 16;
    char *text = malloc(room);
    *size = 0;
    while (text != NULL && room <= MOST_BYTES) {
        size_t count = fread(text + *size, 1, room - 1 - *size, file);
        *size += count;
        if (count == 0) break;
        if (*size + 1 < room) continue;
        room *= 2;
        char *larger = realloc(text, room);
        if (larger == NULL) free(text);
        text = larger;
    }
    int why = text == NULL ? ENOMEM : ferror(file) ? EIO : room > MOST_BYTES ? EFBIG : 0;
    fclose(file);
    if (why != 0) {
        free(text);
        errno = why;
        return NULL;
    }
    text[*size] = '\0';
    return text;
}

/* Whether the last line is the hash of what stands before; cuts it off. */
static int check_hash(char *text, size_t size) {
    if (size < 23 || strlen(text) != size) return 0;
    char *last = text + size - 22; /* "hash ", 16 digits, newline */
    uint64_t hash;
    if (last[-1] != '\n' || sscanf(last, "hash %16" SCNx64, &hash) != 1) return 0;
    if (hash != lobe_hash(LOBE_HASH_SEED, text, size - 22)) return 0;
    *last = '\0';
    return 1;
}

/* Where the texts differ first, as the word that begins the line. NULL: `text` begins with
 * `header`. */
static const char *find_difference(const char *text, const char *header, char word[32]) {
    size_t line = 0;
    for (size_t i = 0; header[i] != '\0'; ++i) {
        if (text[i] != header[i]) {
            snprintf(word, 32, "%.*s", (int)strcspn(header + line, " "), header + line);
            return word;
        }
        if (header[i] == '\n') line = i + 1;
    }
    return NULL;
}

static int read_row(const char *line, lobe_report_row *row) {
    int kind, known, used = 0;
    *row = (lobe_report_row){0};
    int fields = sscanf(line, "%15[^\t]\t%d\t%d\t%la\t%la\t%la\t%n", row->test, &kind, &known,
                        &row->statistic, &row->value, &row->limit, &used);
    if (fields != 6 || used == 0) return 0;
    row->kind = kind;
    row->is_known = known;
    snprintf(row->detail, sizeof row->detail, "%s", line + used);
    return 1;
}

/* Cuts a line off the front of *text. NULL at the end. */
static char *next_line(char **text) {
    char *line = *text;
    char *end = strchr(line, '\n');
    if (end == NULL) return NULL;
    *end = '\0';
    *text = end + 1;
    return line;
}

static int read_case(lobe_run *run, const char *line, char **text) {
    size_t position;
    int rows;
    if (sscanf(line, "case\t%zu\t%d", &position, &rows) != 2) return 0;
    if (position >= run->suite.chosen_count || rows < 0 || rows > LOBE_REPORT_ROOM) return 0;
    lobe_outcome *outcome = &run->outcomes[position];
    for (int i = 0; i < rows; ++i) {
        line = next_line(text);
        if (line == NULL || !read_row(line, &outcome->report.rows[i])) return 0;
    }
    outcome->report.count = rows;
    lobe_report_sanitize(&outcome->report);
    outcome->is_done = 1;
    return 1;
}

static void read_state(lobe_run *run, char *text, size_t size, const char *header) {
    const char *path = run->options->state;
    char word[32];
    if (!check_hash(text, size)) {
        lobe_run_stop(run, LOBE_VERIFY_BAD_STATE,
                      "%.300s: not a whole state of a run; remove it to start again", path);
        return;
    }
    if (find_difference(text, header, word) != NULL) {
        lobe_run_stop(
            run, LOBE_VERIFY_BAD_STATE,
            "%.300s: of another run, its %s differs; use the same options or another file", path,
            word);
        return;
    }
    char *rest = text + strlen(header);
    for (char *line; (line = next_line(&rest)) != NULL;) {
        if (read_case(run, line, &rest)) continue;
        lobe_run_stop(run, LOBE_VERIFY_BAD_STATE, "%.300s: damaged; remove it to start again",
                      path);
        return;
    }
}

void lobe_state_open(lobe_run *run) {
    size_t size, header_size;
    char *header = compose(run, 0, &header_size);
    char *text = read_file(run->options->state, &size);
    int why = errno;
    if (header == NULL) {
        lobe_run_stop(run, LOBE_VERIFY_NO_MEMORY, "out of memory; close other programs");
    } else if (text != NULL) {
        read_state(run, text, size, header);
    } else if (why != 0) {
        lobe_run_stop(run, LOBE_VERIFY_BAD_STATE, "%.300s: cannot read: %s; choose another file",
                      run->options->state, strerror(why));
    }
    free(text);
    free(header);
    if (run->trouble == LOBE_VERIFY_OK) lobe_state_save(run);
}
