/* A brace in series with a damper whose law has an exact step. */
#ifndef ED_BRACE_H
#define ED_BRACE_H

#include "damper/law.h"

/* As ed_law.step, for the total deformation of damper and brace; the state is the law's, then the damper's own deformation, the speed at
 * which the brace stretches, and from the last trial its two stretches with the own deformation and duration of that trial. `trial`
 * must hold the last trial's state, or a copy of `committed`: its stretches are the first guess. */
enum { ED_BRACE_STATE = 6 };
int ed_brace_step(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out);

#endif
