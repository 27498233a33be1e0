#ifndef ED_QUADRATURE_H
#define ED_QUADRATURE_H

enum { ED_MAX_RULE = 10 };

/* Gauss-Lobatto points and weights on [0, 1]; n from 2 to ED_MAX_RULE. Exact for polynomials of degree 2n - 3. */
void ed_gauss_lobatto(int n, double *point, double *weight);

#endif
