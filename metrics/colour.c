#include "colour.h"

#include <math.h>

/* Linear sRGB to XYZ, white D65: exact fractions of the chromaticities of ITU-R BT.709. */
static const double xyz_of_rgb[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};

/* The inverse, to the digits of double. */
static const double rgb_of_xyz[3][3] = {
    {3.2410032329763583, -1.5373989694887853, -0.4986158819963628},
    {-0.9692242522025163, 1.8759299836951757, 0.0415542263400847},
    {0.0556394198519754, -0.2040112061239099, 1.0571489771875333}};

static double white(int i) {
    return xyz_of_rgb[i][0] + xyz_of_rgb[i][1] + xyz_of_rgb[i][2];
}

static colour multiply(const double m[3][3], colour c) {
    colour r;
    for (int i = 0; i < 3; i++)
        r.v[i] = (float)(m[i][0] * c.v[0] + m[i][1] * c.v[1] + m[i][2] * c.v[2]);
    return r;
}

static colour relative_xyz(colour rgb) {
    colour c = multiply(xyz_of_rgb, rgb);
    for (int i = 0; i < 3; i++) c.v[i] = (float)(c.v[i] / white(i));
    return c;
}

colour lobe_opponent_of_rgb(colour rgb) {
    const colour c = relative_xyz(rgb);
    return (colour){
        {116.0f * c.v[1] - 16.0f, 500.0f * (c.v[0] - c.v[1]), 200.0f * (c.v[1] - c.v[2])}};
}

colour lobe_rgb_of_opponent(colour opponent) {
    const float y = (opponent.v[0] + 16.0f) / 116.0f;
    const float relative[3] = {y + opponent.v[1] / 500.0f, y, y - opponent.v[2] / 200.0f};
    colour xyz;
    for (int i = 0; i < 3; i++) xyz.v[i] = (float)(relative[i] * white(i));
    return multiply(rgb_of_xyz, xyz);
}

/* The root of L*, straight where it would be too steep. */
static float lightness_root(float t) {
    const float corner = 6.0f / 29.0f;
    return t > corner * corner * corner ? cbrtf(t) : t / (3.0f * corner * corner) + 4.0f / 29.0f;
}

colour lobe_perceived_of_rgb(colour rgb) {
    const colour c = relative_xyz(rgb);
    const float x = lightness_root(c.v[0]), y = lightness_root(c.v[1]), z = lightness_root(c.v[2]);
    const float lightness = 116.0f * y - 16.0f, hunt = 0.01f * lightness;
    return (colour){{lightness, hunt * 500.0f * (x - y), hunt * 200.0f * (y - z)}};
}

float lobe_colour_distance(colour a, colour b) {
    return fabsf(a.v[0] - b.v[0]) + hypotf(a.v[1] - b.v[1], a.v[2] - b.v[2]);
}
