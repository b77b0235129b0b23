#include "bytes.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void lobe_bytes_add(bytes *b, const void *data, size_t size) {
    if (b->failed || size == 0) return;
    if (b->room - b->size < size) {
        const size_t room = 2 * (b->size + size);
        char *grown = realloc(b->data, room);
        if (!grown) {
            b->failed = 1;
            return;
        }
        b->data = grown;
        b->room = room;
    }
    memcpy(b->data + b->size, data, size);
    b->size += size;
}

void lobe_bytes_free(bytes *b) {
    free(b->data);
    *b = (bytes){0};
}

static int write_all(const bytes *b, const char *path) {
    FILE *file = fopen(path, "wb");
    if (!file) return errno;
    errno = 0;
    const size_t written = fwrite(b->data, 1, b->size, file);
    int error = written == b->size ? 0 : errno ? errno : EIO;
    if (fclose(file) != 0 && !error) error = errno ? errno : EIO;
    return error;
}

int lobe_bytes_save(const bytes *b, const char *path) {
    struct stat status;
    const int exists = stat(path, &status) == 0;
    if (exists && S_ISDIR(status.st_mode)) return EISDIR;
    if (exists && !S_ISREG(status.st_mode)) return write_all(b, path);
    char part[PATH_MAX];
    const int length = snprintf(part, sizeof part, "%s.%ld.part", path, (long)getpid());
    if (length < 0 || (size_t)length >= sizeof part) return ENAMETOOLONG;
    int error = write_all(b, part);
    if (!error && rename(part, path) != 0) error = errno;
    if (error) unlink(part);
    return error;
}
