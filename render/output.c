#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "message.h"

static lobe_render_result fail_errno(const char *path, int error) {
    return lobe_fail(LOBE_RENDER_FAILED, "%s: cannot be written (%s); choose another place", path,
                     strerror(error));
}

static lobe_render_result open_beside(output *out, const char *path, long process) {
    *out = (output){.path = path};
    struct stat status;
    if (stat(path, &status) == 0 && S_ISDIR(status.st_mode)) return fail_errno(path, EISDIR);
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
        out->file = fopen(path, "wb");
        return out->file ? LOBE_RENDER_OK : fail_errno(path, errno);
    }
    size_t size = strlen(path) + 32;
    out->temporary = malloc(size);
    if (!out->temporary) return lobe_fail_memory(path);
    if (process)
        snprintf(out->temporary, size, "%s.%ld.part", path, process);
    else
        snprintf(out->temporary, size, "%s.part", path);
    out->file = fopen(out->temporary, "wb");
    if (out->file) return LOBE_RENDER_OK;
    int error = errno;
    free(out->temporary);
    out->temporary = NULL;
    return fail_errno(path, error);
}

lobe_render_result lobe_output_open(output *out, const char *path) {
    return open_beside(out, path, (long)getpid());
}

lobe_render_result lobe_output_open_durable(output *out, const char *path) {
    lobe_render_result result = open_beside(out, path, 0);
    out->is_durable = 1;
    return result;
}

/* The new name, on the disk. A file system that cannot do this has done what it can. */
static void sync_folder(const char *path) {
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    const int file = folder ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (file >= 0) {
        fsync(file);
        close(file);
    }
    free(folder);
}

void lobe_output_write(output *out, const void *data, size_t size) {
    if (!out->error && fwrite(data, 1, size, out->file) != size) out->error = errno ? errno : EIO;
}

lobe_render_result lobe_output_close(output *out, lobe_render_result result) {
    if (!out->file) return result;
    if ((fflush(out->file) != 0 || ferror(out->file)) && !out->error)
        out->error = errno ? errno : EIO;
    if (out->is_durable && out->temporary && !out->error && fsync(fileno(out->file)) != 0)
        out->error = errno;
    if (fclose(out->file) != 0 && !out->error) out->error = errno ? errno : EIO;
    int keep = result == LOBE_RENDER_OK && !out->error;
    if (out->temporary && keep && rename(out->temporary, out->path) != 0) out->error = errno;
    if (out->temporary && (!keep || out->error)) unlink(out->temporary);
    if (out->is_durable && keep && !out->error) sync_folder(out->path);
    free(out->temporary);
    /* A failed write explains any later failure of the encoder. */
    return out->error ? fail_errno(out->path, out->error) : result;
}
