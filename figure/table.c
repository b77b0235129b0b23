#include "table.h"

#include <stdio.h>
#include <string.h>

void lobe_table_begin(bytes *t, const char *columns) {
    lobe_bytes_add(t, columns, strlen(columns));
    lobe_bytes_add(t, "\n", 1);
}

void lobe_table_row(bytes *t, const char *labels, int count, const double *numbers) {
    if (labels) lobe_bytes_add(t, labels, strlen(labels));
    for (int i = 0; i < count; i++) {
        char text[40];
        const int length =
            snprintf(text, sizeof text, "%s%.10g", i || labels ? "," : "", numbers[i]);
        lobe_bytes_add(t, text, (size_t)length);
    }
    lobe_bytes_add(t, "\n", 1);
}
