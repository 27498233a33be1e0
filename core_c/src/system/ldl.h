/* Sparse symmetric matrices without pivoting, L D L^T by the multifrontal method: one symbolic analysis, factors of many matrices of
 * one pattern, many right sides at once. Stiffness of a structure that stands is positive definite and needs no pivots; without them
 * the place of a pivot that vanishes is the degree at which a structure that cannot stand moves, and the negative ones are counted.
 * Duff & Reid (1983); ordering by AMD. */
#ifndef ED_LDL_H
#define ED_LDL_H

typedef struct ed_ldl ed_ldl;

/* Pattern of the lower triangle (row >= column, the diagonal in it) in compressed columns, read only here. The `last` last columns are
 * eliminated last: their right sides cost half. NULL: out of memory. */
ed_ldl *ed_ldl_new(int n, int last, const int *column_start, const int *row);
void ed_ldl_free(ed_ldl *ldl);
/* Factors a matrix. A pivot up to `vanishing` times its diagonal term in magnitude has vanished: its degree is left out. Returns how
 * many there are. */
int ed_ldl_factor(ed_ldl *ldl, const double *value, double vanishing);
/* Solves for n_rhs right sides, n numbers each, in place. */
void ed_ldl_solve(ed_ldl *ldl, int n_rhs, double *rhs);
/* Of the last factors: column of the first pivot that vanished, -1 if none has; negative pivots. */
int ed_ldl_vanished(const ed_ldl *ldl);
int ed_ldl_negative(const ed_ldl *ldl);
/* The motion that meets no resistance where a pivot has vanished, 1 there: n. */
void ed_ldl_free_motion(ed_ldl *ldl, int column, double *x);
double ed_ldl_nonzeros(const ed_ldl *ldl); /* of L, blocks counted whole */

#endif
