/* Colours: the Okabe-Ito palette, which the colour-blind tell apart, on white and on nearly black. */
#ifndef LOBE_FIGURE_THEME_H
#define LOBE_FIGURE_THEME_H

#include <lobe/figure.h>

typedef struct colour {
    double r, g, b;
} colour;

/* What a colour stands for is the same in every figure. */
typedef enum hue { HUE_BLUE, HUE_GREEN, HUE_RED, HUE_ORANGE, HUE_PURPLE, HUE_SKY, HUE_COUNT } hue;

typedef struct theme {
    colour paper, ink, muted, grid;
    colour hues[HUE_COUNT];
} theme;

const theme *lobe_theme_of(lobe_figure_theme which);

/* t in [0, 1], outside clamped. */
typedef colour colour_map(double t);
colour_map lobe_map_sequential; /* dark blue to yellow: lighter is more */
colour_map lobe_map_diverging;  /* blue, white, red */

#endif
