/* What a case drew and what it should have drawn, for the eye. Plain bytes, as a report. */
#ifndef LOBE_VERIFY_PICTURE_H
#define LOBE_VERIFY_PICTURE_H

#include "tally.h"

enum {
    LOBE_PICTURE_SIZE = 128, /* pixels in each direction */
    LOBE_PICTURE_PIXELS = LOBE_PICTURE_SIZE * LOBE_PICTURE_SIZE,
    LOBE_CURVE_POINTS = 13
};

struct lobe_picture {
    int32_t sheets; /* 0: there is no picture */
    /* Draws per area of the disk, in units of their mean; NAN outside the disk. */
    float observed[2][LOBE_PICTURE_PIXELS];
    float expected[2][LOBE_PICTURE_PIXELS];
    float difference[2][LOBE_PICTURE_PIXELS]; /* of the bin, in standard deviations */
    lobe_verify_furnace curve[LOBE_CURVE_POINTS];
};

/* Returns 0 without memory. */
int lobe_picture_make(lobe_picture *picture, const lobe_verify_model *model,
                      const lobe_settings *settings, const lobe_bins *bins,
                      const lobe_tally *tally);

#endif
