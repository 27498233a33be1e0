/* Whether all of some numbers are finite. */
#ifndef ED_FINITE_H
#define ED_FINITE_H

#include <math.h>
#include <stddef.h>

static inline int ed_all_finite(size_t n, const double *values)
{
  int finite = 1;
  for (size_t i = 0; i < n; i++) /* without leaving early, so that lanes may check several at once */
    finite &= isfinite(values[i]) != 0;
  return finite;
}

#endif
