#include "type.h"

#include <string.h>

static const struct {
    const char *ending, *type;
} types[] = {{".html", "text/html; charset=utf-8"},
             {".css", "text/css; charset=utf-8"},
             {".js", "text/javascript; charset=utf-8"},
             {".mjs", "text/javascript; charset=utf-8"},
             {".wasm", "application/wasm"},
             {".gz", "application/gzip"},
             {".json", "application/json"},
             {".webmanifest", "application/manifest+json"},
             {".svg", "image/svg+xml"},
             {".png", "image/png"},
             {".ico", "image/x-icon"},
             {".woff2", "font/woff2"},
             {".txt", "text/plain; charset=utf-8"}};

const char *lobe_type_of(const char *name) {
    const char *ending = strrchr(name, '.');
    for (size_t k = 0; ending && k < sizeof types / sizeof types[0]; k++)
        if (strcmp(ending, types[k].ending) == 0) return types[k].type;
    return "application/octet-stream";
}
