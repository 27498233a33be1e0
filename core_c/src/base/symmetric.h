/* Symmetric 3x3 matrices as 00 01 02 11 12 22. */
#ifndef ED_SYMMETRIC_H
#define ED_SYMMETRIC_H

static inline void ed_sym3_times(const double *a, const double *x, double *y)
{
  y[0] = a[0] * x[0] + a[1] * x[1] + a[2] * x[2];
  y[1] = a[1] * x[0] + a[3] * x[1] + a[4] * x[2];
  y[2] = a[2] * x[0] + a[4] * x[1] + a[5] * x[2];
}

/* Inverse by cofactors; the return is the determinant (0: not inverted). */
static inline double ed_sym3_inverse(const double *a, double *inverse)
{
  const double c00 = a[3] * a[5] - a[4] * a[4];
  const double c01 = a[2] * a[4] - a[1] * a[5];
  const double c02 = a[1] * a[4] - a[2] * a[3];
  const double determinant = a[0] * c00 + a[1] * c01 + a[2] * c02;
  if (determinant == 0.0)
    return 0.0;
  const double r = 1.0 / determinant;
  inverse[0] = c00 * r;
  inverse[1] = c01 * r;
  inverse[2] = c02 * r;
  inverse[3] = (a[0] * a[5] - a[2] * a[2]) * r;
  inverse[4] = (a[1] * a[2] - a[0] * a[4]) * r;
  inverse[5] = (a[0] * a[3] - a[1] * a[1]) * r;
  return determinant;
}

/* Removes a moment (1 or 2) from a flexibility before inversion: row and column to 0, diagonal to `unit`. */
static inline void ed_sym3_release(double *a, int which, double unit)
{
  if (which == 1) {
    a[1] = a[4] = 0.0;
    a[3] = unit;
  } else {
    a[2] = a[4] = 0.0;
    a[5] = unit;
  }
}

#endif
