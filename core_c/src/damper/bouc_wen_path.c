/* The hysteretic variable of the Bouc-Wen laws along a path.
 *
 * z depends on the order of deformations alone: between two turns of the path it solves an autonomous equation in the way that is gone.
 * With q = |z|, G = A |du| / Y and kappa = (beta +- gamma) / A that is dq/dG = +-(1 - kappa q^n): plus and beta + gamma where z grows the
 * way the path goes, minus and beta - gamma where z falls to zero, from where it grows.
 *
 * Away from zero the solution is summed as its Taylor series in G. q^n is the only power: the coefficients of (q/q_0)^n follow from those
 * of q/q_0. Around zero q^n has no Taylor series for broken n, but the solution through zero has one in y = kappa G^n, q = G P(y), and its
 * inverse is G = q sum_k (kappa q^n)^k / (n k + 1). Pieces end where a series would need more than MOST_TERMS. */
#include "base/power_series.h"
#include "damper/bouc_wen.h"
#include "damper/motions.h"
#include "edcore.h"

#include <float.h>

enum { MOST_TERMS = ED_SERIES_TERMS, MOST_PIECES = 100000 };

/* Terms of a sum that begins with 1. */
static const double ROUNDING = 0.25 * DBL_EPSILON;

/* Of kappa q^n: up to where the solution starts around zero, and of kappa G^n up to where it is followed from there. The series of the
 * first has the radius 1 and that of the second at least as much, so that 13 and 17 terms leave rounding. What starts below NEAR_ZERO
 * and goes to LEAVES_ZERO is beyond NEAR_ZERO then: q^n / G^n is at least (1 - 1/8)^1. */
static const double NEAR_ZERO = 1.0 / 16.0, LEAVES_ZERO = 1.0 / 8.0;
/* Of a piece in units of the way in which q or its rate would change by their own size: longer ones only make large terms that cancel,
 * and below 1 none that falls passes zero, as its rate is never above the larger of that now and 1. */
static const double LONGEST = 0.75;

static double power_of(double q, double n)
{
  return n == 1.0 ? q : n == 2.0 ? q * q : pow(q, n);
}

/* G / q of the solution through zero, where kappa q^n = y. */
static double way_from_zero(double n, double y)
{
  double sum = 1.0, power = 1.0;
  for (int k = 1; k <= MOST_TERMS && fabs(power) > ROUNDING; k++) {
    power *= y;
    sum += power / (n * k + 1.0);
  }
  return sum;
}

/* q / G of it, where kappa G^n = y: P + n y P' = 1 - y P^n. */
static double size_from_zero(double n, double y)
{
  double p[MOST_TERMS + 1], w[MOST_TERMS + 1], sum = 1.0;
  p[0] = w[0] = 1.0;
  for (int k = 0; k < MOST_TERMS; k++) {
    if (k > 0)
      w[k] = ed_power_of_series(n, k, p, w);
    p[k + 1] = -y * w[k] / (n * (k + 1) + 1.0);
    sum += p[k + 1];
    if (fmax(fabs(p[k + 1]), fabs(p[k])) <= ROUNDING)
      break;
  }
  return sum;
}

/* One piece around zero; *left: of G. Falling, it ends at zero. */
static void around_zero(double n, double kappa, double sign, double y, double *q, double *left)
{
  const double from = *q * way_from_zero(n, y), to = from + sign * *left;
  if (to <= 0.0) {
    *q = 0.0;
    *left = -to;
    return;
  }
  const double reached = kappa * power_of(to, n);
  if (fabs(reached) <= LEAVES_ZERO) {
    *q = to * size_from_zero(n, reached);
    *left = 0.0;
    return;
  }
  const double limit = pow(LEAVES_ZERO / fabs(kappa), 1.0 / n);
  *q = limit * size_from_zero(n, copysign(LEAVES_ZERO, kappa));
  *left = to - limit;
}

/* One piece away from zero, where kappa q^n = y and the rate is sign f. */
static void by_taylor(double n, double sign, double y, double f, double *q, double *left)
{
  const double rate = sign < 0.0 ? fmax(f, 1.0) : fabs(f);
  const double piece = fmin(*left, LONGEST * *q / (rate + n * fabs(y))), scale = sign * piece / *q;
  double r[MOST_TERMS + 1], w[MOST_TERMS + 1], sum = 1.0 + scale * f;
  r[0] = w[0] = 1.0;
  r[1] = scale * f;
  for (int k = 1; k < MOST_TERMS; k++) {
    w[k] = ed_power_of_series(n, k, r, w);
    r[k + 1] = -scale * y * w[k] * ED_INVERSE[k + 1];
    sum += r[k + 1];
    if (fmax(fabs(r[k + 1]), fabs(r[k])) <= ROUNDING) {
      *q *= sum;
      *left = piece < *left ? *left - piece : 0.0;
      return;
    }
  }
  /* so much shorter that the last terms are rounding */
  const double last = fmax(fabs(r[MOST_TERMS]), fabs(r[MOST_TERMS - 1])), share = pow(ROUNDING / last, 1.0 / MOST_TERMS);
  sum = 0.0;
  for (int k = MOST_TERMS; k > 0; k--)
    sum = (sum + r[k]) * share;
  *q *= 1.0 + sum;
  *left -= share * piece;
}

/* q along `left` of G, or falling to zero: what is left then stays in *left. */
static int advance(double n, double kappa, double sign, double *q, double *left)
{
  for (int pieces = 0; *left > 0.0; pieces++) {
    const double y = kappa * power_of(*q, n), f = 1.0 - y, rounding = 4.0 * n * DBL_EPSILON;
    if (pieces == MOST_PIECES || !isfinite(y))
      return ED_E_NOT_CONVERGED;
    if (fabs(y) <= NEAR_ZERO) {
      around_zero(n, kappa, sign, y, q, left);
      if (*q == 0.0)
        return ED_OK;
    } else if (fabs(f) <= rounding) { /* yields: the rate is zero to rounding */
      *left = 0.0;
    } else if (sign < 0.0 && f < 0.0) {
      return ED_E_ARGUMENT; /* would grow for ever */
    } else {
      by_taylor(n, sign, y, f, q, left);
    }
  }
  return ED_OK;
}

/* z along a monotone motion. */
static int move(const ed_bouc_wen_shape *shape, double change, double *z)
{
  const double way = ed_way(change), A = shape->A;
  double left = A * fabs(change) / shape->Y, q = fabs(*z);
  int status = ED_OK;
  if (*z * way < 0.0) {
    status = advance(shape->n, (shape->beta - shape->gamma) / A, -1.0, &q, &left);
    if (status != ED_OK)
      return status;
    if (q > 0.0) {
      *z = -way * q;
      return ED_OK;
    }
  }
  if (left > 0.0) {
    status = advance(shape->n, (shape->beta + shape->gamma) / A, 1.0, &q, &left);
    *z = way * q;
  } else if (q == 0.0) {
    *z = 0.0;
  }
  return status;
}

int ed_bouc_wen_follow(const ed_bouc_wen_shape *shape, const ed_path *path, const ed_path direction[2], double *z, double slope[2])
{
  ed_motion motion[3];
  const int n = ed_path_motions(path, direction, motion), wanted = ed_path_moves(direction);
  double from = path->c[0], begins[2] = {0.0, 0.0}, here, at_end, unused;
  slope[0] = slope[1] = 0.0;
  for (int i = 0; i < n; i++) {
    const double change = motion[i].u - from, way = motion[i].sign, before = *z;
    const int status = move(shape, change, z);
    if (status != ED_OK)
      return status;
    from = motion[i].u;
    if (!wanted)
      continue;
    /* An autonomous equation: what z is moved at the start is moved on as the rates at both ends. That at a start behind a turn is not
     * zero, since z returns from there. */
    double share = 0.0;
    ed_bouc_wen_slope(shape, *z, way, &at_end, &unused);
    if (i > 0) {
      ed_bouc_wen_slope(shape, before, way, &here, &unused);
      share = at_end / here;
    }
    for (int j = 0; j < 2; j++) {
      slope[j] = at_end * (motion[i].slope[j] - begins[j]) + (i > 0 ? share * slope[j] : 0.0);
      begins[j] = motion[i].slope[j];
    }
  }
  return isfinite(*z) ? ED_OK : ED_E_NOT_FINITE;
}
