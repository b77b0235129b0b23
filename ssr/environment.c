/* Prefiltered light from everywhere, interpolated over directions and roughness. */
#include <math.h>

#include "pipeline.h"

static v3 texel_at(const lobe_ssr_environment *e, int level, int x, int y) {
    x = x < 0 ? x + e->width : x >= e->width ? x - e->width : x;
    y = y < 0 ? 0 : y >= e->height ? e->height - 1 : y;
    const size_t texel = ((size_t)level * (size_t)e->height + (size_t)y) * (size_t)e->width;
    const v3 light = ssr_v3(e->rgb + 3 * (texel + (size_t)x));
    return v3_of(k_usable(light.x), k_usable(light.y), k_usable(light.z));
}

static v3 lerp(v3 a, v3 b, float t) {
    return v3_add(v3_scale(a, 1.0f - t), v3_scale(b, t));
}

static v3 level_at(const lobe_ssr_environment *e, int level, v3 direction) {
    const float pi = 3.14159265358979f;
    const float u = 0.5f + atan2f(direction.z, direction.x) / (2.0f * pi);
    const float v = acosf(ssr_clamp(direction.y, -1.0f, 1.0f)) / pi;
    const float px = u * (float)e->width - 0.5f, py = v * (float)e->height - 0.5f;
    const int x = (int)floorf(px), y = (int)floorf(py);
    const float tx = px - floorf(px), ty = py - floorf(py);
    return lerp(lerp(texel_at(e, level, x, y), texel_at(e, level, x + 1, y), tx),
                lerp(texel_at(e, level, x, y + 1), texel_at(e, level, x + 1, y + 1), tx), ty);
}

v3 lobe_ssr_environment_at(const lobe_ssr_environment *e, v3 direction, float roughness) {
    if (!e->rgb) return v3_of(0.0f, 0.0f, 0.0f);
    const float level = k_saturate(roughness) * (float)(e->levels - 1);
    const int low = (int)level, high = low + 1 < e->levels ? low + 1 : low;
    return lerp(level_at(e, low, direction), level_at(e, high, direction), level - (float)low);
}
