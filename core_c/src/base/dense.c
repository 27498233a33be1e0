#include "base/dense.h"

#include "base/clones.h"

#include <math.h>

ED_CLONES int ed_dense_factor(int n, double *a, int *pivot)
{
  for (int k = 0; k < n; k++) {
    int best = k;
    for (int i = k + 1; i < n; i++)
      if (fabs(a[i * n + k]) > fabs(a[best * n + k]))
        best = i;
    pivot[k] = best;
    if (a[best * n + k] == 0.0)
      return 0;
    for (int j = 0; best != k && j < n; j++) {
      const double swap = a[k * n + j];
      a[k * n + j] = a[best * n + j];
      a[best * n + j] = swap;
    }
    const double *restrict chosen = a + k * n;
    for (int i = k + 1; i < n; i++) {
      double *restrict row = a + i * n; /* another one */
      const double factor = row[k] /= chosen[k];
      for (int j = k + 1; j < n; j++)
        row[j] -= factor * chosen[j];
    }
  }
  return 1;
}

void ed_dense_solve(int n, const double *a, const int *pivot, double *x)
{
  for (int k = 0; k < n; k++) {
    const double swap = x[k];
    x[k] = x[pivot[k]];
    x[pivot[k]] = swap;
  }
  for (int i = 1; i < n; i++)
    for (int j = 0; j < i; j++)
      x[i] -= a[i * n + j] * x[j];
  for (int i = n - 1; i >= 0; i--) {
    for (int j = i + 1; j < n; j++)
      x[i] -= a[i * n + j] * x[j];
    x[i] /= a[i * n + i];
  }
}
