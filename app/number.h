/* app/number.h: numbers as text. The program never calls setlocale, so a decimal point is a point. */
#ifndef LOBE_APP_NUMBER_H
#define LOBE_APP_NUMBER_H

#include <stdbool.h>
#include <stdint.h>

enum { LOBE_APP_NUMBER_SIZE = 32 }; /* room for any formatted number */

/* A finite decimal number at the start of `text`; `*end` is the first character after it. Refuses
 * NaN, infinity, hexadecimal and what overflows. */
bool lobe_app_scan_number(const char *text, const char **end, double *number);

/* The same for the whole of `text`. */
bool lobe_app_read_number(const char *text, double *number);

/* `text` is least to most numbers with commas between; returns how many, 0 if it is not. */
int lobe_app_read_numbers(const char *text, int least, int most, double *numbers);

/* A whole number in decimal digits. */
bool lobe_app_read_integer(const char *text, uint64_t *integer);

/* The fewest digits that give back the same value; returns the length. NaN and infinities are
 * written as printf does. */
int lobe_app_format_f32(char *text, float number);
int lobe_app_format_f64(char *text, double number);

#endif
