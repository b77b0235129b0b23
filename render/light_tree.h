/* A tree of lights: which one is drawn depends on the place that it is to light (Conty Estevez and Kulla, "Importance Sampling
 * of Many Lights with Adaptive Tree Splitting", 2018, without their splitting). A node knows a box, a cone of
 * directions and the power of its lights; at a place it counts by an estimate of what they send there at most, and one of
 * two nodes is taken in proportion. What comes from infinitely far is drawn by power. */
#ifndef LOBE_RENDER_LIGHT_TREE_H
#define LOBE_RENDER_LIGHT_TREE_H

#include <stdint.h>

#include "vector.h"

/* What the tree knows of a light, and of all lights below a node. */
typedef struct light_bounds {
    vec3 low, high;
    vec3 axis;     /* unit */
    float spread;  /* greatest angle between the axis and a normal, 0 to pi */
    float beyond;  /* greatest angle of light with a normal, 0 to pi/2 */
    float power;   /* relative */
    int two_sided; /* some shine backward too */
} light_bounds;

typedef struct light_node {
    vec3 middle, axis;
    float radius;
    float cos_spread, sin_spread, cos_beyond;
    float power;
    int two_sided;
    uint32_t other;  /* the second child; the first one lies behind its parent. 0: a leaf */
    uint32_t parent; /* the root's is the root */
    uint32_t light;
} light_node;

typedef struct light_tree {
    light_node *nodes; /* NULL: no light has power */
    uint32_t *leaves;  /* of each light, LIGHT_NOWHERE: it is never drawn */
    uint32_t node_count;
} light_tree;

#define LIGHT_NOWHERE UINT32_MAX

/* 0: no memory. Lights without power are left out. */
int lobe_light_tree_create(light_tree *tree, const light_bounds *lights, uint32_t count);
void lobe_light_tree_free(light_tree *tree);

/* A light for a place with this normal, of either sign; 0: none, as light comes from all sides. `u`: in [0, 1). */
uint32_t lobe_light_tree_draw(const light_tree *tree, vec3 place, vec3 normal, double u,
                              float *probability);

/* The probability of drawing it. */
float lobe_light_tree_probability(const light_tree *tree, vec3 place, vec3 normal, uint32_t light);

#endif
