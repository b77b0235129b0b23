/* A picture of lobe_render back from OpenEXR, with the number of samples of every pixel. */
#ifndef LOBE_RENDER_EXR_FILM_H
#define LOBE_RENDER_EXR_FILM_H

#include "film.h"

/* The names of attributes and of the channel, for both directions. */
#define EXR_SCENE "lobe.scene"
#define EXR_METHOD "lobe.method"
#define EXR_SEED "lobe.seed"
#define EXR_SAMPLES "lobe.samples"
#define EXR_OPTIONS "lobe.options"
#define EXR_SAMPLES_LAYER "samples."
#define EXR_WEIGHTS_LAYER "weights." /* of adaptive pictures */

/* Components of a channel as letters: "RGB". */
const char *lobe_exr_components(lobe_aov aov);

/* What EXR_OPTIONS holds of a picture that is written at an exposure. */
enum { EXR_OPTIONS_ROOM = IDENTITY_ROOM + 32 };
void lobe_exr_options(char text[EXR_OPTIONS_ROOM], const char *identity, float exposure);

lobe_render_result lobe_exr_read_film(const char *path, lobe_film **film);

#endif
