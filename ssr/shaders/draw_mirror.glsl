/* ssr/shaders/draw_mirror.glsl: the ray of a mirror. */
#include "common.glsl"

facet_draw ssr_draw(ssr_surface surface, ssr_noise u) {
    return ssr_mirror_draw(surface.to_viewer);
}
