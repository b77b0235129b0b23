/* app/ssr_report.h: the page of `lobe ssr --truth`. */
#ifndef LOBE_APP_SSR_REPORT_H
#define LOBE_APP_SSR_REPORT_H

#include "ssr_contest.h"

/* FOLDER/report.html; `title`: what is seen, `command`: what was typed. */
lobe_app_status lobe_app_write_ssr_report(const lobe_app_ssr_contest *contest, const char *title,
                                          const char *command, bool is_interrupted,
                                          const char *folder);

#endif
