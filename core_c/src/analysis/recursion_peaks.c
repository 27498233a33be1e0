/* Peaks, with their places, in the responses of many oscillators that are written as recursions of the second order. */
#include "base/clones.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>

enum { LANES = 8 };

typedef struct {
  double b0[LANES], b1[LANES], b2[LANES], a1[LANES], a2[LANES];
} recursions;

/* y: n x LANES; largest: of |y| in each lane. The order of operations is that of the transposed direct form. */
ED_CLONES static void respond(int n, const double *restrict x, const recursions *restrict r, double *restrict y,
                              double *restrict largest)
{
  double z1[LANES] = {0.0}, z2[LANES] = {0.0}, top[LANES] = {0.0};
  for (int i = 0; i < n; i++)
    for (int l = 0; l < LANES; l++) {
      const double xi = x[i], yi = z1[l] + r->b0[l] * xi, size = fabs(yi);
      z1[l] = z2[l] + xi * r->b1[l] - yi * r->a1[l];
      z2[l] = xi * r->b2[l] - yi * r->a2[l];
      y[(size_t)i * LANES + l] = yi;
      top[l] = size > top[l] ? size : top[l];
    }
  for (int l = 0; l < LANES; l++)
    largest[l] = top[l];
}

/* Puts a peak among the `most` largest, which stand in order; of equal ones the earlier goes first. */
static void keep(double place, double value, int most, int *count, double *places, double *values)
{
  int at = *count < most ? *count : most;
  while (at > 0 && fabs(values[at - 1]) < fabs(value))
    at--;
  if (at == most)
    return;
  if (*count < most)
    ++*count;
  for (int k = *count - 1; k > at; k--)
    places[k] = places[k - 1], values[k] = values[k - 1];
  places[at] = place;
  values[at] = value;
}

/* The maxima of |y| in one lane that reach a threshold, by the parabola through three samples. */
static void look(int n, const double *y, double threshold, int most, int *count, double *places, double *values)
{
  *count = 0;
  for (int i = 1; i < n - 1; i++) {
    const double before = y[(size_t)(i - 1) * LANES], middle = y[(size_t)i * LANES], after = y[(size_t)(i + 1) * LANES];
    const double size = fabs(middle);
    if (size < threshold || size < fabs(before) || size <= fabs(after))
      continue;
    const double shift = 0.5 * (before - after) / (before - 2.0 * middle + after);
    keep(i + shift, middle - 0.25 * (before - after) * shift, most, count, places, values);
  }
}

int ed_recursion_peaks(int n, const double *samples, int n_recursions, const double *numerator, const double *denominator,
                       double share, int most, int *count, double *place, double *value)
{
  if (n < 3 || n_recursions < 0 || most < 1 || !(share >= 0.0 && share <= 1.0))
    return ED_E_ARGUMENT;
  double *y = malloc((size_t)n * LANES * sizeof *y);
  if (!y)
    return ED_E_MEMORY;
  int status = ED_OK;
  for (int from = 0; from < n_recursions && status == ED_OK; from += LANES) {
    const int lanes = n_recursions - from < LANES ? n_recursions - from : LANES;
    recursions r = {.b0 = {0.0}};
    double largest[LANES];
    for (int l = 0; l < lanes; l++) {
      const double *b = numerator + 3 * (from + l), *a = denominator + 2 * (from + l);
      r.b0[l] = b[0], r.b1[l] = b[1], r.b2[l] = b[2], r.a1[l] = a[0], r.a2[l] = a[1];
    }
    respond(n, samples, &r, y, largest);
    for (int l = 0; l < lanes; l++) {
      if (!isfinite(y[(size_t)(n - 1) * LANES + l]))
        status = ED_E_NOT_FINITE;
      const size_t at = (size_t)(from + l) * most;
      look(n, y + l, share * largest[l], most, &count[from + l], place + at, value + at);
    }
  }
  free(y);
  return status;
}
