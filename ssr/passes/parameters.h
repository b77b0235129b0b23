/* ssr/passes/parameters.h: all that a pass on a GPU is told besides the pictures. Numbers of 32 bits only: a
 * buffer of layout std430 holds them as C does. */
#ifndef LOBE_SSR_PARAMETERS_H
#define LOBE_SSR_PARAMETERS_H

#include "camera.h"
#include "noise.h"

#define SSR_PYRAMID_LEVELS 17 /* 32768 pixels down to one */

K_STRUCT(ssr_parameters) {
    ssr_camera now;
    ssr_camera last;
    ssr_noise_keys noise;
    kint width;
    kint height;
    kint levels;
    kint level_width[SSR_PYRAMID_LEVELS];
    kint level_height[SSR_PYRAMID_LEVELS];
    kint level_start[SSR_PYRAMID_LEVELS]; /* cells before it */
    kint highest_level;                   /* that the march may use */
    kint max_iterations;
    kint way; /* lobe_ssr_resolve */
    kint mirrors;
    kint biases_first; /* the bias is of the first random number */
    kint as_hdrp;
    kint reflects_sky;
    kint has_history;
    kint has_mask;
    kint has_motion;
    kint has_motion_z;
    kint has_f0;
    kint has_tangent;
    kint environment_width;
    kint environment_height;
    kint environment_levels; /* 0: black */
    real thickness;
    real edge_fade;
    real fade_start;
    real fade_end;
    real accumulation;
    real rejection;
    real bias;
};

#endif
