#include "system/solver.h"

#include "edcore.h"

#include <klu.h>
#include <math.h>
#include <stdlib.h>

struct ed_solver {
  int n;
  int *column_start, *row, *diagonal;
  const double *scale;
  double *scaled;       /* nnz: the matrix that is factored */
  klu_common common;
  klu_symbolic *symbolic;
  klu_numeric *usual;   /* pivots of the first matrix, used for all that they suit */
  klu_numeric *special; /* pivots chosen for one matrix that they did not suit */
  klu_numeric *active;  /* one of the two, or NULL */
  double flops;
  double pivot_ratio;
};

/* |pivot| / |its diagonal term| is a measure that no choice of units changes. Below SINGULAR nothing but rounding is left of
 * the pivot; below POOR, or above GROWN (of what a small pivot before it made), the usual pivots do not suit. */
static const double SINGULAR = 1e-14, POOR = 1e-9, GROWN = 1e4;

static int pivots_suit(ed_solver *solver, const klu_numeric *numeric, const double *value)
{
  const double *pivot = numeric->Udiag;
  const int *column = solver->symbolic->Q;
  double smallest = 1.0, largest = 0.0;
  for (int k = 0; k < solver->n; k++) {
    const double own = fabs(value[solver->diagonal[column[k]]]);
    const double ratio = own > 0.0 ? fabs(pivot[k]) / own : (pivot[k] != 0.0 ? 1.0 : 0.0);
    if (!(ratio >= smallest))
      smallest = ratio;
    if (!(ratio <= largest))
      largest = ratio;
  }
  solver->pivot_ratio = smallest;
  return smallest > POOR && largest < GROWN;
}

ed_solver *ed_solver_new(int n, int *column_start, int *row, int *diagonal, const double *scale)
{
  ed_solver *solver = calloc(1, sizeof *solver);
  if (!solver)
    return NULL;
  solver->n = n;
  solver->column_start = column_start;
  solver->row = row;
  solver->diagonal = diagonal;
  solver->scale = scale;
  solver->scaled = malloc(((size_t)column_start[n] + 1) * sizeof *solver->scaled);
  klu_defaults(&solver->common);
  solver->common.btf = 0;   /* one block: the structure is connected */
  solver->common.scale = 0; /* stiffness is symmetric, its diagonal a good pivot, also where units differ a lot */
  solver->common.tol = 1e-6; /* for the same reason: one elsewhere only where the diagonal is less than that share of its column */
  solver->symbolic = klu_analyze(n, column_start, row, &solver->common);
  if (!solver->symbolic || !solver->scaled) {
    ed_solver_free(solver);
    return NULL;
  }
  return solver;
}

void ed_solver_free(ed_solver *solver)
{
  if (!solver)
    return;
  klu_free_numeric(&solver->usual, &solver->common);
  klu_free_numeric(&solver->special, &solver->common);
  klu_free_symbolic(&solver->symbolic, &solver->common);
  free(solver->scaled);
  free(solver);
}

static void scale_matrix(ed_solver *solver, const double *value)
{
  const double *s = solver->scale;
  for (int j = 0; j < solver->n; j++)
    for (int k = solver->column_start[j]; k < solver->column_start[j + 1]; k++)
      solver->scaled[k] = s ? s[j] * s[solver->row[k]] * value[k] : value[k];
}

static void scale_vectors(const ed_solver *solver, double *x, int count)
{
  for (int c = 0; solver->scale && c < count; c++)
    for (int i = 0; i < solver->n; i++)
      x[(size_t)c * (size_t)solver->n + (size_t)i] *= solver->scale[i];
}

int ed_solver_factor(ed_solver *solver, const double *matrix, int *repivoted)
{
  klu_common *common = &solver->common;
  double *value = solver->scaled;
  scale_matrix(solver, matrix);
  *repivoted = 0;
  solver->active = NULL;
  klu_free_numeric(&solver->special, common);
  if (solver->usual) {
    if (klu_refactor(solver->column_start, solver->row, value, solver->symbolic, solver->usual, common) &&
        common->status == KLU_OK && pivots_suit(solver, solver->usual, value)) {
      solver->active = solver->usual;
      return ED_OK;
    }
  }
  *repivoted = 1;
  klu_numeric *chosen = klu_factor(solver->column_start, solver->row, value, solver->symbolic, common);
  if (!chosen)
    return common->status == KLU_OUT_OF_MEMORY ? ED_E_MEMORY : ED_E_SINGULAR;
  /* the answer must not depend on which matrices came before: only the first one's pivots are kept for others */
  if (solver->usual)
    solver->special = chosen;
  else
    solver->usual = chosen;
  solver->active = chosen;
  if (solver->flops == 0.0 && klu_flops(solver->symbolic, chosen, common))
    solver->flops = common->flops;
  pivots_suit(solver, chosen, value);
  return common->status == KLU_OK && solver->pivot_ratio > SINGULAR ? ED_OK : ED_E_SINGULAR;
}

int ed_solver_solve(ed_solver *solver, double *rhs, int n_rhs)
{
  if (!solver->active)
    return ED_E_STATE;
  scale_vectors(solver, rhs, n_rhs);
  if (!klu_solve(solver->symbolic, solver->active, solver->n, n_rhs, rhs, &solver->common))
    return ED_E_SINGULAR;
  scale_vectors(solver, rhs, n_rhs);
  return ED_OK;
}

int ed_solver_negative_pivots(const ed_solver *solver)
{
  int negative = 0;
  if (!solver->active)
    return -1;
  for (int k = 0; k < solver->n; k++) {
    if (solver->active->Pnum[k] != solver->symbolic->Q[k])
      return -1;
    negative += ((const double *)solver->active->Udiag)[k] < 0.0;
  }
  return negative;
}

double ed_solver_flops(const ed_solver *solver)
{
  return solver->flops;
}

double ed_solver_solve_flops(const ed_solver *solver)
{
  return solver->active ? 2.0 * ((double)solver->active->lnz + (double)solver->active->unz) : 0.0;
}

double ed_solver_pivot_ratio(const ed_solver *solver)
{
  return solver->pivot_ratio;
}
