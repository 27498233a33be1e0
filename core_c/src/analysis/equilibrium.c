/* Iteration of one step to equilibrium: Newton with factors kept while they converge well, full Newton, line search. */
#include "base/lanes.h"
#include "system/analysis.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

int ed_iteration_allocate(ed_iteration *iteration, int n)
{
  double **vectors[] = {&iteration->r, &iteration->du, &iteration->work, &iteration->work2, &iteration->predicted};
  for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
    if (!(*vectors[i] = calloc((size_t)n, sizeof(double))))
      return ED_E_MEMORY;
  iteration->residuals = calloc(ED_MAX_RESIDUALS, sizeof(double));
  return iteration->residuals ? ED_OK : ED_E_MEMORY;
}

void ed_iteration_free(ed_iteration *iteration)
{
  free(iteration->r);
  free(iteration->du);
  free(iteration->work);
  free(iteration->work2);
  free(iteration->predicted);
  free(iteration->residuals);
}

/* Unbalance relative to the largest force so far; moments are made comparable by the mean element length. */
double ed_unbalance(ed_analysis *a, const double *r)
{
  double largest = 0.0;
  for (int i = 0; i < a->numbering.n; i++) {
    const double value = fabs(r[i]) / (a->numbering.rotational[i] ? a->numbering.length : 1.0);
    if (!(value <= largest)) { /* a NaN counts as the largest */
      largest = value;
      a->iteration.worst = i;
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

/* Of the ends of members, each with so many forces before so many moments. */
ED_INLINE void raise_by_members(const ed_analysis *a, const int forces, const int moments, double *force, double *moment)
{
  double most_force = 0.0, most_moment = 0.0;
  const double *f = a->members.force;
  for (int end = 0; end < 2 * a->model->n_members; end++, f += forces + moments) {
    for (int i = 0; i < forces; i++)
      most_force = larger(most_force, fabs(f[i]));
    for (int i = 0; i < moments; i++)
      most_moment = larger(most_moment, fabs(f[forces + i]));
  }
  *force = most_force;
  *moment = most_moment;
}

/* Largest force on the end of a member or damper, or a node, of the accepted steps and of this iterate; iterates that were left do not count. */
void ed_raise_force_level(ed_analysis *a)
{
  double force, moment;
  if (a->model->dimension == 2)
    raise_by_members(a, 2, 1, &force, &moment);
  else
    raise_by_members(a, 3, 3, &force, &moment);
  for (int i = 0; i < a->numbering.n; i++) {
    double *largest = a->numbering.rotational[i] ? &moment : &force;
    *largest = larger(*largest, fabs(a->loading.external[i]));
  }
  ed_largest_history_force(&a->run, a->numbering.rotational, &force, &moment);
  force = larger(force, ed_largest_device_force(a)); /* members may carry none */
  a->trial.head->force_level = larger(a->committed.head->force_level, larger(force, moment / a->numbering.length));
}

int ed_last_iterations(const ed_iteration *iteration)
{
  return iteration->n_residuals > 0 ? iteration->n_residuals - 1 : 0;
}

void ed_move(ed_analysis *a, const ed_step *step, double factor, const double *du)
{
  for (int i = 0; i < a->numbering.n; i++) {
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
    step->residual(a, step, a->iteration.r);
  return status;
}

static double slope(const ed_analysis *a)
{
  double sum = 0.0;
  for (int i = 0; i < a->numbering.n; i++)
    sum += a->iteration.du[i] * a->iteration.r[i];
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
    ed_move(a, step, next - taken, a->iteration.du);
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
  if (a->factors.stamp == a->matrix.stamp)
    return 0;
  const double rate = unbalance / before;
  if (rate >= 0.7)
    return 1;
  const double to_come = log(a->settings.tolerance / unbalance) / log(rate);
  return to_come > 1.5 + a->factors.price;
}

/* What rounding alone does to the unbalance: no iteration gets below it. */
double ed_rounding(ed_analysis *a)
{
  double largest = 0.0;
  ed_assemble_tangent(a);
  for (int i = 0; i < a->numbering.n; i++) {
    const double force = fabs(a->matrix.tangent[a->matrix.diagonal[i]] * a->trial.u[i]) + a->numbering.mass[i] * fabs(a->trial.a[i]);
    largest = larger(largest, a->numbering.rotational[i] ? force / a->numbering.length : force);
  }
  return 4.0 * DBL_EPSILON * largest / a->trial.head->force_level;
}

/* The last eight iterations did not halve the unbalance; unknown beyond those that are kept. */
int ed_stalls(const ed_iteration *iteration, int number)
{
  enum { PATIENCE = 8 };
  const double *residual = iteration->residuals + number;
  return number >= PATIENCE && number < iteration->n_residuals && residual[0] > 0.5 * residual[-PATIENCE];
}

int ed_accept(ed_statistics *statistics, double unbalance)
{
  statistics->worst_unbalance = larger(statistics->worst_unbalance, unbalance);
  return ED_OK;
}

int ed_equilibrate(ed_analysis *a, const ed_step *step, int fallback)
{
  const int keep_factors = fallback == 0 && a->settings.reuse;
  double before = HUGE_VAL;
  int status;
  a->iteration.n_residuals = 0;
  a->devices.oscillating = 0;
  step->residual(a, step, a->iteration.r);
  for (int iteration = 0;; iteration++) {
    const double unbalance = ed_unbalance(a, a->iteration.r);
    if (a->iteration.n_residuals < ED_MAX_RESIDUALS)
      a->iteration.residuals[a->iteration.n_residuals++] = unbalance;
    if (!isfinite(unbalance) && iteration > 0)
      return ED_E_NOT_FINITE;
    if (iteration > 0 && unbalance <= a->settings.tolerance) /* small motions are not for the tolerance to swallow */
      return ed_accept(&a->statistics, unbalance);
    if (iteration == a->settings.max_iterations)
      return ED_E_NOT_CONVERGED;
    /* going round in circles: piecewise linear laws, or a damping stiffness that jumps with them */
    if (ed_stalls(&a->iteration, iteration))
      return unbalance <= ed_rounding(a) ? ed_accept(&a->statistics, unbalance) : ED_E_NOT_CONVERGED;
    const int same = a->factors.stamp >= 0 && a->factors.k == step->k && a->factors.m == step->m &&
                     a->factors.c == step->c;
    int factor = !same;
    if (same && !keep_factors)
      factor = a->factors.stamp != a->matrix.stamp || fallback != 0;
    else if (same && iteration > 0)
      factor = worth_factoring(a, unbalance, before);
    if (!step->balance && !a->devices.oscillating && iteration >= 3 && ed_installed(a) &&
        unbalance > 0.1 * a->iteration.residuals[iteration - 2])
      factor = a->devices.oscillating = 1;
    if (factor && (status = ed_factor_effective(a, step->k, step->m, step->c)) != ED_OK)
      return status;
    memcpy(a->iteration.du, a->iteration.r, (size_t)a->numbering.n * sizeof(double));
    if ((status = ed_solve_effective(a, 1, a->iteration.du)) != ED_OK)
      return status;
    a->statistics.iterations++;
    const double start = fallback >= ED_FALLBACK_LINE_SEARCH ? slope(a) : 0.0;
    if (step->balance)
      status = step->balance(a, step, iteration == 0);
    else
      ed_move(a, step, 1.0, a->iteration.du);
    if (status == ED_OK)
      status = step->balance ? ed_update_members(a) : ed_update_elements(a);
    if (status != ED_OK)
      return status;
    step->residual(a, step, a->iteration.r);
    if (fallback >= ED_FALLBACK_LINE_SEARCH && (status = search(a, step, start)) != ED_OK)
      return status;
    before = unbalance;
  }
}
