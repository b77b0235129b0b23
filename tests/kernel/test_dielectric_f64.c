#include "kernel/bind/c_f64.h"

/* to what the long double of the oracle cancels */
#define BETA_ERROR 2e-13
#define LIGHT_ERROR 2e-15

#include "dielectric_template.h"
