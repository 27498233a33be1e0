/* Where a history begins, and what passes from one to the next. */
#include "damper/run_of_test.h"

#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STATES = 3 }; /* of a history */

int ed_test_run_open(ed_test_run *run, const ed_damper *damper, int method, double fineness, ed_watch *watch)
{
  const size_t size = (size_t)ed_damper_state_size(damper);
  *run = (ed_test_run){.method = method, .fineness = fineness, .watch = watch, .keeps_law = 1};
  const int status = ed_stepper_open(&run->stepper, damper, method, fineness, watch);
  if (status != ED_OK)
    return status;
  run->room = calloc(STATES * size + 1, sizeof(double));
  if (!run->room)
    return ED_E_MEMORY;
  run->state = run->room;
  run->trial = run->room + size;
  return ED_OK;
}

int ed_test_run_tune(ed_test_run *run, double fineness)
{
  const ed_damper *damper = run->stepper.damper;
  if (fineness == run->fineness || !run->stepper.system) /* nothing else has one that changes */
    return ED_OK;
  run->fineness = fineness;
  ed_stepper_close(&run->stepper);
  return ed_stepper_open(&run->stepper, damper, run->method, fineness, run->watch);
}

int ed_test_run_exchange(ed_test_run *run, const ed_damper *damper)
{
  const ed_damper *old = run->stepper.damper;
  if (damper == old)
    return ED_OK;
  if (damper->law != old->law || ed_damper_state_size(damper) != ed_damper_state_size(old))
    return ED_E_ARGUMENT;
  ed_stepper_close(&run->stepper);
  return ed_stepper_open(&run->stepper, damper, run->method, run->fineness, run->watch);
}

int ed_test_run_shares_law(const ed_damper *one, const ed_damper *other)
{
  return one->n_effects > 0 && other->n_effects > 0 && one->law == other->law && ed_damper_has_exact_step(one) &&
         ed_damper_has_exact_step(other) && one->brace + one->joint + other->brace + other->joint == 0.0 &&
         one->n_parameters == other->n_parameters &&
         memcmp(one->parameter, other->parameter, (size_t)one->n_parameters * sizeof *one->parameter) == 0 &&
         memcmp(one->prior_extremes, other->prior_extremes, sizeof one->prior_extremes) == 0;
}

void ed_test_run_close(ed_test_run *run)
{
  ed_stepper_close(&run->stepper);
  free(run->room);
}

void ed_test_run_carry(ed_test_run *run, double rest)
{
  const size_t size = (size_t)ed_damper_state_size(run->stepper.damper);
  run->before = run->room + 2 * size;
  run->rest = rest;
  memcpy(run->before, run->state, size * sizeof *run->state);
}

void ed_test_run_begin(ed_test_run *run)
{
  const ed_damper *damper = run->stepper.damper;
  const int size = ed_damper_state_size(damper);
  memset(run->state, 0, (size_t)size * sizeof *run->state);
  memset(run->trial, 0, (size_t)size * sizeof *run->trial);
  ed_damper_start(damper, run->state);
  ed_effects_start(damper, run->state, 0);
  if (run->before && run->keeps_law && damper->law->keep)
    damper->law->keep(damper, run->before, run->state);
  if (run->before)
    ed_effects_keep_law(damper, run->before, run->state);
}

int ed_check_samples(int n, const double *time, const double *u, const double *v, int *done)
{
  return ed_check_test(&(ed_test){.n = n, .time = time, .u = u, .v = v}, done);
}

static int is_allowed(const ed_rig *rig)
{
  const double all = rig->stiffness + rig->back + rig->bend + rig->power + rig->within + rig->play + rig->damping;
  return isfinite(all) && rig->stiffness > 0.0 && rig->back > 0.0 && rig->bend >= 0.0 && rig->power >= 1.0 && rig->within >= 0.0 &&
         rig->play >= 0.0 && rig->damping >= 0.0 && (rig->power == 1.0 || (rig->bend > 0.0 && rig->play == 0.0));
}

int ed_check_test(const ed_test *test, int *done)
{
  const double *factor = test->factor, *added = test->added, *spring = test->spring;
  *done = 0;
  if (test->rig && !is_allowed(test->rig))
    return ED_E_ARGUMENT;
  for (; *done < test->n; ++*done) {
    const int i = *done;
    if (!isfinite(test->time[i] + test->u[i] + test->v[i]) || (factor && !isfinite(factor[i])) || (added && !isfinite(added[i])) ||
        (spring && !isfinite(spring[i])))
      return ED_E_NOT_FINITE;
    if ((i > 0 && !(test->time[i] > test->time[i - 1])) || (factor && factor[i] < 0.0) || (spring && spring[i] < 0.0))
      return ED_E_ARGUMENT;
  }
  *done = 0;
  return test->n >= 1 ? ED_OK : ED_E_ARGUMENT;
}
