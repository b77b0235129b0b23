/* tests/render/told.h: the warnings of a scene, as they were told; the first eight are kept. */
#ifndef TESTS_RENDER_TOLD_H
#define TESTS_RENDER_TOLD_H

#include <stdio.h>

static char told[8][300];
static int tellings;

static void tell(void *user, const char *message) {
    (void)user;
    if (tellings < 8) snprintf(told[tellings], sizeof told[0], "%s", message);
    ++tellings;
}

#endif
