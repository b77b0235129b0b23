/* The distribution of visible slopes: its density and its draws (Heitz & d'Eon 2014). */
#ifndef LOBE_FIGURE_VISIBLE_SLOPES_H
#define LOBE_FIGURE_VISIBLE_SLOPES_H

#include "figures.h"

lobe_figure_result lobe_figure_visible_slopes(run *r, lobe_ndf ndf);

#endif
