#include "damper/power_integral.h"

#include "damper/gauss_jacobi.h"

#include <complex.h>
#include <math.h>

/* All in x = s/h. v = a + b x + c x^2 has two roots, real or a conjugate pair. |v|^alpha is smooth on pieces well away from both;
 * it is t^alpha times something smooth on pieces that end at one (t: distance from it) and are well away from the other.
 * Where the whole path is slow, the rounding of the power at rest counts: v (v^2 + rest^2)^((alpha - 1)/2) is smooth on pieces well
 * away from the places where v = +-i rest. */
typedef struct {
  const ed_power_rule *rule;
  const ed_path *direction;
  double a, b, c;
  int n_roots;
  double root[2], imaginary[2];
  double h, time; /* time = h / tau */
  double rest;    /* 0: the path is fast */
  double value, slope[2], chord[2];
} sums;

/* Multiples of the speed of rest from which on a path is fast: rounding the power changes its integral by less than 1e-5 of it. */
static const double FAST = 1e4;
/* Roots this close to an end of the path are taken to lie there: far below what matters. */
static const double AT_END = 1e-12;
/* Pieces beside two roots close together that are not halved any more: what they hold is too little to matter. */
static const double SHORTEST = 1e-10;
/* A root is well away from a piece if its distances to the two ends add up to so many lengths of the piece: it is then outside an
 * ellipse about the ends, which gives the error of Gauss' rule. For 3 points and for 5. */
static const double WELL_AWAY_FEW = 10.0, WELL_AWAY = 2.5;
/* Length of a piece in relaxation times: at most START + GROW * (time from its end to the end of the path). */
static const double START_FEW = 0.25, START = 1.0, GROW = 0.35;

void ed_power_rule_prepare(ed_power_rule *rule, double alpha, double tau, double rest)
{
  rule->alpha = alpha;
  rule->tau = tau;
  rule->rest = rest;
  ed_gauss_jacobi(ED_POWER_FEW, 0.0, rule->few, rule->few_weight);
  ed_gauss_jacobi(ED_POWER_MANY, 0.0, rule->many, rule->many_weight);
  ed_gauss_jacobi(ED_POWER_MANY, alpha - 1.0, rule->turn, rule->turn_weight);
}

static double snapped(double root)
{
  return fabs(root) <= AT_END ? 0.0 : fabs(root - 1.0) <= AT_END ? 1.0 : root;
}

static void find_roots(sums *sum)
{
  const double a = sum->a, b = sum->b, c = sum->c;
  sum->n_roots = 0;
  sum->imaginary[0] = sum->imaginary[1] = 0.0;
  if (fabs(c) <= 1e-14 * (fabs(a) + fabs(b))) {
    if (b != 0.0)
      sum->root[sum->n_roots++] = snapped(-a / b);
    return;
  }
  sum->n_roots = 2;
  const double discriminant = b * b - 4.0 * a * c;
  if (discriminant < 0.0) {
    sum->root[0] = sum->root[1] = -0.5 * b / c;
    sum->imaginary[0] = sum->imaginary[1] = 0.5 * sqrt(-discriminant) / fabs(c);
  } else {
    const double q = -0.5 * (b + copysign(sqrt(discriminant), b)), first = q / c, second = q != 0.0 ? a / q : 0.0;
    sum->root[0] = snapped(fmin(first, second));
    sum->root[1] = snapped(fmax(first, second));
  }
}

/* Of v = i rest, rest > 0; those of v = -i rest are their conjugates. */
static void find_slow_roots(sums *sum)
{
  const double a = sum->a, b = sum->b, c = sum->c;
  double complex root[2];
  sum->n_roots = 0;
  if (fabs(c) <= 1e-14 * (fabs(a) + fabs(b) + sum->rest)) {
    if (fabs(b) > 1e-14 * (fabs(a) + sum->rest))
      root[sum->n_roots++] = (-a + I * sum->rest) / b;
  } else {
    const double complex square = csqrt(b * b - 4.0 * c * (a - I * sum->rest));
    root[0] = 0.5 * (-b + square) / c;
    root[1] = 0.5 * (-b - square) / c;
    sum->n_roots = 2;
  }
  for (int i = 0; i < sum->n_roots; i++) {
    sum->root[i] = creal(root[i]);
    sum->imaginary[i] = fabs(cimag(root[i]));
  }
}

/* The end of the longest piece from `from` on that the path allows: the next reversal, or the end. */
static double next_reversal(const sums *sum, double from)
{
  for (int i = 0; sum->rest == 0.0 && i < sum->n_roots; i++)
    if (sum->imaginary[i] == 0.0 && sum->root[i] > from && sum->root[i] < 1.0)
      return sum->root[i];
  return 1.0;
}

/* Sum of the distances of a root to the ends of a piece, over the length of the piece. */
static double distance(const sums *sum, int root, double from, double to)
{
  const double left = sum->root[root] - from, right = sum->root[root] - to, y = sum->imaginary[root];
  const double both = y == 0.0 ? fabs(left) + fabs(right) : sqrt(left * left + y * y) + sqrt(right * right + y * y);
  return both / (to - from);
}

/* Adds the value at x, given the chord of the power, |v|^(alpha - 1), times the weight, and tangent / chord. */
static inline void add(sums *sum, double x, double v, double weight, double tangent)
{
  const double share = weight * exp(-(1.0 - x) * sum->time) * sum->time;
  sum->value += share * v;
  for (int j = 0; sum->direction && j < 2; j++) {
    const double along = share * ed_path_v(&sum->direction[j], x * sum->h);
    sum->slope[j] += tangent * along;
    sum->chord[j] += along;
  }
}

/* |v|^(alpha - 1); the least speed is far below any that counts and keeps it finite at 0. */
static inline double power_of(const sums *sum, double speed)
{
  return pow(fmax(speed, 1e-30 * sum->rule->rest), sum->rule->alpha - 1.0);
}

static inline double velocity(const sums *sum, double x)
{
  return sum->a + x * (sum->b + x * sum->c);
}

static void regular_piece(sums *sum, double from, double to, int n, const double *point, const double *weight)
{
  for (int i = 0; i < n; i++) {
    const double x = from + (to - from) * point[i], v = velocity(sum, x), length = weight[i] * (to - from);
    if (sum->rest == 0.0) {
      add(sum, x, v, length * power_of(sum, fabs(v)), sum->rule->alpha);
      continue;
    }
    const double rounded = v * v + sum->rest * sum->rest;
    add(sum, x, v, length * pow(rounded, 0.5 * (sum->rule->alpha - 1.0)), 1.0 + (sum->rule->alpha - 1.0) * v * v / rounded);
  }
}

/* Between a reversal and another place: |v|^(alpha - 1) = (|v| / t)^(alpha - 1) t^(alpha - 1), the last factor in the rule. */
static void turning_piece(sums *sum, double turn, double other)
{
  const ed_power_rule *rule = sum->rule;
  for (int i = 0; i < ED_POWER_MANY; i++) {
    const double t = rule->turn[i], x = turn + (other - turn) * t, v = velocity(sum, x);
    add(sum, x, v, rule->turn_weight[i] * fabs(other - turn) * power_of(sum, fabs(v) / t), rule->alpha);
  }
}

/* Adds the piece if some rule suits it; 0 if none does. */
static int add_piece(sums *sum, double from, double to)
{
  const double time = (to - from) * sum->time, rest = GROW * (1.0 - to) * sum->time;
  const int shortest = to - from < SHORTEST;
  if (time > START + rest)
    return 0;
  int turn = -1;
  double nearest = 1e300;
  for (int i = 0; i < sum->n_roots; i++) {
    if (turn < 0 && sum->imaginary[i] == 0.0 && (sum->root[i] == from || sum->root[i] == to))
      turn = i;
    else
      nearest = fmin(nearest, distance(sum, i, from, to));
  }
  if (nearest < WELL_AWAY && !shortest)
    return 0;
  const ed_power_rule *rule = sum->rule;
  if (turn >= 0)
    turning_piece(sum, sum->root[turn], sum->root[turn] == from ? to : from);
  else if (nearest >= WELL_AWAY_FEW && time <= START_FEW)
    regular_piece(sum, from, to, ED_POWER_FEW, rule->few, rule->few_weight);
  else
    regular_piece(sum, from, to, ED_POWER_MANY, rule->many, rule->many_weight);
  return 1;
}

double ed_power_integral(const ed_power_rule *rule, const ed_path *path, const ed_path *direction, double slope[2],
                         double chord[2])
{
  const double h = path->h;
  sums sum = {.rule = rule, .direction = direction, .a = path->c[1], .b = 2.0 * path->c[2] * h, .c = 3.0 * path->c[3] * h * h,
              .h = h, .time = h / rule->tau};
  if (rule->alpha < 1.0 && fabs(sum.a) + fabs(sum.b) + fabs(sum.c) < FAST * rule->rest) {
    sum.rest = rule->rest;
    find_slow_roots(&sum);
  } else
    find_roots(&sum);
  for (double from = 0.0; from < 1.0;) {
    double to = next_reversal(&sum, from);
    while (!add_piece(&sum, from, to))
      to = 0.5 * (from + to);
    from = to;
  }
  for (int j = 0; direction && j < 2; j++) {
    slope[j] = sum.slope[j];
    chord[j] = sum.chord[j];
  }
  return sum.value;
}

double ed_power_now(const ed_power_rule *rule, double v, double *slope)
{
  const double rest = rule->alpha < 1.0 ? rule->rest : 0.0, rounded = v * v + rest * rest;
  const double chord = rounded > 0.0 ? pow(rounded, 0.5 * (rule->alpha - 1.0)) : 0.0;
  *slope = rounded > 0.0 ? chord * (1.0 + (rule->alpha - 1.0) * v * v / rounded) : rule->alpha == 1.0 ? 1.0 : 0.0;
  return chord * v;
}
