/* A page in points (1/72 inch) from the upper left corner, kept in memory as SVG, PDF or PNG. */
#ifndef LOBE_FIGURE_CANVAS_H
#define LOBE_FIGURE_CANVAS_H

#include <cairo.h>

#include "bytes.h"
#include "theme.h"

/* Widths of a column and of a page of the usual journals. */
#define COLUMN_WIDTH 240.0
#define PAGE_WIDTH 504.0

#define TEXT_SIZE 7.5
#define SMALL_SIZE 6.5

typedef enum picture_format { PICTURE_NONE, PICTURE_SVG, PICTURE_PDF, PICTURE_PNG } picture_format;

picture_format lobe_picture_format_of(const char *path);

typedef struct canvas {
    cairo_t *cr; /* NULL before lobe_canvas_begin */
    picture_format format;
    double dpi;
    const theme *theme;
    bytes file;
    double width, height;
} canvas;

/* Starts the page; once for a figure. */
void lobe_canvas_begin(canvas *c, double width, double height);

/* Ends it and fills `file`. 0: out of memory. */
int lobe_canvas_end(canvas *c);

typedef struct box {
    double x, y, width, height;
} box;

typedef enum dash { DASH_SOLID, DASH_LONG, DASH_DOTS, DASH_MIXED } dash;

typedef struct pen {
    colour colour;
    dash dash;
    double width;
} pen;

pen lobe_pen(const canvas *c, hue h, dash d);
void lobe_set_colour(canvas *c, colour k, double opacity);
/* Strokes the path of `cr`. */
void lobe_stroke(canvas *c, pen p);
void lobe_stroke_line(canvas *c, pen p, double x0, double y0, double x1, double y1);
void lobe_arrow(canvas *c, pen p, double x0, double y0, double x1, double y1);
/* Dots: one path for all of a colour keeps files small. */
void lobe_add_dot(canvas *c, double x, double y);
void lobe_stroke_dots(canvas *c, colour k, double radius);

#endif
