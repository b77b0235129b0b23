// bench/peers/bsdl.cpp: visible and bounded visible normals by GGXDist of OSL's libbsdl (its headers alone).
#include <algorithm>
#include <cmath>
#include <cstdint>

// The tables of energy are made by its build; draws do not need them.
#define BAKE_BSDL_TABLES 1
#define BSDL_UNROLL()

#include <BSDL/config.h>
using BSDLConfig = bsdl::BSDLDefaultConfig;

#include <BSDL/tools.h>

#include <BSDL/bsdf_decl.h>
#include <BSDL/microfacet_tools_impl.h>

#include "peer.h"

namespace {

// Its parameters are a perceptual roughness and an anisotropy.
bsdl::GGXDist distribution_of(const float alpha[2]) {
    const float mean = 0.5f * (alpha[0] + alpha[1]);
    return bsdl::GGXDist(std::sqrt(mean), std::abs(alpha[0] - alpha[1]) / (alpha[0] + alpha[1]),
                         alpha[1] > alpha[0]);
}

Imath::V3f direction(const float *const v[3], size_t i) {
    return {v[0][i], v[1][i], v[2][i]};
}

void store(const peer_rows *rows, size_t i, const Imath::V3f &m, float pdf) {
    rows->m[0][i] = m.x;
    rows->m[1][i] = m.y;
    rows->m[2][i] = m.z;
    rows->pdf[i] = pdf;
}

} // namespace

void peer_bsdl_ellipsoid(const peer_rows *rows) {
    const bsdl::GGXDist distribution = distribution_of(rows->alpha);
    for (size_t i = 0; i < rows->count; ++i) {
        const Imath::V3f wi = direction(rows->wi, i);
        const Imath::V3f m = distribution.sample(wi, rows->u[0][i], rows->u[1][i]);
        store(rows, i, m, distribution.G1(wi) * distribution.D(m) * wi.dot(m) / wi.z);
    }
}

void peer_bsdl_bounded(const peer_rows *rows) {
    const bsdl::GGXDist distribution = distribution_of(rows->alpha);
    for (size_t i = 0; i < rows->count; ++i) {
        const Imath::V3f wi = direction(rows->wi, i);
        const Imath::V3f m = distribution.sample_for_refl(wi, rows->u[0][i], rows->u[1][i]);
        store(rows, i, m, distribution.D_refl_D(wi, m) * distribution.D(m) / (4 * wi.z));
    }
}
