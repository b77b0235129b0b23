#include "kernel/bind/c_f32.h"

#define RESIDUAL 1e-7

#include "beckmann_slopes_template.h"
