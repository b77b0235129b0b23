#include "kernel/bind/c_f64.h"

#define ULP 2.3e-16

#include "elementary_template.h"
