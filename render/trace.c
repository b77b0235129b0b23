#include "trace.h"

#include <stdlib.h>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define INTERSECT(scene, rayhit) rtcIntersect1(scene, rayhit, NULL)
#define OCCLUDED(scene, ray) rtcOccluded1(scene, ray, NULL)
#else
#include <embree3/rtcore.h>
#define INTERSECT(scene, rayhit)                                                                   \
    do {                                                                                           \
        struct RTCIntersectContext context;                                                        \
        rtcInitIntersectContext(&context);                                                         \
        rtcIntersect1(scene, &context, rayhit);                                                    \
    } while (0)
#define OCCLUDED(scene, ray)                                                                       \
    do {                                                                                           \
        struct RTCIntersectContext context;                                                        \
        rtcInitIntersectContext(&context);                                                         \
        rtcOccluded1(scene, &context, ray);                                                        \
    } while (0)
#endif

struct tracer {
    RTCDevice device;
    RTCScene scene;
};

static void build(tracer *t, const void *vertices, uint32_t vertex_count, uint32_t vertex_stride,
                  const void *indices, uint32_t triangle_count, uint32_t index_stride) {
    RTCGeometry geometry = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0,
                               vertex_stride, vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices, 0,
                               index_stride, triangle_count);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(t->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(t->scene);
}

tracer *lobe_tracer_create(const void *vertices, uint32_t vertex_count, uint32_t vertex_stride,
                           const void *indices, uint32_t triangle_count, uint32_t index_stride) {
    tracer *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    t->device = rtcNewDevice(NULL);
    t->scene = t->device ? rtcNewScene(t->device) : NULL;
    if (t->scene) {
        rtcSetSceneFlags(t->scene, RTC_SCENE_FLAG_ROBUST);
        build(t, vertices, vertex_count, vertex_stride, indices, triangle_count, index_stride);
    }
    if (!t->scene || rtcGetDeviceError(t->device) != RTC_ERROR_NONE) {
        lobe_tracer_free(t);
        return NULL;
    }
    return t;
}

void lobe_tracer_free(tracer *t) {
    if (!t) return;
    if (t->scene) rtcReleaseScene(t->scene);
    if (t->device) rtcReleaseDevice(t->device);
    free(t);
}

static struct RTCRay ray_of(vec3 origin, vec3 direction, float distance) {
    return (struct RTCRay){.org_x = origin.x,
                           .org_y = origin.y,
                           .org_z = origin.z,
                           .dir_x = direction.x,
                           .dir_y = direction.y,
                           .dir_z = direction.z,
                           .tfar = distance,
                           .mask = ~0u};
}

int lobe_tracer_nearest(const tracer *t, vec3 origin, vec3 direction, float from, float to,
                        ray_hit *hit) {
    struct RTCRayHit query; /* Embree writes the hit where there is one */
    query.ray = ray_of(origin, direction, to);
    query.ray.tnear = from;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    INTERSECT(t->scene, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return 0;
    *hit = (ray_hit){query.hit.primID, query.ray.tfar, query.hit.u, query.hit.v};
    return 1;
}

int lobe_tracer_blocked(const tracer *t, vec3 origin, vec3 direction, float distance) {
    struct RTCRay ray = ray_of(origin, direction, distance);
    OCCLUDED(t->scene, &ray);
    return ray.tfar < 0.0f;
}

uint64_t lobe_tracer_replay(const tracer *t, const logged_ray *rays, size_t count) {
    uint64_t met = 0;
    for (size_t i = 0; i < count; i++) {
        const logged_ray *r = &rays[i];
        if (r->to < 0.0f) {
            met += (uint64_t)lobe_tracer_blocked(t, r->origin, r->direction, -r->to);
        } else {
            ray_hit hit;
            met += (uint64_t)lobe_tracer_nearest(t, r->origin, r->direction, r->from, r->to, &hit);
        }
    }
    return met;
}
