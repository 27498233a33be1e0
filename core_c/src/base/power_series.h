/* Powers of a power series, by their coefficients. */
#ifndef ED_POWER_SERIES_H
#define ED_POWER_SERIES_H

/* Coefficient k >= 1 of (1 + r_1 s + r_2 s^2 + ...)^power, from the coefficients before it (w[0] = 1) and r up to k: w = r^power solves
 * r w' = power r' w (Miller; Henrici 1956, "Automatic computations with power series", J. ACM 3, 10). */
static inline double ed_power_of_series(double power, int k, const double *r, const double *w)
{
  double sum = 0.0;
  for (int j = 1; j <= k; j++)
    sum += ((power + 1.0) * j - k) * r[j] * w[k - j];
  return sum / k;
}

#endif
