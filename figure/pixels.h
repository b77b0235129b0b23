/* Images in a figure. */
#ifndef LOBE_FIGURE_PIXELS_H
#define LOBE_FIGURE_PIXELS_H

#include "canvas.h"

/* Rows from the top. */
typedef colour pixel_function(const void *user, int column, int row);

/* Fills the box, one pixel a cell, edges kept sharp. */
void lobe_paint_pixels(canvas *c, box b, int columns, int rows, pixel_function *colour_of,
                       const void *user);

#endif
