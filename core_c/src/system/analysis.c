#include "system/analysis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of the members that have one; without any, 1. */
static double mean_length(const ed_members *members, int n)
{
  double total = 0.0;
  int long_ones = 0;
  for (int m = 0; m < n; m++) {
    total += members->element[m].length;
    long_ones += members->element[m].length > 0.0;
  }
  return long_ones ? total / long_ones : 1.0;
}

static int prepare(ed_analysis *a)
{
  const ed_model *model = a->model;
  int status;
  if ((status = ed_number(a)) != ED_OK || (status = ed_members_allocate(a)) != ED_OK)
    return status;
  const int n = a->numbering.n;
  if ((status = ed_set_length(&a->numbering, mean_length(&a->members, model->n_members))) != ED_OK ||
      (status = ed_loading_allocate(&a->loading, model, n)) != ED_OK ||
      (status = ed_iteration_allocate(&a->iteration, n)) != ED_OK || (status = ed_state_allocate(a)) != ED_OK ||
      (status = ed_build_pattern(a)) != ED_OK || (status = ed_factors_allocate(a)) != ED_OK)
    return status;
  const size_t bytes = ((size_t)a->matrix.nnz + 1) * sizeof(double);
  a->fallbacks.events = calloc(ED_MAX_EVENTS, sizeof *a->fallbacks.events);
  a->damping.reference = malloc(bytes);
  if (!a->fallbacks.events || !a->damping.reference)
    return ED_E_MEMORY;
  a->matrix.stamp = 1;
  a->matrix.damped_stamp = 0;
  if ((status = ed_check_structure(a)) != ED_OK || (status = ed_condensation_allocate(a)) != ED_OK)
    return status;
  memcpy(a->matrix.initial, a->matrix.tangent, bytes);
  memcpy(a->matrix.initial_damping, ed_damping_tangent(a), bytes);
  memcpy(a->damping.reference, a->matrix.initial_damping, bytes);
  return ED_OK;
}

ed_analysis *ed_analysis_new(const ed_model *model, int *status, char *message, int size)
{
  ed_analysis *a = calloc(1, sizeof *a);
  *status = ED_E_MEMORY;
  if (a) {
    a->model = model;
    a->settings.tolerance = 1e-7;
    a->settings.max_iterations = 25;
    a->settings.halvings = 8;
    a->settings.reuse = 1;
    a->settings.energy = 1;
    a->damping.rayleigh_kind = ED_STIFFNESS_INITIAL;
    a->members.control.tolerance = 1e-16;
    a->devices.tolerance = 1e-6;
    a->members.control.fast_elastic = 1;
    *status = prepare(a);
  }
  if (*status == ED_OK)
    return a;
  if (size > 0)
    snprintf(message, (size_t)size, "%s", *status == ED_E_MEMORY ? "out of memory" : a->message);
  ed_analysis_free(a);
  return NULL;
}

void ed_analysis_free(ed_analysis *a)
{
  if (!a)
    return;
  ed_run_end(a);
  ed_numbering_free(&a->numbering);
  ed_members_free(&a->members, a->model->n_members);
  free(a->trial.block);
  free(a->committed.block);
  ed_storage_free(&a->storage);
  ed_loading_free(&a->loading);
  ed_devices_free(&a->devices);
  ed_damping_free(&a->damping);
  ed_matrices_free(&a->matrix);
  ed_factors_free(&a->factors);
  ed_iteration_free(&a->iteration);
  ed_condensation_free(&a->condensation);
  free(a->fallbacks.events);
  ed_channels_free(&a->channels);
  free(a);
}

const char *ed_analysis_message(const ed_analysis *a)
{
  return a->message;
}

void ed_analysis_ask(ed_analysis *a, const ed_stop *stop)
{
  a->stop = stop ? *stop : (ed_stop){0};
}

int ed_n_equations(const ed_analysis *a)
{
  return a->numbering.n;
}

int ed_n_nonzeros(const ed_analysis *a)
{
  return a->matrix.nnz;
}

void ed_equations(const ed_analysis *a, int *equation)
{
  memcpy(equation, a->numbering.equation, (size_t)a->numbering.degrees * sizeof *equation);
}

int ed_stiffness(ed_analysis *a, int *column_start, int *row, double *value)
{
  ed_assemble_tangent(a);
  memcpy(column_start, a->matrix.column_start, ((size_t)a->numbering.n + 1) * sizeof *column_start);
  memcpy(row, a->matrix.row, (size_t)a->matrix.nnz * sizeof *row);
  memcpy(value, a->matrix.tangent, (size_t)a->matrix.nnz * sizeof *value);
  for (int i = 0; i < a->matrix.nnz; i++)
    if (!isfinite(value[i]))
      return ed_fail(a, ED_E_NOT_FINITE, "a term of the stiffness in row %d is not a finite number", row[i] + 1);
  return ED_OK;
}

void ed_mass(const ed_analysis *a, double *mass)
{
  memcpy(mass, a->numbering.mass, (size_t)a->numbering.n * sizeof *mass);
}

int ed_unstable_directions(ed_analysis *a)
{
  return ed_factor_effective(a, 1.0, 0.0, 0.0) == ED_OK ? ed_solver_negative_pivots(a->factors.solver) : -1;
}

int ed_set(ed_analysis *a, int setting, double value)
{
  if (a->run.kind != ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "settings cannot change during a run");
  if (!isfinite(value) || value < 0.0)
    return ed_fail(a, ED_E_ARGUMENT, "setting %d: %g is not allowed", setting, value);
  switch (setting) {
    case ED_TOLERANCE:
      if (!(value > 0.0 && value < 1.0))
        return ed_fail(a, ED_E_ARGUMENT, "the tolerance %g is not between 0 and 1", value);
      a->settings.tolerance = value;
      return ED_OK;
    case ED_MAX_ITERATIONS:
      if (value < 1.0 || value > ED_MAX_RESIDUALS)
        return ed_fail(a, ED_E_ARGUMENT, "iterations must be in 1..%d", ED_MAX_RESIDUALS);
      a->settings.max_iterations = (int)value;
      return ED_OK;
    case ED_ELEMENT_TOLERANCE:
      a->members.control.tolerance = value;
      return ED_OK;
    case ED_HALVINGS:
      if (value > 20.0)
        return ed_fail(a, ED_E_ARGUMENT, "more than 20 halvings are not allowed");
      a->settings.halvings = (int)value;
      return ED_OK;
    case ED_FAST_ELASTIC:
      a->members.control.fast_elastic = value != 0.0;
      return ED_OK;
    case ED_REUSE_FACTORS:
      a->settings.reuse = value != 0.0;
      return ED_OK;
    case ED_ENERGY:
      if (value != 0.0 && !a->settings.energy)
        ed_restart_energy(a);
      a->settings.energy = value != 0.0;
      return ED_OK;
    default:
      return ed_fail(a, ED_E_ARGUMENT, "unknown setting %d", setting);
  }
}

void ed_get_statistics(const ed_analysis *a, ed_statistics *statistics)
{
  *statistics = a->statistics;
  statistics->state_updates = a->members.control.updates;
  statistics->element_iterations = a->members.control.iterations;
  statistics->elastic_updates = a->members.control.elastic;
}

int ed_n_events(const ed_analysis *a)
{
  return a->fallbacks.n_events;
}

void ed_get_event(const ed_analysis *a, int index, ed_event *event)
{
  if (index >= 0 && index < a->fallbacks.n_events)
    *event = a->fallbacks.events[index];
}
