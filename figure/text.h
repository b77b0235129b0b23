/* Text with indices: "α_x" and "10^{−3}"; one character, or what stands in braces. */
#ifndef LOBE_FIGURE_TEXT_H
#define LOBE_FIGURE_TEXT_H

#include "canvas.h"

typedef enum align { ALIGN_LEFT, ALIGN_CENTRE, ALIGN_RIGHT } align;

double lobe_text_width(canvas *c, double size, const char *text);
/* y is the base line. */
void lobe_text(canvas *c, colour k, double size, align a, double x, double y, const char *text);
/* Read from below. */
void lobe_text_upward(canvas *c, colour k, double size, align a, double x, double y,
                      const char *text);

/* Strokes with their names in rows of the page's width, centred; y is the base line of the first. Returns
 * that of the last. */
typedef struct legend_entry {
    const char *name;
    pen pen;
} legend_entry;

double lobe_legend(canvas *c, double y, int count, const legend_entry *entries);

#endif
