/* What is known of Smith-GGX and of each method independently of the library. */
#ifndef LOBE_VERIFY_GGX_ORACLES_H
#define LOBE_VERIFY_GGX_ORACLES_H

#include "ggx_model.h"

/* Sets weight_bound, accepted_oracle, density_oracle and albedo_oracle of a subject's model. */
void lobe_ggx_set_oracles(lobe_ggx_subject *subject);

#endif
