/* How a damper is moved from one state to the next: by its exact step, by SUNDIALS, or in fixed steps (ED_DAMPER_* in eddamper.h). */
#ifndef ED_STEPPER_H
#define ED_STEPPER_H

#include "damper/fixed_steps.h"
#include "damper/ode_system.h"

typedef struct {
  const ed_damper *damper;
  ed_ode_system *system; /* NULL unless SUNDIALS integrates */
  ed_fixed_steps *fixed; /* NULL unless it goes in fixed steps */
} ed_stepper;

/* fineness: as in ed_damper_history. watch: of the call, for as long as the stepper is open. Close it in any case. */
int ed_stepper_open(ed_stepper *stepper, const ed_damper *damper, int method, double fineness, ed_watch *watch);
void ed_stepper_close(ed_stepper *stepper);

/* Steps from here on belong to this motion of all that stands in series; NULL: nothing does. */
static inline void ed_stepper_plan(const ed_stepper *stepper, const ed_path *motion)
{
  if (stepper->fixed)
    ed_fixed_steps_plan(stepper->fixed, motion);
}

/* One step, as ed_law.step. */
static inline int ed_stepper_along(const ed_stepper *stepper, const double *committed, const ed_path *path, const ed_path direction[2],
                                   double *trial, ed_damper_force *out)
{
  if (stepper->fixed)
    return ed_fixed_steps_along(stepper->fixed, committed, path, direction, trial, out);
  if (stepper->system)
    return ed_ode_system_step(stepper->system, &committed, path, (const ed_path(*)[2])direction, &trial, out);
  return ed_damper_advance(stepper->damper, NULL, committed, path, direction, trial, out);
}

#endif
