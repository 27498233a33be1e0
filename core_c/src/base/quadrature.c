#include "quadrature.h"

#include <math.h>

/* Interior points are the roots of P'_{n-1}, found by Newton from the Chebyshev-Lobatto points; weights 2/(n(n-1)P^2).
 * Abramowitz & Stegun 25.4.32. */
void ed_gauss_lobatto(int n, double *point, double *weight)
{
  const int degree = n - 1;
  for (int i = 0; i < n; i++) {
    double x = -cos(3.14159265358979323846 * i / degree);
    double legendre = 1.0;
    for (int iteration = 0; iteration < 50; iteration++) {
      double before = 1.0, now = x;
      for (int k = 2; k <= degree; k++) {
        const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now;
        now = next;
      }
      legendre = now;
      if (i == 0 || i == degree)
        break;
      /* (1 - x^2) P'_m = m (P_{m-1} - x P_m), and its derivative is -m (m+1) P_m */
      const double step = (before - x * now) / ((degree + 1) * now);
      x += step;
      if (fabs(step) < 1e-16)
        break;
    }
    point[i] = 0.5 * (1.0 + x);
    weight[i] = 1.0 / (n * degree * legendre * legendre);
  }
  point[0] = 0.0;
  point[degree] = 1.0;
}
