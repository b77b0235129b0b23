#include "kernel/bind/c_f32.h"

#define BETA_ERROR 8e-6
#define LIGHT_ERROR 8e-7

#include "dielectric_template.h"
