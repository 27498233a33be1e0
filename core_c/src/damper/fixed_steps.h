/* Differential equations of a damper in steps whose number the motion alone decides, so that forces are a smooth function of the
 * parameters and the same on every machine: for histories that are computed again and again with other parameters.
 *
 * Alexander's singly diagonally implicit Runge-Kutta method of two stages (order 2, L-stable and stiffly accurate: Hairer & Wanner 1996,
 * IV.6, gamma = 1 - 1/sqrt 2). Its stages are solved by Newton's method with the law's own derivatives. One linear step in its place
 * (Rosenbrock) would not do: where a power of the velocity is flat at rest, what stands in series with it is not met there. */
#ifndef ED_FIXED_STEPS_H
#define ED_FIXED_STEPS_H

#include "damper/law.h"

typedef struct ed_fixed_steps ed_fixed_steps;

/* Laws with differential equations and without exact step, or with one that integrates in parts. */
int ed_fixed_steps_suit(const ed_damper *damper);
/* length: of a deformation in which the law changes; sub-steps move a quarter of it at most. NULL: out of memory. */
ed_fixed_steps *ed_fixed_steps_new(const ed_damper *damper, double length);
void ed_fixed_steps_free(ed_fixed_steps *fixed);
/* Steps from here on take the sub-steps that this motion asks for, in each piece between two turns of their own path, however that path
 * moves with the parameters. NULL, and before the first call: those that their own path asks for. */
void ed_fixed_steps_plan(ed_fixed_steps *fixed, const ed_path *motion);
/* From `committed` along the path as ed_law.step does, with effects. The slopes leave out that extremes which the path itself set, and
 * then left, move with the unknowns. ED_OK, ED_E_NOT_CONVERGED, ED_E_NOT_FINITE. */
int ed_fixed_steps_along(ed_fixed_steps *fixed, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
                         ed_damper_force *out);

#endif
