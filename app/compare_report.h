/* app/compare_report.h: a comparison as one page that needs nothing else, and its error maps as files. */
#ifndef LOBE_APP_COMPARE_REPORT_H
#define LOBE_APP_COMPARE_REPORT_H

#include "comparison.h"
#include "report.h"

/* FOLDER/report.html, and for every cell FOLDER/NAME-relative.png and -flip.png. */
lobe_app_status lobe_app_write_report(const lobe_app_comparison *c, const char *folder);

#endif
