/* ssr/shaders/group.glsl: threads that run together. */
layout(local_size_x = 8, local_size_y = 8) in;
