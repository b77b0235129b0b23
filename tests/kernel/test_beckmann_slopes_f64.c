#include "kernel/bind/c_f64.h"

#define RESIDUAL 2e-15

#include "beckmann_slopes_template.h"
