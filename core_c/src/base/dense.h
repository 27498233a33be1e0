/* Small dense systems. */
#ifndef ED_DENSE_H
#define ED_DENSE_H

/* LU with row pivoting in place, n x n by rows; 0 when singular. */
int ed_dense_factor(int n, double *matrix, int *pivot);
void ed_dense_solve(int n, const double *factors, const int *pivot, double *x);

#endif
