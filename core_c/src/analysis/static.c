/* Load control. */
#include "system/analysis.h"

#include <math.h>
#include <string.h>

static void residual(ed_analysis *a, const ed_step *step, double *r)
{
  (void)step;
  for (int i = 0; i < a->numbering.n; i++)
    r[i] = a->loading.external[i] - a->trial.resisting[i];
  ed_raise_force_level(a);
}

int ed_static_begin(ed_analysis *a, int pattern, double factor, int steps)
{
  if (a->run.kind != ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "another run has not ended");
  if (pattern < 0 || pattern >= a->model->n_patterns)
    return ed_fail(a, ED_E_ID, "there is no load pattern %d", pattern);
  if (steps < 1 || !isfinite(factor))
    return ed_fail(a, ED_E_ARGUMENT, "%d load steps to factor %g", steps, factor);
  ed_start_run(a, ED_RUN_STATIC, steps, a->loading.factors_committed[pattern]);
  a->run.pattern = pattern;
  a->run.factor_start = a->loading.factors_committed[pattern];
  a->run.factor_end = factor;
  return ED_OK;
}

int ed_static_attempt(ed_analysis *a, double fraction, int fallback)
{
  const ed_run *run = &a->run;
  const ed_step step = {.k = 1.0, .residual = residual};
  ed_state_head *head = a->trial.head;
  head->position += fraction;
  ed_slowly(&a->devices);
  a->iteration.n_residuals = 0;
  const double share = (run->done + head->position) / run->steps;
  const double factor = share >= 1.0 ? run->factor_end : run->factor_start + share * (run->factor_end - run->factor_start);
  a->loading.factors[run->pattern] = factor;
  head->time = factor;
  ed_set_factors(a);
  /* element loads act inside the elements: their states must follow before the first residual */
  int status = ed_update_elements(a);
  if (status == ED_OK)
    status = ed_equilibrate(a, &step, fallback);
  /* equilibrium beyond a critical load is no state that a structure can be in */
  if (status == ED_OK && a->factors.stamp != a->matrix.stamp)
    status = ed_factor_effective(a, 1.0, 0.0, 0.0);
  return status == ED_OK && ed_solver_negative_pivots(a->factors.solver) > 0 ? ED_E_UNSTABLE : status;
}
