/* app/explore.c: `lobe explore`: the page in the browser. */
#include <stdio.h>

#include <lobe/explore.h>

#include "browser.h"
#include "commands.h"
#include "interrupt.h"
#include "options.h"
#include "output.h"

enum { PORT = 8080, TRIES = 32, LAST_PORT = 65535 };

typedef struct explore_values {
    const char *folder;
    uint64_t port;
    bool no_open;
} explore_values;

static bool read_port(const lobe_app_option *option, const char *text, void *value) {
    if (lobe_app_read_u64(option, text, value)) {
        if (*(uint64_t *)value <= LAST_PORT) return true;
        lobe_app_report(option->name, "use 0 to 65535", "'%.60s' is out of range", text);
    }
    return false;
}

#define AT(member) offsetof(explore_values, member)

static const lobe_app_option serve_options[] = {
    {"--port", "N", "8080",
     "to serve on, or the next that is free; 0: any; only this machine is answered", read_port,
     AT(port), NULL},
    {"--no-open", NULL, NULL, "open no browser", NULL, AT(no_open), NULL},
    {0}};

static const lobe_app_option write_options[] = {
    {"-o", "DIR", NULL, "write the page into a new folder, for any web server, and stop",
     lobe_app_read_name, AT(folder), NULL},
    {0}};

static lobe_app_status status_of(lobe_explore_result result) {
    if (result == LOBE_EXPLORE_OK) return LOBE_APP_DONE;
    lobe_app_report_line(lobe_explore_error_message());
    return result == LOBE_EXPLORE_BAD_INPUT ? LOBE_APP_BAD_INPUT : LOBE_APP_FAILED;
}

/* On the first free port from the wished one on. */
static lobe_app_status start(int wished, lobe_explore_server **server) {
    int port = wished;
    lobe_explore_result result = lobe_explore_start(port, server);
    while (result == LOBE_EXPLORE_TAKEN && port < LAST_PORT && port < wished + TRIES)
        result = lobe_explore_start(++port, server);
    if (result == LOBE_EXPLORE_OK && port != wished) {
        char hint[32];
        snprintf(hint, sizeof hint, "serving on %d", port);
        lobe_app_report("--port", hint, "%d is taken by another program", wished);
    }
    return status_of(result);
}

static lobe_app_status serve(const explore_values *v) {
    lobe_explore_server *server = NULL;
    lobe_app_hold_interrupt(); /* before there are threads: theirs is the same mask */
    const lobe_app_status status = start((int)v->port, &server);
    if (status) return status;
    char address[64];
    snprintf(address, sizeof address, "http://127.0.0.1:%d/", lobe_explore_port(server));
    lobe_app_print("%s\n", address);
    lobe_app_flush();
    const bool is_shown = !v->no_open && lobe_app_open_browser(address);
    fprintf(stderr, "%s; Ctrl-C ends it.\n",
            is_shown ? "Opening the browser" : "Open the address in a browser");
    lobe_app_await_interrupt();
    lobe_explore_stop(server);
    return LOBE_APP_INTERRUPTED;
}

lobe_app_status lobe_app_explore(int argc, char **argv) {
    explore_values values = {.port = PORT};
    const lobe_app_group groups[] = {
        {"Serve", serve_options, &values}, {"Write", write_options, &values}, {0}};
    const lobe_app_command command = {
        "explore",
        "[--port N] [--no-open] | -o DIR",
        "The interactive page: lobes, samples, caps and pictures in the browser, computed by the "
        "library\nitself. Serves it to this machine alone until Ctrl-C, or writes it as static "
        "files.",
        NULL,
        groups,
        "lobe explore"};
    lobe_app_arguments arguments;
    lobe_app_status status = lobe_app_parse(&command, argc, argv, &arguments);
    if (status || arguments.is_answered) return status;
    if ((status = lobe_app_exclude(&arguments, "-o", "--port"))) return status;
    if ((status = lobe_app_exclude(&arguments, "-o", "--no-open"))) return status;
    return values.folder ? status_of(lobe_explore_write(values.folder)) : serve(&values);
}
