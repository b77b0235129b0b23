/* Code that may crash, loop for ever or take all memory, in a process of its own. */
#ifndef LOBE_VERIFY_CHILD_H
#define LOBE_VERIFY_CHILD_H

#include <stddef.h>
#include <sys/types.h>

typedef struct lobe_child {
    pid_t pid;    /* 0: none */
    double until; /* on lobe_child_clock */
} lobe_child;

/* Bytes that both processes see. NULL without memory. */
void *lobe_shared_make(size_t size);
void lobe_shared_free(void *shared, size_t size);

double lobe_child_clock(void);

/* Runs work(task) in a new process, which then ends with status 0. Its standard output is the
 * standard error of this one. Returns 0 if no process can be started. */
int lobe_child_start(lobe_child *child, void (*work)(void *task), void *task, double seconds);

/* 1: it has ended, and `cause` says how ("crashed (Segmentation fault)", "ran out of time (20 s)"),
 * empty for status 0. One out of time is ended here. */
int lobe_child_has_ended(lobe_child *child, char *cause, size_t room);

void lobe_child_end(lobe_child *child);

/* Some milliseconds. */
void lobe_child_pause(void);

#endif
