#include "light_tree.h"

#include <stdlib.h>
#include <string.h>

enum { BUCKETS = 12, DEPTH_BY_COST = 30 };

/* ---- Building -------------------------------------------------------------------------------- */

typedef struct entry {
    light_bounds bounds;
    vec3 middle;
    uint32_t light;
} entry;

static const light_bounds empty = {.low = {INFINITY, INFINITY, INFINITY},
                                   .high = {-INFINITY, -INFINITY, -INFINITY}};

static vec3 v3_least(vec3 a, vec3 b) {
    return v3(minf(a.x, b.x), minf(a.y, b.y), minf(a.z, b.z));
}

static vec3 v3_most(vec3 a, vec3 b) {
    return v3(maxf(a.x, b.x), maxf(a.y, b.y), maxf(a.z, b.z));
}

static float component(vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* The smallest cone around two, by turning the wider one toward the other. */
static void join_cones(light_bounds *a, const light_bounds *more) {
    light_bounds b = *more;
    if (a->two_sided && b.two_sided && v3_dot(a->axis, b.axis) < 0.0f) b.axis = v3_neg(b.axis);
    if (b.spread > a->spread) {
        const light_bounds other = *a;
        a->axis = b.axis;
        a->spread = b.spread;
        b.axis = other.axis;
        b.spread = other.spread;
    }
    const float cosine = clampf(v3_dot(a->axis, b.axis), -1.0f, 1.0f), between = acosf(cosine);
    if (between + b.spread <= a->spread) return;
    const float spread = 0.5f * (a->spread + between + b.spread);
    const vec3 aside =
        v3_normalize_or(v3_sub(b.axis, v3_scale(a->axis, cosine)), v3(0.0f, 0.0f, 0.0f));
    if (spread >= LOBE_PI || v3_dot(aside, aside) == 0.0f) {
        a->spread = LOBE_PI;
        return;
    }
    const float turn = spread - a->spread;
    a->axis = v3_normalize_or(v3_add(v3_scale(a->axis, cosf(turn)), v3_scale(aside, sinf(turn))),
                              a->axis);
    a->spread = spread;
}

static light_bounds join(light_bounds a, const light_bounds *b) {
    if (b->power == 0.0f) return a;
    if (a.power == 0.0f) return *b;
    join_cones(&a, b);
    a.low = v3_least(a.low, b->low);
    a.high = v3_most(a.high, b->high);
    a.beyond = maxf(a.beyond, b->beyond);
    a.power += b->power;
    a.two_sided |= b->two_sided;
    return a;
}

/* What a node is expected to cost: power, times the solid angle that it may light, times its size. Boxes without area still
 * have an extent. */
static float cost_of(const light_bounds *b) {
    if (b->power == 0.0f) return 0.0f;
    const vec3 d = v3_sub(b->high, b->low);
    const float all = minf(b->spread + b->beyond, LOBE_PI), s = b->spread;
    const float angle =
        2.0f * LOBE_PI * (1.0f - cosf(s)) +
        0.5f * LOBE_PI *
            (2.0f * all * sinf(s) - cosf(s - 2.0f * all) - 2.0f * s * sinf(s) + cosf(s));
    const float size = 2.0f * (d.x * d.y + d.y * d.z + d.z * d.x) + v3_dot(d, d);
    return b->power * angle * size;
}

static int bucket_of(const entry *e, int axis, float low, float high) {
    const float share = (component(e->middle, axis) - low) / (high - low);
    return (int)clampf(share * BUCKETS, 0.0f, BUCKETS - 1);
}

/* The cheapest plane between buckets of an axis: the first bucket behind it. */
static int find_plane(const entry *entries, uint32_t count, int axis, float low, float high,
                      float *least) {
    light_bounds buckets[BUCKETS], behind[BUCKETS];
    for (int i = 0; i < BUCKETS; i++) buckets[i] = empty;
    for (uint32_t i = 0; i < count; i++) {
        light_bounds *b = &buckets[bucket_of(&entries[i], axis, low, high)];
        *b = join(*b, &entries[i].bounds);
    }
    behind[BUCKETS - 1] = buckets[BUCKETS - 1];
    for (int i = BUCKETS - 2; i > 0; i--) behind[i] = join(buckets[i], &behind[i + 1]);
    int best = 0;
    light_bounds before = buckets[0];
    for (int i = 1; i < BUCKETS; i++) {
        const float cost = cost_of(&before) + cost_of(&behind[i]);
        if (before.power > 0.0f && behind[i].power > 0.0f && cost < *least) {
            *least = cost;
            best = i;
        }
        before = join(before, &buckets[i]);
    }
    return best;
}

/* Entries before the plane come first; how many there are. */
static uint32_t divide(entry *entries, uint32_t count, int axis, float low, float high, int plane) {
    uint32_t first = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (bucket_of(&entries[i], axis, low, high) >= plane) continue;
        const entry e = entries[first];
        entries[first++] = entries[i];
        entries[i] = e;
    }
    return first;
}

/* How many entries the first child gets. Where cost does not help, half of them. */
static uint32_t split(entry *entries, uint32_t count, int depth) {
    vec3 low = empty.low, high = empty.high;
    for (uint32_t i = 0; i < count; i++) {
        low = v3_least(low, entries[i].middle);
        high = v3_most(high, entries[i].middle);
    }
    const vec3 extent = v3_sub(high, low);
    const float longest = v3_max(extent);
    float least = INFINITY;
    int best_axis = 0, best = 0;
    for (int axis = 0; axis < 3 && depth < DEPTH_BY_COST; axis++) {
        if (!(component(extent, axis) > 1e-6f * longest)) continue;
        float cost = least * component(extent, axis) / longest; /* thin slices are dear */
        const float limit = cost;
        const int plane =
            find_plane(entries, count, axis, component(low, axis), component(high, axis), &cost);
        if (plane == 0 || !(cost < limit)) continue;
        least = cost * longest / component(extent, axis);
        best_axis = axis;
        best = plane;
    }
    if (best == 0) return count / 2;
    return divide(entries, count, best_axis, component(low, best_axis), component(high, best_axis),
                  best);
}

static void set_node(light_node *n, const light_bounds *b, uint32_t parent) {
    const vec3 half = v3_scale(v3_sub(b->high, b->low), 0.5f);
    /* wider by more than what the sums round */
    const float spread = minf(b->spread + 1e-3f, LOBE_PI);
    *n = (light_node){.middle = v3_add(b->low, half),
                      .axis = b->axis,
                      .radius = 1.0001f * v3_length(half),
                      .cos_spread = cosf(spread),
                      .sin_spread = sinf(spread),
                      .cos_beyond = cosf(b->beyond),
                      .power = b->power,
                      .two_sided = b->two_sided,
                      .parent = parent,
                      .light = LIGHT_NOWHERE};
}

static uint32_t build(light_tree *t, entry *entries, uint32_t count, uint32_t parent, int depth) {
    const uint32_t own = t->node_count++;
    light_bounds all = empty;
    for (uint32_t i = 0; i < count; i++) all = join(all, &entries[i].bounds);
    set_node(&t->nodes[own], &all, parent);
    if (count == 1) {
        t->nodes[own].light = entries->light;
        t->leaves[entries->light] = own;
        return own;
    }
    const uint32_t first = split(entries, count, depth);
    build(t, entries, first, own, depth + 1);
    t->nodes[own].other = build(t, entries + first, count - first, own, depth + 1);
    return own;
}

int lobe_light_tree_create(light_tree *t, const light_bounds *lights, uint32_t count) {
    *t = (light_tree){0};
    entry *entries = malloc(((size_t)count + 1) * sizeof *entries);
    t->leaves = malloc(((size_t)count + 1) * sizeof *t->leaves);
    uint32_t used = 0;
    for (uint32_t i = 0; i < count && entries && t->leaves; i++) {
        const light_bounds *b = &lights[i];
        t->leaves[i] = LIGHT_NOWHERE;
        if (b->power > 0.0f)
            entries[used++] = (entry){*b, v3_scale(v3_add(b->low, b->high), 0.5f), i};
    }
    if (used > 0) t->nodes = malloc((2 * (size_t)used - 1) * sizeof *t->nodes);
    if (t->nodes) build(t, entries, used, 0, 0);
    const int is_good = entries && t->leaves && (used == 0 || t->nodes);
    free(entries);
    if (!is_good) lobe_light_tree_free(t);
    return is_good;
}

void lobe_light_tree_free(light_tree *t) {
    free(t->nodes);
    free(t->leaves);
    *t = (light_tree){0};
}

/* ---- Drawing --------------------------------------------------------------------------------- */

/* An angle less another, not below 0. */
typedef struct angle {
    float cosine, sine;
} angle;

static angle less(angle a, angle b) {
    if (a.cosine >= b.cosine) return (angle){1.0f, 0.0f};
    return (angle){a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

static angle angle_of(float cosine) {
    const float c = minf(cosine, 1.0f);
    return (angle){c, sqrtf(maxf(1.0f - c * c, 0.0f))};
}

/* How much of the power may arrive, but for what is common to all nodes. A surface is never taken to be quite edge-on: what
 * it reflects need not go by the cosine. */
static float importance(const light_node *n, vec3 place, vec3 normal) {
    const vec3 to = v3_sub(n->middle, place);
    const float square = v3_dot(to, to), near = n->radius * n->radius;
    const float far = maxf(square, maxf(near, 1e-30f));
    if (square <= near) return n->power / far;
    const vec3 direction = v3_scale(to, 1.0f / sqrtf(square));
    const float sine2 = near / square;
    const angle width = {sqrtf(1.0f - sine2), sqrtf(sine2)};
    const float toward = -v3_dot(n->axis, direction);
    const angle off = angle_of(n->two_sided ? fabsf(toward) : maxf(toward, -1.0f));
    const angle spread = {n->cos_spread, n->sin_spread};
    const float sent = less(less(off, spread), width).cosine;
    if (sent <= n->cos_beyond) return 0.0f;
    float received = 1.0f;
    if (v3_dot(normal, normal) > 0.0f)
        received = maxf(less(angle_of(fabsf(v3_dot(normal, direction))), width).cosine, 0.1f);
    return n->power * maxf(sent, 0.0f) * received / far;
}

/* Probability of the first of two nodes. */
static float first_share(const light_node *a, const light_node *b, vec3 place, vec3 normal) {
    const float x = importance(a, place, normal), y = importance(b, place, normal);
    const float share = x / (x + y);
    return share >= 0.0f && share <= 1.0f ? share : a->power / (a->power + b->power);
}

uint32_t lobe_light_tree_draw(const light_tree *t, vec3 place, vec3 normal, double u,
                              float *probability) {
    const light_node *n = t->nodes;
    *probability = 1.0f;
    while (n->other) {
        const light_node *first = n + 1, *second = &t->nodes[n->other];
        const float share = first_share(first, second, place, normal);
        const double limit = (double)share;
        n = u < limit ? first : second;
        *probability *= u < limit ? share : 1.0f - share;
        u = u < limit ? u / limit : (u - limit) / (1.0 - limit);
    }
    return n->light;
}

float lobe_light_tree_probability(const light_tree *t, vec3 place, vec3 normal, uint32_t light) {
    if (t->leaves[light] == LIGHT_NOWHERE) return 0.0f;
    float probability = 1.0f;
    for (uint32_t i = t->leaves[light]; i != 0;) {
        const uint32_t parent = t->nodes[i].parent;
        const light_node *first = &t->nodes[parent + 1];
        const float share = first_share(first, &t->nodes[t->nodes[parent].other], place, normal);
        probability *= i == parent + 1 ? share : 1.0f - share;
        i = parent;
    }
    return probability;
}
