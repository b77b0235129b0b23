/* The page over HTTP. What is asked for is looked up in a table of names; no path ever reaches a file
 * system. */
#include <arpa/inet.h>
#include <errno.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "page.h"
#include "type.h"

enum { CONNECTIONS = 64, SILENCE_S = 5, CONNECTION_BYTES = 16384 };

struct lobe_explore_server {
    struct MHD_Daemon *daemon;
    struct MHD_Response *unknown, *method, *host;
    struct MHD_Response **files; /* one a file of the page */
    int port;
};

/* The page brings its scripts, styles and WebAssembly as files, talks to nobody, and stands in no frame.
 * Isolated from other origins it gets a clock that is fine enough to time itself. */
static const struct {
    const char *name, *value;
} headers[] = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' "
     "data: blob:; font-src 'self'; connect-src 'self'; worker-src 'self'; manifest-src 'self'; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Embedder-Policy", "require-corp"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Permissions-Policy", "camera=(), geolocation=(), microphone=()"},
    {"Cache-Control", "no-cache"}}; /* the next version of the program brings another page */

static struct MHD_Response *make_response(const void *bytes, size_t size, const char *type) {
    /* The library's interface lacks a const; it does not write to persistent memory. */
    struct MHD_Response *response =
        MHD_create_response_from_buffer(size, (void *)(size_t)bytes, MHD_RESPMEM_PERSISTENT);
    int is_good = response && MHD_add_response_header(response, "Content-Type", type) == MHD_YES;
    for (size_t k = 0; is_good && k < sizeof headers / sizeof headers[0]; k++)
        is_good = MHD_add_response_header(response, headers[k].name, headers[k].value) == MHD_YES;
    if (is_good || !response) return response;
    MHD_destroy_response(response);
    return NULL;
}

static struct MHD_Response *make_text(const char *text) {
    return make_response(text, strlen(text), "text/plain; charset=utf-8");
}

static int make_responses(lobe_explore_server *s) {
    s->files = calloc((size_t)lobe_page_count, sizeof *s->files);
    if (!s->files) return 0;
    for (int k = 0; k < lobe_page_count; k++) {
        const page_file *file = &lobe_page_files[k];
        s->files[k] = make_response(file->bytes, file->size, lobe_type_of(file->name));
        if (!s->files[k]) return 0;
    }
    s->unknown = make_text("There is no such file.\n");
    s->host = make_text("This address is known as 127.0.0.1 or localhost.\n");
    s->method = make_text("Only GET and HEAD are answered.\n");
    return s->unknown && s->host && s->method &&
           MHD_add_response_header(s->method, "Allow", "GET, HEAD") == MHD_YES;
}

/* A page from elsewhere can give its own name this address, and would then be of one origin with what it
 * fetches. No host: HTTP/1.0. */
static int is_own_host(const char *host) {
    static const char *const names[] = {"127.0.0.1", "localhost"};
    if (!host) return 1;
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        const size_t length = strlen(names[k]);
        if (strncmp(host, names[k], length) == 0 && (host[length] == ':' || !host[length]))
            return 1;
    }
    return 0;
}

static struct MHD_Response *find_file(const lobe_explore_server *s, const char *url) {
    const char *name = strcmp(url, "/") == 0 ? "index.html" : url + 1;
    for (int k = 0; url[0] == '/' && k < lobe_page_count; k++)
        if (strcmp(name, lobe_page_files[k].name) == 0) return s->files[k];
    return NULL;
}

/* Answered before its body is read, so that the connection ends with it. */
static int has_body(struct MHD_Connection *connection) {
    return MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Content-Length") ||
           MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Transfer-Encoding");
}

static enum MHD_Result answer(void *user, struct MHD_Connection *connection, const char *url,
                              const char *method, const char *version, const char *upload,
                              size_t *upload_size, void **request) {
    const lobe_explore_server *s = user;
    static int seen;
    (void)version, (void)upload, (void)upload_size;
    if (!*request && !has_body(connection)) {
        *request = &seen; /* an answer at the first call would end the connection */
        return MHD_YES;
    }
    if (strcmp(method, MHD_HTTP_METHOD_GET) != 0 && strcmp(method, MHD_HTTP_METHOD_HEAD) != 0)
        return MHD_queue_response(connection, MHD_HTTP_METHOD_NOT_ALLOWED, s->method);
    if (!is_own_host(MHD_lookup_connection_value(connection, MHD_HEADER_KIND, "Host")))
        return MHD_queue_response(connection, MHD_HTTP_MISDIRECTED_REQUEST, s->host);
    struct MHD_Response *file = find_file(s, url);
    return MHD_queue_response(connection, file ? MHD_HTTP_OK : MHD_HTTP_NOT_FOUND,
                              file ? file : s->unknown);
}

/* Names are compared as they come: the page's own need no escapes. */
static size_t keep_escapes(void *user, struct MHD_Connection *connection, char *text) {
    (void)user, (void)connection;
    return strlen(text);
}

static lobe_explore_result listen_on(lobe_explore_server *s, int port) {
    struct sockaddr_in address = {.sin_family = AF_INET,
                                  .sin_port = htons((uint16_t)port),
                                  .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    errno = 0;
    s->daemon = MHD_start_daemon(
        MHD_USE_AUTO_INTERNAL_THREAD, (uint16_t)port, NULL, NULL, answer, s, MHD_OPTION_SOCK_ADDR,
        (struct sockaddr *)&address, MHD_OPTION_CONNECTION_LIMIT, (unsigned)CONNECTIONS,
        MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)SILENCE_S, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
        (size_t)CONNECTION_BYTES, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_UNESCAPE_CALLBACK,
        keep_escapes, NULL, MHD_OPTION_END);
    if (s->daemon) {
        s->port = MHD_get_daemon_info(s->daemon, MHD_DAEMON_INFO_BIND_PORT)->port;
        return LOBE_EXPLORE_OK;
    }
    if (errno == EADDRINUSE)
        return lobe_explore_fail(LOBE_EXPLORE_TAKEN,
                                 "port %d: taken by another program; give another", port);
    if (errno == EACCES)
        return lobe_explore_fail(LOBE_EXPLORE_BAD_INPUT,
                                 "port %d: reserved for the system; use 1024 or above", port);
    return lobe_explore_fail(LOBE_EXPLORE_FAILED, "port %d: cannot be served (%s); give another",
                             port, errno ? strerror(errno) : "unknown error");
}

lobe_explore_result lobe_explore_start(int port, lobe_explore_server **server) {
    *server = NULL;
    const lobe_explore_result page = lobe_explore_check_page();
    if (page) return page;
    if (port < 0 || port > 65535)
        return lobe_explore_fail(LOBE_EXPLORE_BAD_INPUT, "port %d: out of range; use 0 to 65535",
                                 port);
    lobe_explore_server *s = calloc(1, sizeof *s);
    const lobe_explore_result result =
        s && make_responses(s)
            ? listen_on(s, port)
            : lobe_explore_fail(LOBE_EXPLORE_FAILED, "explore: out of memory; free some");
    if (result)
        lobe_explore_stop(s);
    else
        *server = s;
    return result;
}

int lobe_explore_port(const lobe_explore_server *server) {
    return server->port;
}

static void free_response(struct MHD_Response *response) {
    if (response) MHD_destroy_response(response);
}

void lobe_explore_stop(lobe_explore_server *server) {
    if (!server) return;
    if (server->daemon) MHD_stop_daemon(server->daemon);
    for (int k = 0; server->files && k < lobe_page_count; k++) free_response(server->files[k]);
    free_response(server->unknown);
    free_response(server->method);
    free_response(server->host);
    free(server->files);
    free(server);
}
