#include "damper/stepper.h"

#include "edcore.h"

#include <math.h>

int ed_stepper_open(ed_stepper *stepper, const ed_damper *damper, int method, double fineness, ed_watch *watch)
{
  int status = ED_OK;
  *stepper = (ed_stepper){.damper = damper};
  if (method == ED_DAMPER_FIXED) {
    if (!(fineness > 0.0) || !isfinite(fineness))
      return ED_E_ARGUMENT;
    if (!ed_fixed_steps_suit(damper))
      return ED_OK;
    stepper->fixed = ed_fixed_steps_new(damper, fineness);
    return stepper->fixed ? ED_OK : ED_E_MEMORY;
  }
  if (method == ED_DAMPER_BEST && ed_damper_has_exact_step(damper))
    return ED_OK;
  if (!damper->law->rate || damper->joint > 0.0 || (damper->brace > 0.0 && !damper->law->takes_brace))
    return ED_E_STATE;
  stepper->system = ed_ode_system_new(1, &damper, fineness, &status);
  if (stepper->system)
    ed_ode_system_watch(stepper->system, watch);
  return status;
}

void ed_stepper_close(ed_stepper *stepper)
{
  ed_ode_system_free(stepper->system);
  ed_fixed_steps_free(stepper->fixed);
}
