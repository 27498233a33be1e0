#include "damper/gauss_jacobi.h"

#include <math.h>

/* Jacobi polynomial P_n^(0, power) at 2t - 1 and its derivative to t (Abramowitz & Stegun 22.7.1). */
static double jacobi(int n, double power, double t, double *slope)
{
  const double x = 2.0 * t - 1.0;
  double before = 1.0, before_slope = 0.0;
  double now = 1.0 + (power + 2.0) * (t - 1.0), now_slope = power + 2.0;
  for (int i = 2; i <= n; i++) {
    const double m = 2.0 * i + power, scale = 2.0 * i * (i + power) * (m - 2.0);
    const double linear = (m - 1.0) * m * (m - 2.0) / scale, constant = -(m - 1.0) * power * power / scale;
    const double back = 2.0 * (i - 1.0) * (i - 1.0 + power) * m / scale;
    const double next = (linear * x + constant) * now - back * before;
    const double next_slope = 2.0 * linear * now + (linear * x + constant) * now_slope - back * before_slope;
    before = now;
    before_slope = now_slope;
    now = next;
    now_slope = next_slope;
  }
  *slope = now_slope;
  return now;
}

void ed_gauss_jacobi(int n, double power, double *point, double *weight)
{
  double t = 0.0, slope;
  for (int k = 0; k < n; k++) {
    /* Newton on the polynomial without the roots found, from below all others: ascends to the next root */
    for (int i = 0; i < 100; i++) {
      const double value = jacobi(n, power, t, &slope);
      double found = 0.0;
      for (int j = 0; j < k; j++)
        found += 1.0 / (t - point[j]);
      const double change = value / (slope - value * found);
      t -= change;
      if (fabs(change) <= 1e-15 * t)
        break;
    }
    point[k] = t;
    jacobi(n, power, t, &slope);
    weight[k] = 1.0 / (t * (1.0 - t) * slope * slope); /* 25.4.33, the slope being to t */
    t += 1e-3 * (1.0 - t);
  }
}
