/* Forces on a frame during a history that the caller gives from step to step, such as that of a damper in a laboratory.
 *
 * Over a step a force is linear. It may jump from the end of one step to the start of the next. Accelerations jump with it where there
 * is mass; degrees without mass go from balance with the force before the jump to balance at the end of the step. */
#include "system/analysis.h"

#include <math.h>

/* Displacement of the committed state along a force. */
static double along(const ed_analysis *a, const ed_history_load *load)
{
  double sum = 0.0;
  for (int i = 0; i < load->n_terms; i++)
    sum += load->coefficient[i] * a->committed.u[load->equation[i]];
  return sum;
}

int ed_history_force(ed_analysis *a, int n, const int *node, const int *degree, const double *coefficient)
{
  ed_run *run = &a->run;
  if (run->kind != ED_RUN_HISTORY)
    return ed_fail(a, ED_E_STATE, "a force of a history is given while one runs");
  if (run->n_forces == ED_HISTORY_FORCES)
    return ed_fail(a, ED_E_ARGUMENT, "a history has %d forces at most", ED_HISTORY_FORCES);
  if (n < 1 || n > ED_MAX_GIVEN_TERMS)
    return ed_fail(a, ED_E_ARGUMENT, "a force of a history acts on 1 to %d degrees, not %d", ED_MAX_GIVEN_TERMS, n);
  ed_history_load load = {0};
  int place[ED_MAX_TERMS];
  double along_it[ED_MAX_TERMS];
  for (int i = 0; i < n; i++) {
    if (node[i] < 0 || node[i] >= a->model->n_nodes || degree[i] < 0 || degree[i] >= ed_degrees(a->model))
      return ed_fail(a, ED_E_ID, "there is no degree %d of node %d", degree[i], node[i]);
    if (!isfinite(coefficient[i]))
      return ed_fail(a, ED_E_NOT_FINITE, "coefficient %d of a force is not a finite number", i + 1);
    place[i] = ed_degrees(a->model) * node[i] + degree[i];
    along_it[i] = coefficient[i];
  }
  const int terms = ed_put_on_masters(a->model, n, place, along_it);
  for (int i = 0; i < terms; i++) {
    const int equation = a->numbering.equation[place[i]];
    if (equation < 0) {
      load.fixed[load.n_fixed] = place[i];
      load.fixed_coefficient[load.n_fixed++] = along_it[i];
    } else {
      load.equation[load.n_terms] = equation;
      load.coefficient[load.n_terms++] = along_it[i];
    }
  }
  if (load.n_fixed > 0 && run->n_motions > 0)
    return ed_fail(a, ED_E_ARGUMENT, "a force of a history cannot act on supports of which some move");
  if (load.n_terms == 0)
    return ed_fail(a, ED_E_ARGUMENT, "a force of a history acts on supports alone");
  load.origin = along(a, &load);
  a->trial.head->given_work[run->n_forces] = a->committed.head->given_work[run->n_forces] = 0.0;
  run->force[run->n_forces] = load;
  return run->n_forces++;
}

int ed_history_set_force(ed_analysis *a, int force, double start, double end)
{
  ed_run *run = &a->run;
  if (run->kind != ED_RUN_HISTORY || run->failed || run->limited)
    return ed_fail(a, ED_E_STATE, "a force of a history is given while one runs");
  if (force < 0 || force >= run->n_forces)
    return ed_fail(a, ED_E_ID, "there is no force %d of the history", force);
  if (!isfinite(start) || !isfinite(end))
    return ed_fail(a, ED_E_NOT_FINITE, "force %d of the history is not a finite number", force);
  ed_history_load *load = &run->force[force];
  const double jump = start - load->start;
  for (int i = 0; i < load->n_terms; i++) {
    const double mass = a->numbering.mass[load->equation[i]];
    if (mass > 0.0 && !isfinite(a->committed.a[load->equation[i]] + load->coefficient[i] * jump / mass))
      return ed_fail(a, ED_E_NOT_FINITE, "the acceleration by force %d of the history is not a finite number", force);
  }
  for (int i = 0; i < load->n_terms; i++) {
    const int equation = load->equation[i];
    if (a->numbering.mass[equation] > 0.0)
      a->trial.a[equation] = a->committed.a[equation] += load->coefficient[i] * jump / a->numbering.mass[equation];
  }
  load->start = start;
  load->end = end;
  return ED_OK;
}

void ed_move_history_forces(ed_run *run, double from, double to)
{
  for (int k = 0; k < run->n_forces; k++) {
    ed_history_load *load = &run->force[k];
    load->before = load->start + from * (load->end - load->start);
    load->now = to >= 1.0 ? load->end : load->start + to * (load->end - load->start);
    load->before_without_mass = from <= 0.0 ? load->last : load->before;
  }
}

void ed_finish_history_forces(ed_run *run)
{
  for (int k = 0; k < run->n_forces; k++)
    run->force[k].last = run->force[k].start = run->force[k].end;
}

static double before(const double *mass, const ed_history_load *load, int term)
{
  return mass[load->equation[term]] > 0.0 ? load->before : load->before_without_mass;
}

void ed_add_history_forces(const ed_run *run, const double *mass, double share_before, double *r)
{
  for (int k = 0; k < run->n_forces; k++) {
    const ed_history_load *load = &run->force[k];
    for (int i = 0; i < load->n_terms; i++)
      r[load->equation[i]] += load->coefficient[i] * ((1.0 - share_before) * load->now + share_before * before(mass, load, i));
  }
}

double ed_history_force_work(ed_analysis *a)
{
  double all = 0.0;
  for (int k = 0; k < a->run.n_forces; k++) {
    const ed_history_load *load = &a->run.force[k];
    double work = 0.0;
    for (int i = 0; i < load->n_terms; i++) {
      const int equation = load->equation[i];
      work += 0.5 * load->coefficient[i] * (before(a->numbering.mass, load, i) + load->now) *
              (a->trial.u[equation] - a->committed.u[equation]);
    }
    a->trial.head->given_work[k] += work;
    all += work;
  }
  return all;
}

double ed_history_force_value(const ed_analysis *a, int kind, int force)
{
  if (force >= a->run.n_forces)
    return 0.0;
  const ed_history_load *load = &a->run.force[force];
  if (kind == ED_GIVEN_FORCE)
    return load->now;
  return kind == ED_GIVEN_WORK ? -a->committed.head->given_work[force] : load->origin - along(a, load);
}

double ed_history_force_on(const ed_run *run, int degree)
{
  double sum = 0.0;
  for (int k = 0; k < run->n_forces; k++) {
    const ed_history_load *load = &run->force[k];
    for (int i = 0; i < load->n_fixed; i++)
      if (load->fixed[i] == degree)
        sum += load->fixed_coefficient[i] * load->now;
  }
  return sum;
}

void ed_largest_history_force(const ed_run *run, const int *rotational, double *force, double *moment)
{
  for (int k = 0; k < run->n_forces; k++) {
    const ed_history_load *load = &run->force[k];
    for (int i = 0; i < load->n_terms; i++) {
      double *largest = rotational[load->equation[i]] ? moment : force;
      *largest = fmax(*largest, fabs(load->coefficient[i] * load->now));
    }
  }
}
