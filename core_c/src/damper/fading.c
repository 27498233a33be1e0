/* Histories that fade from sample to sample and are fed by what comes in between: strains of relaxing springs, heat, softening. */
#include "edcore.h"

#include <math.h>

/* Below this nothing is left; arithmetic with denormal numbers would be slow. */
static const double NOTHING = 1e-290;

int ed_fading(int n, const double *decay, const double *made, double before, double *q)
{
  if (n < 1)
    return ED_E_ARGUMENT;
  double last = q[0] = before;
  for (int i = 1; i < n; i++) {
    last = decay[i - 1] * last + made[i - 1];
    if (fabs(last) < NOTHING)
      last = 0.0;
    q[i] = last;
  }
  return isfinite(last) ? ED_OK : ED_E_NOT_FINITE; /* it is passed on to the end */
}

int ed_fading_complex(int n, const double *decay, const double *made, const double *before, double *q)
{
  if (n < 1)
    return ED_E_ARGUMENT;
  double re = q[0] = before[0], im = q[1] = before[1];
  for (int i = 1; i < n; i++) {
    const double *d = decay + 2 * (i - 1), *m = made + 2 * (i - 1), real = d[0] * re - d[1] * im + m[0];
    im = d[0] * im + d[1] * re + m[1];
    re = real;
    if (fabs(re) + fabs(im) < NOTHING)
      re = im = 0.0;
    q[2 * i] = re;
    q[2 * i + 1] = im;
  }
  return isfinite(re) && isfinite(im) ? ED_OK : ED_E_NOT_FINITE;
}
