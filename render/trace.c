#include "trace.h"

#include <stdatomic.h>
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
    RTCScene *shapes;
    uint32_t shape_count;
    uint32_t world; /* the first triangle that lies in the world */
    const shape *ranges;
    const instance *instances;
    atomic_llong bytes, most_bytes;
};

/* ---- Building ---------------------------------------------------------------------------------- */

/* Of all trees: what is done, and what the one in work is of the whole. */
typedef struct builder {
    const tracer_scene *from;
    tracer *t;
    double done, share, whole;
    atomic_flag is_told;
} builder;

static int is_cancelled(const builder *b) {
    return b->from->cancel && *b->from->cancel;
}

/* Embree calls from any of its threads: one of them speaks at a time. */
static bool tell(void *user, double fraction) {
    builder *b = user;
    if (b->from->progress && !atomic_flag_test_and_set(&b->is_told)) {
        b->from->progress(b->from->progress_user, (b->done + fraction * b->share) / b->whole);
        atomic_flag_clear(&b->is_told);
    }
    return !is_cancelled(b);
}

static bool count_bytes(void *user, ssize_t bytes, bool is_after) {
    (void)is_after;
    tracer *t = user;
    const long long now = atomic_fetch_add(&t->bytes, (long long)bytes) + (long long)bytes;
    long long most = atomic_load(&t->most_bytes);
    while (now > most && !atomic_compare_exchange_weak(&t->most_bytes, &most, now)) {
    }
    return true;
}

static RTCScene begin_scene(const builder *b) {
    RTCScene scene = rtcNewScene(b->t->device);
    if (scene) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
}

static void commit(builder *b, RTCScene scene, double share) {
    b->share = share;
    rtcSetSceneProgressMonitorFunction(scene, tell, b);
    if (!is_cancelled(b)) rtcCommitScene(scene);
    rtcSetSceneProgressMonitorFunction(scene, NULL, NULL);
    b->done += share;
    b->share = 0.0;
    tell(b, 0.0);
}

static void add_triangles(const builder *b, RTCScene scene, uint32_t first, uint32_t count) {
    const tracer_scene *from = b->from;
    if (count == 0) return;
    RTCGeometry geometry = rtcNewGeometry(b->t->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               from->vertices, 0, from->vertex_stride, from->vertex_count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, from->indices,
                               (size_t)first * from->index_stride, from->index_stride, count);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
}

static void add_instance(const builder *b, uint32_t index) {
    const instance *i = &b->from->instances[index];
    RTCGeometry geometry = rtcNewGeometry(b->t->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, b->t->shapes[i->shape]);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, i->to_world);
    rtcCommitGeometry(geometry);
    /* the numbers of instances are theirs, that of the world comes after them */
    rtcAttachGeometryByID(b->t->scene, geometry, index);
    rtcReleaseGeometry(geometry);
}

static void build_shapes(builder *b) {
    tracer *t = b->t;
    for (uint32_t i = 0; i < b->from->shape_count; i++) {
        const shape *s = &b->from->shapes[i];
        t->shapes[i] = begin_scene(b);
        if (!t->shapes[i]) return;
        t->shape_count++;
        add_triangles(b, t->shapes[i], s->first, s->count);
        commit(b, t->shapes[i], (double)s->count);
    }
}

static void build(builder *b) {
    tracer *t = b->t;
    const tracer_scene *from = b->from;
    const uint32_t placed = from->triangle_count - t->world;
    b->whole = (double)from->triangle_count + (double)from->instance_count;
    build_shapes(b);
    if (t->shape_count < from->shape_count || is_cancelled(b)) return;
    for (uint32_t i = 0; i < from->instance_count; i++) add_instance(b, i);
    add_triangles(b, t->scene, t->world, placed);
    commit(b, t->scene, (double)placed + (double)from->instance_count);
}

tracer *lobe_tracer_create(const tracer_scene *from) {
    tracer *t = calloc(1, sizeof *t);
    if (!t) return NULL;
    builder b = {.from = from, .t = t, .is_told = ATOMIC_FLAG_INIT};
    t->ranges = from->shapes;
    t->instances = from->instances;
    if (from->shape_count > 0) {
        const shape *last = &from->shapes[from->shape_count - 1];
        t->world = last->first + last->count;
    }
    t->shapes = calloc((size_t)from->shape_count + 1, sizeof(RTCScene));
    t->device = t->shapes ? rtcNewDevice(NULL) : NULL;
    if (t->device) rtcSetDeviceMemoryMonitorFunction(t->device, count_bytes, t);
    t->scene = t->device ? begin_scene(&b) : NULL;
    if (t->scene) build(&b);
    if (!t->scene || is_cancelled(&b) || rtcGetDeviceError(t->device) != RTC_ERROR_NONE) {
        lobe_tracer_free(t);
        return NULL;
    }
    return t;
}

uint64_t lobe_tracer_bytes(const tracer *t, uint64_t *most) {
    const long long bytes = atomic_load(&t->bytes);
    *most = (uint64_t)atomic_load(&t->most_bytes);
    return bytes > 0 ? (uint64_t)bytes : 0;
}

void lobe_tracer_free(tracer *t) {
    if (!t) return;
    if (t->scene) rtcReleaseScene(t->scene);
    for (uint32_t i = 0; i < t->shape_count; i++) rtcReleaseScene(t->shapes[i]);
    if (t->device) rtcReleaseDevice(t->device);
    free(t->shapes);
    free(t);
}

/* ---- Rays -------------------------------------------------------------------------------------- */

/* Embree loads four numbers of a ray at once. Had they been stored one by one, the load would wait until all of them
 * are in the cache. */
typedef float four __attribute__((vector_size(16)));

static void fill(struct RTCRay *ray, vec3 origin, float from, vec3 direction, float to) {
    const four start = {origin.x, origin.y, origin.z, from};
    const four way = {direction.x, direction.y, direction.z, 0.0f};
    memcpy(&ray->org_x, &start, sizeof start);
    memcpy(&ray->dir_x, &way, sizeof way);
    ray->tfar = to;
    ray->mask = ~0u;
    ray->id = 0;
    ray->flags = 0;
}

int lobe_tracer_nearest(const tracer *t, vec3 origin, vec3 direction, float from, float to,
                        ray_hit *hit) {
    struct RTCRayHit query; /* Embree writes the hit where there is one */
    fill(&query.ray, origin, from, direction, to);
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    INTERSECT(t->scene, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return 0;
    /* Embree's "none" is NO_INSTANCE */
    const uint32_t instance = query.hit.instID[0];
    const uint32_t first =
        instance == NO_INSTANCE ? t->world : t->ranges[t->instances[instance].shape].first;
    hit->triangle = first + query.hit.primID;
    hit->instance = instance;
    hit->distance = query.ray.tfar;
    hit->u = query.hit.u;
    hit->v = query.hit.v;
    return 1;
}

int lobe_tracer_blocked(const tracer *t, vec3 origin, vec3 direction, float distance) {
    struct RTCRay ray;
    fill(&ray, origin, 0.0f, direction, distance);
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
