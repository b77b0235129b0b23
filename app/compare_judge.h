/* app/compare_judge.h: makes the pictures of a comparison: renders them, or reads two files. */
#ifndef LOBE_APP_COMPARE_JUDGE_H
#define LOBE_APP_COMPARE_JUDGE_H

#include "comparison.h"
#include "view.h"

typedef struct lobe_app_judge {
    lobe_app_view view;
    const char *source;    /* scene */
    const char *reference; /* file; NULL: render it */
    const char *folder;    /* for the pictures; NULL: none are kept */
    uint64_t spp[LOBE_APP_SIZES_MAX];
    uint64_t reference_spp; /* 0: sixteen times the most samples */
    int progress;           /* lobe_app_progress_mode */
} lobe_app_judge;

/* Fills the cells. LOBE_APP_INTERRUPTED: with what was finished, which is nothing if c->reference is NULL. */
lobe_app_status lobe_app_judge_scene(const lobe_app_judge *judge, lobe_app_comparison *c);

/* The one picture of `c` against the other file. */
lobe_app_status lobe_app_judge_files(const char *picture, const char *reference,
                                     lobe_app_comparison *c);

/* "FOLDER/NAME-SPPspp.ENDING"; a size of -1: the reference. */
void lobe_app_picture_path(const lobe_app_comparison *c, int contender, int size,
                           const char *folder, const char *ending, char *path, size_t length);

/* Writes .exr and .png of `rgb`. */
lobe_app_status lobe_app_save_picture(const lobe_app_comparison *c, const char *folder,
                                      int contender, int size, const float *rgb);

#endif
