/* The passes on OpenGL: pictures are buffers, each bound to the number that the shaders know it by; a
 * frame's pictures go there, the passes run, the results come back. */
#include "../driver.h"

#include <stdio.h>
#include <stdlib.h>

#include "../message.h"
#include "context.h"
#include "driver_state.h"
#include "parameters.h"
#include "program.h"

/* ---- Buffers --------------------------------------------------------------------------------- */

/* Bytes of a pixel; of the rest see bytes_of. */
static const unsigned char pixel_bytes[BUFFER_COUNT] = {
    [BUFFER_Z] = 4,           [BUFFER_NORMAL] = 12,  [BUFFER_ROUGHNESS] = 4, [BUFFER_MASK] = 1,
    [BUFFER_ANISOTROPY] = 4,  [BUFFER_TANGENT] = 12, [BUFFER_DRAWN] = 16,    [BUFFER_MET] = 16,
    [BUFFER_MOTION] = 8,      [BUFFER_FOUND] = 16,   [BUFFER_RESOLVED] = 16, [BUFFER_HISTORY] = 16,
    [BUFFER_REFLECTION] = 16, [BUFFER_LAST_Z] = 4,   [BUFFER_F0] = 12,       [BUFFER_RADIANCE] = 12,
    [BUFFER_COMPOSITE] = 12,  [BUFFER_MOTION_Z] = 4};

enum { LEVEL_STRIDE = 256 }; /* at which parts of a buffer may begin, on any driver */

static size_t bytes_of(const lobe_ssr *s, const gl_state *g, int buffer) {
    if (buffer == BUFFER_PARAMETERS) return sizeof g->parameters;
    if (buffer == BUFFER_DEPTH) return 8 * lobe_ssr_gl_cells(&g->parameters);
    if (buffer == BUFFER_LEVEL) return (size_t)LEVEL_STRIDE * SSR_LEVELS_MAX;
    if (buffer == BUFFER_COLOR)
        return 12 * (s->options.resolve == LOBE_SSR_APPROX ? lobe_ssr_gl_cells(&g->parameters)
                                                           : ssr_pixels(s));
    const size_t bytes = pixel_bytes[buffer] * ssr_pixels(s);
    return (bytes + 15) / 16 * 16; /* the mask is read by words */
}

/* Buffers of a frame that may be left out are made when one first has them. */
static int is_optional(int buffer) {
    return buffer == BUFFER_MASK || buffer == BUFFER_ANISOTROPY || buffer == BUFFER_TANGENT ||
           buffer == BUFFER_MOTION || buffer == BUFFER_MOTION_Z || buffer == BUFFER_F0 ||
           buffer == BUFFER_ENVIRONMENT;
}

static lobe_ssr_result make_buffer(gl_state *g, int buffer, size_t bytes) {
    if (bytes > (size_t)g->largest_buffer)
        return lobe_ssr_fail(LOBE_SSR_FAILED,
                             "OpenGL: the driver's buffers hold %lld bytes, %zu are needed; use a "
                             "smaller --size, or the processor (--backend cpu)",
                             (long long)g->largest_buffer, bytes);
    glDeleteBuffers(1, &g->buffer[buffer]);
    glCreateBuffers(1, &g->buffer[buffer]);
    glNamedBufferStorage(g->buffer[buffer], (GLsizeiptr)bytes, NULL, GL_DYNAMIC_STORAGE_BIT);
    g->bytes[buffer] = bytes;
    return lobe_ssr_gl_check("buffers");
}

static lobe_ssr_result make_buffers(const lobe_ssr *s, gl_state *g) {
    lobe_ssr_result result = LOBE_SSR_OK;
    for (int k = 0; !result && k < BUFFER_COUNT; k++)
        result = make_buffer(g, k, is_optional(k) ? 16 : bytes_of(s, g, k));
    if (result) return result;
    for (GLint level = 0; level < SSR_LEVELS_MAX; level++)
        glNamedBufferSubData(g->buffer[BUFFER_LEVEL], (GLintptr)level * LEVEL_STRIDE, sizeof level,
                             &level);
    static const float nothing[4] = {0.0f};
    for (int k = BUFFER_FOUND; k <= BUFFER_LAST_Z; k++)
        glClearNamedBufferData(g->buffer[k], GL_R32F, GL_RED, GL_FLOAT, nothing);
    return lobe_ssr_gl_check("buffers");
}

static void bind_buffers(const gl_state *g) {
    for (int k = 0; k < BUFFER_COUNT; k++)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)k, g->buffer[k]);
}

/* ---- Pictures of a frame --------------------------------------------------------------------- */

static lobe_ssr_result send(gl_state *g, int buffer, const void *data, size_t bytes) {
    if (!data) return LOBE_SSR_OK;
    if (g->bytes[buffer] < bytes) {
        const lobe_ssr_result result = make_buffer(g, buffer, (bytes + 15) / 16 * 16);
        if (result) return result;
    }
    glNamedBufferSubData(g->buffer[buffer], 0, (GLsizeiptr)bytes, data);
    return LOBE_SSR_OK;
}

static lobe_ssr_result send_frame(const lobe_ssr *s, gl_state *g, const lobe_ssr_frame *f) {
    const lobe_ssr_environment *e = &f->environment;
    const size_t texels = (size_t)g->parameters.environment_width *
                          (size_t)g->parameters.environment_height *
                          (size_t)g->parameters.environment_levels;
    const struct {
        int buffer;
        const void *data;
        size_t bytes;
    } parts[] = {
        {BUFFER_PARAMETERS, &g->parameters, sizeof g->parameters},
        {BUFFER_Z, f->z, 4 * ssr_pixels(s)},
        {BUFFER_NORMAL, f->normal, 12 * ssr_pixels(s)},
        {BUFFER_ROUGHNESS, f->roughness, 4 * ssr_pixels(s)},
        {BUFFER_MASK, f->mask, ssr_pixels(s)},
        {BUFFER_ANISOTROPY, f->tangent ? f->anisotropy : NULL, 4 * ssr_pixels(s)},
        {BUFFER_TANGENT, f->anisotropy ? f->tangent : NULL, 12 * ssr_pixels(s)},
        {BUFFER_MOTION, f->motion, 8 * ssr_pixels(s)},
        {BUFFER_MOTION_Z, f->motion_z, 4 * ssr_pixels(s)},
        {BUFFER_COLOR, f->previous_color, 12 * ssr_pixels(s)},
        {BUFFER_F0, f->f0, 12 * ssr_pixels(s)},
        {BUFFER_ENVIRONMENT, e->rgb, 12 * texels},
    };
    lobe_ssr_result result = LOBE_SSR_OK;
    for (size_t k = 0; !result && k < sizeof parts / sizeof *parts; k++)
        result = send(g, parts[k].buffer, parts[k].data, parts[k].bytes);
    return result ? result : lobe_ssr_gl_check("pictures of a frame");
}

static void receive(const gl_state *g, int buffer, size_t bytes, void *to) {
    glGetNamedBufferSubData(g->buffer[buffer], 0, (GLsizeiptr)bytes, to);
}

static void count_ray(const lobe_ssr_ray *ray, lobe_ssr_statistics *st) {
    st->rays += ray->state != LOBE_SSR_NO_RAY;
    st->rejected += ray->state == LOBE_SSR_REJECTED;
    st->hits += ssr_meets(ray->state);
    st->steps += (uint64_t)ray->steps;
}

static void unpack_rays(lobe_ssr *s, const gl_state *g, lobe_ssr_statistics *st) {
    for (size_t i = 0; i < ssr_pixels(s); i++) {
        const ssr_drawn *drawn = &g->drawn[i];
        const ssr_met met = g->met[i];
        s->rays[i] = (lobe_ssr_ray){
            .direction = {drawn->direction.x, drawn->direction.y, drawn->direction.z},
            .pdf = drawn->pdf,
            .weight = met.weight,
            .length = met.reach,
            .x = ssr_met_x(met),
            .y = ssr_met_y(met),
            .state = ssr_met_state(met),
            .steps = ssr_met_steps(met)};
        count_ray(&s->rays[i], st);
    }
}

static lobe_ssr_result receive_results(lobe_ssr *s, const gl_state *g, lobe_ssr_statistics *st) {
    receive(g, BUFFER_DRAWN, 16 * ssr_pixels(s), g->drawn);
    receive(g, BUFFER_MET, 16 * ssr_pixels(s), g->met);
    receive(g, BUFFER_RESOLVED, 16 * ssr_pixels(s), s->resolved);
    receive(g, BUFFER_REFLECTION, 16 * ssr_pixels(s), s->reflection);
    receive(g, BUFFER_RADIANCE, 12 * ssr_pixels(s), s->radiance);
    receive(g, BUFFER_COMPOSITE, 12 * ssr_pixels(s), s->composite);
    const lobe_ssr_result result = lobe_ssr_gl_check("results");
    if (result == LOBE_SSR_OK) unpack_rays(s, g, st);
    return result;
}

/* ---- Passes ---------------------------------------------------------------------------------- */

enum { GROUP = 8 }; /* threads a side */

static void dispatch(const gl_state *g, int program, int width, int height) {
    glUseProgram(g->program[program]);
    glDispatchCompute((GLuint)(width + GROUP - 1) / GROUP, (GLuint)(height + GROUP - 1) / GROUP, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

static void run_whole(const gl_state *g, int program) {
    dispatch(g, program, g->parameters.width, g->parameters.height);
}

static void run_pyramid(const lobe_ssr *s, const gl_state *g) {
    const ssr_parameters *p = &g->parameters;
    run_whole(g, PROGRAM_DEPTH);
    for (int level = 1; level < p->levels; level++) {
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, BUFFER_LEVEL, g->buffer[BUFFER_LEVEL],
                          (GLintptr)level * LEVEL_STRIDE, LEVEL_STRIDE);
        dispatch(g, PROGRAM_HALVE_DEPTH, p->level_width[level], p->level_height[level]);
        if (s->options.resolve == LOBE_SSR_APPROX)
            dispatch(g, PROGRAM_HALVE_COLOR, p->level_width[level], p->level_height[level]);
    }
}

/* What was the reflection is history now. */
static void swap_history(gl_state *g) {
    const GLuint swapped = g->buffer[BUFFER_HISTORY];
    g->buffer[BUFFER_HISTORY] = g->buffer[BUFFER_REFLECTION];
    g->buffer[BUFFER_REFLECTION] = swapped;
    bind_buffers(g);
}

static void run_pass(const lobe_ssr *s, gl_state *g, lobe_ssr_pass pass) {
    switch (pass) {
    case LOBE_SSR_PASS_PYRAMID:
        run_pyramid(s, g);
        break;
    case LOBE_SSR_PASS_TRACE:
        run_whole(g, PROGRAM_TRACE);
        break;
    case LOBE_SSR_PASS_REPROJECT:
        run_whole(g, PROGRAM_REPROJECT);
        break;
    case LOBE_SSR_PASS_RESOLVE:
        run_whole(g, PROGRAM_RESOLVE);
        break;
    case LOBE_SSR_PASS_ACCUMULATE:
        swap_history(g);
        run_whole(g, PROGRAM_ACCUMULATE);
        run_whole(g, PROGRAM_KEEP_Z);
        break;
    case LOBE_SSR_PASS_COMPOSITE:
        run_whole(g, PROGRAM_COMPOSITE);
        break;
    case LOBE_SSR_PASS_COUNT:
        break;
    }
}

/* A GPU is asked for its own time, once all is done. A software renderer does its work within the calls and
 * tells no time of it. */
static void time_pass(lobe_ssr *s, gl_state *g, lobe_ssr_pass pass, lobe_ssr_statistics *st) {
    const double start = lobe_ssr_milliseconds();
    if (!g->context.is_software) glBeginQuery(GL_TIME_ELAPSED, g->query[pass]);
    run_pass(s, g, pass);
    if (!g->context.is_software) {
        glEndQuery(GL_TIME_ELAPSED);
        return;
    }
    glFinish();
    st->milliseconds[pass] = lobe_ssr_milliseconds() - start;
}

static void read_times(const gl_state *g, lobe_ssr_statistics *st) {
    for (int pass = 0; !g->context.is_software && pass < LOBE_SSR_PASS_COUNT; pass++) {
        GLuint64 nanoseconds = 0;
        glGetQueryObjectui64v(g->query[pass], GL_QUERY_RESULT, &nanoseconds);
        st->milliseconds[pass] = 1e-6 * (double)nanoseconds;
    }
}

static lobe_ssr_result run_passes(lobe_ssr *s, gl_state *g, const lobe_ssr_frame *f,
                                  lobe_ssr_statistics *st) {
    lobe_ssr_gl_set_frame(&g->parameters, s, f);
    lobe_ssr_result result = send_frame(s, g, f);
    if (result) return result;
    bind_buffers(g);
    for (int pass = 0; pass < LOBE_SSR_PASS_COUNT; pass++) time_pass(s, g, (lobe_ssr_pass)pass, st);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glFinish();
    result = lobe_ssr_gl_check("passes");
    if (result) return result;
    read_times(g, st);
    return receive_results(s, g, st);
}

static lobe_ssr_result run(lobe_ssr *s, const lobe_ssr_frame *f, lobe_ssr_statistics *st) {
    gl_state *g = s->driver_state;
    lobe_ssr_result result = lobe_ssr_gl_take(&g->context);
    if (result) return result;
    result = run_passes(s, g, f, st);
    lobe_ssr_gl_release(&g->context);
    return result;
}

/* ---- Opening --------------------------------------------------------------------------------- */

static const char *kernel_of(lobe_method method) {
    static const char *const kernels[LOBE_METHOD_COUNT] = {
        [LOBE_METHOD_NDF] = "ggx_ndf",
        [LOBE_METHOD_SLOPE_PUBLISHED] = "ggx_slope_published",
        [LOBE_METHOD_SLOPE] = "ggx_slope",
        [LOBE_METHOD_ELLIPSOID] = "ggx_ellipsoid",
        [LOBE_METHOD_CAPS] = "ggx_caps",
        [LOBE_METHOD_BOUNDED] = "ggx_bounded",
        [LOBE_METHOD_OPTIMAL] = "ggx_optimal",
        [LOBE_METHOD_HORIZON_MIRROR] = "ggx_horizon_mirror",
        [LOBE_METHOD_HORIZON_EXACT] = "ggx_horizon_exact",
        [LOBE_METHOD_HORIZON_UNIFORM] = "ggx_horizon_uniform",
        [LOBE_METHOD_HORIZON] = "ggx_horizon"};
    return kernels[method];
}

static lobe_ssr_result make_trace(const lobe_ssr *s, gl_state *g) {
    const lobe_ssr_options *o = &s->options;
    if (o->mode == LOBE_SSR_MIRROR)
        return lobe_ssr_gl_program(NULL, (const char *[]){"draw_mirror", "trace", NULL},
                                   &g->program[PROGRAM_TRACE]);
    const char *kernel = kernel_of(o->mode == LOBE_SSR_NDF ? LOBE_METHOD_NDF : o->method);
    char words[256];
    snprintf(words, sizeof words,
             "#define SSR_STATE %s\n#define SSR_PREPARE %s_prepare\n#define SSR_SAMPLE %s_draw\n",
             kernel, kernel, kernel);
    return lobe_ssr_gl_program(words, (const char *[]){kernel, "draw_lobe", "trace", NULL},
                               &g->program[PROGRAM_TRACE]);
}

static lobe_ssr_result make_programs(const lobe_ssr *s, gl_state *g) {
    static const char *const names[PROGRAM_COUNT] = {[PROGRAM_DEPTH] = "depth",
                                                     [PROGRAM_HALVE_DEPTH] = "halve_depth",
                                                     [PROGRAM_HALVE_COLOR] = "halve_color",
                                                     [PROGRAM_REPROJECT] = "reproject",
                                                     [PROGRAM_RESOLVE] = "resolve",
                                                     [PROGRAM_ACCUMULATE] = "accumulate",
                                                     [PROGRAM_KEEP_Z] = "keep_z",
                                                     [PROGRAM_COMPOSITE] = "composite"};
    lobe_ssr_result result = make_trace(s, g);
    for (int k = 0; !result && k < PROGRAM_COUNT; k++)
        if (names[k])
            result = lobe_ssr_gl_program(NULL, (const char *[]){names[k], NULL}, &g->program[k]);
    return result;
}

/* Every driver in use offers more than the 8 that the standard asks for; one that does not is told. */
static lobe_ssr_result check_limits(gl_state *g) {
    GLint blocks = 0, bindings = 0;
    glGetIntegerv(GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, &blocks);
    glGetIntegerv(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, &bindings);
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &g->largest_buffer);
    if (blocks >= 12 && bindings >= BUFFER_COUNT) return LOBE_SSR_OK;
    return lobe_ssr_fail(LOBE_SSR_FAILED,
                         "OpenGL: %s offers a shader %d buffers of %d, 12 of %d are needed; use "
                         "the processor (--backend cpu)",
                         g->context.renderer, blocks, bindings, BUFFER_COUNT);
}

static int make_memory(const lobe_ssr *s, gl_state *g) {
    g->drawn = malloc(ssr_pixels(s) * sizeof *g->drawn);
    g->met = malloc(ssr_pixels(s) * sizeof *g->met);
    return g->drawn && g->met;
}

static void drop(gl_state *g) {
    for (int k = 0; k < PROGRAM_COUNT; k++) glDeleteProgram(g->program[k]);
    glDeleteBuffers(BUFFER_COUNT, g->buffer);
    glDeleteQueries(LOBE_SSR_PASS_COUNT, g->query);
    lobe_ssr_gl_close(&g->context);
    free(g->drawn);
    free(g->met);
    free(g);
}

static lobe_ssr_result fill(const lobe_ssr *s, gl_state *g) {
    if (s->options.backend == LOBE_SSR_AUTO && g->context.is_software)
        return lobe_ssr_fail(LOBE_SSR_FAILED,
                             "OpenGL: %s is no GPU; use --backend gl to run it all the same",
                             g->context.renderer);
    g->parameters = lobe_ssr_gl_parameters(s);
    lobe_ssr_result result = check_limits(g);
    if (!result) result = make_buffers(s, g);
    if (!result) result = make_programs(s, g);
    if (!result && !make_memory(s, g)) result = lobe_ssr_fail_memory("reflections");
    glGenQueries(LOBE_SSR_PASS_COUNT, g->query);
    return result;
}

static lobe_ssr_result open_gl(lobe_ssr *s) {
    gl_state *g = calloc(1, sizeof *g);
    if (!g) return lobe_ssr_fail_memory("reflections");
    lobe_ssr_result result = lobe_ssr_gl_open(&g->context);
    if (result) {
        free(g);
        return result;
    }
    result = fill(s, g);
    if (result) {
        drop(g);
        return result;
    }
    lobe_ssr_gl_release(&g->context);
    s->driver_state = g;
    return LOBE_SSR_OK;
}

static void close_gl(lobe_ssr *s) {
    gl_state *g = s->driver_state;
    if (!g) return;
    /* without its context nothing can be given back but with the context itself */
    (void)lobe_ssr_gl_take(&g->context);
    drop(g);
    s->driver_state = NULL;
}

static const char *device(const lobe_ssr *s) {
    return ((const gl_state *)s->driver_state)->context.renderer;
}

const ssr_driver lobe_ssr_gl_driver = {LOBE_SSR_GL, open_gl, run, device, close_gl};
