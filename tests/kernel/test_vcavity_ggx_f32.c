#include "kernel/bind/c_f32.h"

#include "vcavity_ggx.h"

#define CLOSE 1e-6
#define DENSITY_CLOSE 1e-6
#define RECIPROCAL_CLOSE 2e-4

#include "vcavity_template.h"
