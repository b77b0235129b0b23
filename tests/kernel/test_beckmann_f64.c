#include "kernel/bind/c_f64.h"

#define TOLERANCE 1e-14

#include "beckmann_template.h"
