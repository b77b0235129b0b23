#include "kernel/bind/c_f64.h"

#define SAME_PDF 1e-11
#define SAME_WEIGHT 1e-13
#define UNIT 1e-14

#include "planes_template.h"
