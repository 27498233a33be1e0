/* The hysteretic variable of the Bouc-Wen law in two directions, Y z' = A v - z |z|^(n-2) (gamma |z . v| + beta z . v): alike in all
 * directions, and along a single one the law of the plane (Park, Wen & Ang 1986, with |z . v| in place of the sum over axes, which is not
 * alike in all directions; Harvey & Gavin 2014).
 *
 * With b = A v / Y and kappa = (beta +- gamma) / A, by the sign of z . b, that is z' = b - kappa z |z|^(n-2) (z . b). Between changes of
 * the sign it is summed as its Taylor series along the curved path; |z|^(n-2) is the only power. */
#include "base/power_series.h"
#include "damper/bouc_wen.h"
#include "edcore.h"

#include <float.h>

enum { TERMS = ED_SERIES_TERMS, MOST_PIECES = 100000, SAMPLES = 4, HALVINGS = 60 };

static const double ROUNDING = 0.25 * DBL_EPSILON;
/* Of a piece, over |z| and the way in which the rate changes: a series reaches no farther than to where |z| is zero. |z|^n
 * grows by no more than exp(4 LONGEST) along a piece, so that terms that are small tell of those to come. Where a piece is still too
 * long its last terms say by how much. */
static const double LONGEST = 1.5;

/* z, b and z . b along a piece of the path, by powers of the share t of it. */
typedef struct {
  double z[2][TERMS + 1], b[2][3], a[TERMS + 3];
} ed_series;

static double value(const double *c, int terms, double t)
{
  double sum = c[terms];
  for (int k = terms; k > 0; k--)
    sum = sum * t + c[k - 1];
  return sum;
}

/* z . b */
static double along(const ed_series *s, int terms, double t)
{
  return value(s->a, terms + 2, t);
}

/* Its derivative. */
static double pace(const ed_series *s, int terms, double t)
{
  double sum = 0.0;
  for (int k = terms + 2; k > 0; k--)
    sum = sum * t + k * s->a[k];
  return sum;
}

/* Coefficients of z from z(0) and b on, as many as leave rounding of `size`. Returns the share of the piece to which they do. */
static double expand(double n, double kappa, double size, ed_series *s, int *terms)
{
  double r[TERMS], w[TERMS], *a = s->a, g[TERMS], last = 0.0;
  const double square = s->z[0][0] * s->z[0][0] + s->z[1][0] * s->z[1][0], factor = kappa * pow(square, 0.5 * n - 1.0);
  for (int k = 0; k < TERMS; k++) {
    double parts = 0.0;
    a[k] = g[k] = 0.0;
    for (int c = 0; c < 2; c++) {
      for (int j = 0; j <= k; j++)
        parts += s->z[c][j] * s->z[c][k - j];
      for (int j = 0; j <= k && j < 3; j++)
        a[k] += s->z[c][k - j] * s->b[c][j];
    }
    r[k] = parts / square;
    w[k] = k > 0 ? ed_power_of_series(0.5 * n - 1.0, k, r, w) : 1.0;
    for (int j = 0; j <= k; j++)
      g[k] += a[j] * w[k - j];
    const double before = last;
    last = 0.0;
    for (int c = 0; c < 2; c++) {
      double sum = 0.0;
      for (int j = 0; j <= k; j++)
        sum += s->z[c][j] * g[k - j];
      s->z[c][k + 1] = ((k < 3 ? s->b[c][k] : 0.0) - factor * sum) * ED_INVERSE[k + 1];
      last = fmax(last, fabs(s->z[c][k + 1]));
    }
    *terms = k + 1;
    if (k >= 3 && fmax(last, before) <= ROUNDING * size)
      return 1.0;
    if (k == TERMS - 1)
      return pow(ROUNDING * size / fmax(last, before), 1.0 / TERMS);
  }
  return 1.0;
}

/* Where between two shares of a piece, sign times a function of the series falls below zero. */
static double where(double (*of)(const ed_series *, int, double), const ed_series *s, int terms, double sign, double low, double high)
{
  for (int i = 0; i < HALVINGS; i++) {
    const double middle = 0.5 * (low + high);
    if (sign * of(s, terms, middle) < 0.0)
      high = middle;
    else
      low = middle;
  }
  return high;
}

/* Where within the share `to` z . b first has the other sign, also where it only dips below zero; `to` where it has not. */
static double change_of_sign(ed_series *s, int terms, double sign, double to, int *changes)
{
  s->a[terms] = s->a[terms + 1] = s->a[terms + 2] = 0.0;
  double low = 0.0, least_possible = sign * s->a[0];
  for (int k = 1; k <= terms + 2; k++) {
    for (int c = 0; k >= terms && c < 2; c++) /* what the last terms of z bring to it */
      for (int j = k - terms; j < 3; j++)
        s->a[k] += s->z[c][k - j] * s->b[c][j];
    least_possible -= fabs(s->a[k]);
  }
  *changes = least_possible < 0.0;
  if (!*changes)
    return to;
  for (int i = 1; i <= SAMPLES; i++) {
    double high = to * i / SAMPLES;
    if (sign * along(s, terms, high) >= 0.0 && sign * pace(s, terms, low) < 0.0 && sign * pace(s, terms, high) > 0.0) {
      const double least = where(pace, s, terms, -sign, low, high);
      high = sign * along(s, terms, least) < 0.0 ? least : high;
    }
    if (sign * along(s, terms, high) < 0.0)
      return where(along, s, terms, sign, low, high);
    low = to * i / SAMPLES;
  }
  *changes = 0;
  return to;
}

/* z along a whole path. */
static int move(const ed_bouc_wen_shape *shape, const ed_path path[2], double z[2])
{
  const double n = shape->n, widest = pow(DBL_EPSILON, 1.0 / (n + 1.0)) * pow(shape->A / (fabs(shape->beta) + shape->gamma), 1.0 / n);
  const double core = 0.25 * widest; /* so far from zero z = b t is exact to rounding of the largest z */
  double from = 0.0, sign = 0.0;
  for (int pieces = 0; from < 1.0; pieces++) {
    if (pieces == MOST_PIECES || !isfinite(z[0] + z[1]))
      return ED_E_NOT_CONVERGED;
    ed_series s;
    double left = 1.0 - from, longest = 0.0;
    const double size = hypot(z[0], z[1]), kappa_most = (fabs(shape->beta) + shape->gamma) / shape->A;
    const double reach = size <= core ? core : LONGEST * size / (1.0 + n * (0.25 + kappa_most * pow(size, n)));
    for (int c = 0; c < 2; c++) {
      const double h = path[c].h, f = shape->A / shape->Y, *p = path[c].c;
      const double c1 = f * p[1] * h, c2 = f * p[2] * h * h, c3 = f * p[3] * h * h * h;
      s.z[c][0] = z[c];
      s.b[c][0] = c1 + from * (2.0 * c2 + from * 3.0 * c3);
      s.b[c][1] = 2.0 * c2 + 6.0 * c3 * from;
      s.b[c][2] = 3.0 * c3;
      longest = fmax(longest, left * (fabs(s.b[c][0]) + left * (fabs(s.b[c][1]) + left * fabs(s.b[c][2]))));
    }
    if (longest > reach)
      left *= reach / longest;
    for (int c = 0; c < 2; c++) {
      s.b[c][0] *= left;
      s.b[c][1] *= left * left;
      s.b[c][2] *= left * left * left;
    }
    if (size <= core) {
      for (int c = 0; c < 2; c++)
        z[c] += s.b[c][0] + 0.5 * s.b[c][1] + s.b[c][2] / 3.0;
      sign = 0.0;
      from = longest > reach ? from + left : 1.0;
      continue;
    }
    for (int k = 0; k < 3 && sign == 0.0; k++)
      sign = ed_way(z[0] * s.b[0][k] + z[1] * s.b[1][k]);
    int terms, changes;
    const double holds = expand(n, (shape->beta + sign * shape->gamma) / shape->A, size + fmin(longest, reach), &s, &terms);
    const double share = change_of_sign(&s, terms, sign, holds, &changes);
    for (int c = 0; c < 2; c++)
      z[c] = value(s.z[c], terms, share);
    from = longest <= reach && share == 1.0 ? 1.0 : from + share * left;
    if (changes)
      sign = -sign;
  }
  return isfinite(z[0] + z[1]) ? ED_OK : ED_E_NOT_FINITE;
}

int ed_bouc_wen_follow_pair(const ed_bouc_wen_shape *shape, const ed_path path[2], const ed_path direction[2], double z[2],
                            double slope[2][2][2])
{
  const double start[2] = {z[0], z[1]}, h = path[0].h, little = sqrt(DBL_EPSILON) * shape->Y;
  int status = move(shape, path, z);
  for (int i = 0; i < 4; i++) {
    const int c = i / 2, j = i % 2;
    const double *d = direction[j].c, size = h * (fabs(d[1]) + h * (fabs(d[2]) + h * fabs(d[3])));
    double there[2] = {start[0], start[1]};
    ed_path moved[2] = {path[0], path[1]};
    for (int k = 1; size > 0.0 && k < 4; k++)
      moved[c].c[k] += little / size * d[k];
    if (status == ED_OK && size > 0.0)
      status = move(shape, moved, there);
    for (int k = 0; k < 2; k++)
      slope[k][c][j] = size > 0.0 ? (there[k] - z[k]) * size / little : 0.0;
  }
  return status;
}
