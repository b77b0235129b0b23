/* lib/batch_avx512_f64.c: the loops over a block in double precision. */
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define TARGET_AVX512
#include "target.h"

#include "../kernel/bind/c_f64.h"

#define BATCH_TABLE lobe_batch_avx512_f64
#include "batch_loops.h"

TARGET_END
