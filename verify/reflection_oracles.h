/* What is known of Smith-GGX and of each method independently of the library. */
#ifndef LOBE_VERIFY_REFLECTION_ORACLES_H
#define LOBE_VERIFY_REFLECTION_ORACLES_H

#include "reflection_model.h"

/* Sets weight_bound, accepted_oracle, density_oracle and albedo_oracle of a subject's model. */
void lobe_reflection_set_oracles(lobe_reflection_subject *subject);

#endif
