/* Sparse solver: solutions, refactorisation with known pivots, new pivots when the old ones are poor, singular
 * matrices. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"
#include "system/solver.h"

#include <math.h>
#include <string.h>

enum { N = 40, HALF = 3, MOST = N * (2 * HALF + 1) };

/* A banded pattern, and where the diagonal lies. */
static int pattern(int *start, int *row, int *diagonal)
{
  int count = 0;
  for (int j = 0; j < N; j++) {
    start[j] = count;
    for (int i = j - HALF; i <= j + HALF; i++)
      if (i >= 0 && i < N) {
        if (i == j)
          diagonal[j] = count;
        row[count++] = i;
      }
  }
  start[N] = count;
  return count;
}

/* Symmetric positive definite: diagonally dominant. */
static void stiffness(const int *start, const int *row, numbers *source, double *value)
{
  double band[N][HALF + 1];
  for (int i = 0; i < N; i++)
    for (int k = 0; k <= HALF; k++)
      band[i][k] = k == 0 ? next_number(source, 8.0, 12.0) : next_number(source, -1.0, 1.0);
  for (int j = 0; j < N; j++)
    for (int k = start[j]; k < start[j + 1]; k++)
      value[k] = row[k] <= j ? band[row[k]][j - row[k]] : band[j][row[k] - j];
}

static void multiply(const int *start, const int *row, const double *value, const double *x, double *y)
{
  memset(y, 0, N * sizeof *y);
  for (int j = 0; j < N; j++)
    for (int k = start[j]; k < start[j + 1]; k++)
      y[row[k]] += value[k] * x[j];
}

static void check_solution(ed_solver *solver, const int *start, const int *row, const double *value, numbers *source)
{
  double x[2 * N], b[2 * N];
  for (int i = 0; i < 2 * N; i++)
    x[i] = next_number(source, -1.0, 1.0);
  multiply(start, row, value, x, b);
  multiply(start, row, value, x + N, b + N);
  CHECK_STATUS(ed_solver_solve(solver, b, 2), ED_OK);
  for (int i = 0; i < 2 * N; i++)
    CHECK_NEAR(b[i], x[i], 1e-13); /* well conditioned */
}

static void check_refactor(void)
{
  int start[N + 1], row[MOST], diagonal[N], repivoted;
  double value[MOST], x[N], y[N];
  numbers source = {2};
  const int count = pattern(start, row, diagonal);
  ed_solver *old = ed_solver_new(N, start, row, diagonal, NULL);
  CHECK_STATUS(ed_solver_solve(old, x, 1), ED_E_STATE); /* nothing factored yet */
  for (int trial = 0; trial < 5; trial++) {
    stiffness(start, row, &source, value);
    CHECK_STATUS(ed_solver_factor(old, value, &repivoted), ED_OK);
    CHECK_INT(repivoted, trial == 0);
    CHECK(ed_solver_pivot_ratio(old) > 0.1 && ed_solver_pivot_ratio(old) <= 1.0);
    check_solution(old, start, row, value, &source);
    ed_solver *fresh = ed_solver_new(N, start, row, diagonal, NULL);
    CHECK_STATUS(ed_solver_factor(fresh, value, &repivoted), ED_OK);
    CHECK_INT(repivoted, 1);
    for (int i = 0; i < N; i++)
      x[i] = y[i] = next_number(&source, -1.0, 1.0);
    ed_solver_solve(old, x, 1);
    ed_solver_solve(fresh, y, 1);
    CHECK_SAME(x, y, N); /* the same pivots, the same operations */
    ed_solver_free(fresh);
  }
  CHECK(ed_solver_flops(old) > 0.0 && ed_solver_solve_flops(old) >= 2.0 * count);
  ed_solver_free(old);
}

static void check_singular(void)
{
  int start[N + 1], row[MOST], diagonal[N], repivoted;
  double value[MOST];
  numbers source = {4};
  pattern(start, row, diagonal);
  ed_solver *solver = ed_solver_new(N, start, row, diagonal, NULL);
  for (int kind = 0; kind < 3; kind++)
    for (int before = 0; before < 2; before++) { /* at once, and after good factors */
      stiffness(start, row, &source, value);
      if (before)
        CHECK_STATUS(ed_solver_factor(solver, value, &repivoted), ED_OK);
      for (int j = 0; j < N; j++)
        for (int k = start[j]; k < start[j + 1]; k++) {
          const int i = row[k];
          if (kind == 0 && (i == 7 || j == 7))
            value[k] = 0.0; /* a degree without stiffness */
          if (kind == 1) /* a chain of springs that nothing holds: exact in floating point */
            value[k] = i == j ? (i == 0 || i == N - 1 ? 1.0 : 2.0) : (i - j == 1 || j - i == 1 ? -1.0 : 0.0);
          if (kind == 2) /* the same with stiffnesses that are not: rounding is left of the pivot */
            value[k] = i == j ? 0.1 * (i < N - 1) + 0.1 * (i > 0) * 1.0 : (i - j == 1 || j - i == 1 ? -0.1 : 0.0);
        }
      CHECK_STATUS(ed_solver_factor(solver, value, &repivoted), ED_E_SINGULAR);
    }
  /* and it recovers */
  stiffness(start, row, &source, value);
  CHECK_STATUS(ed_solver_factor(solver, value, &repivoted), ED_OK);
  check_solution(solver, start, row, value, &source);
  ed_solver_free(solver);
}

/* Old pivots that would ruin the answer are replaced. */
static void check_repivot(void)
{
  static int start[] = {0, 2, 4}, row[] = {0, 1, 0, 1}, diagonal[] = {0, 3};
  double good[] = {2.0, 1.0, 1.0, 2.0}, weak[] = {1e-12, 1.0, 1.0, 1.0}, b[] = {1.0, 2.0};
  int repivoted;
  ed_solver *solver = ed_solver_new(2, start, row, diagonal, NULL);
  CHECK_STATUS(ed_solver_factor(solver, good, &repivoted), ED_OK);
  CHECK_STATUS(ed_solver_factor(solver, good, &repivoted), ED_OK);
  CHECK_INT(repivoted, 0);
  CHECK_STATUS(ed_solver_factor(solver, weak, &repivoted), ED_OK);
  CHECK_STATUS(ed_solver_solve(solver, b, 1), ED_OK);
  CHECK_NEAR(b[0], 1.0 / (1.0 - 1e-12), 1e-14); /* without pivoting four digits remain */
  CHECK_NEAR(b[1], (1.0 - 2e-12) / (1.0 - 1e-12), 1e-14);
  /* indefinite, as beyond a limit point: still solved */
  double indefinite[] = {0.0, 1.0, 1.0, 0.0};
  b[0] = 3.0;
  b[1] = 4.0;
  CHECK_STATUS(ed_solver_factor(solver, indefinite, &repivoted), ED_OK);
  CHECK_STATUS(ed_solver_solve(solver, b, 1), ED_OK);
  CHECK_NEAR(b[0], 4.0, 1e-15);
  CHECK_NEAR(b[1], 3.0, 1e-15);
  ed_solver_free(solver);
}

/* No choice of units makes a matrix singular or saves one. */
static void check_units(void)
{
  int start[N + 1], row[MOST], diagonal[N], repivoted;
  double value[MOST];
  numbers source = {9};
  pattern(start, row, diagonal);
  ed_solver *solver = ed_solver_new(N, start, row, diagonal, NULL);
  stiffness(start, row, &source, value);
  for (int j = 0; j < N; j++)
    for (int k = start[j]; k < start[j + 1]; k++)
      value[k] *= (j % 3 == 2 ? 1e6 : 1.0) * (row[k] % 3 == 2 ? 1e6 : 1.0) * 1e-9;
  CHECK_STATUS(ed_solver_factor(solver, value, &repivoted), ED_OK);
  CHECK(ed_solver_pivot_ratio(solver) > 0.1);
  ed_solver_free(solver);
}

int main(void)
{
  check_refactor();
  check_singular();
  check_repivot();
  check_units();
  ed_solver_free(NULL);
  return checks_end("sparse solver");
}
