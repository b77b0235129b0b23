/* The page as static files: written beside the final name, then renamed. */
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "message.h"
#include "page.h"

typedef struct stage {
    char folder[PATH_MAX];
} stage;

/* 0, or ENAMETOOLONG. */
static int join(char path[PATH_MAX], const stage *s, const char *name) {
    const int length = snprintf(path, PATH_MAX, "%s/%s", s->folder, name);
    return length < 0 || length >= PATH_MAX ? ENAMETOOLONG : 0;
}

/* The folders between the stage and the file. */
static int make_folders(const stage *s, char path[PATH_MAX]) {
    for (char *p = path + strlen(s->folder) + 1; (p = strchr(p, '/')); p++) {
        *p = 0;
        const int error = mkdir(path, 0777) == 0 || errno == EEXIST ? 0 : errno;
        *p = '/';
        if (error) return error;
    }
    return 0;
}

static int write_file(const stage *s, const page_file *file) {
    char path[PATH_MAX];
    int error = join(path, s, file->name);
    if (!error) error = make_folders(s, path);
    FILE *out = error ? NULL : fopen(path, "wbx");
    if (!out) return error ? error : errno;
    errno = 0;
    if (fwrite(file->bytes, 1, file->size, out) != file->size) error = errno ? errno : EIO;
    if (fclose(out) != 0 && !error) error = errno ? errno : EIO;
    return error;
}

/* Takes away what was written, folders after what is in them. */
static void remove_stage(const stage *s) {
    char path[PATH_MAX];
    for (int k = 0; k < lobe_page_count; k++) {
        if (join(path, s, lobe_page_files[k].name)) continue;
        unlink(path);
        for (char *p; (p = strrchr(path, '/')) && p > path + strlen(s->folder);) {
            *p = 0;
            rmdir(path); /* fails until it is empty */
        }
    }
    rmdir(s->folder);
}

/* An empty folder gives way to the new one, nothing else does. */
static int write_all(const stage *s, const char *folder) {
    if (mkdir(s->folder, 0777) != 0) return errno;
    int error = 0;
    for (int k = 0; k < lobe_page_count && !error; k++) error = write_file(s, &lobe_page_files[k]);
    if (!error && rename(s->folder, folder) != 0) error = errno;
    if (error) remove_stage(s);
    return error;
}

lobe_explore_result lobe_explore_write(const char *folder) {
    const lobe_explore_result page = lobe_explore_check_page();
    if (page) return page;
    size_t length = strlen(folder);
    while (length > 1 && folder[length - 1] == '/') length--;
    char final[PATH_MAX];
    stage s;
    const int end = snprintf(final, sizeof final, "%.*s", (int)length, folder),
              size = snprintf(s.folder, sizeof s.folder, "%s.%ld.part", final, (long)getpid());
    if (end < 0 || size < 0 || (size_t)size >= sizeof s.folder || (size_t)end >= sizeof final)
        return lobe_explore_fail(LOBE_EXPLORE_BAD_INPUT, "%.60s...: too long; give a shorter name",
                                 folder);
    const int error = write_all(&s, final);
    if (!error) return LOBE_EXPLORE_OK;
    if (error == ENOTEMPTY || error == EEXIST || error == ENOTDIR)
        return lobe_explore_fail(LOBE_EXPLORE_BAD_INPUT,
                                 "%s: not an empty folder, and nothing is overwritten; give the "
                                 "name of a new one",
                                 folder);
    return lobe_explore_fail(LOBE_EXPLORE_FAILED,
                             "%s: cannot be written (%s); give the name of a new folder elsewhere",
                             folder, strerror(error));
}
