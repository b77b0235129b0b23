#include "json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "output.h"

lobe_app_status lobe_app_print_json(json_t *object) {
    char *text = object ? json_dumps(object, JSON_COMPACT | JSON_PRESERVE_ORDER) : NULL;
    json_decref(object);
    if (!text) {
        lobe_app_report("standard output", "free some", "out of memory");
        return LOBE_APP_FAILED;
    }
    lobe_app_write(text, strlen(text));
    lobe_app_print("\n");
    free(text);
    return LOBE_APP_DONE;
}

json_t *lobe_app_json_number(double number) {
    return isfinite(number) ? json_real(number) : json_null();
}

json_t *lobe_app_json_text(const char *text) {
    json_t *string = json_string(text);
    if (string) return string;
    char *ascii = strdup(text);
    for (char *c = ascii; c && *c; c++)
        if ((unsigned char)*c > 0x7f) *c = '?';
    string = ascii ? json_string(ascii) : NULL;
    free(ascii);
    return string;
}
