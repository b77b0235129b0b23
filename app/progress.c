#include "progress.h"

#include <math.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

enum { BAR_WIDTH = 30 };

const char *const lobe_app_progress_modes[] = {"auto", "always", "never", "json", NULL};

double lobe_app_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

lobe_app_progress lobe_app_begin_progress(int mode, const char *label, const char *unit) {
    if (mode == LOBE_APP_PROGRESS_AUTO)
        mode = isatty(STDERR_FILENO) ? LOBE_APP_PROGRESS_ALWAYS : LOBE_APP_PROGRESS_NEVER;
    const double now = lobe_app_seconds();
    return (lobe_app_progress){.label = label,
                               .unit = unit,
                               .mode = (lobe_app_progress_mode)mode,
                               .start = now,
                               .shown = now};
}

static double rate_of(const lobe_app_progress *progress, double seconds, double work) {
    return seconds > 0 ? (work - progress->work_before) / seconds : 0;
}

static double seconds_left(const lobe_app_progress *progress, double seconds, double fraction) {
    const double now = fraction - progress->fraction_before;
    return now > 0 ? seconds * (1 - fraction) / now : 1e6;
}

static void print_json(const lobe_app_progress *progress, double seconds, double fraction,
                       double work) {
    fprintf(stderr, "{\"progress\":\"%s\",\"seconds\":%.3f,\"%s\":%.0f,\"rate\":%.6g",
            progress->label, seconds, progress->unit, work, rate_of(progress, seconds, work));
    if (fraction > 0)
        fprintf(stderr, ",\"fraction\":%.6f,\"seconds_left\":%.3f", fraction,
                seconds_left(progress, seconds, fraction));
    fprintf(stderr, "}\n");
}

/* "5.1 Mrows/s", "48 %/s" */
static void print_rate(double rate, const char *unit) {
    static const char *const prefixes[] = {"", "k", "M", "G"};
    int i = 0;
    for (; rate >= 1000 && i < 3; i++) rate /= 1000;
    fprintf(stderr, "%.3g %s%s/s", rate, prefixes[i], unit);
}

static void print_bar(const lobe_app_progress *progress, double seconds, double fraction,
                      double work) {
    char bar[BAR_WIDTH + 1];
    for (int i = 0; i < BAR_WIDTH; i++) bar[i] = i < fraction * BAR_WIDTH ? '#' : '.';
    bar[BAR_WIDTH] = '\0';
    fprintf(stderr, "\r\033[K%s [%s] %3.0f %%  ", progress->label, bar,
            fraction > 0 ? 100 * fraction : 0);
    print_rate(rate_of(progress, seconds, work), progress->unit);
    if (fraction > 0) {
        const int left = (int)fmin(seconds_left(progress, seconds, fraction), 1e6);
        fprintf(stderr, "  %d:%02d left", left / 60, left % 60);
    }
    fflush(stderr);
}

void lobe_app_show_progress(lobe_app_progress *progress, double fraction, double work) {
    if (progress->mode == LOBE_APP_PROGRESS_NEVER) return;
    const double now = lobe_app_seconds();
    if (now - progress->shown < 0.2 && fraction < 1) return;
    progress->shown = now;
    if (progress->mode == LOBE_APP_PROGRESS_JSON)
        print_json(progress, now - progress->start, fraction, work);
    else
        print_bar(progress, now - progress->start, fraction, work);
}

void lobe_app_end_progress(lobe_app_progress *progress) {
    if (progress->mode == LOBE_APP_PROGRESS_ALWAYS) fprintf(stderr, "\r\033[K");
}
