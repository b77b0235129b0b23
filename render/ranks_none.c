/* Built without MPI: every process is alone. */
#include "message.h"
#include "ranks.h"

const char *lobe_ranks_library(void) {
    return NULL;
}

lobe_render_result lobe_ranks_join(int *rank) {
    *rank = 0;
    return LOBE_RENDER_OK;
}

lobe_render_result lobe_ranks_agree(lobe_render_result result) {
    return result;
}

void lobe_ranks_leave(void) {}

int lobe_ranks_size(void) {
    return 1;
}

int lobe_ranks_own(void) {
    return 0;
}

void lobe_ranks_broadcast(void *data, int size) {
    (void)data, (void)size;
}

void lobe_ranks_serve(crew *c) {
    (void)c;
}

void lobe_ranks_dismiss(crew *c) {
    (void)c;
}

lobe_render_result lobe_ranks_help(crew *c) {
    (void)c;
    return LOBE_RENDER_OK;
}
