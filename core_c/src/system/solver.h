/* Sparse linear systems: one symbolic analysis, factor once with pivoting, refactor with known pivots, solve. */
#ifndef ED_SOLVER_H
#define ED_SOLVER_H

typedef struct ed_solver ed_solver;

/* Pattern in compressed columns, where the diagonal terms lie, and what rows and columns are multiplied by before pivots are
 * compared (makes moments comparable with forces; NULL: 1). The arrays must outlive the solver. NULL: out of memory. */
ed_solver *ed_solver_new(int n, int *column_start, int *row, int *diagonal, const double *scale);
void ed_solver_free(ed_solver *solver);
/* ED_OK, ED_E_SINGULAR or ED_E_MEMORY. *repivoted: full factorisation was needed. */
int ed_solver_factor(ed_solver *solver, const double *value, int *repivoted);
/* Solves for n_rhs right sides in place. */
int ed_solver_solve(ed_solver *solver, double *rhs, int n_rhs);
/* Floating-point operations of a refactorisation and of a solution. */
double ed_solver_flops(const ed_solver *solver);
double ed_solver_solve_flops(const ed_solver *solver);
/* Negative pivots of the last factors, -1 where pivots off the diagonal leave the count without meaning. */
int ed_solver_negative_pivots(const ed_solver *solver);
/* Of the last factors: smallest |pivot| / |diagonal term|. */
double ed_solver_pivot_ratio(const ed_solver *solver);

#endif
