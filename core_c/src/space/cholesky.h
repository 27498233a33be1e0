/* Sparse symmetric positive definite systems: one symbolic analysis, then factors by Cholesky's method, by supernodes (multifrontal: Duff &
 * Reid 1983), and many right sides at once. */
#ifndef ED_CHOLESKY_H
#define ED_CHOLESKY_H

typedef struct ed_cholesky ed_cholesky;

/* Pattern in compressed columns, both triangles, and where the diagonal terms lie. The last n_last equations are eliminated last: where
 * loads and displacements at these count, what is before them is left alone. NULL: out of memory. */
ed_cholesky *ed_cholesky_new(int n, int n_last, const int *column_start, const int *row, const int *diagonal);
void ed_cholesky_free(ed_cholesky *cholesky);
/* ED_OK, or ED_E_SINGULAR where a pivot is not above 1e-14 of its diagonal term, as where the matrix is not positive definite. */
int ed_cholesky_factor(ed_cholesky *cholesky, const double *value);
/* Of the last factors: smallest pivot / diagonal term; 0 where there are none. */
double ed_cholesky_pivot_ratio(const ed_cholesky *cholesky);
/* Solves for n_rhs right sides in place. ED_E_STATE without factors. */
int ed_cholesky_solve(ed_cholesky *cholesky, double *rhs, int n_rhs);
/* Terms of the inverse in rows and columns of `count` equations: count x count. */
int ed_cholesky_inverse(ed_cholesky *cholesky, int count, const int *equation, double *inverse);

#endif
