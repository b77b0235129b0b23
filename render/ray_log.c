#include "ray_log.h"

#include <stdlib.h>

/* Room for one more element; 0: no memory. */
static int grow(void **array, size_t count, size_t *room, size_t size) {
    if (count < *room) return 1;
    const size_t larger = *room ? 2 * *room : 1024;
    void *moved = larger > SIZE_MAX / size ? NULL : realloc(*array, larger * size);
    if (!moved) return 0;
    *array = moved;
    *room = larger;
    return 1;
}

void lobe_ray_log_begin_unit(ray_log *log) {
    if (grow((void **)&log->units, log->unit_count, &log->unit_room, sizeof *log->units))
        log->units[log->unit_count++] = log->count;
    else
        log->out_of_memory = 1;
}

void lobe_ray_log_add(ray_log *log, logged_ray ray, ray_kind kind) {
    log->of_kind[kind]++;
    if (grow((void **)&log->rays, log->count, &log->room, sizeof *log->rays))
        log->rays[log->count++] = ray;
    else
        log->out_of_memory = 1;
}

void lobe_ray_log_free(ray_log *log) {
    free(log->rays);
    free(log->units);
    *log = (ray_log){0};
}

size_t lobe_ray_log_unit(const ray_log *log, size_t unit, const logged_ray **rays) {
    const size_t end = unit + 1 < log->unit_count ? log->units[unit + 1] : log->count;
    *rays = log->rays + log->units[unit];
    return end - log->units[unit];
}
