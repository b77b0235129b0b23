/* tests/ssr/bits.c: fingerprints of all that the passes give, by every instruction set of this processor.
 *
 * For each way through the passes, one line with a hash of the results of three frames, the last of them broken; the
 * sets of this processor have to agree (status 1 if not). The frames are made without libm: another processor prints
 * the same lines if its bits are the same (tests/house/test_neon.sh). */
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <lobe/batch.h>
#include <lobe/random.h>
#include <lobe/ssr.h>

enum { WIDTH = 150, HEIGHT = 61, PIXELS = WIDTH * HEIGHT, TEXELS = 8 * 4 * 3 };

static struct pictures {
    float z[PIXELS], normal[3 * PIXELS], roughness[PIXELS], anisotropy[PIXELS], tangent[3 * PIXELS],
        f0[3 * PIXELS], motion[2 * PIXELS], motion_z[PIXELS], color[3 * PIXELS], light[3 * TEXELS];
    unsigned char mask[PIXELS];
} pictures;

static const lobe_ssr_camera camera = {{0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1},
                                       0.8f,      0.325f,    0.05f,     50};

/* In [0, 1). */
static float unit(uint64_t stream, uint64_t i) {
    return lobe_random_unit_f32(lobe_random(11, stream, i).word[0]);
}

static float signed_unit(uint64_t stream, uint64_t i) {
    return 2.0f * unit(stream, i) - 1.0f;
}

/* A floor at y = 0 and a wall at z = -6, of all roughnesses; what it shows moves. */
static void fill_room(void) {
    for (uint64_t i = 0; i < PIXELS; i++) {
        const float down =
            (2.0f * ((float)(i / WIDTH) + 0.5f) / HEIGHT - 1.0f) * camera.tan_y + 0.1f;
        const float floor_z = down > 0.0f ? 1.0f / down : 100.0f;
        const int is_floor = floor_z < 6.0f;
        pictures.z[i] = is_floor ? floor_z : 6.0f;
        pictures.roughness[i] = unit(1, i);
        pictures.anisotropy[i] = signed_unit(2, i);
        pictures.motion_z[i] = 0.1f * pictures.z[i] * signed_unit(3, i);
        pictures.mask[i] = unit(4, i) < 0.95f;
        for (uint64_t k = 0; k < 3; k++) {
            pictures.normal[3 * i + k] =
                (k == (is_floor ? 1 : 2) ? 1.0f : 0.0f) + 0.1f * signed_unit(5, 3 * i + k);
            pictures.tangent[3 * i + k] = signed_unit(6, 3 * i + k);
            pictures.f0[3 * i + k] = unit(7, 3 * i + k);
            pictures.color[3 * i + k] = unit(8, 3 * i + k);
        }
        for (uint64_t k = 0; k < 2; k++)
            pictures.motion[2 * i + k] = 0.02f * signed_unit(9, 2 * i + k);
    }
    for (uint64_t i = 0; i < 3 * TEXELS; i++) pictures.light[i] = unit(10, i);
}

/* One number in five is one that no frame should hold. */
static void spoil(float *values, uint64_t count, uint64_t stream) {
    static const float odd[] = {NAN, INFINITY, -INFINITY, 0.0f, -1.0f, 3e38f, 1e-42f, 1e9f};
    for (uint64_t i = 0; i < count; i++)
        if (unit(stream, 2 * i) < 0.2f) values[i] = odd[(int)(8.0f * unit(stream, 2 * i + 1))];
}

static void spoil_room(void) {
    spoil(pictures.z, PIXELS, 20);
    spoil(pictures.normal, 3 * PIXELS, 21);
    spoil(pictures.roughness, PIXELS, 22);
    spoil(pictures.anisotropy, PIXELS, 23);
    spoil(pictures.tangent, 3 * PIXELS, 24);
    spoil(pictures.f0, 3 * PIXELS, 25);
    spoil(pictures.motion, 2 * PIXELS, 26);
    spoil(pictures.motion_z, PIXELS, 27);
    spoil(pictures.color, 3 * PIXELS, 28);
}

static lobe_ssr_frame frame_of(int has_all) {
    lobe_ssr_frame f = {.z = pictures.z,
                        .normal = pictures.normal,
                        .roughness = pictures.roughness,
                        .previous_color = pictures.color,
                        .camera = camera,
                        .previous_camera = camera};
    f.previous_camera.eye.x += 0.02f;
    f.motion = pictures.motion;
    if (!has_all) return f;
    f.anisotropy = pictures.anisotropy;
    f.tangent = pictures.tangent;
    f.f0 = pictures.f0;
    f.motion_z = pictures.motion_z;
    f.mask = pictures.mask;
    f.environment = (lobe_ssr_environment){8, 4, 3, pictures.light};
    return f;
}

/* FNV-1a over words. */
static uint64_t mixed(uint64_t hash, const void *values, size_t bytes) {
    for (size_t at = 0; at < bytes; at += sizeof(uint32_t)) {
        uint32_t word;
        memcpy(&word, (const char *)values + at, sizeof word);
        hash = (hash ^ word) * UINT64_C(0x100000001b3);
    }
    return hash;
}

/* Of three frames; 0: failed. */
static uint64_t hash_of(lobe_ssr_options options, int has_all) {
    lobe_ssr *ssr = NULL;
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    if (lobe_ssr_create(WIDTH, HEIGHT, options, &ssr) != LOBE_SSR_OK) return 0;
    fill_room();
    for (int k = 0; k < 3; k++) {
        if (k == 2) spoil_room();
        const lobe_ssr_frame f = frame_of(has_all);
        if (lobe_ssr_run(ssr, &f, NULL) != LOBE_SSR_OK) return 0;
        hash = mixed(hash, lobe_ssr_rays(ssr), PIXELS * sizeof(lobe_ssr_ray));
        hash = mixed(hash, lobe_ssr_reflection(ssr), 4 * PIXELS * sizeof(float));
        hash = mixed(hash, lobe_ssr_composite(ssr), 3 * PIXELS * sizeof(float));
    }
    lobe_ssr_free(ssr);
    return hash;
}

enum { RESOLVES = LOBE_SSR_OWN + 1, WAYS = RESOLVES + 5 };

static lobe_ssr_options way_at(int way) {
    lobe_ssr_options o = lobe_ssr_default_options();
    o.fade_start = 0.2f;
    o.fade_end = 1.0f;
    o.threads = 1;
    o.resolve = way < RESOLVES ? (lobe_ssr_resolve)way : o.resolve;
    if (way == RESOLVES) o.mode = LOBE_SSR_MIRROR;
    if (way == RESOLVES + 1) o.mode = LOBE_SSR_NDF;
    o.as_hdrp = way == RESOLVES + 2;
    o.linear_march = way == RESOLVES + 3;
    if (way == RESOLVES + 4) o.method = LOBE_METHOD_HORIZON;
    return o;
}

int main(void) {
    int failed = 0;
    for (int way = 0; way < WAYS; way++) {
        uint64_t first = 0;
        for (int k = 0; lobe_isa_at(k); k++) {
            lobe_restrict_isa(lobe_isa_at(k));
            const uint64_t hash = hash_of(way_at(way), way % 2);
            if (k == 0) first = hash;
            if (hash == 0 || hash != first)
                fprintf(stderr, "bits: way %d: %s disagrees\n", way, lobe_isa_at(k));
            failed |= hash == 0 || hash != first;
        }
        printf("way %d %016" PRIx64 "\n", way, first);
    }
    return failed;
}
