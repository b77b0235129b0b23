/* kernel/bind/hlsl.h: the kernel's words in HLSL, single precision. */
#ifndef K_BIND_HLSL_H
#define K_BIND_HLSL_H

#define K_FLOAT_BITS(x) asint(x)
#define K_BITS_FLOAT(bits) asfloat(bits)

#include "shader.h"

#endif
