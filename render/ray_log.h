/* The rays of a picture in the order in which they were traced, to trace them again without the renderer. */
#ifndef LOBE_RENDER_RAY_LOG_H
#define LOBE_RENDER_RAY_LOG_H

#include "lobe/render.h"
#include "trace.h"

typedef enum ray_kind { RAY_CAMERA, RAY_BOUNCE, RAY_SHADOW, RAY_KINDS } ray_kind;

typedef struct ray_log {
    logged_ray *rays;
    size_t count, room;
    size_t *units; /* where each unit of the schedule begins in `rays` */
    size_t unit_count, unit_room;
    uint64_t of_kind[RAY_KINDS];
    int out_of_memory; /* the log is not whole */
} ray_log;

void lobe_ray_log_begin_unit(ray_log *log);
void lobe_ray_log_add(ray_log *log, logged_ray ray, ray_kind kind);
void lobe_ray_log_free(ray_log *log);

/* Rays of a unit. */
size_t lobe_ray_log_unit(const ray_log *log, size_t unit, const logged_ray **rays);

/* Render with one thread, and note all rays. */
lobe_render_result lobe_render_logged(const lobe_scene *scene, lobe_render_options options,
                                      ray_log *log, lobe_render_statistics *statistics);

#endif
