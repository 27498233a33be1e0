#ifndef ED_GAUSS_JACOBI_H
#define ED_GAUSS_JACOBI_H

/* Gauss points and weights on [0, 1] for integrals of t^power f(t), power > -1: exact for polynomials f of degree 2n - 1. */
void ed_gauss_jacobi(int n, double power, double *point, double *weight);

#endif
