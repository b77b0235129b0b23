/* The list of extra channels, by name. */
#include <string.h>

#include "lobe/render.h"

static const struct {
    const char *name, *about;
    int channels;
} aovs[LOBE_AOV_COUNT] = {
#define AOV_ROW(ID, name, channels, about) [LOBE_AOV_##ID] = {name, about, channels},
    LOBE_AOVS(AOV_ROW)
#undef AOV_ROW
};

static int in_range(lobe_aov aov) {
    return (unsigned)aov < LOBE_AOV_COUNT;
}

lobe_aov lobe_aov_from_name(const char *name) {
    for (int i = 0; i < LOBE_AOV_COUNT; i++)
        if (strcmp(aovs[i].name, name) == 0) return (lobe_aov)i;
    return LOBE_AOV_COUNT;
}

const char *lobe_aov_name(lobe_aov aov) {
    return in_range(aov) ? aovs[aov].name : NULL;
}

const char *lobe_aov_about(lobe_aov aov) {
    return in_range(aov) ? aovs[aov].about : NULL;
}

int lobe_aov_channels(lobe_aov aov) {
    return in_range(aov) ? aovs[aov].channels : 0;
}
