#include "browser.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <unistd.h>

extern char **environ;

/* The browser gets signals as they were before this program changed them, and a group of its own: Ctrl-C on
 * the terminal is not meant for it. */
static int spawn(char *const argv[], posix_spawn_file_actions_t *files,
                 posix_spawnattr_t *attributes) {
    sigset_t none, changed;
    sigemptyset(&none);
    sigemptyset(&changed);
    sigaddset(&changed, SIGPIPE);
    posix_spawnattr_setsigmask(attributes, &none);
    posix_spawnattr_setsigdefault(attributes, &changed);
    posix_spawnattr_setpgroup(attributes, 0);
    posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                             POSIX_SPAWN_SETPGROUP);
    posix_spawn_file_actions_addopen(files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(files, STDOUT_FILENO, STDERR_FILENO);
    pid_t child;
    return posix_spawnp(&child, argv[0], files, attributes, argv, environ);
}

static bool is_set(const char *name) {
    const char *value = getenv(name);
    return value && *value;
}

bool lobe_app_open_browser(const char *address) {
    if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY")) return false;
    char name[] = "xdg-open", *const argv[] = {name, (char *)(size_t)address, NULL};
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&files) != 0) return false;
    bool is_open = false;
    if (posix_spawnattr_init(&attributes) == 0) {
        is_open = spawn(argv, &files, &attributes) == 0;
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&files);
    return is_open;
}
