/* A brace in series with a damper whose law has an exact step. */
#ifndef ED_BRACE_H
#define ED_BRACE_H

#include "damper/law.h"

/* As ed_law.step, for the total deformation of damper and brace. The state is the law's, then the damper's own deformation, the speed at
 * which the brace stretches and its change, and what the last trial found: `trial` must hold the state of the last trial from `committed`, or a copy
 * of `committed`; it makes the first guess. rough: as in ed_damper_try. */
enum { ED_BRACE_STATE = 15 };
int ed_brace_step(const ed_damper *damper, int rough, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out);

#endif
