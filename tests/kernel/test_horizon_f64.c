#include "kernel/bind/c_f64.h"

#define VECTOR_WO 1e-12
#define VECTOR_PDF 1e-12
#define SAME_PDF 1e-12
#define SAME_PDF_WO 1e-13
#define UNIT 1e-14

#include "horizon_template.h"
