#include "kernel/bind/c_f32.h"

#define VECTOR_WO 1e-5
#define VECTOR_PDF 3e-5
#define SAME_PDF 1e-4
#define SAME_PDF_WO 1e-5
#define UNIT 1e-6

#include "horizon_template.h"
