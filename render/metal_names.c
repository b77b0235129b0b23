/* Metals by name: n and k at 650, 550 and 450 nm, for red, green and blue, linearly between the rows of the
 * published tables. Gold, silver, copper: Johnson & Christy, Phys. Rev. B 6, 4370 (1972); iron, titanium, chromium,
 * nickel: the same, Phys. Rev. B 9, 5056 (1974); aluminium: Rakic, Appl. Opt. 34, 4755 (1995). */
#include "lobe/render.h"

#include <string.h>

static const struct {
    const char *name;
    float n[3], k[3];
} metals[] = {{"aluminium", {1.558f, 1.015f, 0.633f}, {7.712f, 6.627f, 5.454f}},
              {"chromium", {3.107f, 3.181f, 2.323f}, {3.331f, 3.329f, 3.135f}},
              {"copper", {0.238f, 1.007f, 1.240f}, {3.626f, 2.582f, 2.393f}},
              {"gold", {0.156f, 0.424f, 1.383f}, {3.602f, 2.472f, 1.915f}},
              {"iron", {2.911f, 2.950f, 2.584f}, {3.089f, 2.932f, 2.767f}},
              {"nickel", {1.990f, 1.921f, 1.729f}, {4.209f, 3.616f, 2.944f}},
              {"silver", {0.052f, 0.060f, 0.040f}, {4.409f, 3.597f, 2.648f}},
              {"titanium", {2.741f, 2.542f, 2.267f}, {3.814f, 3.435f, 3.038f}}};

enum { METALS = sizeof metals / sizeof *metals };

const char *lobe_metal_name(size_t index) {
    return index < METALS ? metals[index].name : NULL;
}

int lobe_metal_from_name(const char *name, lobe_metal *metal) {
    for (size_t i = 0; i < METALS; i++)
        if (strcmp(metals[i].name, name) == 0) {
            *metal = (lobe_metal){.law = LOBE_METAL_CONDUCTOR};
            memcpy(metal->n, metals[i].n, sizeof metal->n);
            memcpy(metal->k, metals[i].k, sizeof metal->k);
            return 1;
        }
    return 0;
}
