#include "damper/power_integral.h"

#include "base/power_exp.h"
#include "damper/gauss_jacobi.h"

#include <complex.h>
#include <math.h>
#include <stddef.h>

/* All in x = s/h. v = a + b x + c x^2 has two roots, real or a conjugate pair. |v|^alpha is smooth on pieces well away from both;
 * it is t^alpha times something smooth on pieces that end at one (t: distance from it) and are well away from the other.
 * Where the whole path is slow, the rounding of the power at rest counts. What it takes from the power beside a reversal is a closed
 * form as long as v is a line there; else v (v^2 + rest^2)^((alpha - 1)/2) is smooth on pieces well away from the places where
 * v = +-i rest. */
enum { GATHERED = 24 };
typedef struct {
  const ed_power_rule *rule;
  const ed_path *direction;
  double a, b, c;
  int n_roots;
  double root[2], imaginary[2];
  double h, time; /* time = h / tau */
  double rest;    /* 0: the path is fast */
  int complex_roots; /* the roots are those of v = +-i rest */
  double power;   /* of the base of each place */
  double value, slope[2], chord[2];
  /* Places that are still to be added: the chord of the power, |v|^(alpha - 1), is base^power. */
  int n;
  double x[GATHERED], v[GATHERED], weight[GATHERED], tangent[GATHERED], base[GATHERED], fading[GATHERED];
} sums;

/* Multiples of the speed of rest from which on a path is fast: rounding the power changes its integral by less than 1e-5 of it. */
static const double FAST = 1e4;
/* Likewise of the path and of its extreme, from which on v is a line beside a reversal as far as the rounding reaches. */
static const double STRAIGHT = 100.0;
/* Roots this close to an end of the path are taken to lie there: far below what matters. */
static const double AT_END = 1e-12;
/* Pieces beside two roots close together that are not halved any more: what they hold is too little to matter. */
static const double SHORTEST = 1e-6;
/* Times the last piece, up to which the next one is tried. */
static const double LONGER = 4.0;
/* Pieces of one path. Towards a root they halve, down to SHORTEST, and grow by LONGER behind it: some 30 for each of two roots. Towards
 * the end they shrink by 1 + GROW at least each second time, down to the rounding of a place: 250. Beyond it something is not a number. */
enum { MOST_PIECES = 1000 };
/* A root is well away from a piece if its distances to the two ends add up to so many lengths of the piece: it is then outside an
 * ellipse about the ends, which gives the error of Gauss' rule. For 3 points and for 5. */
static const double WELL_AWAY_FEW = 10.0, WELL_AWAY = 2.5;
/* Length of a piece in relaxation times: at most START + GROW * (time from its end to the end of the path). */
static const double START_FEW = 0.25, START = 1.0, GROW = 0.35;
/* Gauss-Laguerre rule of 8 points (Abramowitz & Stegun, table 25.9) for an end from which all roots are far: so many relaxation times,
 * of which e^-17, 4e-8, is left. Shorter paths than the least need fewer points piece by piece; of ones longer than FORGOTTEN, which
 * those cut at 40 by their law are in spite of rounding, nothing is left of the beginning. */
enum { LAGUERRE = 8 };
static const double FAR_AWAY = 17.0, LAGUERRE_LEAST = 4.0, FORGOTTEN = 39.0;
static const double LAGUERRE_POINT[LAGUERRE] = {0.17027963230510099, 0.90370177679937991, 2.2510866298661307, 4.2667001702876588,
                                                7.0459054023934655,  10.758516010180996,  15.740678641278004, 22.863131736889265};
/* Weight e^point. */
static const double LAGUERRE_WEIGHT[LAGUERRE] = {0.43772341049291136, 1.0338693476655976, 1.6697097656587758, 2.3769247017585995,
                                                 3.2085409133479263,  4.2685755108251318, 5.818083368671922,  8.9062262152922109};

/* Below this power the rule beside a reversal is that of this power: at 0 its first point is the reversal itself, with an infinite
 * weight. What that changes is less than the rounding of a sum of many steps. */
static const double LEAST_POWER = 1e-12;

void ed_power_rule_prepare(ed_power_rule *rule, double alpha, double tau, double rest)
{
  rule->alpha = alpha;
  rule->tau = tau;
  rule->rest = rest;
  ed_gauss_jacobi(ED_POWER_FEW, 0.0, rule->few, rule->few_weight);
  ed_gauss_jacobi(ED_POWER_MANY, 0.0, rule->many, rule->many_weight);
  ed_gauss_jacobi(ED_POWER_MANY, fmax(alpha, LEAST_POWER) - 1.0, rule->turn, rule->turn_weight);
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
  for (int i = 0; !sum->complex_roots && i < sum->n_roots; i++)
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

static void add_gathered(sums *sum)
{
  double share[GATHERED];
  for (int i = sum->n; i % ED_POWER_BLOCK; i++)
    sum->base[i] = 1.0, sum->fading[i] = 0.0;
  ed_power_exp(sum->n, sum->power, sum->base, sum->fading, share);
  for (int i = 0; i < sum->n; i++) {
    share[i] *= sum->weight[i] * sum->time;
    sum->value += share[i] * sum->v[i];
    for (int j = 0; sum->direction && j < 2; j++) {
      const double along = share[i] * ed_path_v(&sum->direction[j], sum->x[i] * sum->h);
      sum->slope[j] += sum->tangent[i] * along;
      sum->chord[j] += along;
    }
  }
  sum->n = 0;
}

/* tangent: over the chord. */
static inline void gather(sums *sum, double x, double v, double weight, double base, double tangent)
{
  const int i = sum->n++;
  sum->x[i] = x;
  sum->v[i] = v;
  sum->weight[i] = weight;
  sum->base[i] = base;
  sum->tangent[i] = tangent;
  sum->fading[i] = -(1.0 - x) * sum->time;
  if (sum->n == GATHERED)
    add_gathered(sum);
}

/* The least speed is far below any that counts and keeps the chord finite at 0. */
static inline double some(const sums *sum, double speed)
{
  const double least = 1e-30 * sum->rule->rest;
  return speed > least ? speed : least;
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
      gather(sum, x, v, length, some(sum, fabs(v)), sum->rule->alpha);
      continue;
    }
    const double rounded = v * v + sum->rest * sum->rest;
    gather(sum, x, v, length, rounded, 1.0 + (sum->rule->alpha - 1.0) * v * v / rounded);
  }
}

/* Takes away what the rounding takes from the power between a reversal and another place, where v is a line: with V = |v| at the other
 * place the integral over v from 0 to V of v^alpha - v (v^2 + rest^2)^((alpha - 1)/2), and that of the derivatives of both, times a line
 * along the path. */
static void round_turn(sums *sum, double turn, double other)
{
  const double alpha = sum->rule->alpha, v = velocity(sum, other), size = fabs(v), steep = fabs(sum->b + 2.0 * turn * sum->c);
  const double share = sum->time * exp(-(1.0 - turn) * sum->time) / steep;
  const double squares = size * size + sum->rest * sum->rest, power = pow(size, alpha), rounded = pow(squares, 0.5 * (alpha + 1.0));
  const double less = (size * power - rounded + pow(sum->rest, alpha + 1.0)) / (alpha + 1.0), last = power - size * rounded / squares;
  const double moment = (other > turn ? size * last - less : less - size * last) / steep;
  sum->value -= copysign(share * less, v);
  for (int j = 0; sum->direction && j < 2; j++) {
    const double s = turn * sum->h, *c = sum->direction[j].c, speeding = sum->h * (2.0 * c[2] + 6.0 * c[3] * s);
    sum->slope[j] -= share * (ed_path_v(&sum->direction[j], s) * last + speeding * moment);
  }
}

/* Between a reversal and another place: |v|^(alpha - 1) = (|v| / t)^(alpha - 1) t^(alpha - 1), the last factor in the rule. */
static void turning_piece(sums *sum, double turn, double other)
{
  const ed_power_rule *rule = sum->rule;
  for (int i = 0; i < ED_POWER_MANY; i++) {
    const double t = rule->turn[i], x = turn + (other - turn) * t, v = velocity(sum, x), speed = some(sum, fabs(v) / t);
    gather(sum, x, v, rule->turn_weight[i] * fabs(other - turn), sum->rest == 0.0 ? speed : speed * speed, rule->alpha);
  }
  if (sum->rest > 0.0)
    round_turn(sum, turn, other);
}

/* Adds the piece if some rule suits it; 0 if none does. One that cannot be halved is added in any case. */
static int add_piece(sums *sum, double from, double to, int halved)
{
  const double time = (to - from) * sum->time, rest = GROW * (1.0 - to) * sum->time;
  const int shortest = to - from < SHORTEST || !halved;
  if (time > START + rest && halved)
    return 0;
  int turn = -1;
  double nearest = 1e300;
  for (int i = 0; i < sum->n_roots; i++) {
    if (turn < 0 && !sum->complex_roots && sum->imaginary[i] == 0.0 && (sum->root[i] == from || sum->root[i] == to))
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

/* Whether all roots are far from an end. */
static int far_from(const sums *sum, double end)
{
  for (int i = 0; i < sum->n_roots; i++)
    if (hypot(sum->root[i] - end, sum->imaginary[i]) * sum->time < FAR_AWAY)
      return 0;
  return 1;
}

/* The integral up to an end as if the path had always been what it is now; share: 1, or -1 to take it away. */
static void add_settled(sums *sum, double end, double share)
{
  for (int i = 0; i < LAGUERRE; i++) {
    const double x = end - LAGUERRE_POINT[i] / sum->time, v = velocity(sum, x);
    gather(sum, x, v, share * LAGUERRE_WEIGHT[i] / sum->time, some(sum, fabs(v)), sum->rule->alpha);
  }
}

/* How many points Gauss' rule needs over a whole path that is short and well away from reversals; 0: it is not. */
static int plain_points(const sums *sum)
{
  enum { MEAN = 3, FAR = 10 };
  const double slow = 2e4 * sum->rule->rest, first = sum->a, last = sum->a + sum->b + sum->c;
  const double both = fabs(first + last), change = fabs(last - first) + 0.5 * fabs(sum->c);
  if (sum->time > 0.5 || both < MEAN * change || both < slow)
    return 0;
  return both >= FAR * change ? ED_POWER_FEW : ED_POWER_MANY;
}

/* Whether v is a line beside its reversals as far as the rounding reaches. */
static int straight(const sums *sum)
{
  const double a = sum->a, b = sum->b, c = sum->c, far = STRAIGHT * sum->rest;
  return fabs(a) + fabs(b) + fabs(c) >= far && fabs(4.0 * a * c - b * b) >= 4.0 * fabs(c) * far;
}

static void add_pieces(sums *sum)
{
  const ed_power_rule *rule = sum->rule;
  if (rule->alpha < 1.0 && fabs(sum->a) + fabs(sum->b) + fabs(sum->c) < FAST * rule->rest) {
    sum->rest = rule->rest;
    sum->power *= 0.5; /* of the square of a speed */
    sum->complex_roots = !straight(sum);
  }
  if (sum->complex_roots)
    find_slow_roots(sum);
  else
    find_roots(sum);
  if (sum->rest == 0.0 && sum->time >= LAGUERRE_LEAST && far_from(sum, 1.0) && (sum->time >= FORGOTTEN || far_from(sum, 0.0))) {
    add_settled(sum, 1.0, 1.0);
    if (sum->time < FORGOTTEN)
      add_settled(sum, 0.0, -1.0);
    return;
  }
  int pieces = 0;
  for (double from = 0.0, longest = 1.0; from < 1.0;) {
    const double end = next_reversal(sum, from);
    double to = end - from > longest ? from + longest : end, middle = 0.5 * (from + to);
    while (!add_piece(sum, from, to, middle > from && middle < to)) {
      to = middle;
      middle = 0.5 * (from + to);
    }
    if (!(to > from) || ++pieces == MOST_PIECES) {
      sum->value = NAN;
      return;
    }
    longest = LONGER * (to - from);
    from = to;
  }
}

/* The struct is set field by field, as clearing its buffers takes as long as a short step. */
static void begin(sums *sum, const ed_power_rule *rule, const ed_path *path, const ed_path *direction)
{
  const double h = path->h;
  sum->rule = rule;
  sum->direction = direction;
  sum->value = sum->slope[0] = sum->slope[1] = sum->chord[0] = sum->chord[1] = 0.0;
  sum->n = 0;
  sum->a = path->c[1], sum->b = 2.0 * path->c[2] * h, sum->c = 3.0 * path->c[3] * h * h;
  sum->h = h, sum->time = h / rule->tau;
  sum->rest = 0.0, sum->complex_roots = 0;
  sum->power = rule->alpha - 1.0;
}

/* The integral over a path that few points suffice for, most of those in a frame: nothing is gathered. */
static double plain_integral(const sums *sum, int n, const double *point, const double *weight, double slope[2], double chord[2])
{
  enum { ROOM = (ED_POWER_MANY + ED_POWER_BLOCK - 1) / ED_POWER_BLOCK * ED_POWER_BLOCK };
  double v[ROOM], base[ROOM] = {0.0}, fading[ROOM] = {0.0}, share[ROOM], value = 0.0, along[2] = {0.0}; /* gcc -O1 sees no filling below */
  for (int i = 0; i < n; i++) {
    v[i] = velocity(sum, point[i]);
    base[i] = fabs(v[i]);
    fading[i] = -(1.0 - point[i]) * sum->time;
  }
  for (int i = n; i % ED_POWER_BLOCK; i++)
    base[i] = 1.0, fading[i] = 0.0;
  ed_power_exp(n, sum->power, base, fading, share);
  for (int i = 0; i < n; i++) {
    share[i] *= weight[i] * sum->time;
    value += share[i] * v[i];
    for (int j = 0; sum->direction && j < 2; j++)
      along[j] += share[i] * ed_path_v(&sum->direction[j], point[i] * sum->h);
  }
  for (int j = 0; sum->direction && j < 2; j++) {
    slope[j] = sum->rule->alpha * along[j];
    chord[j] = along[j];
  }
  return value;
}

double ed_power_integral(const ed_power_rule *rule, const ed_path *path, const ed_path *direction, double slope[2],
                         double chord[2])
{
  sums sum;
  begin(&sum, rule, path, direction);
  const int points = plain_points(&sum);
  if (points == ED_POWER_FEW)
    return plain_integral(&sum, points, rule->few, rule->few_weight, slope, chord);
  if (points == ED_POWER_MANY)
    return plain_integral(&sum, points, rule->many, rule->many_weight, slope, chord);
  add_pieces(&sum);
  add_gathered(&sum);
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
