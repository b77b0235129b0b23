#include "kernel/bind/c_f32.h"

#define TOLERANCE 2e-6

#include "beckmann_template.h"
