#define _POSIX_C_SOURCE 200809L

#include "suite.h"

#include <fnmatch.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "library_cases.h"

enum { PATTERN_ROOM = 256 };

const uint64_t LOBE_HASH_SEED = 14695981039346656037u;

uint64_t lobe_hash(uint64_t hash, const void *bytes, size_t size) {
    const unsigned char *b = bytes;
    for (size_t i = 0; i < size; ++i) hash = (hash ^ b[i]) * 1099511628211u;
    return hash;
}

uint64_t lobe_title_stream(const lobe_case_title *title) {
    uint64_t hash = lobe_hash(LOBE_HASH_SEED, title->model, strlen(title->model));
    return lobe_hash(hash, title->configuration, strlen(title->configuration));
}

static int matches(const char *only, const lobe_case_title *title) {
    char text[sizeof *title + 2], pattern[PATTERN_ROOM];
    if (strlen(only) >= PATTERN_ROOM - 2) return 0;
    snprintf(text, sizeof text, "%s %s", title->model, title->configuration);
    snprintf(pattern, sizeof pattern, "*%s*", only);
    return fnmatch(pattern, text, 0) == 0;
}

/* How many models have a case at this configuration: those of a kind share their configurations. */
static size_t count_alike(const lobe_suite *suite, const char *configuration) {
    size_t alike = 0;
    for (size_t i = 0; i < suite->count; ++i)
        alike += strcmp(suite->titles[i].configuration, configuration) == 0;
    return alike;
}

/* Every stride-th case of each model, shifted by one from model to model. Where fewer models share a
 * configuration, one of them has it all the same. */
static void choose_spread(lobe_suite *suite, size_t stride) {
    size_t model = 0, position = 0;
    for (size_t i = 0; i < suite->count; ++i) {
        if (i > 0 && strcmp(suite->titles[i].model, suite->titles[i - 1].model) != 0) {
            model += 1;
            position = 0;
        }
        size_t alike = count_alike(suite, suite->titles[i].configuration);
        if ((position + model) % (alike < stride ? alike : stride) == 0)
            suite->chosen[suite->chosen_count++] = i;
        position += 1;
    }
}

int lobe_suite_choose(lobe_suite *suite, const lobe_verify_options *options) {
    suite->chosen = malloc((suite->count + 1) * sizeof *suite->chosen);
    suite->chosen_count = 0;
    if (suite->chosen == NULL) {
        lobe_suite_free(suite);
        return 0;
    }
    if (options->only != NULL) {
        for (size_t i = 0; i < suite->count; ++i) {
            if (!matches(options->only, &suite->titles[i])) continue;
            suite->chosen[suite->chosen_count++] = i;
        }
    } else {
        size_t most = options->level == LOBE_VERIFY_FULL ? LOBE_VERIFY_FULL_CASES : suite->count;
        choose_spread(suite, most > 0 ? (suite->count + most - 1) / most : 1);
    }
    return 1;
}

void lobe_suite_free(lobe_suite *suite) {
    free(suite->titles);
    free(suite->chosen);
    *suite = (lobe_suite){0};
}

int lobe_library_suite(lobe_suite *suite) {
    *suite = (lobe_suite){.count = lobe_library_case_count()};
    suite->titles = malloc(suite->count * sizeof *suite->titles);
    if (suite->titles == NULL) return 0;
    for (size_t i = 0; i < suite->count; ++i) lobe_library_case_title(i, &suite->titles[i]);
    return 1;
}
