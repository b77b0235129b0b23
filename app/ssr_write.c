#include "ssr_write.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <lobe/ssr_picture.h>

lobe_app_status lobe_app_make_folder(const char *folder) {
    struct stat status;
    if (mkdir(folder, 0777) == 0) return LOBE_APP_DONE;
    const int why = errno;
    if (why == EEXIST && stat(folder, &status) == 0 && S_ISDIR(status.st_mode))
        return LOBE_APP_DONE;
    lobe_app_report(folder, "choose another folder", "cannot be made (%s)", strerror(why));
    return LOBE_APP_FAILED;
}

static const char *name_of(char path[PATH_MAX], const char *folder, const char *kind, int index,
                           const char *ending) {
    snprintf(path, PATH_MAX, "%s/%s-%04d.%s", folder, kind, index, ending);
    return path;
}

lobe_ssr_result lobe_app_write_ssr_frame(const char *folder, int index, const lobe_ssr *ssr,
                                         const lobe_app_truth *truth, int width, int height) {
    const float *composite = lobe_ssr_composite(ssr), *radiance = lobe_ssr_radiance(ssr),
                *reflection = lobe_ssr_reflection(ssr);
    lobe_ssr_channel channels[14] = {{"R", composite, 3},
                                     {"G", composite + 1, 3},
                                     {"B", composite + 2, 3},
                                     {"radiance.R", radiance, 3},
                                     {"radiance.G", radiance + 1, 3},
                                     {"radiance.B", radiance + 2, 3},
                                     {"reflection.R", reflection, 4},
                                     {"reflection.G", reflection + 1, 4},
                                     {"reflection.B", reflection + 2, 4},
                                     {"reflection.A", reflection + 3, 4}};
    int count = 10;
    if (truth) {
        channels[count++] = (lobe_ssr_channel){"truth.R", truth->rgb, 3};
        channels[count++] = (lobe_ssr_channel){"truth.G", truth->rgb + 1, 3};
        channels[count++] = (lobe_ssr_channel){"truth.B", truth->rgb + 2, 3};
        channels[count++] = (lobe_ssr_channel){"truth.A", truth->on_screen, 1};
    }
    char path[PATH_MAX];
    lobe_ssr_result result = lobe_ssr_write_exr(name_of(path, folder, "frame", index, "exr"), width,
                                                height, channels, count, NULL);
    if (result == LOBE_SSR_OK)
        result = lobe_ssr_write_png(name_of(path, folder, "frame", index, "png"), width, height,
                                    composite, 3);
    return result;
}

int lobe_app_read_truth(const char *folder, int index, const char *key, lobe_app_truth *truth) {
    static const char *const names[] = {"R", "G", "B", "A"};
    const size_t count = (size_t)truth->width * (size_t)truth->height;
    float *planes = malloc(3 * count * sizeof *planes);
    if (!planes) return 0;
    float *const values[] = {planes, planes + count, planes + 2 * count, truth->on_screen};
    char path[PATH_MAX];
    const int is_read = lobe_ssr_read_exr(name_of(path, folder, "truth", index, "exr"),
                                          truth->width, truth->height, names, 4, key, values);
    for (size_t i = 0; is_read && i < 3 * count; i++) truth->rgb[i] = planes[i % 3 * count + i / 3];
    free(planes);
    return is_read;
}

lobe_ssr_result lobe_app_write_truth(const char *folder, int index, const char *key,
                                     const lobe_app_truth *truth) {
    const lobe_ssr_channel channels[4] = {{"R", truth->rgb, 3},
                                          {"G", truth->rgb + 1, 3},
                                          {"B", truth->rgb + 2, 3},
                                          {"A", truth->on_screen, 1}};
    char path[PATH_MAX];
    return lobe_ssr_write_exr(name_of(path, folder, "truth", index, "exr"), truth->width,
                              truth->height, channels, 4, key);
}

lobe_app_status lobe_app_write_stats(const char *folder, const json_t *stats) {
    char path[PATH_MAX], part[PATH_MAX];
    snprintf(path, sizeof path, "%s/stats.json", folder);
    snprintf(part, sizeof part, "%s/stats.json.part", folder);
    errno = 0;
    if (json_dump_file(stats, part, JSON_INDENT(1) | JSON_PRESERVE_ORDER) == 0 &&
        rename(part, path) == 0)
        return LOBE_APP_DONE;
    const int why = errno;
    remove(part);
    lobe_app_report(path, "choose another folder", "cannot be written (%s)", strerror(why));
    return LOBE_APP_FAILED;
}
