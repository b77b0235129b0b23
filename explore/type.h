#ifndef LOBE_EXPLORE_TYPE_H
#define LOBE_EXPLORE_TYPE_H

/* The media type of a file by its ending. */
const char *lobe_type_of(const char *name);

#endif
