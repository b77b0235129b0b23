#include "kernel/bind/c_f64.h"

#define SCALED_CLOSE 1e-10
#define DENSITY_CLOSE 1e-10

#include "vcavity_deep_template.h"
