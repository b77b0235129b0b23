/* Single rays, for those who do not want a whole picture. */
#include "lobe/rays.h"

#include <stdlib.h>
#include <string.h>

#include "framing.h"
#include "integrator.h"
#include "place.h"

struct lobe_rays {
    integrator integrator;
    const coat_table **coats;
};

lobe_render_result lobe_rays_create(const lobe_scene *scene, lobe_rays **rays) {
    const lobe_render_options o = lobe_render_default_options();
    *rays = NULL;
    lobe_rays *r = calloc(1, sizeof *r);
    const coat_table **coats = r ? lobe_find_coats(scene, &o.reflection) : NULL;
    if (!coats) {
        free(r);
        return lobe_fail_memory(scene->name);
    }
    r->coats = coats;
    r->integrator = (integrator){scene,      {.ggx = o.reflection, .multiscatter = o.multiscatter},
                                 coats,      o.heuristic,
                                 o.depth,    o.roulette_depth,
                                 .log = NULL};
    *rays = r;
    return LOBE_RENDER_OK;
}

void lobe_rays_free(lobe_rays *rays) {
    if (!rays) return;
    free(rays->coats);
    free(rays);
}

int lobe_rays_meet(const lobe_rays *rays, lobe_vec3_f32 origin, lobe_vec3_f32 direction,
                   lobe_ray_surface *surface) {
    return lobe_first_surface(rays->integrator.scene, origin, direction, surface);
}

int lobe_rays_find(const lobe_rays *rays, const lobe_rays *from, const lobe_ray_place *place,
                   lobe_vec3_f32 *position) {
    return lobe_has_same_parts(rays->integrator.scene, from->integrator.scene) &&
           lobe_find_place(rays->integrator.scene, place, position);
}

lobe_vec3_f32 lobe_rays_light(const lobe_rays *rays, lobe_vec3_f32 origin, lobe_vec3_f32 direction,
                              uint64_t seed, uint64_t stream, uint32_t index, uint32_t samples) {
    sampler points = {.key = lobe_sampler_key(seed, (uint32_t)stream, (uint32_t)(stream >> 32)),
                      .index = index,
                      .index_bits = lobe_sampler_index_bits(samples)};
    uint64_t count = 0;
    const film_sample sample =
        lobe_trace_path(&rays->integrator, origin, direction, &points, &count);
    return v3_is_finite(sample.radiance) ? sample.radiance : v3_all(0.0f);
}

lobe_vec3_f32 lobe_rays_environment(const lobe_rays *rays, lobe_vec3_f32 direction) {
    const lobe_scene *s = rays->integrator.scene;
    return s->has_sky ? lobe_environment_at(&s->sky, direction) : v3_all(0.0f);
}

lobe_render_result lobe_scene_view(const lobe_scene *scene, const char *camera, float aspect,
                                   lobe_view *view) {
    uint32_t i = 0;
    while (camera && i < scene->camera_count && strcmp(scene->cameras[i].name, camera) != 0) i++;
    if (i == scene->camera_count)
        return lobe_fail(LOBE_RENDER_BAD_INPUT,
                         "%s: no camera named %s; without a name the first one is taken",
                         scene->name, camera ? camera : "");
    *view = (lobe_view){scene->cameras[i].position, scene->cameras[i].target, scene->cameras[i].up,
                        scene->cameras[i].vertical_degrees};
    if (scene->is_framed) view->vertical_degrees = lobe_framed_degrees(aspect);
    return LOBE_RENDER_OK;
}
