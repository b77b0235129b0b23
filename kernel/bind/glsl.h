/* kernel/bind/glsl.h: the kernel's words in GLSL 4.50 and GLSL ES 3.10, single precision. */
#ifndef K_BIND_GLSL_H
#define K_BIND_GLSL_H

#ifdef GL_ES
precision highp float;
precision highp int;
#endif

#define K_FLOAT_BITS(x) floatBitsToInt(x)
#define K_BITS_FLOAT(bits) intBitsToFloat(bits)

#include "shader.h"

#endif
