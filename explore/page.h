/* The files of the page, in a source file that embed.cmake makes while building. */
#ifndef LOBE_EXPLORE_PAGE_H
#define LOBE_EXPLORE_PAGE_H

#include <stddef.h>

typedef struct page_file {
    const char *name; /* "index.html", "js/plot.js" */
    const void *bytes;
    size_t size;
} page_file;

extern const page_file lobe_page_files[];
extern const int lobe_page_count; /* 0: there was no compiler for WebAssembly */

#endif
