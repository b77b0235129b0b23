/* app/metal.h: the option --metal of pictures. */
#ifndef LOBE_APP_METAL_H
#define LOBE_APP_METAL_H

#include <lobe/render.h>

#include "options.h"

lobe_app_reader lobe_app_read_metal; /* value: lobe_metal */

#endif
