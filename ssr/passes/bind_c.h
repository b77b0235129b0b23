/* ssr/passes/bind_c.h: the passes in C, single precision. A shader includes its own binding instead. */
#ifndef LOBE_SSR_BIND_C_H
#define LOBE_SSR_BIND_C_H

#include "kernel/bind/c_f32.h"

#include "accumulate.h"
#include "camera.h"
#include "fade.h"
#include "march.h"
#include "weight.h"

#endif
