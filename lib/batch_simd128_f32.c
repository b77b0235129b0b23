/* lib/batch_simd128_f32.c: the loops over a block in single precision. */
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define TARGET_SIMD128
#include "target.h"

#include "../kernel/bind/c_f32.h"

#define BATCH_TABLE lobe_batch_simd128_f32
#include "batch_loops.h"

TARGET_END
