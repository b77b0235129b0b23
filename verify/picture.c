#include "picture.h"

#include <math.h>

#include "draws.h"
#include "sphere_chart.h"

/* Of the furnace curve: bins in each direction, draws at each angle. */
enum { CURVE_GRID = 8, CURVE_DRAWS = 16384, CURVE_PILOT = 16384 };

static const double PI = 3.14159265358979323846;

static void paint_pixel(lobe_picture *picture, const lobe_bins *bins, const lobe_tally *tally,
                        int sheet, int pixel, lobe_disk_point point) {
    double t, a;
    lobe_square_from_disk(point, &t, &a);
    size_t bin = lobe_bins_find(bins, sheet, t, a);
    double n = (double)tally->draws;
    double mean = n / (PI * bins->sheets); /* draws per area */
    double expected = n * bins->share[bin];
    double off = (double)tally->counts[bin] - expected;
    double deviation = sqrt(fmax(expected * (1 - bins->share[bin]), 1));
    picture->observed[sheet][pixel] = (float)((double)tally->counts[bin] / bins->area[bin] / mean);
    picture->expected[sheet][pixel] = (float)(expected / bins->area[bin] / mean);
    picture->difference[sheet][pixel] = (float)(off / deviation);
}

static void paint_sheet(lobe_picture *picture, const lobe_bins *bins, const lobe_tally *tally,
                        int sheet) {
    for (int pixel = 0; pixel < LOBE_PICTURE_PIXELS; ++pixel) {
        double x = 2 * (pixel % LOBE_PICTURE_SIZE + 0.5) / LOBE_PICTURE_SIZE - 1;
        double y = 1 - 2 * (pixel / LOBE_PICTURE_SIZE + 0.5) / LOBE_PICTURE_SIZE;
        double v = 1 - x * x - y * y;
        if (v > 0) {
            paint_pixel(picture, bins, tally, sheet, pixel, (lobe_disk_point){x, y, sqrt(v)});
        } else {
            picture->observed[sheet][pixel] = NAN;
            picture->expected[sheet][pixel] = NAN;
            picture->difference[sheet][pixel] = NAN;
        }
    }
}

/* The same model at another angle: what is known of it there is nothing but its functions. */
static lobe_verify_model turned(const lobe_verify_model *model, double theta, double phi) {
    lobe_verify_model other = *model;
    other.wi[0] = (float)(sin(theta) * cos(phi));
    other.wi[1] = (float)(sin(theta) * sin(phi));
    other.wi[2] = (float)cos(theta);
    other.chart = model->covers_sphere ? lobe_sphere_chart() : lobe_hemisphere_chart();
    if (lobe_verify_is_sphere(model)) other.below = lobe_lower_hemisphere_chart();
    other.pilot_draws = CURVE_PILOT;
    other.twin = NULL;
    return other;
}

static int measure_furnace(const lobe_verify_model *model, const lobe_settings *settings,
                           lobe_verify_furnace *point) {
    lobe_bins bins;
    if (!lobe_bins_make_roughly(&bins, model, CURVE_GRID, 16)) return 0;
    lobe_verify_state state;
    model->prepare(model->self, model->wi, &state);
    double sum = 0, squares = 0;
    for (uint64_t i = 0; i < CURVE_DRAWS; ++i) {
        double u[3];
        lobe_random_numbers(model, settings, i, u);
        double weight = model->sample(&state, u).weight;
        sum += weight;
        squares += weight * weight;
    }
    point->integral = bins.value;
    point->sampled = sum / CURVE_DRAWS;
    double variance = fmax(squares / CURVE_DRAWS - point->sampled * point->sampled, 0);
    point->error = sqrt(variance / CURVE_DRAWS);
    lobe_bins_free(&bins);
    return 1;
}

/* From the normal to the horizon in the plane of wi, on the side of the surface where wi is. */
static int measure_curve(lobe_picture *picture, const lobe_verify_model *model,
                         const lobe_settings *settings) {
    double phi = atan2(model->wi[1], model->wi[0]);
    for (int i = 0; i < LOBE_CURVE_POINTS; ++i) {
        double degrees = fmin(7.5 * i, 89);
        if (model->wi[2] < 0) degrees = 180 - degrees;
        lobe_verify_model other = turned(model, degrees * PI / 180, phi);
        picture->curve[i].theta = degrees;
        if (!measure_furnace(&other, settings, &picture->curve[i])) return 0;
    }
    return 1;
}

int lobe_picture_make(lobe_picture *picture, const lobe_verify_model *model,
                      const lobe_settings *settings, const lobe_bins *bins,
                      const lobe_tally *tally) {
    for (int sheet = 0; sheet < bins->sheets; ++sheet) paint_sheet(picture, bins, tally, sheet);
    if (!measure_curve(picture, model, settings)) return 0;
    picture->sheets = bins->sheets;
    return 1;
}
