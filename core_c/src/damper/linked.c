/* Histories of a linear structure with dampers as links. */
#include "base/dense.h"
#include "damper/run_of_test.h"
#include "edcore.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CLOSE 1e-10                /* of the largest force of a link so far: balance at the end of a step */
enum { NEWTON = 8, TURNS = 40 }; /* turns with slopes; and without, which short steps let converge where slopes jump */

typedef struct {
  int n, m; /* states, links */
  const double *seen;
  ed_test_run *link; /* m */
  int opened;
  ed_watch watch;
  double *room;
  double *turned;                /* n x n: the transition by columns */
  double *gain;                  /* 2m x m: what a force at the end of a step changes of deformations and velocities there */
  double *free, *before, *there; /* 2m each: without forces at the end; at the beginning; at the end */
  double *change, *largest;      /* m each */
  double *slope;                 /* 2m: derivatives of forces to deformation and velocity */
  double *matrix;                /* m x m */
  int *pivot;
} linked;

static int open_links(linked *of, const ed_damper *const *damper, int method, double fineness)
{
  const size_t m = (size_t)of->m, n = (size_t)of->n;
  of->link = calloc(m ? m : 1, sizeof *of->link);
  of->room = calloc(n * n + 3 * m * m + 10 * m, sizeof *of->room);
  of->pivot = calloc(m + 1, sizeof *of->pivot);
  if (!of->link || !of->room || !of->pivot)
    return ED_E_MEMORY;
  of->turned = of->room;
  of->gain = of->turned + n * n;
  of->matrix = of->gain + 2 * m * m;
  of->free = of->matrix + m * m;
  of->before = of->free + 2 * m;
  of->there = of->before + 2 * m;
  of->slope = of->there + 2 * m;
  of->change = of->slope + 2 * m;
  of->largest = of->change + m;
  int status = ED_OK;
  for (int k = 0; k < of->m && status == ED_OK; k++) {
    of->opened = k + 1;
    status = ed_test_run_open(&of->link[k], damper[k], method, fineness, &of->watch);
  }
  return status;
}

static void close_links(linked *of)
{
  for (int k = 0; k < of->opened; k++)
    ed_test_run_close(&of->link[k]);
  free(of->link);
  free(of->room);
  free(of->pivot);
}

/* y (rows) = matrix (rows x columns) x. */
static void times(int rows, int columns, const double *matrix, const double *x, double *y)
{
  for (int i = 0; i < rows; i++) {
    double sum = 0.0;
    for (int j = 0; j < columns; j++)
      sum += matrix[(size_t)i * (size_t)columns + (size_t)j] * x[j];
    y[i] = sum;
  }
}

/* y (n) = columns (n x n) x + added: by columns, so that the sums of rows go on side by side. */
static void advance(int n, const double *columns, const double *x, const double *added, double *restrict y)
{
  memcpy(y, added, (size_t)n * sizeof *y);
  for (int j = 0; j < n; j++) {
    const double *column = columns + (size_t)j * (size_t)n;
    for (int i = 0; i < n; i++)
      y[i] += column[i] * x[j];
  }
}

/* All links at rest, or after a rest with what they keep. */
static int begin(linked *of, const ed_linked_test *test, int carried, double rest)
{
  const int n = of->n, m = of->m;
  const double none = 0.0;
  for (int k = 0; k < m; k++) {
    ed_test_run *link = &of->link[k];
    if (carried) {
      double force;
      ed_test_run_carry(link, rest);
      ed_test_run_begin(link);
      const int status = ed_test_run_hold(link, 1, &none, &none, &none, 1.0, &force);
      if (status != ED_OK)
        return status;
    } else
      ed_damper_start(link->stepper.damper, link->state);
    of->before[k] = of->before[m + k] = of->largest[k] = 0.0;
  }
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      of->turned[j * n + i] = test->a[i * n + j];
  for (int i = 0; i < 2 * m; i++)
    for (int k = 0; k < m; k++) {
      double sum = 0.0;
      for (int j = 0; j < n; j++)
        sum += of->seen[i * n + j] * test->from_links[1][j * m + k];
      of->gain[i * m + k] = sum;
    }
  return ED_OK;
}

/* What the links answer to the motion `there`; the largest imbalance over what is allowed. */
static int answer(linked *of, double h, const double *force, double *imbalance)
{
  const int m = of->m;
  *imbalance = 0.0;
  for (int k = 0; k < m; k++) {
    ed_test_run *link = &of->link[k];
    ed_path path, direction[2];
    ed_damper_force out = {0};
    ed_path_hermite(&path, h, of->before[k], of->before[m + k], of->there[k], of->there[m + k]);
    ed_path_hermite_directions(direction, h);
    memcpy(link->trial, link->state, (size_t)ed_damper_state_size(link->stepper.damper) * sizeof *link->state);
    const int status = ed_stepper_along(&link->stepper, link->state, &path, direction, link->trial, &out);
    if (status != ED_OK)
      return status;
    if (!isfinite(out.force))
      return ED_E_NOT_FINITE;
    of->change[k] = out.force - force[k];
    of->slope[k] = out.slope[0];
    of->slope[m + k] = out.slope[1];
    of->largest[k] = fmax(of->largest[k], fabs(out.force));
    *imbalance = fmax(*imbalance, fabs(of->change[k]) / (CLOSE * of->largest[k] + DBL_MIN));
  }
  return ED_OK;
}

/* Newton's step of the forces, from their imbalance. */
static int newton(linked *of)
{
  const int m = of->m;
  for (int k = 0; k < m; k++)
    for (int j = 0; j < m; j++)
      of->matrix[k * m + j] = (k == j) - of->slope[k] * of->gain[k * m + j] - of->slope[m + k] * of->gain[(m + k) * m + j];
  if (!ed_dense_factor(m, of->matrix, of->pivot))
    return ED_E_NOT_CONVERGED;
  ed_dense_solve(m, of->matrix, of->pivot, of->change);
  return ED_OK;
}

/* Forces at the end of a step, from those at its beginning. */
static int balance(linked *of, double h, double *force)
{
  const int m = of->m;
  for (int turn = 0; turn < TURNS; turn++) {
    times(2 * m, m, of->gain, force, of->there);
    for (int i = 0; i < 2 * m; i++)
      of->there[i] += of->free[i];
    double imbalance;
    int status = answer(of, h, force, &imbalance);
    if (status == ED_OK && imbalance > 1.0 && turn < NEWTON)
      status = newton(of);
    if (status != ED_OK)
      return status;
    for (int k = 0; k < m; k++)
      force[k] += of->change[k];
    if (imbalance <= 1.0)
      return ED_OK;
  }
  return ED_E_NOT_CONVERGED;
}

static int one_test(linked *of, const ed_linked_test *test, double *state, double *force, int *done)
{
  const int n = of->n, m = of->m;
  memset(state, 0, (size_t)n * sizeof *state);
  memset(force, 0, (size_t)m * sizeof *force);
  for (*done = 1; *done < test->n; ++*done) {
    const double *x = state + (size_t)(*done - 1) * (size_t)n, *before = force + (size_t)(*done - 1) * (size_t)m;
    double *next = state + (size_t)*done * (size_t)n, *after = force + (size_t)*done * (size_t)m;
    if (ed_watch_step(&of->watch))
      return ED_E_STOPPED;
    advance(n, of->turned, x, test->pushed + (size_t)(*done - 1) * (size_t)n, next);
    for (int i = 0; i < n; i++)
      for (int k = 0; k < m; k++)
        next[i] += test->from_links[0][i * m + k] * before[k];
    times(2 * m, n, of->seen, next, of->free);
    for (int k = 0; k < m; k++)
      after[k] = *done > 1 ? 2.0 * before[k] - before[k - m] : before[k]; /* near, where forces are smooth */
    const int status = balance(of, test->h, after);
    if (status != ED_OK)
      return status;
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
      for (int k = 0; k < m; k++)
        next[i] += test->from_links[1][i * m + k] * after[k];
      sum += next[i];
    }
    if (!isfinite(sum))
      return ED_E_NOT_FINITE;
    memcpy(of->before, of->there, 2 * (size_t)m * sizeof *of->before);
    for (int k = 0; k < m; k++)
      ed_test_run_accept(&of->link[k]);
  }
  return ED_OK;
}

int ed_linked_history(int n_states, int n_links, const ed_damper *const *damper, const double *seen, int n_tests,
                      const ed_linked_test *test, int carry, double rest, int method, double fineness, double *state, double *force,
                      ed_campaign_end *end)
{
  *end = (ed_campaign_end){.status = ED_E_ARGUMENT};
  if (n_states < 1 || n_links < 0 || n_tests < 1 || (carry && !(rest > 0.0 && isfinite(rest))))
    return end->status;
  for (int i = 0; i < n_tests; i++) {
    end->test = i;
    if (test[i].n < 2 || !(test[i].h > 0.0 && isfinite(test[i].h)))
      return end->status;
  }
  linked of = {.n = n_states, .m = n_links, .seen = seen, .watch = ed_watch_of(n_links ? &damper[0]->stop : NULL)};
  end->test = 0;
  end->status = open_links(&of, damper, method, fineness);
  for (int k = 0; k < of.opened; k++)
    of.link[k].keeps_law = carry == ED_CARRY_ALL;
  for (int i = 0; i < n_tests && end->status == ED_OK; i++) {
    end->test = i;
    end->sample = 0;
    end->status = begin(&of, &test[i], carry && i > 0, rest);
    if (end->status == ED_OK)
      end->status = one_test(&of, &test[i], state, force, &end->sample);
    state += (size_t)test[i].n * (size_t)n_states;
    force += (size_t)test[i].n * (size_t)n_links;
  }
  close_links(&of);
  return end->status;
}
