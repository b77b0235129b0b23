#include "kernel/bind/c_f64.h"

#define RESIDUAL 5e-16

#include "beckmann_slopes_template.h"
