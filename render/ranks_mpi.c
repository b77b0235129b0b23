/* The same by MPI. Only the first thread of a process calls it. A failed call means that the job is coming to its end: it
 * counts as an interrupt, so that rank 0 saves what it has. */
#include "ranks.h"

#include <stdlib.h>
#include <string.h>

#include <mpi.h>

#include "message.h"

enum { TAG_RESULT = 1, TAG_UNITS, TAG_END, UNITS_MAX = 4096, UNITS_AHEAD = 2 };

static struct {
    int size, own;    /* size: 0 before lobe_ranks_join */
    unsigned *wanted; /* rank 0: units that each rank asked for */
    int asked;        /* rank 0: ranks that have asked at all */
} ranks;

/* What goes back: the unit, then the pixels, then the sums of the first hits if they are kept. `wanted`: so many units
 * more are asked for. */
typedef struct result_header {
    unit unit;
    uint32_t wanted;
    uint64_t rays;
} result_header;

typedef struct result {
    struct result *next;
    MPI_Request request;
    char bytes[];
} result;

/* ---- Joining and leaving --------------------------------------------------------------------- */

static int is_under_mpirun(void) {
    static const char *const names[] = {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (getenv(names[i])) return 1;
    return 0;
}

const char *lobe_ranks_library(void) {
    static char text[MPI_MAX_LIBRARY_VERSION_STRING];
    int length = 0;
    if (!text[0]) MPI_Get_library_version(text, &length);
    text[strcspn(text, ",\n")] = '\0';
    return text;
}

lobe_render_result lobe_ranks_join(int *rank) {
    *rank = 0;
    if (!is_under_mpirun() || ranks.size) return LOBE_RENDER_OK;
    int provided;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &provided) != MPI_SUCCESS ||
        provided < MPI_THREAD_FUNNELED)
        return lobe_fail(LOBE_RENDER_FAILED,
                         "MPI: cannot be started with threads; run without mpirun");
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks.size);
    MPI_Comm_rank(MPI_COMM_WORLD, &ranks.own);
    ranks.wanted = calloc((size_t)ranks.size, sizeof *ranks.wanted);
    if (!ranks.wanted) return lobe_fail_memory("MPI");
    *rank = ranks.own;
    return LOBE_RENDER_OK;
}

void lobe_ranks_leave(void) {
    if (ranks.size) MPI_Finalize();
    free(ranks.wanted);
    ranks.wanted = NULL;
    ranks.size = 0;
}

int lobe_ranks_size(void) {
    return ranks.size ? ranks.size : 1;
}

int lobe_ranks_own(void) {
    return ranks.own;
}

void lobe_ranks_broadcast(void *data, int size) {
    if (ranks.size > 1) MPI_Bcast(data, size, MPI_BYTE, 0, MPI_COMM_WORLD);
}

lobe_render_result lobe_ranks_agree(lobe_render_result result) {
    if (ranks.size <= 1) return result;
    int failed = result == LOBE_RENDER_OK ? ranks.size : ranks.own, first;
    MPI_Allreduce(&failed, &first, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (first == ranks.size) return LOBE_RENDER_OK;
    char line[1024] = "";
    int code = (int)result;
    if (ranks.own == first) strncpy(line, lobe_render_error_message(), sizeof line - 1);
    MPI_Bcast(line, sizeof line, MPI_CHAR, first, MPI_COMM_WORLD);
    MPI_Bcast(&code, 1, MPI_INT, first, MPI_COMM_WORLD);
    if (first == 0) return lobe_fail((lobe_render_result)code, "%s", line);
    return lobe_fail((lobe_render_result)code, "rank %d: %s", first, line);
}

/* ---- Messages of results --------------------------------------------------------------------- */

static size_t pixel_bytes(void) {
    return (size_t)TILE * TILE * sizeof(film_pixel);
}

static size_t first_hit_bytes(const lobe_film *film) {
    return film->first_hit ? (size_t)TILE * TILE * FILM_FIRST_HIT_VALUES * sizeof(double) : 0;
}

static size_t result_bytes(const lobe_film *film) {
    return sizeof(result_header) + pixel_bytes() + first_hit_bytes(film);
}

static void pack(char *bytes, const result_header *header, const lobe_film *tile) {
    memcpy(bytes, header, sizeof *header);
    memcpy(bytes + sizeof *header, tile->pixels, pixel_bytes());
    if (tile->first_hit)
        memcpy(bytes + sizeof *header + pixel_bytes(), tile->first_hit, first_hit_bytes(tile));
}

static void unpack(const char *bytes, result_header *header, lobe_film *tile) {
    memcpy(header, bytes, sizeof *header);
    memcpy(tile->pixels, bytes + sizeof *header, pixel_bytes());
    if (tile->first_hit)
        memcpy(tile->first_hit, bytes + sizeof *header + pixel_bytes(), first_hit_bytes(tile));
}

/* ---- Rank 0 ---------------------------------------------------------------------------------- */

static void cancel(crew *c) {
    omp_set_lock(&c->lock);
    c->is_stopped = c->is_cancelled = 1;
    omp_unset_lock(&c->lock);
}

static int is_interrupted(const crew *c) {
    return c->options->cancel && *c->options->cancel;
}

/* A rank may die in the middle of its message, which then never ends: wait, but not through an interrupt. 0: it did not
 * come; `bytes` may still be written to. */
static int receive_bytes(const crew *c, int from, char *bytes, size_t size) {
    MPI_Request request;
    int is_there = 0, is_good;
    is_good = MPI_Irecv(bytes, (int)size, MPI_BYTE, from, TAG_RESULT, MPI_COMM_WORLD, &request) ==
              MPI_SUCCESS;
    while (is_good && !is_there && !is_interrupted(c))
        is_good = MPI_Test(&request, &is_there, MPI_STATUS_IGNORE) == MPI_SUCCESS;
    return is_good && is_there;
}

static int receive(crew *c, int from, lobe_film *tile, char *bytes) {
    if (!receive_bytes(c, from, bytes, result_bytes(tile))) {
        cancel(c);
        return 0;
    }
    result_header header;
    unpack(bytes, &header, tile);
    ranks.wanted[from] += header.wanted;
    if (header.unit.count == 0) { /* only asks */
        ranks.asked++;
        return 1;
    }
    omp_set_lock(&c->lock);
    c->source.deliver(c, &header.unit, tile, header.rays);
    omp_unset_lock(&c->lock);
    return 1;
}

static int is_result_there(crew *c, int *from) {
    int is_there = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, TAG_RESULT, MPI_COMM_WORLD, &is_there, &status) != MPI_SUCCESS)
        cancel(c);
    *from = status.MPI_SOURCE;
    return is_there;
}

static void receive_all(crew *c) {
    int from;
    if (c->is_cancelled || !is_result_there(c, &from)) return;
    lobe_film *tile = lobe_film_create(TILE, TILE, c->film->aovs);
    char *bytes = tile ? malloc(result_bytes(tile)) : NULL;
    int is_good = bytes != NULL;
    if (!is_good) cancel(c);
    while (is_good && receive(c, from, tile, bytes))
        if (!is_result_there(c, &from)) break;
    /* after an interrupt the library may still write there */
    if (!c->is_cancelled) free(bytes);
    lobe_film_free(tile);
}

static void answer(crew *c, int rank) {
    unit units[64];
    int count = 0;
    omp_set_lock(&c->lock);
    while (count < 64 && (unsigned)count < ranks.wanted[rank] &&
           c->source.next(c, &units[count]) == SCHEDULE_UNIT)
        count++;
    omp_unset_lock(&c->lock);
    if (count == 0) return;
    ranks.wanted[rank] -= (unsigned)count;
    if (MPI_Send(units, count * (int)sizeof *units, MPI_BYTE, rank, TAG_UNITS, MPI_COMM_WORLD) !=
        MPI_SUCCESS)
        cancel(c);
}

void lobe_ranks_serve(crew *c) {
    receive_all(c);
    for (int rank = 1; rank < ranks.size; rank++)
        if (ranks.wanted[rank] > 0) answer(c, rank);
}

/* Nothing is under way any more but, perhaps, first questions. */
void lobe_ranks_dismiss(crew *c) {
    while (ranks.asked < ranks.size - 1 && !c->is_cancelled) receive_all(c);
    ranks.asked = 0;
    memset(ranks.wanted, 0, (size_t)ranks.size * sizeof *ranks.wanted);
    for (int rank = 1; rank < ranks.size; rank++)
        MPI_Send(NULL, 0, MPI_BYTE, rank, TAG_END, MPI_COMM_WORLD);
}

/* ---- The other ranks ------------------------------------------------------------------------- */

/* Guarded by the lock of the crew. */
static struct {
    unit units[UNITS_MAX];
    uint32_t first, count; /* a ring */
    result *finished;      /* to be sent, by the first thread */
    result *under_way;     /* only the first thread's */
    uint32_t aovs;
    _Atomic int is_over;
} help;

static schedule_answer next_of_help(crew *c, unit *u) {
    if (is_interrupted(c)) help.is_over = 1;
    if (help.is_over) return SCHEDULE_END;
    if (help.count == 0) return SCHEDULE_WAIT;
    *u = help.units[help.first];
    help.first = (help.first + 1) % UNITS_MAX;
    help.count--;
    return SCHEDULE_UNIT;
}

static void deliver_help(crew *c, const unit *u, const lobe_film *tile, uint64_t rays) {
    (void)c;
    result *r = malloc(sizeof *r + result_bytes(tile));
    if (!r) MPI_Abort(MPI_COMM_WORLD, LOBE_RENDER_FAILED);
    pack(r->bytes, &(result_header){*u, 1, rays}, tile);
    r->next = help.finished;
    help.finished = r;
}

static void send_result(result *r, size_t size) {
    if (MPI_Isend(r->bytes, (int)size, MPI_BYTE, 0, TAG_RESULT, MPI_COMM_WORLD, &r->request) !=
        MPI_SUCCESS)
        help.is_over = 1;
    r->next = help.under_way;
    help.under_way = r;
}

static void forget_sent(void) {
    for (result **at = &help.under_way; *at;) {
        result *r = *at;
        int is_sent = 0;
        if (MPI_Test(&r->request, &is_sent, MPI_STATUS_IGNORE) != MPI_SUCCESS) help.is_over = 1;
        if (is_sent) {
            *at = r->next;
            free(r);
        } else {
            at = &r->next;
        }
    }
}

static void take_units(crew *c, const unit *units, int count) {
    omp_set_lock(&c->lock);
    for (int i = 0; i < count && help.count < UNITS_MAX; i++)
        help.units[(help.first + help.count++) % UNITS_MAX] = units[i];
    omp_unset_lock(&c->lock);
}

static void tend_help(crew *c) {
    omp_set_lock(&c->lock);
    result *finished = help.finished;
    help.finished = NULL;
    omp_unset_lock(&c->lock);
    while (finished) {
        result *r = finished;
        finished = r->next;
        const lobe_film shape = {.first_hit = help.aovs ? (double[1]){0} : NULL};
        send_result(r, result_bytes(&shape));
    }
    forget_sent();
    for (int is_there = 1; is_there && !help.is_over;) {
        unit units[64];
        int bytes;
        MPI_Status status;
        if (MPI_Iprobe(0, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status) != MPI_SUCCESS)
            help.is_over = 1;
        if (!is_there || help.is_over) break;
        MPI_Recv(units, sizeof units, MPI_BYTE, 0, status.MPI_TAG, MPI_COMM_WORLD, &status);
        MPI_Get_count(&status, MPI_BYTE, &bytes);
        if (status.MPI_TAG == TAG_END) help.is_over = 1;
        take_units(c, units, bytes / (int)sizeof *units);
    }
}

/* The first message only asks: every thread shall have a unit and others to go on with. */
static int ask_first(const crew *c) {
    lobe_film *tile = lobe_film_create(TILE, TILE, c->options->aovs);
    result *r = tile ? malloc(sizeof *r + result_bytes(tile)) : NULL;
    if (r) {
        uint32_t wanted = (uint32_t)c->threads * (1 + UNITS_AHEAD);
        if (wanted > UNITS_MAX) wanted = UNITS_MAX;
        pack(r->bytes, &(result_header){.wanted = wanted}, tile);
        help.aovs = tile->first_hit != NULL;
        send_result(r, result_bytes(tile));
    }
    lobe_film_free(tile);
    return r != NULL;
}

lobe_render_result lobe_ranks_help(crew *c) {
    help.first = help.count = 0;
    help.is_over = 0;
    c->source = (crew_source){next_of_help, deliver_help, tend_help};
    const int is_good = ask_first(c) && lobe_crew_work(c, c->options->aovs);
    while (help.under_way && !is_interrupted(c)) forget_sent();
    return is_good ? LOBE_RENDER_OK : lobe_fail_memory("tiles");
}
