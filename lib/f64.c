/* lib/f64.c: the library in double precision. */
#include "../kernel/bind/c_f64.h"

#define LOBE_NAME(stem) lobe_##stem##_f64

#include "albedo_template.h"
#include "fresnel_template.h"
#include "reflection_template.h"
