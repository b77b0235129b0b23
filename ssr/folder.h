/* A folder of frames: what gbuffer.json says, and the pictures of the present frame. */
#ifndef LOBE_SSR_ROOM_FOLDER_H
#define LOBE_SSR_ROOM_FOLDER_H

#include "lobe/ssr_folder.h"

#define FOLDER_FORMAT "lobe-gbuffer"

enum { FOLDER_FRAMES_MAX = 1000000, FOLDER_PATH = 4096 };

typedef struct folder_frame {
    const char *file; /* of the JSON text in memory */
    lobe_ssr_camera camera, previous;
} folder_frame;

struct lobe_ssr_folder {
    char path[FOLDER_PATH];
    void *json; /* json_t: keeps the names of the files */
    int width, height, count;
    folder_frame *frames;
    const char *environment_file;     /* NULL: none */
    lobe_ssr_environment environment; /* its sizes, and the light once it is read */
    float *light;
    lobe_ssr_frame frame; /* the present one */
    float *z, *normal, *roughness, *f0, *motion, *motion_z, *color, *tangent, *anisotropy,
        *mask_values;
    unsigned char *mask;
};

/* Fills all but the pictures from gbuffer.json. */
lobe_ssr_result lobe_ssr_folder_parse(lobe_ssr_folder *f);

/* "FOLDER/NAME"; 0: too long. */
int lobe_ssr_folder_name(char path[FOLDER_PATH], const char *folder, const char *name);

#endif
