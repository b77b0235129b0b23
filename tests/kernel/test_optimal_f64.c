#include "kernel/bind/c_f64.h"

#define SLACK 1e-9
#define ROOM 1.0001

#include "optimal_template.h"
