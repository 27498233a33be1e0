/* Peaks, with their places, in the responses of many oscillators that are written as recursions of the second order. */
#include "base/clones.h"
#include "base/watch.h"
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

/* The maxima of |y| in one lane that reach a threshold, by the parabola through three samples. ED_E_NOT_FINITE: a sample or a peak is not
 * finite; between the ends such a sample is no smaller than its neighbours, or one beside it is at an end. */
static int look(int n, const double *y, double threshold, int most, int *count, double *places, double *values, ed_watch *watch)
{
  *count = 0;
  if (!isfinite(y[0]) || !isfinite(y[(size_t)(n - 1) * LANES]))
    return ED_E_NOT_FINITE;
  for (int i = 1; i < n - 1; i++) {
    const double before = y[(size_t)(i - 1) * LANES], middle = y[(size_t)i * LANES], after = y[(size_t)(i + 1) * LANES];
    const double size = fabs(middle);
    if (size < threshold || size < fabs(before) || size <= fabs(after))
      continue;
    const double shift = 0.5 * (before - after) / (before - 2.0 * middle + after);
    const double value = middle - 0.25 * (before - after) * shift;
    if (!isfinite(shift) || !isfinite(value))
      return ED_E_NOT_FINITE;
    keep(i + shift, value, most, count, places, values);
    if (ed_watch_step(watch))
      return ED_E_STOPPED;
  }
  return ED_OK;
}

int ed_recursion_peaks(int n, const double *samples, int n_recursions, const double *numerator, const double *denominator,
                       double share, int most, int *count, double *place, double *value, const ed_stop *stop)
{
  ed_watch watch = ed_watch_of(stop);
  if (n < 3 || n_recursions < 0 || most < 1 || !(share >= 0.0 && share <= 1.0))
    return ED_E_ARGUMENT;
  double *y = malloc((size_t)n * LANES * sizeof *y);
  if (!y)
    return ED_E_MEMORY;
  int status = ED_OK;
  for (long from = 0; from < n_recursions && status == ED_OK; from += LANES) {
    const int lanes = n_recursions - from < LANES ? (int)(n_recursions - from) : LANES;
    recursions r = {.b0 = {0.0}};
    double largest[LANES];
    for (int l = 0; l < lanes; l++) {
      const double *b = numerator + 3 * (from + l), *a = denominator + 2 * (from + l);
      r.b0[l] = b[0], r.b1[l] = b[1], r.b2[l] = b[2], r.a1[l] = a[0], r.a2[l] = a[1];
    }
    respond(n, samples, &r, y, largest);
    if (ed_watch_look(&watch))
      status = ED_E_STOPPED;
    for (int l = 0; l < lanes && status == ED_OK; l++) {
      const size_t at = (size_t)(from + l) * (size_t)most;
      status = look(n, y + l, share * largest[l], most, &count[from + l], place + at, value + at, &watch);
    }
  }
  free(y);
  return status;
}
