/* lib/dielectric_batch_scalar_f32.c: the loops over dielectrics in single precision. */
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define TARGET_SCALAR
#include "target.h"

#include "../kernel/bind/c_f32.h"

#define BATCH_TABLE lobe_dielectric_batch_scalar_f32
#include "dielectric_loops.h"

TARGET_END
