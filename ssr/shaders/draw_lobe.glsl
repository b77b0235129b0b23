/* ssr/shaders/draw_lobe.glsl: a ray by a sampler of Smith-GGX. Before it: the sampler's kernel, and
 * SSR_STATE, SSR_PREPARE and SSR_SAMPLE, its names. */
facet_draw ssr_draw(ssr_surface surface, ssr_noise u) {
    ggx_base g = ggx_base_of(surface.to_viewer, surface.alpha_x, surface.alpha_y,
                             facet_options_of(false, false));
    SSR_STATE s = SSR_PREPARE(g);
    facet_draw d = SSR_SAMPLE(s, k_unit(u.u1), k_unit(u.u2), k_unit(u.u3));
    return facet_draw_of(d, g.wi, g.plane, k_is(g.valid), k_is(g.mirror));
}
