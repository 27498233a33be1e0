/* Small symmetric matrices, of 3x3 as 00 01 02 11 12 22. */
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

/* Of n x n as rows of the upper triangle: where (i, j), i <= j, lies. */
static inline int ed_sym_place(int n, int i, int j)
{
  return i * n - i * (i - 1) / 2 + j - i;
}

static inline void ed_sym_times(const int n, const double *a, const double *x, double *y)
{
  for (int i = 0; i < n; i++) {
    double sum = a[ed_sym_place(n, 0, i)] * x[0];
    for (int j = 1; j < n; j++)
      sum += a[j < i ? ed_sym_place(n, j, i) : ed_sym_place(n, i, j)] * x[j];
    y[i] = sum;
  }
}

/* Inverse of a positive definite matrix of at most ED_SYM_MOST rows; 0 where it is not definite. */
enum { ED_SYM_MOST = 5 };
static inline int ed_sym_inverse(const int n, const double *a, double *inverse)
{
  double L[ED_SYM_MOST][ED_SYM_MOST], pivot[ED_SYM_MOST]; /* a = L D L', then L becomes its inverse */
  for (int j = 0; j < n; j++) {
    pivot[j] = a[ed_sym_place(n, j, j)];
    for (int k = 0; k < j; k++)
      pivot[j] -= L[j][k] * L[j][k] * pivot[k];
    if (!(pivot[j] > 0.0))
      return 0;
    for (int i = j + 1; i < n; i++) {
      double sum = a[ed_sym_place(n, j, i)];
      for (int k = 0; k < j; k++)
        sum -= L[i][k] * L[j][k] * pivot[k];
      L[i][j] = sum / pivot[j];
    }
  }
  for (int j = 0; j < n; j++) {
    L[j][j] = 1.0;
    for (int i = j + 1; i < n; i++) {
      double sum = L[i][j];
      for (int k = j + 1; k < i; k++)
        sum += L[i][k] * L[k][j];
      L[i][j] = -sum;
    }
  }
  for (int i = 0; i < n; i++)
    for (int j = i; j < n; j++) {
      double sum = 0.0;
      for (int k = j; k < n; k++)
        sum += L[k][i] * L[k][j] / pivot[k];
      inverse[ed_sym_place(n, i, j)] = sum;
    }
  return 1;
}

/* Removes a moment from a flexibility before inversion: row and column to 0, diagonal to `unit`. */
static inline void ed_sym_release(int n, double *a, int which, double unit)
{
  for (int i = 0; i < n; i++)
    a[i < which ? ed_sym_place(n, i, which) : ed_sym_place(n, which, i)] = 0.0;
  a[ed_sym_place(n, which, which)] = unit;
}

#endif
