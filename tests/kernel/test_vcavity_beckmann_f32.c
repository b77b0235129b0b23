#include "kernel/bind/c_f32.h"

#include "vcavity_beckmann.h"

#define CLOSE 3e-5
#define DENSITY_CLOSE 1e-5
#define RECIPROCAL_CLOSE 2e-4

#include "vcavity_template.h"
