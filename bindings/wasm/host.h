/* Elementary functions of the browser, for what surrounds the library: angles of bins, colours. The library
 * has its own. Those of the C library would add a tenth to the size of the page. */
#ifndef LOBE_WASM_HOST_H
#define LOBE_WASM_HOST_H

#define FROM_HOST(name) __attribute__((import_module("Math"), import_name(#name)))

FROM_HOST(sin) double host_sin(double x);
FROM_HOST(cos) double host_cos(double x);
FROM_HOST(acos) double host_acos(double x);
FROM_HOST(atan2) double host_atan2(double y, double x);
FROM_HOST(exp) double host_exp(double x);
FROM_HOST(log) double host_log(double x);
FROM_HOST(pow) double host_pow(double x, double y);

static inline float host_atan2f(float y, float x) {
    return (float)host_atan2((double)y, (double)x);
}

static inline float host_acosf(float x) {
    return (float)host_acos((double)x);
}

#endif
