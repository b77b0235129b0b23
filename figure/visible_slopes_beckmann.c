/* Supplement 1 of Heitz & d'Eon 2014, Fig. 1. */
#include "visible_slopes.h"

lobe_figure_result lobe_figure_visible_slopes_beckmann(run *r) {
    return lobe_figure_visible_slopes(r, LOBE_NDF_BECKMANN);
}
