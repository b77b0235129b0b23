/* verify/rounded.h: a number as a model in single precision is given it.
 *
 * gcc 12 at -O2 drops a conversion to float and back where it makes two of them at once (a loop
 * `v[k] = (float)v[k]` over two doubles is compiled to nothing); it may not drop a volatile. */
#ifndef LOBE_VERIFY_ROUNDED_H
#define LOBE_VERIFY_ROUNDED_H

static inline double lobe_rounded_to_float(double x) {
    volatile float narrow = (float)x;
    return narrow;
}

#endif
