/* Time histories by Newmark and generalised-alpha (Chung & Hulbert 1993; HHT is alpha_m = 0). Internal and damping forces are
 * weighted between the ends of the step. */
#include "system/analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Inertia by the vertical motion of the ground of a model in space. */
static void subtract_vertical(const ed_numbering *numbering, double ground, double *r)
{
  for (int i = 0; numbering->influence[2] && ground != 0.0 && i < numbering->n; i++)
    r[i] -= numbering->mass[i] * numbering->influence[2][i] * ground;
}

static void residual(ed_analysis *a, const ed_step *step, double *r)
{
  const ed_numbering *numbering = &a->numbering;
  const ed_state *now = &a->trial, *before = &a->committed;
  const double af = a->run.alpha_f, am = a->run.alpha_m;
  const int n = numbering->n;
  ed_damping_force(a, now->v, now->damping);
  if (af == 0.0 && am == 0.0) {
    for (int i = 0; i < n; i++)
      r[i] = a->loading.external[i] - now->resisting[i] - now->damping[i] -
             numbering->mass[i] * (now->a[i] + numbering->influence[0][i] * step->ground[0] + numbering->influence[1][i] * step->ground[1]);
    subtract_vertical(numbering, step->ground[2], r);
  } else {
    const double gx = (1.0 - af) * step->ground[0] + af * step->ground_before[0];
    const double gy = (1.0 - af) * step->ground[1] + af * step->ground_before[1];
    for (int i = 0; i < n; i++)
      r[i] = a->loading.external[i] - (1.0 - af) * (now->resisting[i] + now->damping[i]) -
             af * (before->resisting[i] + before->damping[i]) -
             numbering->mass[i] * ((1.0 - am) * now->a[i] + am * before->a[i] + numbering->influence[0][i] * gx +
                           numbering->influence[1][i] * gy);
    subtract_vertical(numbering, (1.0 - af) * step->ground[2] + af * step->ground_before[2], r);
  }
  ed_add_history_forces(&a->run, numbering->mass, af, r);
  ed_raise_force_level(a);
}

/* Of a run that cannot begin. */
static void end_where_it_began(ed_analysis *a)
{
  ed_restore(a);
  free(a->run.ground[0]);
  memset(&a->run, 0, sizeof a->run);
}

int ed_history_begin(ed_analysis *a, int n, double dt, const double *ground_x, const double *ground_y, const double *ground_z,
                     int method, const double *p)
{
  if (a->run.kind != ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "another run has not ended");
  if (method != ED_NEWMARK && method != ED_GENERALISED_ALPHA)
    return ed_fail(a, ED_E_ARGUMENT, "unknown integration method %d", method);
  if (n < 1 || !(dt > 0.0) || !isfinite(n * dt))
    return ed_fail(a, ED_E_ARGUMENT, "%d steps of %g", n, dt);
  double mass = 0.0;
  for (int i = 0; i < a->numbering.n; i++)
    mass += a->numbering.mass[i];
  if (mass == 0.0)
    return ed_fail(a, ED_E_ARGUMENT, "a time history needs masses");
  const double am = method == ED_GENERALISED_ALPHA ? p[0] : 0.0, af = method == ED_GENERALISED_ALPHA ? p[1] : 0.0;
  const double gamma = method == ED_GENERALISED_ALPHA ? p[2] : p[0], beta = method == ED_GENERALISED_ALPHA ? p[3] : p[1];
  if (!(beta > 0.0 && gamma > 0.0 && am < 1.0 && af >= 0.0 && af < 1.0) || !isfinite(beta + gamma + am))
    return ed_fail(a, ED_E_ARGUMENT, "integration parameters out of range");
  const size_t samples = (size_t)n + 1;
  double *block = calloc(3 * samples, sizeof *block);
  if (!block)
    return ed_fail(a, ED_E_MEMORY, "out of memory");
  const double *given[3] = {ground_x, ground_y, a->model->dimension == 3 ? ground_z : NULL};
  for (int axis = 0; axis < 3; axis++)
    for (size_t i = 0; given[axis] && i < samples; i++) {
      block[(size_t)axis * samples + i] = given[axis][i];
      if (!isfinite(given[axis][i])) {
        free(block);
        return ed_fail(a, ED_E_NOT_FINITE, "ground acceleration: sample %ld is not a finite number", (long)i + 1);
      }
    }
  ed_backup(a);
  ed_start_run(a, ED_RUN_HISTORY, n, 0.0);
  ed_run *run = &a->run;
  run->dt = dt;
  for (int axis = 0; axis < 3; axis++)
    run->ground[axis] = block + (size_t)axis * samples;
  run->alpha_m = am;
  run->alpha_f = af;
  run->gamma = gamma;
  run->beta = beta;
  memset(a->committed.support_v, 0, 2 * (size_t)a->numbering.n_supports * sizeof(double)); /* accelerations lie behind */
  memset(a->trial.support_v, 0, 2 * (size_t)a->numbering.n_supports * sizeof(double));
  for (int axis = 0; axis < 3; axis++)
    run->ground_now[axis] = run->ground_before[axis] = run->ground[axis][0];
  /* the first acceleration from equilibrium, where there is mass */
  int status = ed_start_devices(a);
  if (status != ED_OK) {
    end_where_it_began(a);
    if (status == ED_E_STOPPED)
      return ed_fail(a, status, "%s at the start", ed_status_text(status));
    char name[2 * ED_NAME];
    ed_name_damper(a->model, &a->devices, name, sizeof name);
    return ed_fail(a, status, "%s: no state was found at the start", name);
  }
  ed_freeze_damping(a, 0);
  ed_damping_force(a, a->trial.v, a->trial.damping);
  const double *const *influence = (const double *const *)a->numbering.influence;
  for (int i = 0; i < a->numbering.n; i++)
    if (a->numbering.mass[i] > 0.0) {
      a->trial.a[i] = (a->loading.external[i] - a->trial.resisting[i] - a->trial.damping[i]) / a->numbering.mass[i] -
                      influence[0][i] * run->ground_now[0] - influence[1][i] * run->ground_now[1];
      if (influence[2])
        a->trial.a[i] -= influence[2][i] * run->ground_now[2];
    }
  for (int i = 0; i < a->numbering.n; i++)
    if (!isfinite(a->trial.a[i])) {
      char name[ED_NAME + 8];
      end_where_it_began(a);
      return ed_fail(a, ED_E_NOT_FINITE, "the first acceleration at %s is not a finite number",
                     ed_equation_name(a->model, &a->numbering, i, name, sizeof name));
    }
  for (int i = 0; i < a->numbering.n; i++) { /* so that the first step goes on with half the first acceleration */
    a->trial.mean_velocity[i] = a->trial.v[i];
    a->trial.mean_velocity_before[i] = a->trial.v[i] - 0.5 * dt * a->trial.a[i];
  }
  memcpy(a->committed.mean_velocity, a->trial.mean_velocity, 2 * (size_t)a->numbering.n * sizeof(double)); /* the one lies behind the other */
  memcpy(a->committed.a, a->trial.a, (size_t)a->numbering.n * sizeof(double));
  memcpy(a->committed.damping, a->trial.damping, (size_t)a->numbering.n * sizeof(double));
  return ED_OK;
}

static double ground_at(const ed_run *run, int axis, double position)
{
  const double *g = run->ground[axis];
  const int i = run->done;
  if (position <= 0.0)
    return g[i];
  return position >= 1.0 ? g[i + 1] : g[i] + position * (g[i + 1] - g[i]);
}

int ed_history_attempt(ed_analysis *a, double fraction, int fallback)
{
  ed_run *run = &a->run;
  ed_state_head *head = a->trial.head;
  const double dt = run->dt * fraction, b = run->beta, g = run->gamma;
  ed_freeze_damping(a, fallback);
  ed_step step = {
      .k = 1.0 - run->alpha_f,
      .m = (1.0 - run->alpha_m) / (b * dt * dt),
      .c = (1.0 - run->alpha_f) * g / (b * dt),
      .velocity = g / (b * dt),
      .acceleration = 1.0 / (b * dt * dt),
      .residual = residual,
      .balance = ed_condenses(a, fallback) ? ed_move_condensed : NULL,
  };
  for (int axis = 0; axis < 3; axis++) {
    step.ground_before[axis] = run->ground_before[axis] = ground_at(run, axis, head->position);
    step.ground[axis] = run->ground_now[axis] = ground_at(run, axis, head->position + fraction);
  }
  ed_move_history_forces(&a->run, head->position, head->position + fraction);
  ed_move_supports(a, head->position + fraction);
  head->position += fraction;
  head->time = (run->done + head->position) * run->dt;
  a->devices.duration = dt;
  a->devices.velocity_factor = step.velocity;
  const double *v0 = a->committed.v, *a0 = a->committed.a;
  /* start from the committed displacement: its element states are known, unless supports have moved */
  for (int i = 0; i < a->numbering.n; i++) {
    a->trial.v[i] = (1.0 - g / b) * v0[i] + dt * (1.0 - 0.5 * g / b) * a0[i];
    a->trial.a[i] = (1.0 - 0.5 / b) * a0[i] - v0[i] / (b * dt);
  }
  if (ed_installed(a) && !step.balance) {
    /* Dampers with a power of the velocity meet a velocity that turns back, as this one, with a force that turns at once: go on as in
     * the last two steps. Velocities and accelerations would not do, stiff modes ring in them. */
    ed_follow_pace(a, a->iteration.predicted);
    ed_move(a, &step, 1.0, a->iteration.predicted);
    const int status = ed_update_elements(a);
    if (status != ED_OK)
      return status;
  } else if (run->n_motions > 0) {
    const int status = ed_update_members(a);
    if (status != ED_OK)
      return status;
  }
  return ed_equilibrate(a, &step, fallback);
}
