/* Somebody else's BSDF, through lobe/plugin.h. */
#ifndef LOBE_VERIFY_PLUGIN_H
#define LOBE_VERIFY_PLUGIN_H

#include <lobe/plugin.h>

#include "model.h"
#include "suite.h"

/* What a plugin says of itself, as plain bytes: this process never loads it. */
typedef struct lobe_plugin_facts {
    char name[32];
    char parameter_name[LOBE_PLUGIN_PARAMETERS][16];
    lobe_plugin plugin; /* its pointers are of no use here */
} lobe_plugin_facts;

typedef struct lobe_plugin_file {
    const char *path;
    uint64_t hash; /* of its bytes */
    lobe_plugin_facts facts;
} lobe_plugin_file;

/* Loads and describes the plugin in a process of its own. Returns 0 with a message, "FILE: WHAT;
 * HINT". */
int lobe_plugin_read(lobe_plugin_file *file, const char *path, char *message, size_t room);

/* Parameters at both ends, in the middle and between, under several incidences. Returns 0 without
 * memory. */
int lobe_plugin_suite(lobe_suite *suite, const lobe_plugin_file *file);

/* In the process that may die: loads the file; NULL with a message. */
const lobe_plugin *lobe_plugin_load(const char *path, char *message, size_t room);

/* The index-th case of the suite. Stays where it is made: the model points into it. */
typedef struct lobe_plugin_subject {
    const lobe_plugin *plugin;
    lobe_plugin_block block;
    lobe_verify_model model;
} lobe_plugin_subject;

void lobe_plugin_subject_make(lobe_plugin_subject *subject, const lobe_plugin *plugin,
                              size_t index);

#endif
