/* What the OpenGL driver keeps of a handle. */
#ifndef LOBE_SSR_GL_DRIVER_STATE_H
#define LOBE_SSR_GL_DRIVER_STATE_H

#include "../pipeline.h"
#include "context.h"

/* By the numbers that the shaders bind. */
typedef enum gl_buffer {
    BUFFER_PARAMETERS,
    BUFFER_Z,
    BUFFER_NORMAL,
    BUFFER_ROUGHNESS,
    BUFFER_MASK,
    BUFFER_ANISOTROPY,
    BUFFER_TANGENT,
    BUFFER_DEPTH,
    BUFFER_DRAWN,
    BUFFER_MET,
    BUFFER_MOTION,
    BUFFER_COLOR,
    BUFFER_FOUND,
    BUFFER_RESOLVED,
    BUFFER_HISTORY,
    BUFFER_REFLECTION,
    BUFFER_LAST_Z,
    BUFFER_F0,
    BUFFER_ENVIRONMENT,
    BUFFER_RADIANCE,
    BUFFER_COMPOSITE,
    BUFFER_LEVEL,
    BUFFER_MOTION_Z,
    BUFFER_COUNT
} gl_buffer;

typedef enum gl_program {
    PROGRAM_DEPTH,
    PROGRAM_HALVE_DEPTH,
    PROGRAM_HALVE_COLOR,
    PROGRAM_TRACE,
    PROGRAM_REPROJECT,
    PROGRAM_RESOLVE,
    PROGRAM_ACCUMULATE,
    PROGRAM_KEEP_Z,
    PROGRAM_COMPOSITE,
    PROGRAM_COUNT
} gl_program;

typedef struct gl_state {
    gl_context context;
    GLint64 largest_buffer;
    GLuint buffer[BUFFER_COUNT], program[PROGRAM_COUNT], query[LOBE_SSR_PASS_COUNT];
    size_t bytes[BUFFER_COUNT];
    ssr_parameters parameters;
    ssr_drawn *drawn; /* as they come back */
    ssr_met *met;
} gl_state;

#endif
