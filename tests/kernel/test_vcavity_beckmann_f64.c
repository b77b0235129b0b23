#include "kernel/bind/c_f64.h"

#include "vcavity_beckmann.h"

#define CLOSE 1e-9
#define DENSITY_CLOSE 1e-8
#define RECIPROCAL_CLOSE 1e-11

#include "vcavity_template.h"
