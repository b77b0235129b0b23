#include "number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool lobe_app_scan_number(const char *text, const char **end, double *number) {
    const char *digits = text + (*text == '+' || *text == '-');
    const bool is_decimal = *digits == '.' || (*digits >= '0' && *digits <= '9');
    const bool is_hexadecimal = digits[0] == '0' && (digits[1] == 'x' || digits[1] == 'X');
    if (!is_decimal || is_hexadecimal) return false;
    char *after;
    *number = strtod(text, &after);
    *end = after;
    return after != text && isfinite(*number);
}

bool lobe_app_read_number(const char *text, double *number) {
    const char *end;
    return lobe_app_scan_number(text, &end, number) && *end == '\0';
}

int lobe_app_read_numbers(const char *text, int least, int most, double *numbers) {
    for (int count = 1; count <= most; count++) {
        if (!lobe_app_scan_number(text, &text, &numbers[count - 1])) return 0;
        if (*text == '\0') return count >= least ? count : 0;
        if (*text++ != ',') return 0;
    }
    return 0;
}

bool lobe_app_read_integer(const char *text, uint64_t *integer) {
    if (*text == '\0') return false;
    uint64_t value = 0;
    for (; *text; text++) {
        const unsigned digit = (unsigned)(*text - '0');
        if (digit > 9 || value > (UINT64_MAX - digit) / 10) return false;
        value = value * 10 + digit;
    }
    *integer = value;
    return true;
}

/* Every power of ten between the smallest and the largest float, and nine digits beyond. */
static double power_of_ten(int exponent) {
    static const double powers[] = {
        1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
        1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22, 1e23, 1e24, 1e25, 1e26, 1e27,
        1e28, 1e29, 1e30, 1e31, 1e32, 1e33, 1e34, 1e35, 1e36, 1e37, 1e38, 1e39, 1e40, 1e41,
        1e42, 1e43, 1e44, 1e45, 1e46, 1e47, 1e48, 1e49, 1e50, 1e51, 1e52, 1e53, 1e54};
    return powers[exponent];
}

static double scaled(double number, int exponent) {
    return exponent < 0 ? number / power_of_ten(-exponent) : number * power_of_ten(exponent);
}

/* Digits d and exponent e with d * 10^e the shortest decimal that is nearer to `magnitude` than to
 * any other float. Doubles carry the sums: their error of 2^-52 is far below the half gap of 2^-25,
 * so that nine digits always pass, and fewer never pass wrongly. Six or fewer digits that pass are
 * found by six: they end in zeros. */
static uint32_t shortest_digits(double magnitude, int *exponent) {
    int binary;
    const double mantissa = frexp(magnitude, &binary);
    const int gap = binary - 24 > -149 ? binary - 24 : -149;
    const double half_gap = ldexp(mantissa == 0.5 ? 0.249 : 0.499, gap); /* narrower below 2^n */
    int leading = (int)floor((binary - 1) * 0.30102999566398120);
    if (scaled(magnitude, -leading) >= 10) leading++;
    for (int count = 6;; count++) {
        *exponent = leading + 1 - count;
        const double digits = floor(scaled(magnitude, -*exponent) + 0.5);
        if (count == 9 || fabs(scaled(digits, *exponent) - magnitude) < half_gap)
            return (uint32_t)digits;
    }
}

/* d * 10^e as printf's %g would write it, without zeros at the end. */
static int write_decimal(char *text, uint32_t digits, int exponent) {
    while (digits % 10 == 0) {
        digits /= 10;
        exponent++;
    }
    char reversed[12];
    int count = 0;
    for (; digits; digits /= 10) reversed[count++] = (char)('0' + digits % 10);
    const int leading = exponent + count - 1;
    const bool is_scientific = leading < -5 || leading > 8;
    const int point = is_scientific ? 0 : leading; /* index of the digit before the point */
    char *out = text;
    if (point < 0) *out++ = '0', *out++ = '.';
    for (int i = point + 1; i < 0; i++) *out++ = '0';
    for (int i = 0; i < count; i++) {
        *out++ = reversed[count - 1 - i];
        if (i == point && i + 1 < count) *out++ = '.';
    }
    for (int i = count; i <= point; i++) *out++ = '0';
    if (is_scientific) {
        *out++ = 'e';
        if (leading < 0) *out++ = '-';
        const int size = abs(leading);
        if (size >= 10) *out++ = (char)('0' + size / 10);
        *out++ = (char)('0' + size % 10);
    }
    *out = '\0';
    return (int)(out - text);
}

int lobe_app_format_f32(char *text, float number) {
    if (!isfinite(number)) return snprintf(text, LOBE_APP_NUMBER_SIZE, "%g", (double)number);
    char *out = text;
    if (signbit(number)) *out++ = '-';
    if (number == 0) {
        *out++ = '0';
        *out = '\0';
        return (int)(out - text);
    }
    int exponent;
    const uint32_t digits = shortest_digits(fabs((double)number), &exponent);
    return (int)(out - text) + write_decimal(out, digits, exponent);
}

int lobe_app_format_f64(char *text, double number) {
    for (int digits = 15;; digits++) {
        const int length = snprintf(text, LOBE_APP_NUMBER_SIZE, "%.*g", digits, number);
        if (digits == 17 || !isfinite(number) || strtod(text, NULL) == number) return length;
    }
}
