/* app/interrupt.h: Ctrl-C asks a command to save what is finished and stop. */
#ifndef LOBE_APP_INTERRUPT_H
#define LOBE_APP_INTERRUPT_H

#include <signal.h>

/* From now on the first interrupt only sets lobe_app_interrupted; a second one ends the program. */
void lobe_app_catch_interrupt(void);

/* For a command that only waits: from now on interrupts wait too, until lobe_app_await_interrupt takes one. */
void lobe_app_hold_interrupt(void);
void lobe_app_await_interrupt(void);

extern volatile sig_atomic_t lobe_app_interrupted;

#endif
