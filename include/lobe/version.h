/* lobe/version.h: the one place for the version; the build reads it from here. */
#ifndef LOBE_VERSION_H
#define LOBE_VERSION_H

#define LOBE_VERSION_MAJOR 0
#define LOBE_VERSION_MINOR 1
#define LOBE_VERSION_PATCH 0
#define LOBE_VERSION_STRING "0.1.0"

#endif
