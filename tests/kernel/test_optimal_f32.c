#include "kernel/bind/c_f32.h"

/* the rounding of the horizon curve itself: optimal-caps, "In single precision" */
#define SLACK 6e-5
#define ROOM 1.001

#include "optimal_template.h"
