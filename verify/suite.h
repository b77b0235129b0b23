/* The list of what is verified: the library's models or those of a plugin, by their names. */
#ifndef LOBE_VERIFY_SUITE_H
#define LOBE_VERIFY_SUITE_H

#include <stddef.h>
#include <stdint.h>

#include <lobe/verify.h>

typedef struct lobe_case_title {
    char model[48];
    char configuration[256];
} lobe_case_title;

typedef struct lobe_suite {
    lobe_case_title *titles; /* of every case */
    size_t count;
    size_t *chosen; /* indices of those to run, in order */
    size_t chosen_count;
} lobe_suite;

/* Chooses by `only` and level; on failure frees the titles. Returns 0 without memory. */
int lobe_suite_choose(lobe_suite *suite, const lobe_verify_options *options);
void lobe_suite_free(lobe_suite *suite);

/* The library's own cases. Returns 0 without memory. */
int lobe_library_suite(lobe_suite *suite);

/* FNV-1a of bytes, going on from `hash`. */
uint64_t lobe_hash(uint64_t hash, const void *bytes, size_t size);
extern const uint64_t LOBE_HASH_SEED;

/* A case draws the same numbers wherever it stands in the list. */
uint64_t lobe_title_stream(const lobe_case_title *title);

#endif
