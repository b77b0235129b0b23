/* app/ssr_write.h: the files of `lobe ssr` in its folder. */
#ifndef LOBE_APP_SSR_WRITE_H
#define LOBE_APP_SSR_WRITE_H

#include <jansson.h>
#include <lobe/ssr_frames.h>

#include "report.h"

/* The truth about a frame, rgb and the share from the screen, in one allocation. */
typedef struct lobe_app_truth {
    int width, height;
    float *rgb;       /* width * height * 3 */
    float *on_screen; /* width * height */
} lobe_app_truth;

/* Makes the folder if there is none. */
lobe_app_status lobe_app_make_folder(const char *folder);

/* FOLDER/frame-NNNN.exr and .png, with the truth if `truth` is not NULL. */
lobe_ssr_result lobe_app_write_ssr_frame(const char *folder, int index, const lobe_ssr *ssr,
                                         const lobe_app_truth *truth, int width, int height);

/* FOLDER/truth-NNNN.exr, kept from run to run: the key says what it belongs to. */
int lobe_app_read_truth(const char *folder, int index, const char *key, lobe_app_truth *truth);
lobe_ssr_result lobe_app_write_truth(const char *folder, int index, const char *key,
                                     const lobe_app_truth *truth);

/* FOLDER/stats.json. */
lobe_app_status lobe_app_write_stats(const char *folder, const json_t *stats);

#endif
