/* lib/dielectric_f32.c: rough dielectrics in single precision. */
#include "../kernel/bind/c_f32.h"

#define LOBE_NAME(stem) lobe_##stem##_f32

#include "dielectric_template.h"
