/* ssr/shaders/common.glsl: what every pass on a GPU begins with: the text of the passes, the pictures by
 * their bindings, and how they are read. */
#include "kernel/bind/glsl.h"
#include "ssr/passes/bind_shader.h"

#include "ssr/passes/accumulate.h"
#include "ssr/passes/composite.h"
#include "ssr/passes/parameters.h"
#include "ssr/passes/pyramid.h"
#include "ssr/passes/ray.h"
#include "ssr/passes/resolve.h"
#include "ssr/passes/trace.h"

#include "group.glsl"

layout(std430, binding = 0) readonly buffer parameter_block {
    ssr_parameters p;
};

/* The pixel of this thread. */
kint own_x() {
    return kint(gl_GlobalInvocationID.x);
}

kint own_y() {
    return kint(gl_GlobalInvocationID.y);
}

bool is_outside(kint width, kint height) {
    return own_x() >= width || own_y() >= height;
}

kint pixel_at(kint x, kint y) {
    return y * p.width + x;
}
