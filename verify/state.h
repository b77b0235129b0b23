/* The finished cases of a run in a file, so that a run that was interrupted goes on. */
#ifndef LOBE_VERIFY_STATE_H
#define LOBE_VERIFY_STATE_H

#include "run.h"

/* Reads the cases that options->state has, and writes it: a file that cannot be written shall not be
 * noticed after an hour. A file that is damaged or of another run stops the run. */
void lobe_state_open(lobe_run *run);

/* Writes all finished cases under a temporary name and renames it. */
void lobe_state_save(lobe_run *run);

#endif
