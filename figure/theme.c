#include "theme.h"

#include <math.h>

#define RGB(hex)                                                                                   \
    { ((hex) >> 16 & 255) / 255.0, ((hex) >> 8 & 255) / 255.0, ((hex)&255) / 255.0 }

static const theme light = {
    RGB(0xffffff),
    RGB(0x1a1a1a),
    RGB(0x707070),
    RGB(0xe4e4e4),
    {RGB(0x0072b2), RGB(0x009e73), RGB(0xc8402f), RGB(0xe69f00), RGB(0xb65f96), RGB(0x56b4e9)}};

static const theme dark = {
    RGB(0x14171c),
    RGB(0xe8e8e8),
    RGB(0x9aa0a8),
    RGB(0x2c3138),
    {RGB(0x4aa3df), RGB(0x2cc295), RGB(0xff7058), RGB(0xf2b32c), RGB(0xdf8fc0), RGB(0x8fd0f5)}};

const theme *lobe_theme_of(lobe_figure_theme which) {
    return which == LOBE_FIGURE_DARK ? &dark : &light;
}

/* Between the stops of a map, evenly spaced. */
static colour between(const colour *stops, int count, double t) {
    const double at = fmin(fmax(t, 0), 1) * (count - 1);
    const int k = at < count - 2 ? (int)at : count - 2;
    const double s = at - k;
    const colour a = stops[k], b = stops[k + 1];
    return (colour){a.r + s * (b.r - a.r), a.g + s * (b.g - a.g), a.b + s * (b.b - a.b)};
}

colour lobe_map_sequential(double t) {
    static const colour stops[] = {RGB(0x101c40), RGB(0x1f4e79), RGB(0x2c8086),
                                   RGB(0x55ad72), RGB(0xb4cf58), RGB(0xfdee8a)};
    return between(stops, sizeof stops / sizeof stops[0], t);
}

colour lobe_map_diverging(double t) {
    static const colour stops[] = {RGB(0x123f7c), RGB(0x5f9fd0), RGB(0xf7f7f7), RGB(0xe58a6a),
                                   RGB(0x9c1a2c)};
    return between(stops, sizeof stops / sizeof stops[0], t);
}
