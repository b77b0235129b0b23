// bench/peers/pbrt.cpp: visible normals by pbrt-v4's TrowbridgeReitzDistribution (its headers alone).
#include <pbrt/util/check.h>

// It counts how often a check fails in pbrt's own statistics, which live in its library.
#undef CHECK_RARE
#define CHECK_RARE(frequency, condition)

#include <pbrt/util/scattering.h>

#include "peer.h"

void peer_pbrt_ellipsoid(const peer_rows *rows) {
    const pbrt::TrowbridgeReitzDistribution distribution(rows->alpha[0], rows->alpha[1]);
    for (size_t i = 0; i < rows->count; ++i) {
        const pbrt::Vector3f wi(rows->wi[0][i], rows->wi[1][i], rows->wi[2][i]);
        const pbrt::Vector3f m = distribution.Sample_wm(wi, {rows->u[0][i], rows->u[1][i]});
        rows->m[0][i] = m.x;
        rows->m[1][i] = m.y;
        rows->m[2][i] = m.z;
        rows->pdf[i] = distribution.PDF(wi, m);
    }
}
