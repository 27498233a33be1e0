/* Moments of a quantity over a step, from which its integral with any slowly fading exponential follows. */
#ifndef ED_MOMENTS_H
#define ED_MOMENTS_H

#include "edcore.h"

enum { ED_PLACES = 24 };

/* Adds n <= ED_PLACES amounts at places from -1 (beginning of the step) to 1 to the moments with Chebyshev's polynomials T_k. All
 * places at once, as each takes its recursion one by one. */
static inline void ed_add_moments(double moment[ED_MOMENTS], int n, const double *place, const double *amount)
{
  double before[ED_PLACES], now[ED_PLACES];
  for (int i = 0; i < n; i++) {
    before[i] = amount[i];
    now[i] = amount[i] * place[i];
  }
  for (int k = 0; k < ED_MOMENTS; k++)
    for (int i = 0; i < n; i++) {
      moment[k] += before[i];
      const double next = 2.0 * place[i] * now[i] - before[i];
      before[i] = now[i];
      now[i] = next;
    }
}

#endif
