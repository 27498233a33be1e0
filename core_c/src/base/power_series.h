/* Powers of a power series, by their coefficients. */
#ifndef ED_POWER_SERIES_H
#define ED_POWER_SERIES_H

enum { ED_SERIES_TERMS = 24 };

/* 1/k up to ED_SERIES_TERMS: a division would take longer than all else of a term. */
static const double ED_INVERSE[ED_SERIES_TERMS + 1] = {
    0.0,        1.0,        1.0 / 2.0,  1.0 / 3.0,  1.0 / 4.0,  1.0 / 5.0,  1.0 / 6.0,  1.0 / 7.0,  1.0 / 8.0,
    1.0 / 9.0,  1.0 / 10.0, 1.0 / 11.0, 1.0 / 12.0, 1.0 / 13.0, 1.0 / 14.0, 1.0 / 15.0, 1.0 / 16.0, 1.0 / 17.0,
    1.0 / 18.0, 1.0 / 19.0, 1.0 / 20.0, 1.0 / 21.0, 1.0 / 22.0, 1.0 / 23.0, 1.0 / 24.0};

/* Coefficient k >= 1 of (1 + r_1 s + r_2 s^2 + ...)^power, from the coefficients before it (w[0] = 1) and r up to k: w = r^power solves
 * r w' = power r' w (Miller; Henrici 1956, "Automatic computations with power series", J. ACM 3, 10). */
static inline double ed_power_of_series(double power, int k, const double *r, const double *w)
{
  const double more = power + 1.0;
  double sum = 0.0, factor = more - k;
  for (int j = 1; j <= k; j++, factor += more)
    sum += factor * r[j] * w[k - j];
  return sum * ED_INVERSE[k];
}

#endif
