// bench/peers/openpbr.cpp: visible normals by Adobe's openpbr-bsdf, with GLM.
#include <glm/glm.hpp>

#include <openpbr.h>

#include "peer.h"

void peer_openpbr_caps(const peer_rows *rows) {
    const vec2 alpha(rows->alpha[0], rows->alpha[1]);
    for (size_t i = 0; i < rows->count; ++i) {
        const vec3 wi(rows->wi[0][i], rows->wi[1][i], rows->wi[2][i]);
        const vec2 u(rows->u[0][i], rows->u[1][i]);
        const vec3 m = openpbr_sample_aniso_ggx_smith_vndf(alpha, wi, u);
        rows->m[0][i] = m.x;
        rows->m[1][i] = m.y;
        rows->m[2][i] = m.z;
        rows->pdf[i] = openpbr_eval_aniso_smith_g1(wi, alpha) * openpbr_eval_aniso_ggx(m, alpha) *
                       glm::dot(wi, m) / wi.z;
    }
}
