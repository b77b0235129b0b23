/* lib/dielectric_batch_sse41_f64.c: the loops over dielectrics in double precision. */
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define TARGET_SSE41
#include "target.h"

#include "../kernel/bind/c_f64.h"

#define BATCH_TABLE lobe_dielectric_batch_sse41_f64
#include "dielectric_loops.h"

TARGET_END
