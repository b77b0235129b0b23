#include "svg.h"

static int is_digit(char c) {
    return c >= '0' && c <= '9';
}

void lobe_svg_shorten(bytes *b) {
    enum { DECIMALS = 2 };
    size_t used = 0;
    int in_path = 0;
    for (size_t i = 0; i < b->size; i++) {
        const char c = b->data[i];
        if (c == '"')
            in_path = !in_path && i >= 2 && b->data[i - 1] == '=' && b->data[i - 2] == 'd';
        b->data[used++] = c;
        if (!in_path || c != '.') continue;
        size_t kept = 0;
        while (i + 1 < b->size && is_digit(b->data[i + 1])) {
            i++;
            if (kept++ < DECIMALS) b->data[used++] = b->data[i];
        }
        while (b->data[used - 1] == '0') used--;
        if (b->data[used - 1] == '.') used--;
    }
    b->size = used;
}
