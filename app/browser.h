#ifndef LOBE_APP_BROWSER_H
#define LOBE_APP_BROWSER_H

#include <stdbool.h>

/* Shows the address in the user's browser, which outlives the program. false: there is no screen, or nothing
 * that opens a browser. */
bool lobe_app_open_browser(const char *address);

#endif
