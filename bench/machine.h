/* bench/machine.h: the processor's name, a clock, and how fast it copies memory. */
#ifndef LOBE_BENCH_MACHINE_H
#define LOBE_BENCH_MACHINE_H

#include <stddef.h>

double machine_seconds(void);

void machine_name(char *name, size_t room);

/* Bytes a second, read and written together, of copying arrays far larger than the caches, on one
 * thread; 0: no memory. */
double machine_copy_rate(int rounds);

#endif
