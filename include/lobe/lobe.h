/* lobe/lobe.h: all of the mathematics library. The renderer and the verifier have headers of their
 * own: lobe/render.h, lobe/verify.h. */
#ifndef LOBE_LOBE_H
#define LOBE_LOBE_H

#include "albedo.h"
#include "batch.h"
#include "dielectric.h"
#include "dielectric_batch.h"
#include "fresnel.h"
#include "reflection.h"
#include "methods.h"
#include "random.h"
#include "types.h"
#include "version.h"
#include "walk.h"

#endif
