/* Two approximations of all scatterings on a rough metal, and the truth by random walks. */
#include <math.h>
#include <stdio.h>

#include <lobe/walk.h>

#include "figures.h"
#include "plot.h"

enum { STEPS = 60, WALKS = 15, CURVES = 3, SETS = 3 };

static const double f0 = 0.6;

typedef struct curves {
    double theta[STEPS], albedo[CURVES][STEPS]; /* one scattering, Kulla-Conty, Turquin */
} curves;

static lobe_microsurface surface_of(double alpha) {
    return (lobe_microsurface){LOBE_NDF_GGX, LOBE_MASKING_SMITH, LOBE_G2_CORRELATED, alpha, alpha};
}

static lobe_reflectance metal(void) {
    return (lobe_reflectance){LOBE_REFLECTANCE_SCHLICK, f0, 0};
}

static void approximations(double alpha, double theta, double albedo[CURVES]) {
    const lobe_microsurface s = surface_of(alpha);
    const vec3 wi = lobe_direction(theta, 0);
    const double missing = 1 - lobe_albedo(s, lobe_reflectance_one(), wi, LOBE_EFFORT_MEDIUM),
                 average = 1 - lobe_albedo_average(s, lobe_reflectance_one(), LOBE_EFFORT_MEDIUM),
                 one = lobe_albedo(s, metal(), wi, LOBE_EFFORT_MEDIUM);
    albedo[0] = one;
    albedo[1] =
        one + lobe_multiscatter_fms_f64(lobe_reflectance_average(metal()), average) * missing;
    albedo[2] = one * lobe_multiscatter_turquin_f64(f0, missing);
}

typedef struct estimate {
    double mean, error; /* one standard deviation of the mean */
} estimate;

static estimate walk_albedo(const run *r, double alpha, double theta) {
    const uint64_t count = lobe_run_samples(r, 10000);
    const lobe_reflectance f = metal();
    double sum = 0, squares = 0;
    for (uint64_t k = 0; k < count && !lobe_run_is_over(r, k); k++) {
        double weight;
        lobe_walk_sample(surface_of(alpha), &f, 1, lobe_direction(theta, 0), r->options->seed, k,
                         1000, &weight);
        sum += weight;
        squares += weight * weight;
    }
    const double n = (double)count, mean = sum / n;
    return (estimate){mean, sqrt(fmax(squares / n - mean * mean, 0) / n)};
}

static int draw_walks(run *r, const plot *p, double alpha, double done) {
    for (int i = 0; i < WALKS; i++) {
        const double theta = 6 * i + 2;
        const estimate e = walk_albedo(r, alpha, theta);
        double a[CURVES];
        approximations(alpha, theta, a);
        const double row[] = {alpha, theta, a[0], a[1], a[2], e.mean, e.error};
        lobe_table_row(&r->table, NULL, 7, row);
        const double x[2] = {theta, theta}, y[2] = {e.mean - 2 * e.error, e.mean + 2 * e.error};
        lobe_plot_line(p, (pen){r->canvas.theme->ink, DASH_SOLID, 0.8}, 2, x, y);
        lobe_plot_dots(p, r->canvas.theme->ink, 1.3, 1, &theta, &e.mean);
        if (!lobe_run_goes_on(r, done + (i + 1.0) / (WALKS * SETS))) return 0;
    }
    return 1;
}

lobe_figure_result lobe_figure_multiscatter(run *r) {
    static const double own[SETS] = {0.2, 0.5, 1};
    const pen pens[CURVES + 1] = {lobe_pen(&r->canvas, HUE_BLUE, DASH_SOLID),
                                  lobe_pen(&r->canvas, HUE_RED, DASH_LONG),
                                  lobe_pen(&r->canvas, HUE_GREEN, DASH_MIXED),
                                  {r->canvas.theme->ink, DASH_DOTS, 2.2}};
    const legend_entry entries[] = {{"one scattering", pens[0]},
                                    {"Kulla–Conty", pens[1]},
                                    {"Turquin", pens[2]},
                                    {"random walks (± 2σ)", pens[3]}};
    lobe_canvas_begin(&r->canvas, PAGE_WIDTH, 186);
    lobe_table_begin(&r->table, "alpha,theta_deg,one,kulla_conty,turquin,walk,walk_error");
    lobe_legend(&r->canvas, 11, 4, entries);
    for (int set = 0; set < SETS; set++) {
        char title[48];
        snprintf(title, sizeof title, "α = %.3g    F_0 = %.3g", own[set], f0);
        const plot p =
            lobe_plot_begin(&r->canvas, (box){36 + 160 * set, 34, 140, 124},
                            (axis){"incidence θ (degrees)", 0, 90, SCALE_DEGREES},
                            (axis){set ? NULL : "albedo", 0.15, 0.75, SCALE_LINEAR}, title);
        curves c;
        for (int i = 0; i < STEPS; i++) {
            double albedo[CURVES];
            c.theta[i] = 1.5 * i;
            approximations(own[set], c.theta[i], albedo);
            for (int k = 0; k < CURVES; k++) c.albedo[k][i] = albedo[k];
        }
        for (int k = 0; k < CURVES; k++) lobe_plot_line(&p, pens[k], STEPS, c.theta, c.albedo[k]);
        if (!draw_walks(r, &p, own[set], (double)set / SETS)) return LOBE_FIGURE_INTERRUPTED;
    }
    return LOBE_FIGURE_OK;
}
