/* lib/dielectric_batch_f32.c: the batches of dielectrics in single precision. */
#include "../kernel/bind/c_f32.h"

#define BATCH_NAME(stem) stem##_f32

#include "dielectric_batch_template.h"
