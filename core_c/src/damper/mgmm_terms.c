#include "damper/mgmm_terms.h"

#include <math.h>

/* Pieces of quadrature: the powers of e by which the integrand may change over one, for 3 points (all together) and for 5 (each of
 * time, u_max and v_max); more by GROW for each power by which it has faded there. */
static const double CHANGE_FEW = 0.1, CHANGE = 1.0, GROW = 0.35;
/* Of a step. The powers of e that a piece may change by grow by 1 + GROW from one to the next, or halve on the way: 250 pieces down to the
 * rounding of a place, for time, and 4800 for a softening by a power as large as a double. Beyond it something is not a number. */
enum { MOST_PIECES = 10000 };

static void add_piece(const ed_mgmm_constants *law, ed_mgmm_sums *sum, const ed_softening_piece *of_u, const ed_softening_piece *of_v,
                      double from, double to, int n, const double *point, const double *weight)
{
  static const double none[2] = {0.0};
  const double h = sum->path.h, length = to - from;
  ed_modulus k = ed_softening_modulus(&law->k_mod, of_u, 0.0, none), c = ed_softening_modulus(&law->c_mod, of_v, 0.0, none);
  double along_u[2] = {0.0}, along_v[2] = {0.0};
  for (int i = 0; i < n; i++) {
    const double s = from + length * point[i], u = ed_path_u(&sum->path, s), v = ed_path_u(&sum->velocity, s);
    for (int j = 0; sum->direction && j < 2; j++) {
      along_u[j] = ed_path_u(&sum->direction[j], s);
      along_v[j] = ed_path_u(&sum->velocity_direction[j], s);
    }
    if (of_u->follow != 0.0)
      k = ed_softening_modulus(&law->k_mod, of_u, u, along_u);
    if (of_v->follow != 0.0)
      c = ed_softening_modulus(&law->c_mod, of_v, v, along_v);
    const double share = weight[i] * length / law->tau * exp((s - h) / law->tau);
    const double stiffness = share * law->relaxing * k.value, damping = share * (law->c1 + c.value);
    sum->value += stiffness * u + damping * v;
    for (int j = 0; sum->direction && j < 2; j++)
      sum->slope[j] += stiffness * along_u[j] + damping * along_v[j] + share * (law->relaxing * k.slope[j] * u + c.slope[j] * v);
  }
}

/* Powers of e by which a softening changes over a piece of the path of its quantity, and has faded at the beginning. */
static double softening_change(const ed_softening *law, const ed_softening_piece *piece, const ed_path *path, double from, double to,
                               double *faded)
{
  const double begin = ed_path_u(path, from);
  *faded = (piece->rest + piece->follow * begin) / law->reference;
  return fabs(piece->follow * (ed_path_u(path, to) - begin)) / law->reference;
}

/* Adds the linear terms between two places if the piece is short enough; 0 if it is not. One that cannot be halved is added in any
 * case: what is in it is nothing. */
static int add_if_short(const ed_mgmm_constants *law, ed_mgmm_sums *sum, const ed_softening_piece *of_u, const ed_softening_piece *of_v,
                        double from, double to, int halved)
{
  const double time = (to - from) / law->tau;
  if (time > CHANGE + GROW * (sum->path.h - to) / law->tau && halved)
    return 0;
  double faded, change = time;
  if (of_u->follow != 0.0) {
    const double softening = softening_change(&law->k_mod, of_u, &sum->path, from, to, &faded);
    if (softening > CHANGE + GROW * faded && halved)
      return 0;
    change += softening;
  }
  if (of_v->follow != 0.0) {
    const double softening = softening_change(&law->c_mod, of_v, &sum->velocity, from, to, &faded);
    if (softening > CHANGE + GROW * faded && halved)
      return 0;
    change += softening;
  }
  const ed_power_rule *rule = &law->power;
  if (change <= CHANGE_FEW)
    add_piece(law, sum, of_u, of_v, from, to, ED_POWER_FEW, rule->few, rule->few_weight);
  else
    add_piece(law, sum, of_u, of_v, from, to, ED_POWER_MANY, rule->many, rule->many_weight);
  return 1;
}

int ed_mgmm_add_softened(const ed_mgmm_constants *law, ed_mgmm_sums *sum, const ed_softening_piece *of_u, const ed_softening_piece *of_v)
{
  const double h = sum->path.h;
  int pieces = 0;
  for (double from = 0.0; from < h;) {
    while (of_u->to <= from) /* the last one ends at h */
      of_u++;
    while (of_v->to <= from)
      of_v++;
    double to = fmin(of_u->to, of_v->to), middle = 0.5 * (from + to);
    while (!add_if_short(law, sum, of_u, of_v, from, to, middle > from && middle < to)) {
      to = middle;
      middle = 0.5 * (from + to);
    }
    if (!(to > from) || ++pieces == MOST_PIECES)
      return 0;
    from = to;
  }
  return 1;
}

int ed_mgmm_still(const double *memory, const ed_path *path)
{
  const double h = path->h, u0 = path->c[0], u1 = ed_path_u(path, h), v0 = path->c[1], v1 = ed_path_v(path, h);
  const double over = 4.0 / 27.0 * h * (fabs(v0) + fabs(v1)), bend = 0.75 * fabs(path->c[3]) * h * h;
  return (v0 > v1 ? v0 : v1) + bend <= memory[ED_LARGEST_V] && (v0 < v1 ? v0 : v1) - bend >= memory[ED_SMALLEST_V] &&
         (u0 > u1 ? u0 : u1) + over <= memory[ED_LARGEST_U] && (u0 < u1 ? u0 : u1) - over >= memory[ED_SMALLEST_U];
}

static double modulus(const ed_softening *law, ed_running extremes)
{
  return law->a * exp(-ed_extremes_mean(extremes) / law->reference) + law->b;
}

void ed_mgmm_remember(const ed_mgmm_constants *law, ed_running of_u, ed_running of_v, double *memory)
{
  memory[ED_LARGEST_U] = of_u.largest;
  memory[ED_SMALLEST_U] = of_u.smallest;
  memory[ED_LARGEST_V] = of_v.largest;
  memory[ED_SMALLEST_V] = of_v.smallest;
  memory[ED_K_MOD] = modulus(&law->k_mod, of_u);
  memory[ED_C_MOD] = modulus(&law->c_mod, of_v);
}
