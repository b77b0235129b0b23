/* app/options.h: the options of a command as a table, from which both the parser and --help work. */
#ifndef LOBE_APP_OPTIONS_H
#define LOBE_APP_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

#include "report.h"

typedef struct lobe_app_option lobe_app_option;

/* Stores `text` in `value`, or prints an error line and returns false. */
typedef bool lobe_app_reader(const lobe_app_option *option, const char *text, void *value);

struct lobe_app_option {
    const char *name;           /* "--alpha" */
    const char *argument;       /* "A[,AY]"; NULL: a flag */
    const char *preset;         /* the default as --help shows it, NULL: there is none */
    const char *help;           /* what it does, with the unit */
    lobe_app_reader *read;      /* NULL: sets a bool (flag) or a const char * (argument) */
    size_t offset;              /* of the value in the group's `values` */
    const char *const *choices; /* for lobe_app_read_choice, NULL at the end */
};

/* Options that belong together, and the struct they fill. A name of NULL ends the table. */
typedef struct lobe_app_group {
    const char *title;
    const lobe_app_option *options;
    void *values;
} lobe_app_group;

typedef struct lobe_app_command {
    const char *name;
    const char *usage; /* what follows the name */
    const char *about;
    const char *operand;          /* "SCENE"; "FILE...": any number; NULL: the command takes none */
    const lobe_app_group *groups; /* a title of NULL at the end */
    const char *example;
} lobe_app_command;

enum { LOBE_APP_OPTIONS_MAX = 64 };

typedef struct lobe_app_arguments {
    const char *operand; /* the first; NULL: not given */
    char **operands;     /* all, at the start of argv */
    int operand_count;
    const char *given[LOBE_APP_OPTIONS_MAX]; /* names of the options given, NULL at the end */
    bool is_answered;                        /* --help was asked for and printed */
} lobe_app_arguments;

/* argv[0] is the first argument after the command's name. Reorders argv. */
lobe_app_status lobe_app_parse(const lobe_app_command *command, int argc, char **argv,
                               lobe_app_arguments *arguments);

bool lobe_app_is_given(const lobe_app_arguments *arguments, const char *name);

/* Bad usage if both options are given. */
lobe_app_status lobe_app_exclude(const lobe_app_arguments *arguments, const char *name,
                                 const char *other);

typedef struct lobe_app_size {
    int width, height;
} lobe_app_size;

/* Readers: int index into `choices`; uint64_t, any value; finite double; const char *, not empty;
 * lobe_app_size. */
lobe_app_reader lobe_app_read_choice, lobe_app_read_count, lobe_app_read_u64, lobe_app_read_f64,
    lobe_app_read_name, lobe_app_read_size;

#endif
