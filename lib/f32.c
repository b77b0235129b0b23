/* lib/f32.c: the library in single precision. */
#include "../kernel/bind/c_f32.h"

#define LOBE_NAME(stem) lobe_##stem##_f32

#include "albedo_template.h"
#include "fresnel_template.h"
#include "reflection_template.h"
