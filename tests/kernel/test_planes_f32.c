#include "kernel/bind/c_f32.h"

#define SAME_PDF 3e-4
#define SAME_WEIGHT 1e-5
#define UNIT 1e-6

#include "planes_template.h"
