#include "damper/path.h"

#include <math.h>

void ed_path_hermite(ed_path *path, double h, double u0, double v0, double u1, double v1)
{
  const double mean = (u1 - u0) / h;
  path->h = h;
  path->c[0] = u0;
  path->c[1] = v0;
  path->c[2] = (3.0 * mean - 2.0 * v0 - v1) / h;
  path->c[3] = (v0 + v1 - 2.0 * mean) / (h * h);
}

void ed_path_hermite_directions(ed_path direction[2], double h)
{
  direction[0] = (ed_path){h, {0.0, 0.0, 3.0 / (h * h), -2.0 / (h * h * h)}};
  direction[1] = (ed_path){h, {0.0, 0.0, -1.0 / h, 1.0 / (h * h)}};
}

void ed_path_piece(const ed_path *path, double s0, double s1, ed_path *piece)
{
  const double *c = path->c;
  piece->h = s1 - s0;
  piece->c[0] = ed_path_u(path, s0);
  piece->c[1] = ed_path_v(path, s0);
  piece->c[2] = c[2] + 3.0 * c[3] * s0;
  piece->c[3] = c[3];
}

/* Below this share of the other terms the square is their rounding, and its second root lies far outside. */
static const double NO_SQUARE = 1e-14;
/* Two roundings of a place at the end of the path: halving gains nothing more. */
static const double SAME_PLACE = 4e-16;

/* Places where a + b s + c s^2 changes sign in (0, h), ascending. */
static int quadratic(double a, double b, double c, double h, double at[2])
{
  int n = 0;
  double root[2];
  int roots = 0;
  const double large = fabs(b) + fabs(c) * h;
  if (fabs(c) * h <= NO_SQUARE * large || c == 0.0) {
    if (b != 0.0)
      root[roots++] = -a / b;
  } else {
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant > 0.0) {
      const double q = -0.5 * (b + copysign(sqrt(discriminant), b));
      root[0] = q / c;
      root[1] = q != 0.0 ? a / q : 0.0;
      roots = 2;
      if (root[1] < root[0]) {
        const double swap = root[0];
        root[0] = root[1];
        root[1] = swap;
      }
    }
  }
  for (int i = 0; i < roots; i++)
    if (root[i] > 0.0 && root[i] < h)
      at[n++] = root[i];
  return n;
}

int ed_path_reversals(const ed_path *path, double at[2])
{
  return quadratic(path->c[1], 2.0 * path->c[2], 3.0 * path->c[3], path->h, at);
}

/* Newton's method kept in its bracket; from NEWTON on halves of it, which leave nothing but rounding. */
double ed_path_crossing(const ed_path *path, double level, double low, double high)
{
  enum { NEWTON = 60, HALVINGS = 60 };
  const double sign = ed_path_u(path, high) > ed_path_u(path, low) ? 1.0 : -1.0;
  double s = 0.5 * (low + high);
  for (int i = 0; i < NEWTON + HALVINGS; i++) {
    const double value = sign * (ed_path_u(path, s) - level), slope = sign * ed_path_v(path, s);
    if (value > 0.0)
      high = s;
    else
      low = s;
    double next = slope > 0.0 ? s - value / slope : low;
    if (!(next > low && next < high) || i >= NEWTON)
      next = 0.5 * (low + high);
    if (fabs(next - s) <= SAME_PLACE * path->h)
      return next;
    s = next;
  }
  return s;
}
