/* Places of surfaces that move: where the same one is in the scene of another moment. A triangle may vanish at a moment,
 * and with it the numbers of those after it change; its vertices stay. */
#ifndef LOBE_RENDER_PLACE_H
#define LOBE_RENDER_PLACE_H

#include "hit.h"
#include "lobe/rays.h"

static inline lobe_ray_place lobe_place_of(const lobe_scene *s, const ray_hit *hit) {
    const triangle *t = &s->triangles[hit->triangle];
    return (lobe_ray_place){
        {t->vertex[0], t->vertex[1], t->vertex[2]}, hit->instance, hit->u, hit->v};
}

/* Whether what is numbered is the same: scenes of one file at two moments. */
static inline int lobe_has_same_parts(const lobe_scene *a, const lobe_scene *b) {
    return a->vertex_count == b->vertex_count && a->shape_count == b->shape_count &&
           a->instance_count == b->instance_count;
}

/* Where it is in `s`, which has the parts of the scene that it is of. 0: not finite. */
static inline int lobe_find_place(const lobe_scene *s, const lobe_ray_place *place,
                                  vec3 *position) {
    const vertex *v = s->vertices;
    const vec3 own = hit_mean(v[place->corner[0]].position, v[place->corner[1]].position,
                              v[place->corner[2]].position, place->u, place->v);
    *position = place->instance == NO_INSTANCE
                    ? own
                    : lobe_instance_point(&s->instances[place->instance], own);
    return v3_is_finite(*position);
}

#endif
