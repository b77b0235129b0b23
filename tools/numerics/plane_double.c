/* tools/numerics/plane_double.c: see the header. */
#include "kernel/bind/c_f64.h"

#include "plane_double.h"

#include "kernel/ggx_horizon_plane_ellipse.h"
#include "kernel/ggx_horizon_plane_table.h"
#include "kernel/ggx_horizon_plane_uniform.h"

static v3 v3_from(const float x[3]) {
    return v3_of((real)x[0], (real)x[1], (real)x[2]);
}

static ggx_base base_of(const plane_input *input) {
    facet_options options = facet_options_of(false, false);
    options.plane = v3_from(input->plane);
    options.floor_share = (real)input->floor_share;
    return ggx_base_of(v3_from(input->wi), (real)input->alpha_x, (real)input->alpha_y, options);
}

plane_output plane_draw_double(plane_sampler sampler, const plane_input *input) {
    ggx_base g = base_of(input);
    real u1 = (real)input->u1, u2 = (real)input->u2, u3 = (real)input->u3;
    facet_draw d;
    if (sampler == PLANE_UNIFORM)
        d = ggx_horizon_plane_uniform_draw(ggx_horizon_plane_uniform_prepare(g), u1, u2, u3);
    else if (sampler == PLANE_TABLE)
        d = ggx_horizon_plane_table_draw(ggx_horizon_plane_table_prepare(g), u1, u2, u3);
    else
        d = ggx_horizon_plane_ellipse_draw(ggx_horizon_plane_ellipse_prepare(g), u1, u2, u3);
    return (plane_output){{d.m.x, d.m.y, d.m.z}, {d.wo.x, d.wo.y, d.wo.z}, d.pdf, d.weight};
}

double plane_pdf_double(plane_sampler sampler, const plane_input *input, const double m[3]) {
    ggx_base g = base_of(input);
    facet_pair pair = ggx_pair_of_m(g, v3_of(m[0], m[1], m[2]));
    if (sampler == PLANE_UNIFORM)
        return ggx_horizon_plane_uniform_pdf(ggx_horizon_plane_uniform_prepare(g), pair);
    return sampler == PLANE_TABLE
               ? ggx_horizon_plane_table_pdf(ggx_horizon_plane_table_prepare(g), pair)
               : ggx_horizon_plane_ellipse_pdf(ggx_horizon_plane_ellipse_prepare(g), pair);
}
