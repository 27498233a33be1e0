#include "system/solver.h"

#include "edcore.h"

#include <klu.h>
#include <math.h>
#include <stdlib.h>

struct ed_solver {
  int n;
  int *column_start, *row;
  klu_common common;
  klu_symbolic *symbolic;
  klu_numeric *numeric;
  int *diagonal;
  double flops;
  double pivot_ratio;
};

/* Smallest |pivot| / |its diagonal term|: a measure that no choice of units changes. Below SINGULAR nothing but rounding
 * is left of the pivot; below POOR pivots known from before are chosen anew. */
static const double SINGULAR = 1e-14, POOR = 1e-9;

static double smallest_pivot(const ed_solver *solver, const double *value)
{
  const double *pivot = solver->numeric->Udiag;
  const int *column = solver->symbolic->Q;
  double smallest = 1.0;
  for (int k = 0; k < solver->n; k++) {
    const double own = fabs(value[solver->diagonal[column[k]]]);
    const double ratio = own > 0.0 ? fabs(pivot[k]) / own : (pivot[k] != 0.0 ? 1.0 : 0.0);
    if (!(ratio >= smallest))
      smallest = ratio;
  }
  return smallest;
}

ed_solver *ed_solver_new(int n, int *column_start, int *row, int *diagonal)
{
  ed_solver *solver = calloc(1, sizeof *solver);
  if (!solver)
    return NULL;
  solver->n = n;
  solver->column_start = column_start;
  solver->row = row;
  solver->diagonal = diagonal;
  klu_defaults(&solver->common);
  solver->common.btf = 0;   /* one block: the structure is connected */
  solver->common.scale = 0; /* stiffness is symmetric, its diagonal a good pivot */
  solver->symbolic = klu_analyze(n, column_start, row, &solver->common);
  if (!solver->symbolic) {
    free(solver);
    return NULL;
  }
  return solver;
}

void ed_solver_free(ed_solver *solver)
{
  if (!solver)
    return;
  klu_free_numeric(&solver->numeric, &solver->common);
  klu_free_symbolic(&solver->symbolic, &solver->common);
  free(solver);
}

int ed_solver_factor(ed_solver *solver, double *value, int *repivoted)
{
  klu_common *common = &solver->common;
  *repivoted = 0;
  if (solver->numeric) {
    const int ok = klu_refactor(solver->column_start, solver->row, value, solver->symbolic, solver->numeric, common);
    if (ok && common->status == KLU_OK) {
      solver->pivot_ratio = smallest_pivot(solver, value);
      if (solver->pivot_ratio > POOR)
        return ED_OK;
    }
    /* the old pivots have become poor: choose new ones */
    klu_free_numeric(&solver->numeric, common);
  }
  *repivoted = 1;
  solver->numeric = klu_factor(solver->column_start, solver->row, value, solver->symbolic, common);
  if (!solver->numeric || common->status != KLU_OK)
    return ED_E_SINGULAR;
  if (solver->flops == 0.0 && klu_flops(solver->symbolic, solver->numeric, common))
    solver->flops = common->flops;
  solver->pivot_ratio = smallest_pivot(solver, value);
  return solver->pivot_ratio > SINGULAR ? ED_OK : ED_E_SINGULAR;
}

int ed_solver_solve(ed_solver *solver, double *rhs, int n_rhs)
{
  if (!solver->numeric)
    return ED_E_STATE;
  return klu_solve(solver->symbolic, solver->numeric, solver->n, n_rhs, rhs, &solver->common) ? ED_OK : ED_E_SINGULAR;
}

double ed_solver_flops(const ed_solver *solver)
{
  return solver->flops;
}

double ed_solver_solve_flops(const ed_solver *solver)
{
  return solver->numeric ? 2.0 * ((double)solver->numeric->lnz + (double)solver->numeric->unz) : 0.0;
}

double ed_solver_pivot_ratio(const ed_solver *solver)
{
  return solver->pivot_ratio;
}
