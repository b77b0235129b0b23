/* bench/peers/peer.h: draws by the code of other projects, each compiled against a checkout that the user names. */
#ifndef LOBE_BENCH_PEERS_PEER_H
#define LOBE_BENCH_PEERS_PEER_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Where draws come from and go: arrays of `count` rows, one roughness pair for all. */
typedef struct peer_rows {
    size_t count;
    float alpha[2];
    const float *wi[3], *u[2];
    float *m[3], *pdf;
} peer_rows;

/* Each draws m for every row, and its density: of the normal, or of the direction that it reflects to (bounded). */
void peer_pbrt_ellipsoid(const peer_rows *rows);
void peer_bsdl_ellipsoid(const peer_rows *rows);
void peer_bsdl_bounded(const peer_rows *rows);
void peer_openpbr_caps(const peer_rows *rows);

#ifdef __cplusplus
}
#endif

#endif
