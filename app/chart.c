#include "chart.h"

#include <math.h>
#include <stdbool.h>

#include "page.h"

enum { WIDTH = 370, HEIGHT = 260, LEFT = 52, RIGHT = 12, TOP = 22, BOTTOM = 40 };

/* Told apart also without colour: the marks differ as well. */
const char lobe_app_chart_style[] =
    ":root{--s0:#2f5fd0;--s1:#c8501e;--s2:#1d8a5b;--s3:#9a3fb0;--s4:#8a6d00;--s5:#0d8296;"
    "--s6:#b42d5e;--s7:#5b6270}"
    "@media(prefers-color-scheme:dark){:root{--s0:#86a9ff;--s1:#ff9a66;--s2:#63d3a0;--s3:#dc93f0;"
    "--s4:#dcc04a;--s5:#5fd0e4;--s6:#ff8cb4;--s7:#b4bac6}}"
    ".s0{--c:var(--s0)}.s1{--c:var(--s1)}.s2{--c:var(--s2)}.s3{--c:var(--s3)}.s4{--c:var(--s4)}"
    ".s5{--c:var(--s5)}.s6{--c:var(--s6)}.s7{--c:var(--s7)}"
    ".chart svg{width:100%;height:auto;display:block}.chart .line{stroke:var(--c);fill:none;"
    "stroke-width:2}.chart .fit{stroke:var(--c);fill:none;stroke-dasharray:3 4;opacity:.7}"
    ".chart .mark{fill:var(--c);stroke:var(--card)}.chart .bar{stroke:var(--c);stroke-width:1.4}"
    ".names{display:flex;flex-wrap:wrap;gap:.1rem .9rem;font-size:.84rem}"
    ".names svg{width:1rem;height:.8rem;display:inline-block;vertical-align:-.05rem;"
    "margin-right:.3rem}";

/* Logarithms, to base 10; of x as it is if linear. */
typedef struct frame {
    double x0, x1, y0, y1;
    bool is_linear;
} frame;

static double along(const frame *f, double x) {
    return f->is_linear ? x : log10(x);
}

static void widen(double *least, double *greatest, double place) {
    if (!isfinite(place)) return;
    *least = fmin(*least, place);
    *greatest = fmax(*greatest, place);
}

/* At least a factor of two, and some air. */
static void pad(double *least, double *greatest) {
    if (!(*least <= *greatest)) *least = *greatest = 0;
    const double air = fmax(0.06 * (*greatest - *least), (0.3 - (*greatest - *least)) / 2);
    *least -= air;
    *greatest += air;
}

static frame frame_of(const lobe_app_chart *chart) {
    frame f = {INFINITY, -INFINITY, INFINITY, -INFINITY, chart->is_linear_in_x};
    for (int k = 0; k < chart->count; k++) {
        const lobe_app_series *s = &chart->series[k];
        for (int i = 0; i < s->count; i++) {
            widen(&f.x0, &f.x1, along(&f, s->x[i]));
            widen(&f.y0, &f.y1, log10(s->y[i]));
            if (isfinite(s->error[i])) widen(&f.y0, &f.y1, log10(s->y[i] + s->error[i]));
        }
    }
    pad(&f.x0, &f.x1);
    pad(&f.y0, &f.y1);
    return f;
}

static double at_x(const frame *f, double x) {
    return LEFT + (WIDTH - LEFT - RIGHT) * (along(f, x) - f->x0) / (f->x1 - f->x0);
}

/* Points below the frame, as an error bar that reaches 0, end at it. */
static double at_y(const frame *f, double y) {
    const double share = y > 0 ? (log10(y) - f->y0) / (f->y1 - f->y0) : 0;
    return TOP + (HEIGHT - TOP - BOTTOM) * (1 - fmax(share, 0));
}

static void write_tick(FILE *file, const frame *f, bool is_x, double value) {
    const double x = is_x ? at_x(f, value) : LEFT, y = is_x ? TOP : at_y(f, value);
    fprintf(file, "<line class=axis x1=%.1f x2=%.1f y1=%.1f y2=%.1f />", x,
            is_x ? x : WIDTH - RIGHT, y, is_x ? HEIGHT - BOTTOM : y);
    fprintf(file, "<text x=%.1f y=%.1f text-anchor=%s>%.10g</text>", is_x ? x : LEFT - 5,
            is_x ? HEIGHT - BOTTOM + 15 : y + 4, is_x ? "middle" : "end", value);
}

/* Decades, with digits between them where there are few. */
static void write_ticks(FILE *file, const frame *f, bool is_x) {
    const double first = is_x ? f->x0 : f->y0, last = is_x ? f->x1 : f->y1;
    const double decades = last - first;
    static const int digits[] = {1, 2, 5, 3, 7};
    const int count = decades > 2.2 ? 1 : decades > 0.8 ? 3 : 5;
    for (int decade = (int)floor(first); decade <= (int)ceil(last); decade++)
        for (int i = 0; i < count; i++) {
            const double value = digits[i] * pow(10, decade);
            if (log10(value) >= first && log10(value) <= last) write_tick(file, f, is_x, value);
        }
}

/* Where the points are, if that is the same for all and leaves room for the numbers. */
static void write_x_ticks(FILE *file, const frame *f, const lobe_app_chart *chart) {
    const lobe_app_series *s = &chart->series[0];
    double before = -INFINITY;
    if (!chart->has_ticks_at_points) {
        write_ticks(file, f, true);
        return;
    }
    for (int i = 0; i < s->count; i++) {
        if (at_x(f, s->x[i]) - before < 26) continue;
        before = at_x(f, s->x[i]);
        write_tick(file, f, true, s->x[i]);
    }
}

static void write_mark(FILE *file, int kind, double x, double y) {
    switch (kind % 4) {
    case 0:
        fprintf(file, "<circle class=mark cx=%.1f cy=%.1f r=4 />", x, y);
        break;
    case 1:
        fprintf(file, "<rect class=mark x=%.1f y=%.1f width=7.4 height=7.4 />", x - 3.7, y - 3.7);
        break;
    case 2:
        fprintf(file, "<path class=mark d=\"M%.1f %.1fl4.8 8.4h-9.6z\"/>", x, y - 5.6);
        break;
    default:
        fprintf(file, "<path class=mark d=\"M%.1f %.1fl5 5l-5 5l-5 -5z\"/>", x, y - 5);
    }
}

/* The line of the fitted slope through the middle of the points. */
static void write_fit(FILE *file, const frame *f, const lobe_app_series *s) {
    double x = 0, y = 0;
    if (s->count < 2 || !isfinite(s->slope) || f->is_linear) return;
    for (int i = 0; i < s->count; i++) {
        x += log10(s->x[i]) / s->count;
        y += log10(s->y[i]) / s->count;
    }
    const double ends[2] = {log10(s->x[0]), log10(s->x[s->count - 1])};
    fprintf(file, "<path class=fit d=\"M%.1f %.1fL%.1f %.1f\"/>", at_x(f, pow(10, ends[0])),
            at_y(f, pow(10, y + s->slope * (ends[0] - x))), at_x(f, pow(10, ends[1])),
            at_y(f, pow(10, y + s->slope * (ends[1] - x))));
}

static void write_series(FILE *file, const frame *f, const lobe_app_series *s, int k) {
    fprintf(file, "<g class=s%d>", k % LOBE_APP_CHART_COLOURS);
    write_fit(file, f, s);
    fputs("<polyline class=line points=\"", file);
    for (int i = 0; i < s->count; i++)
        fprintf(file, "%.1f,%.1f ", at_x(f, s->x[i]), at_y(f, s->y[i]));
    fputs("\"/>", file);
    for (int i = 0; i < s->count; i++) {
        const double x = at_x(f, s->x[i]);
        if (isfinite(s->error[i]))
            fprintf(file, "<line class=bar x1=%.1f x2=%.1f y1=%.1f y2=%.1f />", x, x,
                    at_y(f, s->y[i] - s->error[i]), at_y(f, s->y[i] + s->error[i]));
        write_mark(file, k, x, at_y(f, s->y[i]));
    }
    fputs("</g>", file);
}

static void write_names(FILE *file, const lobe_app_chart *chart) {
    fputs("<div class=names>", file);
    for (int k = 0; k < chart->count; k++) {
        fprintf(file, "<span class=s%d><svg viewBox=\"0 0 16 12\">", k % LOBE_APP_CHART_COLOURS);
        write_mark(file, k, 8, 6);
        fputs("</svg>", file);
        lobe_app_write_html(file, chart->series[k].name);
        fputs("</span>", file);
    }
    fputs("</div>", file);
}

void lobe_app_write_chart(FILE *file, const lobe_app_chart *chart) {
    const frame f = frame_of(chart);
    fprintf(file, "<figure class=chart><svg viewBox=\"0 0 %d %d\" role=img aria-label=\"", WIDTH,
            HEIGHT);
    lobe_app_write_html(file, chart->y_title);
    fputs(" against ", file);
    lobe_app_write_html(file, chart->x_title);
    fputs("\">", file);
    write_x_ticks(file, &f, chart);
    write_ticks(file, &f, false);
    for (int k = 0; k < chart->count; k++) write_series(file, &f, &chart->series[k], k);
    fprintf(file, "<text x=%d y=%d text-anchor=middle>", (LEFT + WIDTH) / 2, HEIGHT - 6);
    lobe_app_write_html(file, chart->x_title);
    fprintf(file, "</text><text x=%d y=%d>", LEFT - 46, TOP - 9);
    lobe_app_write_html(file, chart->y_title);
    fputs("</text></svg>", file);
    write_names(file, chart);
    fputs("</figure>", file);
}
