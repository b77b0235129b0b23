#include "options.h"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include "number.h"
#include "output.h"

enum { HELP_COLUMN = 30, HELP_WIDTH = 96 };

/* ---- Help ------------------------------------------------------------------------------------ */

/* Prints words from the present column on, and goes on below HELP_COLUMN. */
static void print_wrapped(const char *text, size_t column) {
    const char *gap = "";
    while (*text) {
        const size_t length = strcspn(text, " ");
        if (*gap && column + 1 + length > HELP_WIDTH) {
            lobe_app_print("\n%*s", HELP_COLUMN, "");
            column = HELP_COLUMN;
            gap = "";
        }
        lobe_app_print("%s%.*s", gap, (int)length, text);
        column += strlen(gap) + length;
        text += length;
        text += *text == ' ';
        gap = " ";
    }
}

static void print_option(const lobe_app_option *option) {
    char left[128], right[1024];
    snprintf(left, sizeof left, "  %s%s%s", option->name, option->argument ? " " : "",
             option->argument ? option->argument : "");
    size_t used = (size_t)snprintf(right, sizeof right, "%s", option->help);
    for (int i = 0; option->choices && option->choices[i] && used < sizeof right; i++)
        used += (size_t)snprintf(right + used, sizeof right - used, "%s%s", i ? ", " : ": ",
                                 option->choices[i]);
    if (option->preset && used < sizeof right)
        snprintf(right + used, sizeof right - used, " [%s]", option->preset);

    lobe_app_print("%-*s", HELP_COLUMN, left);
    if (strlen(left) >= HELP_COLUMN) lobe_app_print("\n%*s", HELP_COLUMN, "");
    print_wrapped(right, HELP_COLUMN);
    lobe_app_print("\n");
}

static void print_help(const lobe_app_command *command) {
    lobe_app_print("Usage: lobe %s %s\n\n%s\n", command->name, command->usage, command->about);
    for (const lobe_app_group *group = command->groups; group->title; group++) {
        lobe_app_print("\n%s\n", group->title);
        for (const lobe_app_option *option = group->options; option->name; option++)
            print_option(option);
    }
    lobe_app_print("\n  %-*s%s\n\nDefaults stand in [brackets].\n\nExample\n  %s\n",
                   HELP_COLUMN - 2, "--help", "this page", command->example);
}

/* ---- Parsing --------------------------------------------------------------------------------- */

static const lobe_app_option *find_option(const lobe_app_command *command, const char *name,
                                          void **values) {
    for (const lobe_app_group *group = command->groups; group->title; group++)
        for (const lobe_app_option *option = group->options; option->name; option++)
            if (strcmp(option->name, name) == 0) {
                *values = group->values;
                return option;
            }
    return NULL;
}

static lobe_app_status reject_unknown(const lobe_app_command *command, const char *name) {
    const char *names[LOBE_APP_OPTIONS_MAX + 2];
    int count = 0;
    for (const lobe_app_group *group = command->groups; group->title; group++)
        for (const lobe_app_option *option = group->options; option->name; option++)
            if (count < LOBE_APP_OPTIONS_MAX) names[count++] = option->name;
    names[count++] = "--help";
    names[count] = NULL;

    char hint[96];
    const char *nearest = lobe_app_nearest(name, names);
    if (nearest)
        snprintf(hint, sizeof hint, "did you mean %s?", nearest);
    else
        snprintf(hint, sizeof hint, "see lobe %s --help", command->name);
    return lobe_app_reject(name, hint, "unknown option of lobe %s", command->name);
}

static lobe_app_status note_given(lobe_app_arguments *arguments, const char *name) {
    if (lobe_app_is_given(arguments, name))
        return lobe_app_reject(name, "give it once", "given twice");
    int count = 0;
    while (arguments->given[count]) count++;
    arguments->given[count] = name;
    return LOBE_APP_DONE;
}

/* Reads argv[*index], "--name", "--name VALUE" or "--name=VALUE", and steps over it. */
static lobe_app_status parse_option(const lobe_app_command *command, int argc, char **argv,
                                    int *index, lobe_app_arguments *arguments) {
    char name[64];
    const char *argument = argv[(*index)++];
    const size_t length = strcspn(argument, "=");
    snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1),
             argument);
    const char *text = argument[length] == '=' ? argument + length + 1 : NULL;

    void *values;
    const lobe_app_option *option = find_option(command, name, &values);
    if (!option) return reject_unknown(command, name);
    if (note_given(arguments, option->name)) return LOBE_APP_BAD_INPUT;

    void *value = (char *)values + option->offset;
    if (!option->argument) {
        if (text) return lobe_app_reject(name, "write the option alone", "takes no value");
        *(bool *)value = true;
        return LOBE_APP_DONE;
    }
    if (!text && *index < argc) text = argv[(*index)++];
    if (!text) {
        char hint[96];
        snprintf(hint, sizeof hint, "write %s %s", name, option->argument);
        return lobe_app_reject(name, hint, "the value is missing");
    }
    return option->read(option, text, value) ? LOBE_APP_DONE : LOBE_APP_BAD_INPUT;
}

static lobe_app_status take_operand(const lobe_app_command *command, char *text,
                                    lobe_app_arguments *arguments) {
    char hint[96];
    snprintf(hint, sizeof hint, "see lobe %s --help", command->name);
    if (!command->operand || *text == '\0')
        return lobe_app_reject(*text ? text : "''", hint, "unexpected argument");
    if (arguments->operand && !strstr(command->operand, "..."))
        return lobe_app_reject(text, hint, "a second %s", command->operand);
    if (!arguments->operand) arguments->operand = text;
    arguments->operands[arguments->operand_count++] = text;
    return LOBE_APP_DONE;
}

lobe_app_status lobe_app_parse(const lobe_app_command *command, int argc, char **argv,
                               lobe_app_arguments *arguments) {
    *arguments = (lobe_app_arguments){.operands = argv};
    bool has_options = true;
    for (int i = 0; i < argc;) {
        const char *text = argv[i];
        const bool is_option = has_options && text[0] == '-' && text[1] != '\0';
        lobe_app_status status = LOBE_APP_DONE;
        if (is_option && strcmp(text, "--help") == 0) {
            print_help(command);
            arguments->is_answered = true;
            return LOBE_APP_DONE;
        }
        if (is_option && strcmp(text, "--") == 0) {
            has_options = false;
            i++;
        } else if (is_option) {
            status = parse_option(command, argc, argv, &i, arguments);
        } else {
            status = take_operand(command, argv[i++], arguments);
        }
        if (status) return status;
    }
    return LOBE_APP_DONE;
}

bool lobe_app_is_given(const lobe_app_arguments *arguments, const char *name) {
    for (const char *const *given = arguments->given; *given; given++)
        if (strcmp(*given, name) == 0) return true;
    return false;
}

lobe_app_status lobe_app_exclude(const lobe_app_arguments *arguments, const char *name,
                                 const char *other) {
    if (!lobe_app_is_given(arguments, name) || !lobe_app_is_given(arguments, other))
        return LOBE_APP_DONE;
    return lobe_app_reject(name, "give only one of the two", "contradicts %s", other);
}

/* ---- Readers --------------------------------------------------------------------------------- */

bool lobe_app_read_choice(const lobe_app_option *option, const char *text, void *value) {
    char hint[256] = "choose ";
    for (int i = 0; option->choices[i]; i++) {
        if (strcmp(option->choices[i], text) == 0) {
            *(int *)value = i;
            return true;
        }
        const size_t used = strlen(hint);
        snprintf(hint + used, sizeof hint - used, "%s%s", i ? ", " : "", option->choices[i]);
    }
    lobe_app_report(option->name, hint, "there is no '%.60s'", text);
    return false;
}

bool lobe_app_read_u64(const lobe_app_option *option, const char *text, void *value) {
    if (lobe_app_read_integer(text, value)) return true;
    lobe_app_report(option->name, "give a whole number from 0 to 18446744073709551615",
                    "'%.60s' is not one", text);
    return false;
}

bool lobe_app_read_count(const lobe_app_option *option, const char *text, void *value) {
    uint64_t *count = value;
    if (lobe_app_read_integer(text, count) && *count >= 1 && *count <= UINT64_C(1000000000000000))
        return true;
    lobe_app_report(option->name, "give a whole number from 1 to 1000000000000000",
                    "'%.60s' is not one", text);
    return false;
}

bool lobe_app_read_f64(const lobe_app_option *option, const char *text, void *value) {
    if (lobe_app_read_number(text, value)) return true;
    lobe_app_report(option->name, "give a finite decimal number", "'%.60s' is not one", text);
    return false;
}

bool lobe_app_read_name(const lobe_app_option *option, const char *text, void *value) {
    if (*text) {
        *(const char **)value = text;
        return true;
    }
    lobe_app_report(option->name, "give a name", "the value is empty");
    return false;
}

bool lobe_app_read_size(const lobe_app_option *option, const char *text, void *value) {
    lobe_app_size *size = value;
    char extra;
    if (strspn(text, "0123456789x") == strlen(text) && strlen(text) < 12 &&
        sscanf(text, "%dx%d%c", &size->width, &size->height, &extra) == 2)
        return true;
    lobe_app_report(option->name, "give pixels as 960x540", "'%.40s' is not a size", text);
    return false;
}
