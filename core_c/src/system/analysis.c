#include "system/analysis.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int ed_fail(ed_analysis *a, int status, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(a->message, sizeof a->message, format, arguments);
  va_end(arguments);
  return status;
}

static int allocate_work(ed_analysis *a)
{
  const ed_model *model = a->model;
  const size_t n = (size_t)a->n, degrees = 3 * (size_t)model->n_nodes;
  double **vectors[] = {&a->r, &a->du, &a->work, &a->work2, &a->predicted, &a->external, &a->external_committed, &a->solver_scale};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    if (!(*vectors[i] = calloc(n, sizeof(double))))
      return ED_E_MEMORY;
  for (size_t i = 0; i < n; i++)
    a->solver_scale[i] = a->rotational[i] ? 1.0 / a->length : 1.0;
  a->displacement = calloc(degrees, sizeof(double));
  a->resisting = calloc(degrees, sizeof(double));
  a->member_force = calloc(6 * (size_t)model->n_members + 1, sizeof(double));
  a->factors = calloc((size_t)model->n_patterns + 1, sizeof(double));
  a->factors_committed = calloc((size_t)model->n_patterns + 1, sizeof(double));
  a->factors_backup = calloc((size_t)model->n_patterns + 1, sizeof(double));
  a->loads_committed = calloc((size_t)model->n_members + 1, sizeof *a->loads_committed);
  a->residuals = calloc(ED_MAX_RESIDUALS, sizeof(double));
  a->events = calloc(ED_MAX_EVENTS, sizeof *a->events);
  return a->displacement && a->resisting && a->member_force && a->factors && a->factors_committed &&
                 a->factors_backup && a->loads_committed && a->residuals && a->events
             ? ED_OK
             : ED_E_MEMORY;
}

static int prepare(ed_analysis *a)
{
  const ed_model *model = a->model;
  int status = ed_number(a);
  if (status != ED_OK)
    return status;
  a->elements = calloc((size_t)model->n_members + 1, sizeof *a->elements);
  if (!a->elements)
    return ED_E_MEMORY;
  double total = 0.0;
  int long_ones = 0;
  for (int m = 0; m < model->n_members; m++) {
    if (!ed_element_setup(&a->elements[m], model, m))
      return ed_fail(a, ED_E_NOT_FINITE, "element %s: its length or stiffness is not a finite number", model->members[m].name);
    total += a->elements[m].length;
    a->n_struts += a->elements[m].kind == ED_STRUT;
    long_ones += a->elements[m].length > 0.0;
  }
  a->length = long_ones ? total / long_ones : 1.0;
  if ((status = allocate_work(a)) != ED_OK || (status = ed_state_allocate(a)) != ED_OK ||
      (status = ed_build_pattern(a)) != ED_OK)
    return status;
  a->tangent_stamp = 1;
  a->damped_stamp = 0;
  a->factored_stamp = -1;
  if ((status = ed_check_structure(a)) != ED_OK || (status = ed_condensation_allocate(a)) != ED_OK)
    return status;
  memcpy(a->initial, a->tangent, ((size_t)a->nnz + 1) * sizeof(double));
  memcpy(a->initial_damping, ed_damping_tangent(a), ((size_t)a->nnz + 1) * sizeof(double));
  memcpy(a->reference, a->initial_damping, ((size_t)a->nnz + 1) * sizeof(double));
  return ED_OK;
}

ed_analysis *ed_analysis_new(const ed_model *model, int *status, char *message, int size)
{
  ed_analysis *a = calloc(1, sizeof *a);
  *status = ED_E_MEMORY;
  if (a) {
    a->model = model;
    a->tolerance = 1e-7;
    a->max_iterations = 25;
    a->halvings = 8;
    a->reuse = 1;
    a->energy = 1;
    a->rayleigh_kind = ED_STIFFNESS_INITIAL;
    a->control.tolerance = 1e-16;
    a->damper_tolerance = 1e-6;
    a->control.fast_elastic = 1;
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
  ed_solver_free(a->solver);
  ed_devices_free(a);
  for (int m = 0; a->elements && m < a->model->n_members; m++)
    ed_element_clear(&a->elements[m]);
  void *blocks[] = {a->equation,        a->support,         a->mass,          a->influence[0],  a->influence[1],    a->rotational,
                    a->name,            a->column_start,  a->row,           a->diagonal,        a->scatter,
                    a->tangent,         a->initial,       a->initial_damping, a->damped,      a->reference,     a->effective,     a->kept.matrix,    a->backed.matrix,     a->elements,        a->trial.block,
                    a->committed.block, a->block_backup,  a->layers,        a->layers_backup,   a->records,       a->displacement,
                    a->resisting,       a->member_force,  a->factors,       a->factors_committed, a->factors_backup,
                    a->external,        a->external_committed, a->loads_committed, a->modal,     a->modal_solved,
                    a->modal_small,     a->modal_pivot,   a->r,             a->du,              a->work,
                    a->work2,           a->predicted,     a->residuals,     a->channels,        a->terms,
                    a->maximum,         a->minimum,       a->time_maximum,  a->time_minimum,    a->last,
                    a->events,          a->solver_scale};
  for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++)
    free(blocks[i]);
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
  return a->n;
}

int ed_n_nonzeros(const ed_analysis *a)
{
  return a->nnz;
}

void ed_equations(const ed_analysis *a, int *equation)
{
  memcpy(equation, a->equation, 3 * (size_t)a->model->n_nodes * sizeof *equation);
}

int ed_stiffness(ed_analysis *a, int *column_start, int *row, double *value)
{
  ed_assemble_tangent(a);
  memcpy(column_start, a->column_start, ((size_t)a->n + 1) * sizeof *column_start);
  memcpy(row, a->row, (size_t)a->nnz * sizeof *row);
  memcpy(value, a->tangent, (size_t)a->nnz * sizeof *value);
  for (int i = 0; i < a->nnz; i++)
    if (!isfinite(value[i]))
      return ed_fail(a, ED_E_NOT_FINITE, "a term of the stiffness in row %d is not a finite number", row[i] + 1);
  return ED_OK;
}

void ed_mass(const ed_analysis *a, double *mass)
{
  memcpy(mass, a->mass, (size_t)a->n * sizeof *mass);
}

int ed_unstable_directions(ed_analysis *a)
{
  return ed_factor_effective(a, 1.0, 0.0, 0.0) == ED_OK ? ed_solver_negative_pivots(a->solver) : -1;
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
      a->tolerance = value;
      return ED_OK;
    case ED_MAX_ITERATIONS:
      if (value < 1.0 || value > ED_MAX_RESIDUALS)
        return ed_fail(a, ED_E_ARGUMENT, "iterations must be in 1..%d", ED_MAX_RESIDUALS);
      a->max_iterations = (int)value;
      return ED_OK;
    case ED_ELEMENT_TOLERANCE:
      a->control.tolerance = value;
      return ED_OK;
    case ED_HALVINGS:
      if (value > 20.0)
        return ed_fail(a, ED_E_ARGUMENT, "more than 20 halvings are not allowed");
      a->halvings = (int)value;
      return ED_OK;
    case ED_FAST_ELASTIC:
      a->control.fast_elastic = value != 0.0;
      return ED_OK;
    case ED_REUSE_FACTORS:
      a->reuse = value != 0.0;
      return ED_OK;
    case ED_ENERGY:
      if (value != 0.0 && !a->energy)
        ed_restart_energy(a);
      a->energy = value != 0.0;
      return ED_OK;
    default:
      return ed_fail(a, ED_E_ARGUMENT, "unknown setting %d", setting);
  }
}

void ed_get_statistics(const ed_analysis *a, ed_statistics *statistics)
{
  *statistics = a->statistics;
  statistics->state_updates = a->control.updates;
  statistics->element_iterations = a->control.iterations;
  statistics->elastic_updates = a->control.elastic;
}

int ed_n_events(const ed_analysis *a)
{
  return a->n_events;
}

void ed_get_event(const ed_analysis *a, int index, ed_event *event)
{
  if (index >= 0 && index < a->n_events)
    *event = a->events[index];
}
