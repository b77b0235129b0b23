#include "table.h"

#include <math.h>
#include <string.h>

#include "number.h"
#include "output.h"

enum { COLUMNS_MAX = 16, ROW_SIZE = COLUMNS_MAX * (LOBE_APP_NUMBER_SIZE + 16) };

const char *const lobe_app_formats[] = {"csv", "ndjson", "f32le", NULL};

bool lobe_app_begin_table(const lobe_app_table *table) {
    if (table->format != LOBE_APP_CSV) return true;
    for (int i = 0; table->columns[i]; i++) lobe_app_print("%s%s", i ? "," : "", table->columns[i]);
    return lobe_app_print("\n");
}

static char *put(char *out, const char *text) {
    const size_t length = strlen(text);
    memcpy(out, text, length);
    return out + length;
}

static char *put_number(char *out, const lobe_app_table *table, double number) {
    if (table->format == LOBE_APP_NDJSON && !isfinite(number)) return put(out, "null");
    return out + (table->precision == LOBE_APP_F32 ? lobe_app_format_f32(out, (float)number)
                                                   : lobe_app_format_f64(out, number));
}

/* A 32-bit little-endian float, whatever the machine's order. Written out, not as a loop: compilers
 * make one store of it. */
static char *put_f32le(char *out, double number) {
    const float narrow = (float)number;
    uint32_t bits;
    memcpy(&bits, &narrow, sizeof bits);
    out[0] = (char)(bits & 0xff);
    out[1] = (char)(bits >> 8 & 0xff);
    out[2] = (char)(bits >> 16 & 0xff);
    out[3] = (char)(bits >> 24);
    return out + 4;
}

bool lobe_app_write_row(const lobe_app_table *table, const double *numbers) {
    char row[ROW_SIZE], *out = row;
    for (int i = 0; table->columns[i]; i++) {
        switch (table->format) {
        case LOBE_APP_CSV:
            if (i) *out++ = ',';
            out = put_number(out, table, numbers[i]);
            break;
        case LOBE_APP_NDJSON:
            out = put(out, i ? ",\"" : "{\"");
            out = put(out, table->columns[i]);
            out = put(out, "\":");
            out = put_number(out, table, numbers[i]);
            break;
        case LOBE_APP_F32LE:
            out = put_f32le(out, numbers[i]);
            break;
        }
    }
    if (table->format == LOBE_APP_NDJSON) out = put(out, "}");
    if (table->format != LOBE_APP_F32LE) *out++ = '\n';
    return lobe_app_write(row, (size_t)(out - row));
}
