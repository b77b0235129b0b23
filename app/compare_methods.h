/* app/compare_methods.h: the list of methods of `lobe compare`. */
#ifndef LOBE_APP_COMPARE_METHODS_H
#define LOBE_APP_COMPARE_METHODS_H

#include "comparison.h"
#include "view.h"

/* Reads "NAME[:floor=D][:normalization=NAME],…" into c->contender; "default" is the choice by surface. What a
 * name does not say is that of the view. */
lobe_app_status lobe_app_read_methods(const char *list, const lobe_app_view *view,
                                      lobe_app_comparison *c);

#endif
