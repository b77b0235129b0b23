/* Angles in turns, without calls to libm: what a panorama needs of them. */
#ifndef LOBE_RENDER_CIRCLE_H
#define LOBE_RENDER_CIRCLE_H

#include "number.h"

/* Sine and cosine of an angle of -1 to 1 turns, each within 1.1e-7. The nearest quarter turn is taken off; what
 * is left goes through the polynomials of Moshier's Cephes (sinf.c). */
static inline void circle_at(float turns, float *sine, float *cosine) {
    const int quarter = (int)(4.0f * turns + (turns < 0.0f ? -0.5f : 0.5f));
    const float x = 2.0f * LOBE_PI * (turns - 0.25f * (float)quarter), z = x * x;
    const float s = x + x * z * (-1.6666654611e-1f + z * (8.3321608736e-3f - z * 1.9515295891e-4f));
    const float c =
        1.0f - 0.5f * z + z * z * (4.166664568e-2f + z * (-1.388731625e-3f + z * 2.443315711e-5f));
    const float a = quarter & 1 ? c : s, b = quarter & 1 ? s : c;
    *sine = quarter & 2 ? -a : a;
    *cosine = (quarter + 1) & 2 ? -b : b;
}

/* atan2(y, x) in turns, -1/2 to 1/2, within 5e-8; 0 at the origin. Arctangent of [0, 1]: Abramowitz and Stegun
 * 4.4.49. */
static inline float circle_turns(float y, float x) {
    const float ax = fabsf(x), ay = fabsf(y);
    const float low = ax < ay ? ax : ay, high = ax < ay ? ay : ax;
    const float t = high > 0.0f ? low / high : 0.0f, z = t * t;
    float a = 0.0028662257f;
    a = a * z - 0.0161657367f;
    a = a * z + 0.0429096138f;
    a = a * z - 0.0752896400f;
    a = a * z + 0.1065626393f;
    a = a * z - 0.1420889944f;
    a = a * z + 0.1999355085f;
    a = a * z - 0.3333314528f;
    a = (a * z + 1.0f) * t * (0.5f / LOBE_PI);
    a = ax < ay ? 0.25f - a : a;
    a = x < 0.0f ? 0.5f - a : a;
    return y < 0.0f ? -a : a;
}

#endif
