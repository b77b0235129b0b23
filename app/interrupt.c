#include "interrupt.h"

#include <stddef.h>

volatile sig_atomic_t lobe_app_interrupted;

static void note_interrupt(int number) {
    (void)number;
    lobe_app_interrupted = 1;
}

void lobe_app_catch_interrupt(void) {
    struct sigaction action = {0};
    action.sa_handler = note_interrupt;
    action.sa_flags = (int)SA_RESETHAND; /* no SA_RESTART: a waiting read has to return */
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

static sigset_t interrupts(void) {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    return set;
}

void lobe_app_hold_interrupt(void) {
    const sigset_t set = interrupts();
    sigprocmask(SIG_BLOCK, &set, NULL);
}

void lobe_app_await_interrupt(void) {
    const sigset_t set = interrupts();
    int number;
    while (sigwait(&set, &number) != 0) continue;
}
