/* SVG as cairo writes it, made shorter. */
#ifndef LOBE_FIGURE_SVG_H
#define LOBE_FIGURE_SVG_H

#include "bytes.h"

/* Cuts the coordinates of paths after the second decimal: 0.01 points, less than anyone sees. */
void lobe_svg_shorten(bytes *b);

#endif
