/* lib/dielectric_f64.c: rough dielectrics in double precision. */
#include "../kernel/bind/c_f64.h"

#define LOBE_NAME(stem) lobe_##stem##_f64

#include "dielectric_template.h"
