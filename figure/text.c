#include "text.h"

#include <string.h>

/* A stretch of text on one level. */
typedef struct piece {
    const char *begin, *next;
    size_t length;
    char mark; /* '_', '^', or 0 for the base line */
} piece;

/* Bytes of the UTF-8 character at `text`. */
static size_t character_length(const char *text) {
    size_t length = 1;
    while (((unsigned char)text[length] & 0xc0) == 0x80) length++;
    return length;
}

static piece next_piece(const char *text) {
    piece p = {.begin = text};
    if ((*text != '_' && *text != '^') || text[1] == '\0') {
        p.length = 1 + strcspn(text + 1, "_^");
        p.next = text + p.length;
        return p;
    }
    p.mark = *text;
    p.begin = text + 1;
    if (*p.begin != '{') {
        p.length = character_length(p.begin);
        p.next = p.begin + p.length;
        return p;
    }
    p.begin++;
    p.length = strcspn(p.begin, "}");
    p.next = p.begin + p.length + (p.begin[p.length] == '}');
    return p;
}

/* Width of all pieces; shows them from (x, y) on if asked to. */
static double set_pieces(canvas *c, double size, double x, double y, const char *text, int show) {
    double width = 0;
    while (*text) {
        const piece p = next_piece(text);
        char part[128];
        const size_t length = p.length < sizeof part ? p.length : sizeof part - 1;
        memcpy(part, p.begin, length);
        part[length] = '\0';
        cairo_set_font_size(c->cr, p.mark ? 0.72 * size : size);
        cairo_text_extents_t extents;
        cairo_text_extents(c->cr, part, &extents);
        const double drop = p.mark == '_' ? 0.22 : p.mark == '^' ? -0.38 : 0;
        if (show) {
            cairo_move_to(c->cr, x + width, y + drop * size);
            cairo_show_text(c->cr, part);
        }
        width += extents.x_advance;
        text = p.next;
    }
    return width;
}

double lobe_text_width(canvas *c, double size, const char *text) {
    return set_pieces(c, size, 0, 0, text, 0);
}

/* A hyphen before a digit is too short for a minus. */
static void with_minus(char *out, size_t size, const char *text) {
    size_t used = 0;
    for (; *text && used + 4 < size; text++) {
        if (*text == '-' && text[1] >= '0' && text[1] <= '9') {
            memcpy(out + used, "−", 3);
            used += 3;
        } else {
            out[used++] = *text;
        }
    }
    out[used] = '\0';
}

void lobe_text(canvas *c, colour k, double size, align a, double x, double y, const char *plain) {
    char text[256];
    with_minus(text, sizeof text, plain);
    const double width = a == ALIGN_LEFT ? 0 : lobe_text_width(c, size, text);
    lobe_set_colour(c, k, 1);
    set_pieces(c, size, x - (a == ALIGN_RIGHT ? width : 0.5 * width), y, text, 1);
    cairo_new_path(c->cr);
}

void lobe_text_upward(canvas *c, colour k, double size, align a, double x, double y,
                      const char *text) {
    cairo_save(c->cr);
    cairo_translate(c->cr, x, y);
    cairo_rotate(c->cr, -1.5707963267948966);
    lobe_text(c, k, size, a, 0, 0, text);
    cairo_restore(c->cr);
}

enum { STROKE = 16, STROKE_GAP = 4, ENTRY_GAP = 11, ROW_HEIGHT = 11 };

static double entry_width(canvas *c, legend_entry e) {
    return STROKE + STROKE_GAP + lobe_text_width(c, TEXT_SIZE, e.name) + ENTRY_GAP;
}

double lobe_legend(canvas *c, double y, int count, const legend_entry *entries) {
    int first = 0;
    for (;;) {
        double width = entry_width(c, entries[first]) - ENTRY_GAP;
        int end = first + 1;
        for (; end < count; end++) {
            const double more = entry_width(c, entries[end]);
            if (width + more > c->width - 10) break;
            width += more;
        }
        double x = 0.5 * (c->width - width);
        for (; first < end; first++) {
            lobe_stroke_line(c, entries[first].pen, x, y - 2.5, x + STROKE, y - 2.5);
            lobe_text(c, c->theme->ink, TEXT_SIZE, ALIGN_LEFT, x + STROKE + STROKE_GAP, y,
                      entries[first].name);
            x += entry_width(c, entries[first]);
        }
        if (end == count) return y;
        y += ROW_HEIGHT;
    }
}
