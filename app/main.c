/* app/main.c: the program `lobe`: picks the command. */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include <lobe/batch.h>
#include <lobe/render.h>
#include <lobe/version.h>

#include "commands.h"
#include "output.h"

static const struct {
    const char *name;
    lobe_app_run *run;
    const char *about;
} commands[] = {
    {"sample", lobe_app_sample, "draw directions, with densities and weights"},
    {"eval", lobe_app_eval, "evaluate densities and values at given directions"},
    {"albedo", lobe_app_albedo, "integrate what a microsurface reflects"},
    {"verify", lobe_app_verify, "prove models and methods by statistics"},
    {"bench", lobe_app_bench, "time every model"},
    {"info", lobe_app_info, "tell what is in a scene"},
    {"render", lobe_app_render, "path-trace a scene"},
    {"compare", lobe_app_compare, "tell which method is better on a scene, or pictures apart"},
    {"merge", lobe_app_merge, "join renders of several seeds or parts"},
    {"figure", lobe_app_figure, "draw a figure of the papers"},
    {"explore", lobe_app_explore, "see it all in the browser, interactively"},
    {"ssr", lobe_app_ssr, "reflect what is on the screen, and judge it by real rays"},
};

enum { COMMANDS = sizeof commands / sizeof commands[0] };

static lobe_app_status print_help(void) {
    lobe_app_print("Usage: lobe COMMAND [OPTIONS]\n\n"
                   "Microfacet reflection: sampled, evaluated, proven, rendered.\n\nCommands\n");
    for (int i = 0; i < COMMANDS; i++)
        lobe_app_print("  %-10s%s\n", commands[i].name, commands[i].about);
    lobe_app_print("\n  --help    this page; lobe COMMAND --help has the options\n"
                   "  --version the version, the instruction set in use and the MPI library\n\n"
                   "Exit status: 0 done, 1 failed while running, 2 bad usage or input,\n"
                   "3 a verification or comparison did not hold, 130 interrupted.\n\n"
                   "Example\n  lobe sample --alpha 0.3 --wi 0.6,0,0.8 --count 5\n");
    return LOBE_APP_DONE;
}

static lobe_app_status print_version(void) {
    lobe_app_print("lobe %s\nvectors: %s, of", LOBE_VERSION_STRING, lobe_isa());
    for (int i = 0; lobe_isa_at(i); i++) lobe_app_print(" %s", lobe_isa_at(i));
    lobe_app_print("\nMPI: %s\n", lobe_ranks_library() ? lobe_ranks_library() : "none");
    return LOBE_APP_DONE;
}

static lobe_app_status reject_command(const char *name) {
    const char *names[COMMANDS + 1] = {0};
    for (int i = 0; i < COMMANDS; i++) names[i] = commands[i].name;
    const char *nearest = lobe_app_nearest(name, names);
    char hint[64];
    snprintf(hint, sizeof hint, nearest ? "did you mean %s?" : "see lobe --help", nearest);
    return lobe_app_reject(name, hint, "unknown command");
}

static lobe_app_status run(int argc, char **argv) {
    if (argc < 2) return lobe_app_reject("command line", "see lobe --help", "no command");
    if (strcmp(argv[1], "--help") == 0) return print_help();
    if (strcmp(argv[1], "--version") == 0) return print_version();
    for (int i = 0; i < COMMANDS; i++)
        if (strcmp(argv[1], commands[i].name) == 0) return commands[i].run(argc - 2, argv + 2);
    return reject_command(argv[1]);
}

/* A file opened later must not take the number of a closed standard stream: text meant for the user
 * would land in it. */
static void fill_standard_streams(void) {
    int file;
    do file = open("/dev/null", O_RDONLY | O_CLOEXEC);
    while (file >= 0 && file <= 2);
}

int main(int argc, char **argv) {
    fill_standard_streams();
    signal(SIGPIPE, SIG_IGN); /* a reader that went away must not stop a render from being saved */
    return (int)lobe_app_finish_output(run(argc, argv));
}
