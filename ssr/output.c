#include "output.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "message.h"

static lobe_ssr_result fail(const char *path, int error) {
    return lobe_ssr_fail(LOBE_SSR_FAILED, "%s: cannot be written (%s); choose another place", path,
                         strerror(error));
}

lobe_ssr_result lobe_ssr_output_open(ssr_output *out, const char *path) {
    *out = (ssr_output){.path = path};
    const int length =
        snprintf(out->temporary, sizeof out->temporary, "%s.%ld.part", path, (long)getpid());
    if (length < 0 || (size_t)length >= sizeof out->temporary) return fail(path, ENAMETOOLONG);
    out->file = fopen(out->temporary, "wb");
    return out->file ? LOBE_SSR_OK : fail(path, errno);
}

void lobe_ssr_output_write(ssr_output *out, const void *bytes, size_t size) {
    if (!out->error && fwrite(bytes, 1, size, out->file) != size) out->error = errno ? errno : EIO;
}

lobe_ssr_result lobe_ssr_output_close(ssr_output *out, int is_good) {
    if (fclose(out->file) != 0 && !out->error) out->error = errno ? errno : EIO;
    if (is_good && !out->error && rename(out->temporary, out->path) != 0) out->error = errno;
    if (!is_good || out->error) unlink(out->temporary);
    if (out->error) return fail(out->path, out->error);
    return is_good ? LOBE_SSR_OK : lobe_ssr_fail_memory(out->path);
}
