/* Dampers in balance with the frame condensed to their deformations, while factors A of the frame are kept.
 *
 * With the deformations x = B D that an iteration D of the frame brings, forces f(x) of the dampers, their slopes s and those that
 * are in the factors, S_0, the frame's linear part and the dampers as they are balance where
 *
 *   A D = r + k B' (f_now - f(x) + S_0 x),   so   x = B A^-1 r + k F (f_now - f(x) + S_0 x),   F = B A^-1 B'
 *
 * (Woodbury's identity where f is linear). F is as large as there are dampers, and a trial of theirs is cheap beside one of the
 * frame. So Newton's method finds x on its own: the frame is evaluated only for what is not linear in itself, and slopes of dampers
 * that change ask for no new factors. The first balance of a step is with forces that go on as in the last two steps. */
#include "base/clones.h"
#include "base/dense.h"
#include "system/analysis.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Operations of one solution at the dampers, with the iteration that it moves. */
static double solution_flops(const ed_analysis *a)
{
  const double n = a->numbering.n, dampers = a->model->n_devices;
  return 2.0 / 3.0 * dampers * dampers * dampers + 2.0 * dampers * n;
}

/* Operations of an iteration of the frame. */
double ed_iteration_flops(const ed_analysis *a)
{
  const double element = 1000.0; /* about, beside the solution */
  return ed_solver_solve_flops(a->factors.solver) + element * a->model->n_members;
}

int ed_condensation_allocate(ed_analysis *a)
{
  const size_t dampers = (size_t)a->model->n_devices, n = (size_t)a->numbering.n;
  /* A solution here saves an iteration of the frame and its factors at best. Those that SUNDIALS integrates cost more than a frame. */
  if (dampers == 0 || a->devices.n_by_ode > 0 || solution_flops(a) > ed_iteration_flops(a) + ed_solver_flops(a->factors.solver))
    return ED_OK;
  for (int i = 0; i < a->model->n_devices; i++) /* whose force depends on one of the frame has to look at it in each iteration */
    if (a->model->devices[i].axial_spring >= 0)
      return ED_OK;
  ed_condensation *condensation = &a->condensation;
  condensation->response = malloc(dampers * n * sizeof(double));
  condensation->flexibility = malloc(dampers * dampers * sizeof(double));
  condensation->balance = malloc(dampers * dampers * sizeof(double));
  condensation->pivot = malloc(dampers * sizeof(int));
  condensation->work = malloc(8 * dampers * sizeof(double));
  return condensation->response && condensation->flexibility && condensation->balance && condensation->pivot && condensation->work
             ? ED_OK
             : ED_E_MEMORY;
}

void ed_condensation_free(ed_condensation *condensation)
{
  free(condensation->response);
  free(condensation->flexibility);
  free(condensation->balance);
  free(condensation->pivot);
  free(condensation->work);
}

int ed_condenses(const ed_analysis *a, int fallback)
{
  return a->condensation.response && fallback == 0 && a->settings.reuse && a->run.kind == ED_RUN_HISTORY && ed_installed(a);
}

double ed_condensation_flops(const ed_analysis *a)
{
  return ed_condenses(a, 0) ? a->model->n_devices * (ed_solver_solve_flops(a->factors.solver) + 2.0 * a->model->n_devices) : 0.0;
}

void ed_follow_pace(const ed_analysis *a, double *du)
{
  for (int i = 0; i < a->numbering.n; i++)
    du[i] = a->devices.duration * (2.0 * a->committed.mean_velocity[i] - a->committed.mean_velocity_before[i]);
}

/* A^-1 B' and F of the present factors. */
static int find_flexibility(ed_analysis *a)
{
  const int dampers = a->model->n_devices;
  const size_t n = (size_t)a->numbering.n;
  if (a->condensation.known)
    return ED_OK;
  memset(a->condensation.response, 0, (size_t)dampers * n * sizeof(double));
  for (int i = 0; i < dampers; i++)
    ed_add_along_device(&a->numbering, &a->model->devices[i], 1.0, a->condensation.response + (size_t)i * n);
  const int status = ed_solve_effective(a, dampers, a->condensation.response);
  if (status != ED_OK)
    return status;
  for (int i = 0; i < dampers; i++)
    for (int j = 0; j < dampers; j++) {
      const double *response = a->condensation.response + (size_t)i * n;
      a->condensation.flexibility[j * dampers + i] = ed_along_device(&a->numbering, &a->model->devices[j], response);
    }
  a->condensation.known = 1;
  return ED_OK;
}

/* Deformations of the dampers, and the linear law f + s (x - at) of each about the last trial; of a bearing it has what comes of the motion
 * across beside that, by the slope `cross`. */
typedef struct {
  double *free, *x, *at, *now, *force, *slope, *cross, *push;
} condensed;

static void linearise(const ed_analysis *a, condensed *c, const double *moved)
{
  for (int i = 0; i < a->model->n_devices; i++) {
    c->at[i] = ed_along_device(&a->numbering, &a->model->devices[i], moved);
    c->force[i] = ed_device_force(&a->devices, &a->trial, i);
  }
}

/* Before the first trial of a step forces and deformations go on as in the last two steps. */
static void expect(const ed_analysis *a, condensed *c)
{
  ed_follow_pace(a, a->iteration.work);
  for (int i = 0; i < a->model->n_devices; i++) {
    c->at[i] = ed_along_device(&a->numbering, &a->model->devices[i], a->iteration.work);
    c->force[i] = ed_expected_device_force(&a->devices, &a->committed, i);
  }
}

/* The slopes of the last trial, or at the end of the step before, become those of the linear laws. */
static int take_slopes(ed_analysis *a, double k, condensed *c)
{
  const int n = a->model->n_devices;
  const double *in_factors = a->factors.device_slope, *cross_in_factors = in_factors + n;
  for (int j = 0; j < n; j++)
    c->slope[j] = ed_device_slope(&a->devices, &a->trial, j);
  for (int j = 0; a->devices.bearings && j < n; j++)
    c->cross[j] = ed_device_cross_slope(&a->devices, &a->trial, j);
  for (int i = 0; i < n; i++) {
    const double *row = a->condensation.flexibility + i * n;
    double *of = a->condensation.balance + i * n;
    for (int j = 0; j < n; j++)
      of[j] = k * row[j] * (c->slope[j] - in_factors[j]);
    for (int j = 0; a->devices.bearings && j < n; j++) {
      const int other = a->model->devices[j].other;
      if (other >= 0)
        of[other] += k * row[j] * (c->cross[j] - cross_in_factors[j]);
    }
    of[i] += 1.0;
  }
  return ed_dense_factor(n, a->condensation.balance, a->condensation.pivot) ? ED_OK : ED_E_SINGULAR;
}

/* x at which all balance with the linear laws, and the forces k (f_now - f(x) + S_0 x) by which they move the frame. */
static void balance(const ed_analysis *a, double k, condensed *c)
{
  const int n = a->model->n_devices;
  const double *in_factors = a->factors.device_slope, *cross_in_factors = in_factors + n;
  for (int j = 0; j < n; j++)
    c->push[j] = k * (c->now[j] - c->force[j] + c->slope[j] * c->at[j]);
  for (int j = 0; a->devices.bearings && j < n; j++) {
    const int other = a->model->devices[j].other;
    if (other >= 0)
      c->push[j] += k * c->cross[j] * c->at[other];
  }
  for (int i = 0; i < n; i++) {
    const double *row = a->condensation.flexibility + i * n;
    double sum = c->free[i];
    for (int j = 0; j < n; j++)
      sum += row[j] * c->push[j];
    c->x[i] = sum;
  }
  ed_dense_solve(n, a->condensation.balance, a->condensation.pivot, c->x);
  for (int j = 0; j < n; j++)
    c->push[j] -= k * (c->slope[j] - in_factors[j]) * c->x[j];
  for (int j = 0; a->devices.bearings && j < n; j++) {
    const int other = a->model->devices[j].other;
    if (other >= 0)
      c->push[j] -= k * (c->cross[j] - cross_in_factors[j]) * c->x[other];
  }
}

/* Largest unbalance that is left as the forces of a trial are not those of the linear laws. */
static double left(const ed_analysis *a, const condensed *c)
{
  double largest = 0.0;
  for (int i = 0; i < a->model->n_devices; i++) {
    double linear = c->slope[i] * (c->x[i] - c->at[i]);
    const int other = a->devices.bearings ? a->model->devices[i].other : -1;
    if (other >= 0)
      linear += c->cross[i] * (c->x[other] - c->at[other]);
    const double off = a->devices.reach[i] * fabs(ed_device_force(&a->devices, &a->trial, i) - c->force[i] - linear);
    if (!(off <= largest))
      largest = off;
  }
  return largest;
}

ED_CLONES static void add_responses(int n, int count, const double *restrict response, const double *restrict factor, double *restrict sum)
{
  for (int j = 0; j < count; j++, response += n)
    for (int i = 0; i < n; i++)
      sum[i] += response[i] * factor[j];
}

/* `moved` becomes `du` and what the dampers add to it, and the trial state moves along. */
static void move_on(ed_analysis *a, const ed_step *step, const condensed *c, double *moved)
{
  double *change = a->iteration.work;
  memcpy(change, a->iteration.du, (size_t)a->numbering.n * sizeof *change);
  add_responses(a->numbering.n, a->model->n_devices, a->condensation.response, c->push, change);
  for (int i = 0; i < a->numbering.n; i++) {
    const double now = change[i];
    change[i] -= moved[i];
    moved[i] = now;
  }
  ed_move(a, step, 1.0, change);
}

int ed_move_condensed(ed_analysis *a, const ed_step *step, int first)
{
  const int dampers = a->model->n_devices;
  double *work = a->condensation.work, *moved = a->iteration.predicted, before = HUGE_VAL;
  condensed c = {.free = work, .x = work + dampers, .at = work + 2 * dampers, .now = work + 3 * dampers, .force = work + 4 * dampers,
                 .slope = work + 5 * dampers, .push = work + 6 * dampers, .cross = work + 7 * dampers};
  /* Behind the first iteration of the frame the dampers move so little that slopes need not be new for the first trial. */
  int slopes_known = !first && a->condensation.known, status = find_flexibility(a);
  if (status != ED_OK)
    return status;
  for (int i = 0; i < dampers; i++) {
    c.free[i] = ed_along_device(&a->numbering, &a->model->devices[i], a->iteration.du);
    c.now[i] = ed_device_force(&a->devices, first ? &a->committed : &a->trial, i);
  }
  memset(moved, 0, (size_t)a->numbering.n * sizeof *moved);
  for (int trial = 0; trial < a->settings.max_iterations; trial++) {
    const int rough = first && trial == 0;
    if (rough)
      expect(a, &c);
    else
      linearise(a, &c, moved);
    if (!slopes_known && (status = take_slopes(a, step->k, &c)) != ED_OK)
      return status;
    slopes_known = 0;
    balance(a, step->k, &c);
    move_on(a, step, &c, moved);
    if ((status = ed_update_devices(a, rough)) != ED_OK)
      return status;
    const double off = left(a, &c);
    if (!isfinite(off))
      return ED_E_NOT_FINITE;
    if (!rough && off <= a->settings.tolerance * a->trial.head->force_level)
      return ED_OK;
    if (off > 0.5 * before) /* Newton's method oscillates about rest */
      a->devices.oscillating = 1;
    before = off;
  }
  return ED_OK; /* what is left the frame's next iteration sees */
}
