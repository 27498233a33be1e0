/* Dampers on their own: one step, and force histories under given deformation. */
#include "base/finite.h"
#include "damper/law.h"
#include "damper/ode_system.h"

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

int ed_damper_amend(ed_damper *damper, int kind, int inside, int n_parameters, const double *parameters, char *message, int size)
{
  char text[ED_DAMPER_MESSAGE] = "";
  const int status = ed_damper_add_amendment(damper, kind, inside, n_parameters, parameters, text);
  if (status != ED_OK && size > 0)
    snprintf(message, (size_t)size, "%s", text);
  return status;
}

int ed_damper_been(ed_damper *damper, const double extremes[4])
{
  for (int i = 0; i < 4; i++)
    if (!isfinite(extremes[i]) || (i % 2 ? extremes[i] > 0.0 : extremes[i] < 0.0))
      return ED_E_ARGUMENT;
  memcpy(damper->been, extremes, sizeof damper->been);
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

/* The system for SUNDIALS, if this damper and method need one. */
static ed_ode_system *system_for(const ed_damper *damper, int method, double tolerance, ed_watch *watch, int *status)
{
  *status = ED_OK;
  if (method == ED_DAMPER_BEST && ed_damper_has_exact_step(damper))
    return NULL;
  if (!damper->law->rate || damper->joint > 0.0 || (damper->brace > 0.0 && !damper->law->takes_brace)) {
    *status = ED_E_STATE;
    return NULL;
  }
  ed_ode_system *system = ed_ode_system_new(1, &damper, tolerance, status);
  if (system)
    ed_ode_system_watch(system, watch);
  return system;
}

int ed_damper_step(const ed_damper *damper, int method, double tolerance, const double *committed, double h, double u0, double v0,
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
  int status;
  ed_watch watch = ed_watch_of(&damper->stop);
  ed_ode_system *system = system_for(damper, method, tolerance, &watch, &status);
  if (status != ED_OK)
    return status;
  ed_path path, direction[2];
  ed_damper_force out = {0};
  ed_path_hermite(&path, h, u0, v0, u1, v1);
  ed_path_hermite_directions(direction, h);
  memcpy(trial, committed, (size_t)size * sizeof *trial);
  status = system ? ed_ode_system_step(system, &committed, &path, (const ed_path(*)[2])direction, &trial, &out)
                  : ed_damper_advance(damper, NULL, committed, &path, direction, trial, &out);
  ed_ode_system_free(system);
  if (status != ED_OK)
    return status;
  if (!isfinite(out.force + out.slope[0] + out.slope[1]) || !ed_all_finite((size_t)size, trial))
    return ED_E_NOT_FINITE;
  *force = out.force;
  slope[0] = out.slope[0];
  slope[1] = out.slope[1];
  return ED_OK;
}

int ed_check_samples(int n, const double *time, const double *u, const double *v, int *done)
{
  for (*done = 0; *done < n; ++*done) {
    const int i = *done;
    if (!isfinite(time[i] + u[i] + v[i]))
      return ED_E_NOT_FINITE;
    if (i > 0 && !(time[i] > time[i - 1]))
      return ED_E_ARGUMENT;
  }
  *done = 0;
  return n >= 1 ? ED_OK : ED_E_ARGUMENT;
}

/* Exact steps from sample to sample. */
static int exact_history(const ed_damper *damper, double *state, double *trial, int n, const double *time, const double *u,
                         const double *v, double *force, int *done)
{
  ed_watch watch = ed_watch_of(&damper->stop);
  ed_path path;
  const ed_path none[2] = {{0}}; /* no derivative is asked for */
  ed_damper_force out = {0};
  for (int i = *done; i < n; i++) {
    if (ed_watch_step(&watch))
      return ED_E_STOPPED;
    ed_path_hermite(&path, time[i] - time[i - 1], u[i - 1], v[i - 1], u[i], v[i]);
    memcpy(trial, state, (size_t)ed_damper_state_size(damper) * sizeof *trial); /* no guess from an older step */
    const int status = ed_damper_advance(damper, NULL, state, &path, none, trial, &out);
    if (status != ED_OK)
      return status;
    if (!isfinite(out.force))
      return ED_E_NOT_FINITE;
    double *swap = state;
    state = trial;
    trial = swap;
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

/* Amends the law's forces at all samples. held: the force before the first velocity. */
static int amend_history(const ed_damper *damper, double *state, double *trial, int n, const double *time, const double *u,
                         const double *v, double slowly, double held, double *force, int *done)
{
  const size_t size = (size_t)ed_damper_state_size(damper) * sizeof *state;
  const ed_path none[2] = {{0}};
  ed_watch watch = ed_watch_of(&damper->stop);
  ed_path path;
  ed_damper_force out = {.force = held};
  ed_path_hermite(&path, slowly, 0.0, 0.0, u[0], 0.0);
  int status = ed_amend(damper, state, &path, none, trial, &out);
  memcpy(state, trial, size);
  if (status == ED_OK && v[0] != 0.0) {
    jump_path(&path, n, time, u, v);
    out.force = force[0];
    status = ed_amend(damper, state, &path, none, trial, &out);
    ed_amendments_jump(damper, state, trial);
  }
  force[0] = out.force;
  *done = 1;
  for (int i = 1; status == ED_OK && i < n; i++) {
    if (ed_watch_step(&watch))
      return ED_E_STOPPED;
    ed_path_hermite(&path, time[i] - time[i - 1], u[i - 1], v[i - 1], u[i], v[i]);
    out.force = force[i];
    status = ed_amend(damper, state, &path, none, trial, &out);
    memcpy(state, trial, size);
    force[i] = out.force;
    *done = i + (status == ED_OK);
  }
  return status;
}

int ed_damper_history(const ed_damper *damper, int method, double tolerance, int n, const double *time, const double *u,
                      const double *v, double *force, int *done)
{
  int status = ed_check_samples(n, time, u, v, done);
  if (status != ED_OK)
    return status;
  ed_watch watch = ed_watch_of(&damper->stop);
  ed_ode_system *system = system_for(damper, method, tolerance, &watch, &status);
  if (status != ED_OK)
    return status;
  const size_t size = (size_t)ed_damper_state_size(damper);
  double *state = calloc(2 * size + 1, sizeof *state);
  if (!state) {
    ed_ode_system_free(system);
    return ED_E_MEMORY;
  }
  ed_damper_start(damper, state);
  ed_amendments_start(damper, state, 0);
  /* to the first deformation so slowly that nothing viscous is left of the way, then a stop */
  const double slowly = 1e6 * (time[n - 1] - time[0] + 1.0);
  const double ramp_time[2] = {0.0, slowly}, ramp_u[2] = {0.0, u[0]}, ramp_v[2] = {0.0, 0.0};
  double ramp_force[2] = {0.0};
  *done = 1;
  if (system) {
    int reached = 0;
    if (u[0] != 0.0)
      status = ed_ode_system_history(system, state, 2, ramp_time, ramp_u, ramp_v, ramp_force, &reached);
    if (damper->law->remember) /* the first velocity, which a motion that slows down from it does not reach again */
      damper->law->remember(damper, u[0], v[0], state, state + damper->n_ode);
    if (status == ED_OK)
      status = ed_ode_system_history(system, state, n, time, u, v, force, done);
    if (status == ED_OK && damper->n_amendments > 0)
      status = amend_history(damper, state, state + size, n, time, u, v, slowly, ramp_force[1], force, done);
  } else {
    ed_path hold;
    const ed_path none[2] = {{0}};
    ed_damper_force out = {0};
    ed_path_hermite(&hold, slowly, 0.0, 0.0, u[0], 0.0);
    status = ed_damper_advance(damper, NULL, state, &hold, none, state + size, &out);
    memcpy(state, state + size, size * sizeof *state);
    force[0] = out.force; /* corrected below for a first velocity */
    if (status == ED_OK && v[0] != 0.0) { /* the jump to the first velocity: a step of no deformation */
      ed_path start;
      jump_path(&start, n, time, u, v);
      status = ed_damper_advance(damper, NULL, state, &start, none, state + size, &out);
      force[0] = out.force;
      ed_amendments_jump(damper, state, state + size);
    }
    if (status == ED_OK && !isfinite(force[0]))
      status = ED_E_NOT_FINITE;
    if (status == ED_OK)
      status = exact_history(damper, state, state + size, n, time, u, v, force, done);
  }
  free(state);
  ed_ode_system_free(system);
  return status;
}
