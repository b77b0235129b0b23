#include "kernel/bind/c_f32.h"

#define ULP 1.2e-7

#include "elementary_template.h"
