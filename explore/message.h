#ifndef LOBE_EXPLORE_MESSAGE_H
#define LOBE_EXPLORE_MESSAGE_H

#include <lobe/explore.h>

/* Keeps the message. */
lobe_explore_result lobe_explore_fail(lobe_explore_result result, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* LOBE_EXPLORE_OK if there is a page. */
lobe_explore_result lobe_explore_check_page(void);

#endif
