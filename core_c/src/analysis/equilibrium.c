/* Iteration of one step to equilibrium: Newton with factors kept while they converge well, full Newton, line search. */
#include "system/analysis.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Unbalance relative to the largest force so far; moments are made comparable by the mean element length. */
double ed_unbalance(ed_analysis *a, const double *r)
{
  double largest = 0.0;
  for (int i = 0; i < a->n; i++) {
    const double value = fabs(r[i]) / (a->rotational[i] ? a->length : 1.0);
    if (!(value <= largest)) { /* a NaN counts as the largest */
      largest = value;
      a->worst = i;
      if (!isfinite(value))
        return value;
    }
  }
  const double level = a->trial.head->force_level;
  return level > 0.0 ? largest / level : (largest > 0.0 ? HUGE_VAL : 0.0);
}

static inline double larger(double a, double b)
{
  return a > b ? a : b;
}

/* Largest force on a member's end or node, of the accepted steps and of this iterate; iterates that were left do not count. */
void ed_raise_force_level(ed_analysis *a)
{
  double force = 0.0, moment = 0.0;
  for (int m = 0; m < a->model->n_members; m++) {
    const double *f = a->member_force + 6 * m;
    for (int end = 0; end < 6; end += 3) {
      force = larger(force, fabs(f[end]));
      force = larger(force, fabs(f[end + 1]));
      moment = larger(moment, fabs(f[end + 2]));
    }
  }
  for (int i = 0; i < a->n; i++)
    *(a->rotational[i] ? &moment : &force) = larger(a->rotational[i] ? moment : force, fabs(a->external[i]));
  ed_largest_history_force(a, &force, &moment);
  a->trial.head->force_level = larger(a->committed.head->force_level, larger(force, moment / a->length));
}

void ed_freeze_damping(ed_analysis *a, int rung)
{
  a->frozen = rung >= ED_RUNG_FROZEN_DAMPING;
  if (a->rayleigh_stiffness == 0.0)
    return;
  if (a->rayleigh_kind == ED_STIFFNESS_COMMITTED || (a->rayleigh_kind == ED_STIFFNESS_CURRENT && a->frozen)) {
    memcpy(a->reference, ed_damping_tangent(a), ((size_t)a->nnz + 1) * sizeof(double));
  }
}

int ed_last_iterations(const ed_analysis *a)
{
  return a->n_residuals > 0 ? a->n_residuals - 1 : 0;
}

void ed_move(ed_analysis *a, const ed_step *step, double factor, const double *du)
{
  for (int i = 0; i < a->n; i++) {
    const double moved = factor * du[i];
    a->trial.u[i] += moved;
    a->trial.v[i] += step->velocity * moved;
    a->trial.a[i] += step->acceleration * moved;
  }
}

static int evaluate(ed_analysis *a, const ed_step *step)
{
  const int status = ed_update_elements(a);
  if (status == ED_OK)
    step->residual(a, step, a->r);
  return status;
}

static double slope(const ed_analysis *a)
{
  double sum = 0.0;
  for (int i = 0; i < a->n; i++)
    sum += a->du[i] * a->r[i];
  return sum;
}

/* Shortens the last step until the residual along it has fallen (Crisfield 1991, 9.2.3). */
static int search(ed_analysis *a, const ed_step *step, double start)
{
  double taken = 1.0, end = slope(a), low = 0.0, at_low = start;
  for (int i = 0; i < 6 && fabs(end) > 0.8 * fabs(start); i++) {
    double next;
    if (end * at_low < 0.0)
      next = low + (taken - low) * at_low / (at_low - end);
    else {
      if (taken >= 1.0)
        return ED_OK; /* still descending at the full step */
      low = taken;
      at_low = end;
      next = 0.5 * (taken + 1.0);
    }
    next = fmax(next, 0.1 * taken);
    ed_move(a, step, next - taken, a->du);
    taken = next;
    const int status = evaluate(a, step);
    if (status != ED_OK)
      return status;
    end = slope(a);
  }
  return ED_OK;
}

/* Are new factors worth their price? With the rate of convergence seen, the iterations still to come cost more. */
static int worth_factoring(const ed_analysis *a, double unbalance, double before)
{
  if (a->factored_stamp == a->tangent_stamp)
    return 0;
  const double rate = unbalance / before;
  if (rate >= 0.7)
    return 1;
  const double to_come = log(a->tolerance / unbalance) / log(rate);
  return to_come > 1.5 + a->factor_price;
}

/* What rounding alone does to the unbalance: no iteration gets below it. */
double ed_rounding(ed_analysis *a)
{
  double largest = 0.0;
  ed_assemble_tangent(a);
  for (int i = 0; i < a->n; i++) {
    const double force = fabs(a->tangent[a->diagonal[i]] * a->trial.u[i]) + a->mass[i] * fabs(a->trial.a[i]);
    largest = larger(largest, a->rotational[i] ? force / a->length : force);
  }
  return 4.0 * DBL_EPSILON * largest / a->trial.head->force_level;
}

/* The last eight iterations did not halve the unbalance; unknown beyond those that are kept. */
int ed_stalls(const ed_analysis *a, int iteration)
{
  enum { PATIENCE = 8 };
  return iteration >= PATIENCE && iteration < a->n_residuals && a->residuals[iteration] > 0.5 * a->residuals[iteration - PATIENCE];
}

int ed_accept(ed_analysis *a, double unbalance)
{
  a->statistics.worst_unbalance = larger(a->statistics.worst_unbalance, unbalance);
  return ED_OK;
}

int ed_equilibrate(ed_analysis *a, const ed_step *step, int rung)
{
  const int keep_factors = rung == 0 && a->reuse, condensed = ed_condenses(a, rung);
  double before = HUGE_VAL;
  int status;
  a->n_residuals = 0;
  a->swinging = 0;
  step->residual(a, step, a->r);
  for (int iteration = 0;; iteration++) {
    const double unbalance = ed_unbalance(a, a->r);
    if (a->n_residuals < ED_MAX_RESIDUALS)
      a->residuals[a->n_residuals++] = unbalance;
    if (!isfinite(unbalance) && iteration > 0)
      return ED_E_NOT_FINITE;
    if (iteration > 0 && unbalance <= a->tolerance) /* small motions are not for the tolerance to swallow */
      return ed_accept(a, unbalance);
    if (iteration == a->max_iterations)
      return ED_E_NOT_CONVERGED;
    /* going round in circles: piecewise linear laws, or a damping stiffness that jumps with them */
    if (ed_stalls(a, iteration))
      return unbalance <= ed_rounding(a) ? ed_accept(a, unbalance) : ED_E_NOT_CONVERGED;
    const int same = a->factored_stamp >= 0 && a->factored_k == step->k && a->factored_m == step->m &&
                     a->factored_c == step->c;
    int factor = !same;
    if (same && !keep_factors)
      factor = a->factored_stamp != a->tangent_stamp || rung != 0;
    else if (same && iteration > 0)
      factor = worth_factoring(a, unbalance, before);
    if (!condensed && !a->swinging && iteration >= 3 && ed_installed(a) && unbalance > 0.1 * a->residuals[iteration - 2])
      factor = a->swinging = 1;
    if (factor && (status = ed_factor_effective(a, step->k, step->m, step->c)) != ED_OK)
      return status;
    memcpy(a->du, a->r, (size_t)a->n * sizeof(double));
    if ((status = ed_solve_effective(a, 1, a->du)) != ED_OK)
      return status;
    a->statistics.iterations++;
    const double start = rung >= ED_RUNG_LINE_SEARCH ? slope(a) : 0.0;
    if (condensed)
      status = ed_move_condensed(a, step, iteration == 0);
    else
      ed_move(a, step, 1.0, a->du);
    if (status == ED_OK)
      status = condensed ? ed_update_members(a) : ed_update_elements(a);
    if (status != ED_OK)
      return status;
    step->residual(a, step, a->r);
    if (rung >= ED_RUNG_LINE_SEARCH && (status = search(a, step, start)) != ED_OK)
      return status;
    before = unbalance;
  }
}
