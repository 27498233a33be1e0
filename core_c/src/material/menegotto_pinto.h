#ifndef ED_MENEGOTTO_PINTO_H
#define ED_MENEGOTTO_PINTO_H

#include "material/steel.h"

/* Whether the branches that a state remembers may be so many. */
int ed_menegotto_pinto_valid(const double *state);
void ed_menegotto_pinto_trial(const ed_steel *steel, const double *state, double strain, double *stress,
                              double *tangent);
double ed_menegotto_pinto_commit(const ed_steel *steel, double *state, double strain);

#endif
