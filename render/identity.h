/* What decides the bits of a picture but for the seed, as lines "KEY VALUE": two pictures with the same lines and
 * seed have the same bits (on one kind of processor). */
#ifndef LOBE_RENDER_IDENTITY_H
#define LOBE_RENDER_IDENTITY_H

#include "lobe/render.h"

enum { IDENTITY_ROOM = 2048, IDENTITY_VALUE_ROOM = 128 };

/* The options are those that count: no f-number, and the distance that is sharp. */
void lobe_identity_write(char text[IDENTITY_ROOM], const lobe_scene *scene, const lobe_view *view,
                         const lobe_render_options *options);

/* The value of a key; "none" where the text has no such line. */
void lobe_identity_value(const char *text, const char *key, char value[IDENTITY_VALUE_ROOM]);

typedef struct identity_difference {
    char key[32];
    char value[IDENTITY_VALUE_ROOM], other[IDENTITY_VALUE_ROOM]; /* "none": the line is missing */
} identity_difference;

/* The first line of `text` that `other` has not; 0: there is none. `but`: a key that does not count, or NULL. */
int lobe_identity_differs(const char *text, const char *other, const char *but,
                          identity_difference *difference);

#endif
