/* Runs are begun, advanced in pieces and ended. */
#include "system/analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ed_attempt attempts[] = {NULL, ed_static_attempt, ed_pushover_attempt, ed_history_attempt};

void ed_start_run(ed_analysis *a, int kind, int steps, double abscissa)
{
  memset(&a->run, 0, sizeof a->run);
  a->run.kind = (ed_run_kind)kind;
  a->run.steps = steps;
  a->run.every = 1;
  a->watch = ed_watch_of(&a->stop);
  a->fallbacks.n_events = 0;
  a->members.control.no_softening = 0;
  a->statistics.worst_unbalance = 0.0;
  a->committed.head->position = a->trial.head->position = 0.0;
  a->committed.head->time = a->trial.head->time = abscissa;
  a->factors.price = (ed_solver_flops(a->factors.solver) + ed_condensation_flops(a)) / ed_iteration_flops(a);
}

void ed_run_buffers(ed_analysis *a, int every, double *abscissa, double *values, double *energy)
{
  a->run.every = every > 0 ? every : 1;
  a->run.abscissa = abscissa;
  a->run.values = values;
  a->run.energy = energy;
}

int ed_run_advance(ed_analysis *a, int max_steps)
{
  ed_run *run = &a->run;
  if (run->kind == ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "no run has begun");
  if (run->failed)
    return ed_fail(a, ED_E_STATE, "the run has failed");
  if (run->limited)
    return ed_fail(a, ED_E_STATE, "the run has ended at a limit");
  int status = run->done == 0 && run->row == 0 ? ed_sample(a, 1) : ED_OK;
  a->watch = ed_watch_of(&a->stop);
  for (int i = 0; status == ED_OK && i < max_steps && run->done < run->steps; i++) {
    const int events = a->fallbacks.n_events;
    status = ed_solve_step(a, attempts[run->kind]);
    if (status == ED_E_STOPPED) {
      a->fallbacks.n_events = events; /* the step is done anew, if at all */
      return ed_fail(a, status, "%s in step %d", ed_status_text(status), run->done + 1);
    }
    if (status != ED_OK)
      break;
    a->committed.head->position = a->trial.head->position = 0.0;
    ed_finish_history_forces(&a->run);
    run->done++;
    a->statistics.steps++;
    status = ed_sample(a, run->done % run->every == 0);
    if (status != ED_OK)
      break;
    const int channel = ed_beyond_limit(&a->channels);
    if (channel >= 0 && !ed_state_finite(&a->storage, &a->committed))
      break;
    if (channel >= 0) {
      run->limited = channel + 1;
      return ed_fail(a, ED_LIMIT, "%s: channel %d is %.6g in step %d, at %.6g; its limit is %.6g", ed_status_text(ED_LIMIT),
                     channel, a->channels.last[channel], run->done, a->committed.head->time, a->channels.head[channel].limit);
    }
  }
  if (status == ED_OK && !ed_state_finite(&a->storage, &a->committed)) /* after many steps as well: what is not finite stays so */
    status = ed_fail(a, ED_E_NOT_FINITE, "%s: the state after step %d, at %.6g", ed_status_text(ED_E_NOT_FINITE), run->done,
                     a->committed.head->time);
  run->failed = status != ED_OK;
  return status;
}

int ed_run_steps_done(const ed_analysis *a)
{
  return a->run.done;
}

int ed_run_rows(const ed_analysis *a)
{
  return a->run.row;
}

int ed_run_take_rows(ed_analysis *a)
{
  const int rows = a->run.row - a->run.taken;
  a->run.taken = a->run.row;
  return rows;
}

int ed_run_limit(const ed_analysis *a, double *value, double *time)
{
  const int channel = a->run.limited - 1;
  if (channel >= 0) {
    *value = a->channels.last[channel];
    *time = a->committed.head->time;
  }
  return channel;
}

void ed_run_end(ed_analysis *a)
{
  if (a->run.kind == ED_RUN_NONE)
    return;
  if (a->settings.energy)
    ed_close_energy(a);
  free(a->run.ground[0]);
  ed_free_support_motions(&a->run);
  memset(&a->run, 0, sizeof a->run);
}

int ed_initial_velocity(ed_analysis *a, const double *velocity)
{
  if (a->run.kind != ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "initial velocities come before the run");
  double kinetic = 0.0, all = 0.0; /* put in beyond what moves already; that of all */
  for (int i = 0; i < a->numbering.n; i++) {
    if (!isfinite(velocity[i]))
      return ed_fail(a, ED_E_NOT_FINITE, "initial velocity %d is not a finite number", i + 1);
    kinetic += 0.5 * a->numbering.mass[i] * (velocity[i] * velocity[i] - a->committed.v[i] * a->committed.v[i]);
    all += a->numbering.mass[i] * velocity[i] * velocity[i];
  }
  if (!isfinite(kinetic + all))
    return ed_fail(a, ED_E_NOT_FINITE, "the kinetic energy of the initial velocities is not a finite number");
  memcpy(a->committed.v, velocity, (size_t)a->numbering.n * sizeof(double));
  memcpy(a->trial.v, velocity, (size_t)a->numbering.n * sizeof(double));
  a->trial.head->energy[ED_INPUT] += kinetic;
  a->trial.head->largest_input = fmax(a->trial.head->largest_input, fabs(a->trial.head->energy[ED_INPUT]));
  *a->committed.head = *a->trial.head;
  return ED_OK;
}

int ed_try_and_revert(ed_analysis *a, double fraction)
{
  if (a->run.kind == ED_RUN_NONE || a->run.done == a->run.steps)
    return ed_fail(a, ED_E_STATE, "there is no next step to try");
  double ground[2][3];
  memcpy(ground[0], a->run.ground_now, sizeof ground[0]);
  memcpy(ground[1], a->run.ground_before, sizeof ground[1]);
  a->watch = ed_watch_of(&a->stop);
  const int status = attempts[a->run.kind](a, fraction, 0);
  ed_revert(a);
  memcpy(a->run.ground_now, ground[0], sizeof ground[0]);
  memcpy(a->run.ground_before, ground[1], sizeof ground[1]);
  return status;
}
