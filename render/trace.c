#include "trace.h"

#include <stdlib.h>
#include <string.h>

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
    struct RTCRay ray;
    memset(&ray, 0, sizeof ray);
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = distance;
    ray.mask = ~0u;
    return ray;
}

int lobe_tracer_nearest(const tracer *t, vec3 origin, vec3 direction, float from, float to,
                        ray_hit *hit) {
    struct RTCRayHit query;
    memset(&query, 0, sizeof query);
    query.ray = ray_of(origin, direction, to);
    query.ray.tnear = from;
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
