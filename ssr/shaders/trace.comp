/* Trace: one ray a pixel. ssr_draw(surface, noise) draws its direction: the driver puts that before.
 * Agrees with the processor: 99.9 % of the rays end alike in the same
 * pixel; of these direction and weight to 2e-4, density to 5e-4, length to 1e-3. */
#include "surface.glsl"

layout(std430, binding = 7) readonly buffer depth_block {
    ssr_cell cells[];
};
layout(std430, binding = 8) writeonly buffer drawn_block {
    ssr_drawn drawn[];
};
layout(std430, binding = 9) writeonly buffer met_block {
    ssr_met met[];
};

/* Without the farthest depth nothing is known of what lies behind. */
ssr_cell cell_at(kint level, kint x, kint y) {
    kint inside_x = ssr_inside(x, p.level_width[level]);
    kint inside_y = ssr_inside(y, p.level_height[level]);
    ssr_cell cell = cells[p.level_start[level] + inside_y * p.level_width[level] + inside_x];
    if (k_is(p.as_hdrp) && level > 0) cell.farthest = 0.0;
    return cell;
}

ssr_met march(ssr_ray r, ssr_met start) {
    ssr_slab slab = ssr_slab_of(p.now, p.thickness);
    ssr_march m = ssr_march_start(r);
    kint x = 0;
    kint y = 0;
    kint steps = 0;
    while (m.state == SSR_MARCH_GOES && steps < p.max_iterations) {
        x = ssr_march_x(r, m);
        y = ssr_march_y(r, m);
        ssr_cell cell = cell_at(m.level, x, y);
        m = ssr_march_step(r, m, slab, x, y, cell.nearest, cell.farthest, p.highest_level);
        ++steps;
    }
    bool sees_sky = false;
    if (k_is(p.reflects_sky) && ssr_leaves_far(r, m)) {
        m = ssr_march_at_end(r, m);
        x = ssr_march_x(r, m);
        y = ssr_march_y(r, m);
        sees_sky = cell_at(0, x, y).nearest == 0.0;
    }
    kint state = ssr_state_of(m, sees_sky);
    ssr_met end = start;
    end.outcome = ssr_outcome(state, steps);
    if (!ssr_meets(state)) return end;
    return ssr_met_at(end, ssr_inside(x, p.width), ssr_inside(y, p.height),
                      ssr_march_length(r, m));
}

void main() {
    if (is_outside(p.width, p.height)) return;
    kint x = own_x();
    kint y = own_y();
    kint pixel = pixel_at(x, y);
    drawn[pixel] = ssr_nothing_drawn();
    met[pixel] = ssr_met_of(0.0, SSR_NO_RAY);
    real roughness = roughness_of_pixel[pixel];
    if (is_masked(pixel) || !(ssr_roughness_fade(roughness, p.fade_start, p.fade_end) > 0.0)) return;
    ssr_surface surface = surface_at(x, y);
    if (!k_is(surface.seen)) return;
    ssr_noise u = ssr_noise_of(p.noise, k_word(x), k_word(y));
    facet_draw draw = ssr_draw(surface, ssr_biased(u, p.bias, k_is(p.biases_first)));
    ssr_drawn d;
    d.direction = ssr_to_world(surface, draw.wo);
    d.pdf = draw.pdf;
    drawn[pixel] = d;
    met[pixel] = ssr_met_of(draw.weight, SSR_REJECTED);
    if (!ssr_is_kept(draw)) return;
    ssr_ray r = ssr_ray_of(p.now, float(x) + 0.5, float(y) + 0.5,
                           ssr_start_z(surface, z_at(pixel)), d.direction);
    met[pixel] = march(r, ssr_met_of(draw.weight, SSR_MISS));
}
