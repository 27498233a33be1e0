/* Displacement control: the load factor of a pattern follows so that one degree moves as asked (Batoz & Dhatt 1979). */
#include "system/analysis.h"

#include <math.h>
#include <string.h>

/* Sum of a pattern's nodal loads over the equations. */
static void reference_load(const ed_analysis *a, int pattern, double *load)
{
  memset(load, 0, (size_t)a->numbering.n * sizeof *load);
  for (int i = 0; i < a->model->n_nodal_loads; i++) {
    const ed_nodal_load *nodal = &a->model->nodal_loads[i];
    for (int d = 0; nodal->pattern == pattern && d < ed_degrees(a->model); d++)
      ed_add_at_degree(&a->numbering, ed_degrees(a->model) * nodal->node + d, nodal->force[d], load, NULL);
  }
}

/* Of the largest displacement under the loads: one below it is rounding. */
static const double NO_MOTION = 1e-12;

/* Do the loads move the degree at all? */
static int moves(ed_analysis *a, int pattern, int control)
{
  double largest = 0.0, *x = a->iteration.work;
  reference_load(a, pattern, x);
  if (ed_factor_effective(a, 1.0, 0.0, 0.0) != ED_OK || ed_solver_solve(a->factors.solver, x, 1) != ED_OK)
    return 1; /* a state at its limit: the run will show */
  for (int i = 0; i < a->numbering.n; i++)
    largest = fmax(largest, fabs(x[i]) * (a->numbering.rotational[i] ? a->numbering.length : 1.0));
  return fabs(x[control]) * (a->numbering.rotational[control] ? a->numbering.length : 1.0) > NO_MOTION * largest;
}

int ed_pushover_begin(ed_analysis *a, int pattern, int node, int degree, double target, int steps)
{
  const ed_model *model = a->model;
  if (a->run.kind != ED_RUN_NONE)
    return ed_fail(a, ED_E_STATE, "another run has not ended");
  if (pattern < 0 || pattern >= model->n_patterns || node < 0 || node >= model->n_nodes || degree < 0 || degree >= ed_degrees(model))
    return ed_fail(a, ED_E_ID, "there is no load pattern %d or no degree %d at node %d", pattern, degree, node);
  if (steps < 1 || !isfinite(target))
    return ed_fail(a, ED_E_ARGUMENT, "%d steps to %g", steps, target);
  for (int i = 0; i < model->n_member_loads; i++)
    if (model->member_loads[i].pattern == pattern)
      return ed_fail(a, ED_E_ARGUMENT, "a pushover pattern takes loads on nodes only");
  const int at = ed_degrees(model) * node + degree, control = a->numbering.equation[at];
  if (control < 0)
    return ed_fail(a, ED_E_ARGUMENT, "node %s: the controlled degree is fixed", model->nodes[node].name);
  if (a->numbering.plan && a->numbering.plan[at].turn >= 0)
    return ed_fail(a, ED_E_ARGUMENT, "node %s is moved by a diaphragm; control its master %s", model->nodes[node].name,
                   model->nodes[model->nodes[node].master[degree]].name);
  int loaded = 0;
  for (int i = 0; i < model->n_nodal_loads; i++)
    loaded |= model->nodal_loads[i].pattern == pattern;
  if (!loaded)
    return ed_fail(a, ED_E_ARGUMENT, "the pushover pattern has no load");
  if (!moves(a, pattern, control))
    return ed_fail(a, ED_E_ARGUMENT, "the pushover loads do not move the controlled degree");
  ed_start_run(a, ED_RUN_PUSHOVER, steps, a->committed.u[control]);
  a->run.pattern = pattern;
  a->run.control = control;
  a->run.control_start = a->committed.u[control];
  a->run.control_end = target;
  return ED_OK;
}

int ed_pushover_attempt(ed_analysis *a, double fraction, int fallback)
{
  const ed_run *run = &a->run;
  ed_state_head *head = a->trial.head;
  double *load = a->iteration.predicted, *by_load = a->iteration.work;
  int status;
  head->position += fraction;
  ed_slowly(&a->devices);
  const double share = (run->done + head->position) / run->steps;
  const double target = run->control_start + share * (run->control_end - run->control_start);
  head->time = target;
  reference_load(a, run->pattern, load);
  a->iteration.n_residuals = 0;
  /* where a strut is about to snap a frame leaves its path slowly at first, and without the tangents that forbid it */
  a->members.control.no_softening = a->members.n_struts > 0 && fallback >= ED_FALLBACK_LINE_SEARCH;
  const int iterations = a->settings.max_iterations * (a->members.control.no_softening ? 16 : fallback >= ED_FALLBACK_LINE_SEARCH ? 2 : 1);
  if (a->members.control.no_softening && (status = ed_update_elements(a)) != ED_OK)
    return status;
  /* from the safer fallbacks on, the step in free degrees is shortened when it overshoots */
  const double damp = fallback >= ED_FALLBACK_LINE_SEARCH ? 0.5 : 1.0;
  for (int iteration = 0;; iteration++) {
    for (int i = 0; i < a->numbering.n; i++)
      a->iteration.r[i] = a->loading.external[i] - a->trial.resisting[i];
    ed_raise_force_level(a);
    const double unbalance = ed_unbalance(a, a->iteration.r);
    if (a->iteration.n_residuals < ED_MAX_RESIDUALS)
      a->iteration.residuals[a->iteration.n_residuals++] = unbalance;
    if (!isfinite(unbalance) && iteration > 0)
      return ED_E_NOT_FINITE;
    if (iteration > 0 && unbalance <= a->settings.tolerance)
      return ed_accept(&a->statistics, unbalance);
    if (ed_stalls(&a->iteration, iteration) && unbalance <= ed_rounding(a))
      return ed_accept(&a->statistics, unbalance);
    if (iteration == iterations)
      return ED_E_NOT_CONVERGED;
    if ((status = ed_factor_effective(a, 1.0, 0.0, 0.0)) != ED_OK)
      return status;
    memcpy(a->iteration.du, a->iteration.r, (size_t)a->numbering.n * sizeof(double));
    memcpy(by_load, load, (size_t)a->numbering.n * sizeof(double));
    if ((status = ed_solver_solve(a->factors.solver, a->iteration.du, 1)) != ED_OK ||
        (status = ed_solver_solve(a->factors.solver, by_load, 1)) != ED_OK)
      return status;
    a->statistics.iterations++;
    if (by_load[run->control] == 0.0)
      return ED_E_SINGULAR;
    const double missing = target - a->trial.u[run->control];
    const double factor = (missing - a->iteration.du[run->control]) / by_load[run->control];
    const double share_taken = iteration > 0 ? damp : 1.0;
    for (int i = 0; i < a->numbering.n; i++)
      a->trial.u[i] += share_taken * (a->iteration.du[i] + factor * by_load[i]);
    a->loading.factors[run->pattern] += share_taken * factor;
    ed_set_factors(a);
    if ((status = ed_update_elements(a)) != ED_OK)
      return status;
  }
}
