#include "kernel/bind/c_f32.h"

#define RESIDUAL 5e-7

#include "beckmann_slopes_template.h"
