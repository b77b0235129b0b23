#include "kernel/bind/c_f32.h"

#define SCALED_CLOSE 1e-6
#define DENSITY_CLOSE 3e-6

#include "vcavity_deep_template.h"
