#include "ticks.h"

#include <math.h>
#include <stdio.h>

static double transformed(scale s, double value) {
    return s == SCALE_LOG ? log10(value) : s == SCALE_CHANCE ? log(value / (1 - value)) : value;
}

double lobe_axis_share(axis a, double value) {
    const double low = transformed(a.scale, a.low), high = transformed(a.scale, a.high);
    return (transformed(a.scale, value) - low) / (high - low);
}

double lobe_axis_value(axis a, double share) {
    const double low = transformed(a.scale, a.low), high = transformed(a.scale, a.high);
    const double t = low + share * (high - low);
    return a.scale == SCALE_LOG ? pow(10, t) : a.scale == SCALE_CHANCE ? 1 / (1 + exp(-t)) : t;
}

static void add(ticks *t, double at, const char *format, double number) {
    if (t->count == TICKS_MAX) return;
    t->at[t->count] = at;
    snprintf(t->text[t->count++], TICK_TEXT, format, number);
}

/* 1, 2 or 5 times a power of ten, at least `least`. */
static double round_step(double least) {
    const double power = pow(10, floor(log10(least)));
    const double lead = least / power;
    return power * (lead <= 1.0001 ? 1 : lead <= 2.0001 ? 2 : lead <= 5.0001 ? 5 : 10);
}

static double round_angle(double least) {
    static const double steps[] = {5, 15, 30, 45, 90};
    for (int i = 0; i < 5; i++)
        if (steps[i] >= least) return steps[i];
    return 180;
}

static ticks even_ticks(axis a, double most) {
    ticks t = {0};
    const double least = (a.high - a.low) / most;
    const double step = a.scale == SCALE_DEGREES ? round_angle(least) : round_step(least);
    const int digits = step < 1 ? (int)ceil(-log10(step) - 1e-9) : 0;
    char format[16];
    snprintf(format, sizeof format, "%%.%df", digits);
    const double first = ceil(a.low / step - 1e-9);
    for (double k = first; k * step <= a.high + 1e-9 * step; k++)
        add(&t, k * step, format, k == 0 ? 0.0 : k * step);
    return t;
}

static ticks decade_ticks(axis a, double most) {
    ticks t = {0};
    const int low = (int)ceil(log10(a.low) - 1e-9), high = (int)floor(log10(a.high) + 1e-9);
    const int step = (int)ceil((high - low + 1) / most);
    for (int k = high; k >= low && t.count < TICKS_MAX; k -= step) {
        t.at[t.count] = pow(10, k);
        if (k == 0 || k == 1)
            snprintf(t.text[t.count], TICK_TEXT, "%d", k ? 10 : 1);
        else
            snprintf(t.text[t.count], TICK_TEXT, "10^{%d}", k);
        t.count++;
    }
    return t;
}

static ticks chance_ticks(axis a) {
    static const double known[] = {1e-4, 1e-2, 0.5, 0.99, 0.9999};
    ticks t = {0};
    for (int i = 0; i < 5; i++)
        if (known[i] >= a.low && known[i] <= a.high) add(&t, known[i], "%.4g", known[i]);
    return t;
}

ticks lobe_ticks_of(axis a, double length, double spacing) {
    const double most = fmax(1, floor(length / spacing));
    if (a.scale == SCALE_LOG) return decade_ticks(a, most);
    if (a.scale == SCALE_CHANCE) return chance_ticks(a);
    return even_ticks(a, most);
}
