/* Draws of one sampler, of any family: the least that shows how its file is used, and what its results on a GPU
 * are tested with. Before it: the kernel, and its names: SAMPLE_BASE and SAMPLE_BASE_OF, SAMPLE_PAIR_OF_WO and
 * SAMPLE_EVAL of its family, SAMPLE_STATE, SAMPLE_PREPARE, SAMPLE_DRAW and SAMPLE_PDF. */
struct sample_input {
    float wi[3];
    float alpha[2];
    float u[3];
};

struct sample_output {
    float wo[3];
    float pdf;    /* of the draw; 0: rejected, black */
    float weight; /* value times cosine, over the density */
    float again;  /* the density at that wo, by itself */
    float value;  /* value times cosine, by itself */
    float pad;
};

#include "group.glsl"

layout(std430, binding = 0) readonly buffer input_block {
    sample_input inputs[];
};
layout(std430, binding = 1) writeonly buffer output_block {
    sample_output outputs[];
};

void main() {
    uint i = 64 * gl_WorkGroupID.x + gl_LocalInvocationIndex;
    if (i >= uint(inputs.length())) return;
    sample_input n = inputs[i];
    v3 wi = v3_of(n.wi[0], n.wi[1], n.wi[2]);
    facet_options options = facet_options_of(false, false);
    SAMPLE_BASE g = SAMPLE_BASE_OF(wi, n.alpha[0], n.alpha[1], options);
    SAMPLE_STATE s = SAMPLE_PREPARE(g);
    facet_draw d = facet_draw_of(SAMPLE_DRAW(s, k_unit(n.u[0]), k_unit(n.u[1]), k_unit(n.u[2])), g.wi,
                                 g.plane, k_is(g.valid), k_is(g.mirror));
    facet_pair pair = SAMPLE_PAIR_OF_WO(g, d.wo);
    outputs[i].wo[0] = d.wo.x;
    outputs[i].wo[1] = d.wo.y;
    outputs[i].wo[2] = d.wo.z;
    outputs[i].pdf = d.pdf;
    outputs[i].weight = d.weight;
    outputs[i].again = k_select(pair.leaves, k_usable(SAMPLE_PDF(s, pair)), 0.0);
    outputs[i].value = SAMPLE_EVAL(g, pair).f_cos;
    outputs[i].pad = 0.0;
}
