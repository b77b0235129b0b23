#include "machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const size_t COPY_BYTES = (size_t)128 << 20;

double machine_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void machine_name(char *name, size_t room) {
    snprintf(name, room, "unknown processor");
    FILE *file = fopen("/proc/cpuinfo", "r");
    if (file == NULL) return;
    char line[256];
    while (fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) != 0 || colon == NULL) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, room, "%.*s", (int)room - 1, colon + 2);
        break;
    }
    fclose(file);
}

double machine_copy_rate(int rounds) {
    char *from = malloc(COPY_BYTES), *to = malloc(COPY_BYTES);
    double best = 0;
    if (from != NULL && to != NULL) {
        memset(from, 1, COPY_BYTES);
        memset(to, 2, COPY_BYTES);
        for (int round = 0; round < rounds; ++round) {
            double start = machine_seconds();
            memcpy(to, from, COPY_BYTES);
            double rate = 2 * (double)COPY_BYTES / (machine_seconds() - start);
            if (rate > best) best = rate;
        }
    }
    free(from);
    free(to);
    return best;
}
