/* lib/dielectric_batch_f64.c: the batches of dielectrics in double precision. */
#include "../kernel/bind/c_f64.h"

#define BATCH_NAME(stem) stem##_f64

#include "dielectric_batch_template.h"
