/* Dampers on their own: one step, and force histories under given deformation. */
#include "base/finite.h"
#include "damper/run_of_test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

ed_damper *ed_damper_new(int law, int n_parameters, const double *parameters, double brace, double play, int *status,
                         char *message, int size)
{
  char text[ED_DAMPER_MESSAGE] = "out of memory";
  ed_damper *damper = malloc(sizeof *damper);
  *status = damper ? ed_damper_prepare(damper, law, n_parameters, parameters, brace, play, text) : ED_E_MEMORY;
  if (*status == ED_OK)
    return damper;
  if (size > 0)
    snprintf(message, (size_t)size, "%s", text);
  free(damper);
  return NULL;
}

int ed_damper_add_effect(ed_damper *damper, int form, int placement, int n_parameters, const double *parameters, char *message, int size)
{
  char text[ED_DAMPER_MESSAGE] = "";
  const int status = ed_effect_add(damper, form, placement, n_parameters, parameters, text);
  if (status != ED_OK && size > 0)
    snprintf(message, (size_t)size, "%s", text);
  return status;
}

int ed_damper_set_prior_extremes(ed_damper *damper, const double extremes[4])
{
  for (int i = 0; i < 4; i++)
    if (!isfinite(extremes[i]) || (i % 2 ? extremes[i] > 0.0 : extremes[i] < 0.0))
      return ED_E_ARGUMENT;
  memcpy(damper->prior_extremes, extremes, sizeof damper->prior_extremes);
  if (damper->springs)
    memcpy(damper->springs->prior_extremes, extremes, sizeof damper->prior_extremes);
  return ED_OK;
}

void ed_damper_ask(ed_damper *damper, const ed_stop *stop)
{
  damper->stop = stop ? *stop : (ed_stop){0};
}

void ed_damper_free(ed_damper *damper)
{
  if (!damper)
    return;
  ed_damper_clear(damper);
  free(damper);
}

int ed_damper_step(const ed_damper *damper, int method, double fineness, const double *committed, double h, double u0, double v0,
                   double u1, double v1, double *trial, double *force, double *slope)
{
  const int size = ed_damper_state_size(damper);
  double none = 0.0;
  if (!(h > 0.0) || !isfinite(h + u0 + v0 + u1 + v1))
    return ED_E_ARGUMENT;
  if (!ed_all_finite((size_t)size, committed))
    return ED_E_NOT_FINITE;
  if (size == 0) /* the caller need not have a place for nothing */
    committed = trial = &none;
  ed_watch watch = ed_watch_of(&damper->stop);
  ed_stepper stepper;
  int status = ed_stepper_open(&stepper, damper, method, fineness, &watch);
  if (status != ED_OK)
    return status;
  ed_path path, direction[2];
  ed_damper_force out = {0};
  ed_path_hermite(&path, h, u0, v0, u1, v1);
  ed_path_hermite_directions(direction, h);
  memcpy(trial, committed, (size_t)size * sizeof *trial);
  status = ed_stepper_along(&stepper, committed, &path, direction, trial, &out);
  ed_stepper_close(&stepper);
  if (status != ED_OK)
    return status;
  if (!isfinite(out.force + out.slope[0] + out.slope[1]) || !ed_all_finite((size_t)size, trial))
    return ED_E_NOT_FINITE;
  *force = out.force;
  slope[0] = out.slope[0];
  slope[1] = out.slope[1];
  return ED_OK;
}

/* One step from `state` to `trial`, without derivatives. */
static int along(ed_test_run *in, const ed_path *path, ed_damper_force *out)
{
  static const ed_path none[2] = {{0}};
  const ed_damper *damper = in->stepper.damper;
  ed_law_forces *law = in->law;
  *out = (ed_damper_force){0};
  if (!law)
    return ed_stepper_along(&in->stepper, in->state, path, none, in->trial, out);
  if (law->known) {
    out->force = law->force[law->at++];
  } else {
    if (!isnormal(path->h))
      return ED_E_ARGUMENT;
    const int status = damper->law->step(damper, in->state, path, none, in->trial, out);
    if (status != ED_OK)
      return status;
    law->force[law->at++] = out->force;
  }
  return ed_effects_apply(damper, in->state, path, none, in->trial, out);
}

/* Steps from sample to sample. */
static int step_by_step(ed_test_run *in, int n, const double *time, const double *u, const double *v, double *force, int *done)
{
  const size_t size = (size_t)ed_damper_state_size(in->stepper.damper) * sizeof *in->state;
  ed_path path;
  ed_damper_force out = {0};
  for (int i = *done; i < n; i++) {
    if (ed_watch_step(in->watch))
      return ED_E_STOPPED;
    ed_path_hermite(&path, time[i] - time[i - 1], u[i - 1], v[i - 1], u[i], v[i]);
    memcpy(in->trial, in->state, size); /* no guess from an older step */
    const int status = along(in, &path, &out);
    if (status != ED_OK)
      return status;
    if (!isfinite(out.force))
      return ED_E_NOT_FINITE;
    ed_test_run_accept(in);
    force[i] = out.force;
    *done = i + 1;
  }
  return ED_OK;
}

/* A step so short that it leads to the first velocity and nowhere else. */
static void jump_path(ed_path *path, int n, const double *time, const double *u, const double *v)
{
  const double h = 1e-9 * (n > 1 ? time[1] - time[0] : 1.0);
  ed_path_hermite(path, h, u[0], v[0], u[0] + h * v[0], v[0]);
}

/* Adds the effects to the law's forces at all samples. held: the force before the first velocity. */
static int add_effects(ed_test_run *in, int n, const double *time, const double *u, const double *v, double slowly, double held,
                         double *force, int *done)
{
  const ed_damper *damper = in->stepper.damper;
  double *state = in->state, *trial = in->trial;
  const size_t size = (size_t)ed_damper_state_size(damper) * sizeof *state;
  const ed_path none[2] = {{0}};
  ed_path path;
  ed_damper_force out = {.force = held};
  ed_path_hermite(&path, slowly, 0.0, 0.0, u[0], 0.0);
  memcpy(trial, state, size);
  int status = ed_effects_apply(damper, state, &path, none, trial, &out);
  memcpy(state, trial, size);
  if (status == ED_OK && in->before) {
    ed_path_hermite(&path, in->rest, u[0], 0.0, u[0], 0.0);
    ed_effects_keep(damper, in->before, state);
    out.force = held;
    status = ed_effects_apply(damper, state, &path, none, trial, &out);
    memcpy(state, trial, size);
  }
  if (status == ED_OK && v[0] != 0.0) {
    jump_path(&path, n, time, u, v);
    out.force = force[0];
    status = ed_effects_apply(damper, state, &path, none, trial, &out);
    ed_effects_jump(damper, state, trial);
  }
  force[0] = out.force;
  *done = 1;
  for (int i = 1; status == ED_OK && i < n; i++) {
    if (ed_watch_step(in->watch))
      return ED_E_STOPPED;
    ed_path_hermite(&path, time[i] - time[i - 1], u[i - 1], v[i - 1], u[i], v[i]);
    out.force = force[i];
    status = ed_effects_apply(damper, state, &path, none, trial, &out);
    memcpy(state, trial, size);
    force[i] = out.force;
    *done = i + (status == ED_OK);
  }
  return status;
}

/* All samples by SUNDIALS, and the effects behind it. */
static int integrated(ed_test_run *in, int n, const double *time, const double *u, const double *v, double slowly, double *force,
                      int *done)
{
  const ed_damper *damper = in->stepper.damper;
  const double ramp_time[2] = {0.0, slowly}, ramp_u[2] = {0.0, u[0]}, ramp_v[2] = {0.0, 0.0};
  double ramp_force[2] = {0.0}, *state = in->state;
  int status = ED_OK, reached = 0;
  if (u[0] != 0.0)
    status = ed_ode_system_history(in->stepper.system, state, 2, ramp_time, ramp_u, ramp_v, ramp_force, &reached);
  if (damper->law->remember) /* the first velocity, which a motion that slows down from it does not reach again */
    damper->law->remember(damper, u[0], v[0], state, state + damper->n_ode);
  if (status == ED_OK)
    status = ed_ode_system_history(in->stepper.system, state, n, time, u, v, force, done);
  if (status == ED_OK && damper->n_effects > 0)
    status = add_effects(in, n, time, u, v, slowly, ramp_force[1], force, done);
  return status;
}

int ed_test_run_hold(ed_test_run *in, int n, const double *time, const double *u, const double *v, double slowly, double *force)
{
  const ed_damper *damper = in->stepper.damper;
  const size_t size = (size_t)ed_damper_state_size(damper) * sizeof *in->state;
  ed_path path;
  ed_damper_force out = {0};
  ed_path_hermite(&path, slowly, 0.0, 0.0, u[0], 0.0);
  int status = along(in, &path, &out);
  memcpy(in->state, in->trial, size);
  if (status == ED_OK && in->before && damper->n_effects > 0) {
    ed_path_hermite(&path, in->rest, u[0], 0.0, u[0], 0.0);
    ed_effects_keep(damper, in->before, in->state);
    memcpy(in->trial, in->state, size);
    status = along(in, &path, &out);
    memcpy(in->state, in->trial, size);
  }
  force[0] = out.force; /* corrected below for a first velocity */
  if (status == ED_OK && v[0] != 0.0) {
    jump_path(&path, n, time, u, v);
    status = along(in, &path, &out);
    force[0] = out.force;
    ed_effects_jump(damper, in->state, in->trial);
  }
  return status == ED_OK && !isfinite(force[0]) ? ED_E_NOT_FINITE : status;
}

int ed_test_run_history(ed_test_run *in, int n, const double *time, const double *u, const double *v, double *force, int *done)
{
  /* to the first deformation so slowly that nothing viscous is left of the way, then a stop */
  const double slowly = 1e6 * (time[n - 1] - time[0] + 1.0);
  ed_test_run_begin(in);
  ed_stepper_plan(&in->stepper, NULL);
  *done = 1;
  if (in->stepper.system)
    return integrated(in, n, time, u, v, slowly, force, done);
  const int status = ed_test_run_hold(in, n, time, u, v, slowly, force);
  return status == ED_OK ? step_by_step(in, n, time, u, v, force, done) : status;
}

int ed_damper_history(const ed_damper *damper, int method, double fineness, int n, const double *time, const double *u,
                      const double *v, double *force, int *done)
{
  int status = ed_check_samples(n, time, u, v, done);
  if (status != ED_OK)
    return status;
  ed_watch watch = ed_watch_of(&damper->stop);
  ed_test_run run;
  status = ed_test_run_open(&run, damper, method, fineness, &watch);
  if (status == ED_OK)
    status = ed_test_run_history(&run, n, time, u, v, force, done);
  ed_test_run_close(&run);
  return status;
}
