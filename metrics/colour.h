/* The colour spaces of FLIP. */
#ifndef LOBE_METRICS_COLOUR_H
#define LOBE_METRICS_COLOUR_H

/* Linear RGB, CIE XYZ, YCxCz or CIE L*a*b*, as the name of the function says. */
typedef struct colour {
    float v[3];
} colour;

/* YCxCz (Flohr et al. 1993): opponent and linear, so it may be blurred. Y is that of L* without its root. */
colour lobe_opponent_of_rgb(colour rgb);
colour lobe_rgb_of_opponent(colour opponent);

/* L*a*b*, with a* and b* scaled by 0.01 L*: dark colours differ less in hue (Hunt 1952). */
colour lobe_perceived_of_rgb(colour rgb);

/* Distance of Abasi et al. 2020: of lightness, plus of hue and chroma. */
float lobe_colour_distance(colour a, colour b);

#endif
