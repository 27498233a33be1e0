/* Utilisation of steel members by EN 1993-1-1 and EN 1998-1: combinations x members x stations x checks in one pass.
 *
 * Most combinations cannot govern a member. From the largest force of each case along the member follows an upper bound of every
 * utilisation of a combination; combinations are evaluated exactly, in the order that the bounds suggest, until no bound of those
 * that are left reaches what was found. Bounds count with every force at its largest place and with the worst exponent, so the
 * shortcut changes no result. Combinations with the same factors (directions have no sign) are evaluated once. */
#include "base/clones.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N, V_Y, V_Z, T, M_Y, M_Z, FORCES };
enum { KIND_SHAPE = 3 };

/* Above rounding of the sums from which bounds and results come: some tens of operations of 1.1e-16 each. */
static const double ROUNDING = 1e-13;

typedef struct {
  int cases, directions, members, stations, combinations, sets;
  const double *statics, *spectral; /* cases, directions x members x stations x FORCES */
  const double *f, *g;              /* combinations x cases, directions */
  const int *set, *gravity;
} loads;

typedef struct {
  const double *c;             /* constants, ED_N_RD ... */
  double per[ED_N_CONSTANTS];  /* 1 / c of resistances */
  int shape, elastic, twists;
} member;

typedef struct {
  double utilisation[ED_N_CHECKS];
  int combination[ED_N_CHECKS], station[ED_N_CHECKS];
} worst;

static inline double larger(double a, double b)
{
  return a > b ? a : b;
}

static inline double smaller(double a, double b)
{
  return a < b ? a : b;
}

/* load / resistance, where a resistance that is used up carries nothing; both are computed, so that loops have no branches */
static inline double ratio(double load, double resistance)
{
  const double quotient = load / resistance, without = load > 0.0 ? HUGE_VAL : 0.0;
  return resistance > 0.0 ? quotient : without;
}

/* 6.2.8(3) */
static inline double shear_reduction(double v)
{
  const double over = 2.0 * v - 1.0;
  return v > 0.5 ? smaller(over * over, 1.0) : 0.0;
}

/* ---- a section under N, V and M, 6.2.8 to 6.2.10 ---------------------------------------------------------------- */

typedef struct {
  double m_y, m_z;             /* M / M_V,Rd */
  double n_scale, n_web_scale; /* N / N_V,Rd = N n_scale; N / half of the web's = N n_web_scale */
} sheared;

static inline sheared with_shear(const member *b, double v_y, double v_z, double M_y, double M_z)
{
  const double *c = b->c, y = shear_reduction(v_y), z = shear_reduction(v_z);
  const double N_V = c[ED_N_RD] - sqrt(3.0) * (y * c[ED_V_Y_RD] + z * c[ED_V_Z_RD]);
  return (sheared){ratio(M_y, c[ED_M_Y_RD] - z * c[ED_M_Y_SHEAR]), ratio(M_z, (1.0 - y) * c[ED_M_Z_RD]), ratio(1.0, N_V),
                   ratio(1.0, 0.5 * (1.0 - z) * c[ED_N_WEB])};
}

/* The same without shear above half of the resistance. */
static inline sheared without_shear(const member *b, double M_y, double M_z)
{
  return (sheared){M_y * b->per[ED_M_Y_RD], M_z * b->per[ED_M_Z_RD], b->per[ED_N_RD], 2.0 * b->per[ED_N_WEB]};
}

/* M_N,Rd / M_Rd, 6.2.9.1(4) and (5); N_ratio: N / half of the web's N, n < 1 */
static inline void with_axial_force(const member *b, double n, double N_ratio, double *y, double *z)
{
  const double *c = b->c, left = 1.0 - n;
  if (b->shape == ED_CHS) {
    *y = *z = 1.0 - pow(n, 1.7);
    return;
  }
  *y = smaller(left / (1.0 - 0.5 * c[ED_WEB_SHARE_Y]), 1.0);
  if (b->shape == ED_RHS) {
    *z = smaller(left / (1.0 - 0.5 * c[ED_WEB_SHARE_Z]), 1.0);
    return;
  }
  if (n <= 0.25 && N_ratio <= 1.0)
    *y = 1.0;
  const double beyond = (n - c[ED_WEB_SHARE_Z]) / (1.0 - c[ED_WEB_SHARE_Z]);
  *z = n <= c[ED_WEB_SHARE_Z] ? 1.0 : 1.0 - beyond * beyond;
}

/* 6.2.9.1(2) and (6), 6.2.1(7), 6.2.9.2; any value below `found` may be returned for one below it */
static inline double section(const member *b, const sheared *s, double N_Ed, double found)
{
  const double n = N_Ed > 0.0 ? N_Ed * s->n_scale : 0.0;
  const double linear = n + s->m_y + s->m_z;
  if (b->elastic || !(n < 1.0) || linear < found) /* the last: the result would be less still */
    return linear;
  double y, z;
  with_axial_force(b, n, N_Ed * s->n_web_scale, &y, &z);
  if ((s->m_y > 0.0 && !(y > 0.0)) || (s->m_z > 0.0 && !(z > 0.0)))
    return linear;
  const double r_y = s->m_y > 0.0 ? s->m_y / y : 0.0, r_z = s->m_z > 0.0 ? s->m_z / z : 0.0;
  const double single = larger(r_y, r_z);
  if (single >= linear)
    return linear;
  double both;
  if (b->shape == ED_RHS) {
    const double below = 1.0 - 1.13 * n * n, power = below > 0.0 ? smaller(1.66 / below, 6.0) : 6.0;
    both = pow(r_y, power) + pow(r_z, power);
  } else {
    const double beta = b->shape == ED_CHS ? 2.0 : larger(5.0 * n, 1.0);
    both = r_y * r_y + (beta == 1.0 ? r_z : beta == 2.0 ? r_z * r_z : pow(r_z, beta));
  }
  return smaller(larger(single, both), linear);
}

/* Not less than `section` for any smaller forces; `shape` is constant where it is inlined, and nothing branches. Exponents of ratios
 * up to 1 are at least 2 and 1 (I), 2 (CHS), 1.66 (RHS, taken as 1.5); n^1.7 is not more than n^1.5. */
static inline __attribute__((always_inline)) double section_bound(const member *b, int shape, const sheared *s, double N_Ed)
{
  const double *c = b->c, scaled = N_Ed * s->n_scale, n = N_Ed > 0.0 ? scaled : 0.0, left = 1.0 - n;
  const double linear = n + s->m_y + s->m_z;
  double y, z;
  if (shape == ED_CHS) {
    y = z = 1.0 - n * sqrt(n);
  } else if (shape == ED_RHS) {
    y = smaller(left / (1.0 - 0.5 * c[ED_WEB_SHARE_Y]), 1.0);
    z = smaller(left / (1.0 - 0.5 * c[ED_WEB_SHARE_Z]), 1.0);
  } else {
    const double line = smaller(left / (1.0 - 0.5 * c[ED_WEB_SHARE_Y]), 1.0);
    y = larger(4.0 * n, N_Ed * s->n_web_scale) <= 1.0 ? 1.0 : line;
    const double beyond = larger(n - c[ED_WEB_SHARE_Z], 0.0) / (1.0 - c[ED_WEB_SHARE_Z]);
    z = 1.0 - beyond * beyond;
  }
  const double r_y = ratio(s->m_y, y), r_z = ratio(s->m_z, z), single = larger(r_y, r_z);
  const double both = shape == ED_I     ? r_y * r_y + r_z
                      : shape == ED_CHS ? r_y * r_y + r_z * r_z
                                        : r_y * sqrt(r_y) + r_z * sqrt(r_z);
  const double plastic = smaller(larger(single, both), linear);
  return larger(n, single) < 1.0 ? plastic : linear;
}

/* ---- a member in bending and compression, 6.3.3, Annex B -------------------------------------------------------- */

typedef struct {
  double yy, yz, zy, zz;
} factors;

static inline factors annex_b(const member *b, double n_y, double n_z)
{
  const double *c = b->c, l_y = c[ED_LAMBDA_Y], l_z = c[ED_LAMBDA_Z], wide = c[ED_C_MLT] - 0.25;
  factors k;
  if (b->elastic) {
    k.yy = c[ED_C_MY] * (1.0 + 0.6 * smaller(l_y, 1.0) * n_y);
    k.zz = c[ED_C_MZ] * (1.0 + 0.6 * smaller(l_z, 1.0) * n_z);
    k.yz = k.zz;
    k.zy = b->twists ? 1.0 - 0.05 * smaller(l_z, 1.0) / wide * n_z : 0.8 * k.yy;
    return k;
  }
  k.yy = c[ED_C_MY] * (1.0 + smaller(l_y - 0.2, 0.8) * n_y);
  k.zz = c[ED_C_MZ] * (1.0 + (b->shape == ED_I ? smaller(2.0 * l_z - 0.6, 1.4) : smaller(l_z - 0.2, 0.8)) * n_z);
  k.yz = 0.6 * k.zz;
  k.zy = 0.6 * k.yy;
  if (b->twists) {
    const double table = 1.0 - 0.1 * smaller(l_z, 1.0) / wide * n_z;
    k.zy = l_z < 0.4 ? smaller(0.6 + l_z, table) : table;
  }
  return k;
}

typedef struct {
  int n;          /* distinct combinations */
  int *of;        /* n: their numbers, the first of equal ones */
  double *factor; /* (cases + directions) x n: magnitudes */
  double *force;  /* (FORCES + 1) x n: bounds of N ... M_z, and of V_z by gravity in place FORCES */
  double *bound;  /* ED_N_CHECKS x n */
  double *top;    /* (cases + directions) x FORCES */
  double *steady, *swing, *gravity; /* stations x FORCES twice, stations */
  int *mask;      /* n: of the member */
  int *open;      /* n: whether a combination may govern a check */
} workspace;

/* ---- exact evaluation of one combination ------------------------------------------------------------------------ */

static inline void keep(worst *w, int check, double value, int combination, int station)
{
  if (value > w->utilisation[check] || (value == w->utilisation[check] && value >= 0.0 && combination < w->combination[check]))
    w->utilisation[check] = value, w->combination[check] = combination, w->station[check] = station;
}

#define HAS(check) (mask >> (check) & 1)

/* Forces of one combination at all stations: the steady part with its sign, what swings without, V_z by gravity. */
static inline __attribute__((always_inline)) void combine(const loads *l, int at, int k, const workspace *space)
{
  const double *f = l->f + (size_t)k * l->cases, *g = l->g + (size_t)k * l->directions;
  const int row = l->stations * FORCES;
  const size_t all = (size_t)row * l->members, own = (size_t)row * at;
  double *restrict steady = space->steady, *restrict swing = space->swing, *restrict gravity = space->gravity;
  for (int j = 0; j < row; j++)
    steady[j] = swing[j] = 0.0;
  for (int s = 0; s < l->stations; s++)
    gravity[s] = 0.0;
  for (int i = 0; i < l->cases; i++) {
    const double *restrict of = l->statics + i * all + own;
    const double factor = f[i];
    for (int j = 0; j < row; j++)
      steady[j] += factor * of[j];
    for (int s = 0; s < l->stations && l->gravity[i]; s++)
      gravity[s] += factor * of[s * FORCES + V_Z];
  }
  for (int i = 0; i < l->directions; i++) {
    const double *restrict of = l->spectral + i * all + own;
    const double factor = fabs(g[i]);
    for (int j = 0; j < row; j++)
      swing[j] += factor * of[j];
  }
}

typedef struct {
  double value;
  int station;
} peak;

static inline void climb(peak *p, double value, int station)
{
  if (value > p->value)
    p->value = value, p->station = station;
}

ED_CLONES static void evaluate(const loads *l, const member *b, int at, int k, int mask, const workspace *space, worst *w)
{
  enum { COMPRESSION = FORCES, GRAVITY, PEAKS };
  const double *c = b->c, *per = b->per;
  peak top[PEAKS] = {{0.0, 0}};
  combine(l, at, k, space);
  for (int s = 0; s < l->stations; s++) {
    const double *steady = space->steady + s * FORCES, *swing = space->swing + s * FORCES;
    for (int j = 0; j < FORCES; j++)
      climb(&top[j], fabs(steady[j]) + swing[j], s);
    climb(&top[COMPRESSION], swing[N] - steady[N], s);
    climb(&top[GRAVITY], fabs(space->gravity[s]), s);
  }
  const double v_y = top[V_Y].value * per[ED_V_Y_RD], v_z = top[V_Z].value * per[ED_V_Z_RD];
  const int shears = v_y > 0.5 || v_z > 0.5;
  for (int s = 0; s < l->stations && (HAS(ED_CHECK_N_M) || (shears && mask & (1 << ED_CHECK_M_Y | 1 << ED_CHECK_M_Z))); s++) {
    const double *steady = space->steady + s * FORCES, *swing = space->swing + s * FORCES;
    double F[FORCES];
    for (int j = 0; j < FORCES; j++)
      F[j] = fabs(steady[j]) + swing[j];
    const sheared m = shears ? with_shear(b, F[V_Y] * per[ED_V_Y_RD], F[V_Z] * per[ED_V_Z_RD], F[M_Y], F[M_Z])
                             : without_shear(b, F[M_Y], F[M_Z]);
    if (shears && HAS(ED_CHECK_M_Y))
      keep(w, ED_CHECK_M_Y, m.m_y, k, s);
    if (shears && HAS(ED_CHECK_M_Z))
      keep(w, ED_CHECK_M_Z, m.m_z, k, s);
    if (HAS(ED_CHECK_N_M)) {
      keep(w, ED_CHECK_N_M, section(b, &m, F[N], w->utilisation[ED_CHECK_N_M]), k, s);
      if (swing[N] > 0.0 && m.m_z > 0.0) { /* the other sign: a larger N may raise the exponent of m_z */
        const double other = fabs(fabs(steady[N]) - swing[N]);
        keep(w, ED_CHECK_N_M, section(b, &m, other, w->utilisation[ED_CHECK_N_M]), k, s);
      }
    }
  }
  const double n_y = top[COMPRESSION].value * per[ED_N_B_Y], n_z = top[COMPRESSION].value * per[ED_N_B_Z];
  const double m_y = top[M_Y].value * per[ED_M_B], m_z = top[M_Z].value * per[ED_M_Z_RK];
  const factors a = annex_b(b, n_y, n_z);
  const peak result[ED_N_CHECKS] = {
    [ED_CHECK_N] = {top[N].value * per[ED_N_RD], top[N].station},
    [ED_CHECK_V_Y] = {v_y, top[V_Y].station},
    [ED_CHECK_V_Z] = {v_z, top[V_Z].station},
    [ED_CHECK_M_Y] = {shears ? -1.0 : top[M_Y].value * per[ED_M_Y_RD], top[M_Y].station},
    [ED_CHECK_M_Z] = {shears ? -1.0 : top[M_Z].value * per[ED_M_Z_RD], top[M_Z].station},
    [ED_CHECK_N_M] = {-1.0, 0},
    [ED_CHECK_N_B] = {larger(n_y, n_z), top[COMPRESSION].station},
    [ED_CHECK_M_B] = {m_y, top[M_Y].station},
    [ED_CHECK_6_61] = {n_y + a.yy * m_y + a.yz * m_z, top[M_Y].station},
    [ED_CHECK_6_62] = {n_z + a.zy * m_y + a.zz * m_z, top[M_Y].station},
    [ED_CHECK_BEAM_M] = {top[M_Y].value * per[ED_M_Y_RD], top[M_Y].station},
    [ED_CHECK_BEAM_N] = {top[N].value * per[ED_N_RD] / 0.15, top[N].station},
    [ED_CHECK_BEAM_V] = {(top[GRAVITY].value + c[ED_V_M]) * per[ED_V_Z_RD] / 0.5, top[GRAVITY].station},
    [ED_CHECK_COLUMN_V] = {larger(v_y, v_z) / 0.5, v_y > v_z ? top[V_Y].station : top[V_Z].station},
  };
  for (int i = 0; i < ED_N_CHECKS; i++)
    if (HAS(i))
      keep(w, i, result[i].value, k, result[i].station);
}

/* ---- bounds of all combinations of one member ------------------------------------------------------------------- */

/* Largest magnitude along the member of each force of each case and direction: (cases + directions) x FORCES. */
static void largest(const loads *l, int at, double *top)
{
  const size_t row = (size_t)l->stations * FORCES, all = row * l->members, own = row * at;
  for (int i = 0; i < l->cases + l->directions; i++, top += FORCES) {
    const double *of = (i < l->cases ? l->statics + i * all : l->spectral + (i - l->cases) * all) + own;
    for (int j = 0; j < FORCES; j++)
      top[j] = 0.0;
    for (int s = 0; s < l->stations; s++, of += FORCES)
      for (int j = 0; j < FORCES; j++)
        top[j] = larger(top[j], fabs(of[j]));
  }
}

ED_CLONES static void force_bounds(const loads *l, const workspace *w)
{
  const int n = w->n;
  memset(w->force, 0, sizeof *w->force * (FORCES + 1) * n);
  for (int i = 0; i < l->cases + l->directions; i++)
    for (int j = 0; j <= FORCES; j++) {
      if (j == FORCES && !(i < l->cases && l->gravity[i]))
        continue;
      const double top = w->top[i * FORCES + (j < FORCES ? j : V_Z)];
      const double *restrict factor = w->factor + (size_t)i * n;
      double *restrict force = w->force + (size_t)j * n;
      if (top > 0.0 && j != T)
        for (int k = 0; k < n; k++)
          force[k] += factor[k] * top;
    }
}

static inline __attribute__((always_inline)) void fill_bounds(const member *b, int shape, const workspace *w)
{
  const int n = w->n;
  const size_t row = n;
  const double *restrict N_Ed = w->force + N * row, *restrict V_G = w->force + FORCES * row;
  const double *restrict V_y = w->force + V_Y * row, *restrict V_z = w->force + V_Z * row;
  const double *restrict M_y = w->force + M_Y * row, *restrict M_z = w->force + M_Z * row;
  const member own = *b;
  const double *c = own.c, *per = own.per, plastic = own.elastic ? 0.0 : 1.0;
  /* factors of Annex B are linear in the compression, and the largest at one of its ends: none, or a unit of n */
  const factors none = annex_b(&own, 0.0, 0.0), unit = annex_b(&own, 1.0, 1.0);
  const double yy = larger(unit.yy - none.yy, 0.0), zz = larger(unit.zz - none.zz, 0.0), yz = none.yz / none.zz;
  const double zy = own.twists ? 0.0 : none.zy / none.yy, zy_none = own.twists ? none.zy : 0.0;
  double *restrict u = w->bound;
  for (int k = 0; k < n; k++) {
    const double n_y = N_Ed[k] * per[ED_N_B_Y], n_z = N_Ed[k] * per[ED_N_B_Z];
    const double m_y = M_y[k] * per[ED_M_B], m_z = M_z[k] * per[ED_M_Z_RK];
    const double k_yy = none.yy + yy * n_y, k_zz = none.zz + zz * n_z;
    u[ED_CHECK_N * row + k] = N_Ed[k] * per[ED_N_RD];
    u[ED_CHECK_V_Y * row + k] = V_y[k] * per[ED_V_Y_RD];
    u[ED_CHECK_V_Z * row + k] = V_z[k] * per[ED_V_Z_RD];
    u[ED_CHECK_N_B * row + k] = larger(n_y, n_z);
    u[ED_CHECK_M_B * row + k] = m_y;
    u[ED_CHECK_6_61 * row + k] = n_y + k_yy * m_y + yz * k_zz * m_z;
    u[ED_CHECK_6_62 * row + k] = n_z + (zy_none + zy * k_yy) * m_y + k_zz * m_z;
    u[ED_CHECK_BEAM_M * row + k] = M_y[k] * per[ED_M_Y_RD];
    u[ED_CHECK_BEAM_N * row + k] = N_Ed[k] * per[ED_N_RD] / 0.15;
    u[ED_CHECK_BEAM_V * row + k] = (V_G[k] + c[ED_V_M]) * per[ED_V_Z_RD] / 0.5;
    u[ED_CHECK_COLUMN_V * row + k] = larger(V_y[k] * per[ED_V_Y_RD], V_z[k] * per[ED_V_Z_RD]) / 0.5;
  }
  for (int k = 0; k < n; k++) {
    const sheared m = with_shear(&own, V_y[k] * per[ED_V_Y_RD], V_z[k] * per[ED_V_Z_RD], M_y[k], M_z[k]);
    const double linear = N_Ed[k] * m.n_scale + m.m_y + m.m_z, curved = section_bound(&own, shape, &m, N_Ed[k]);
    u[ED_CHECK_M_Y * row + k] = m.m_y;
    u[ED_CHECK_M_Z * row + k] = m.m_z;
    u[ED_CHECK_N_M * row + k] = plastic > 0.0 ? curved : linear;
  }
}

ED_CLONES static void check_bounds(const member *b, const workspace *w)
{
  if (b->shape == ED_I)
    fill_bounds(b, ED_I, w);
  else if (b->shape == ED_RHS)
    fill_bounds(b, ED_RHS, w);
  else
    fill_bounds(b, ED_CHS, w);
}

/* Whether a combination may still govern one of its checks. */
static int may_govern(const workspace *w, int k, const worst *found)
{
  const int mask = w->mask[k];
  for (int i = 0; i < ED_N_CHECKS; i++)
    if (HAS(i) && !(w->bound[(size_t)i * w->n + k] * (1.0 + ROUNDING) < found->utilisation[i]))
      return 1;
  return 0;
}

/* The same of all combinations. */
ED_CLONES static void find_open(const workspace *w, const worst *found)
{
  const int n = w->n, *restrict mask = w->mask;
  int *restrict open = w->open;
  memset(open, 0, sizeof *open * n);
  for (int i = 0; i < ED_N_CHECKS; i++) {
    const double *restrict bound = w->bound + (size_t)i * n;
    const double best = found->utilisation[i];
    for (int k = 0; k < n; k++)
      open[k] |= (bound[k] * (1.0 + ROUNDING) < best ? 0 : 1) & mask[k] >> i;
  }
}

/* `found`: of the member before, whose governing combinations are a good guess; then of this one. */
static void check_member(const loads *l, const member *b, int at, const int *masks, workspace *w, int every, worst *found)
{
  const int n = w->n;
  const worst before = *found;
  for (int i = 0; i < ED_N_CHECKS; i++)
    found->utilisation[i] = -1.0, found->combination[i] = found->station[i] = -1;
  for (int k = 0; k < n; k++)
    w->mask[k] = masks[l->set[w->of[k]]], w->open[k] = w->mask[k] != 0;
  if (!every) {
    largest(l, at, w->top);
    force_bounds(l, w);
    check_bounds(b, w);
    for (int i = 0; i < ED_N_CHECKS; i++) {
      int seen = before.combination[i] < 0;
      for (int j = 0; j < i && !seen; j++)
        seen = before.combination[j] == before.combination[i];
      if (!seen)
        evaluate(l, b, at, before.combination[i], masks[l->set[before.combination[i]]], w, found);
    }
    find_open(w, found);
  }
  for (int k = 0; k < n; k++)
    if (w->open[k] && (every || may_govern(w, k, found)))
      evaluate(l, b, at, w->of[k], w->mask[k], w, found);
}

/* ---- the call --------------------------------------------------------------------------------------------------- */

/* The first of every group of combinations with the same set and factors, directions without sign. */
static int distinct(const loads *l, int *of)
{
  int n = 0;
  for (int k = 0; k < l->combinations; k++) {
    int same = 0;
    for (int i = 0; i < n && !same; i++) {
      same = l->set[of[i]] == l->set[k];
      for (int j = 0; same && j < l->cases; j++)
        same = l->f[(size_t)of[i] * l->cases + j] == l->f[(size_t)k * l->cases + j];
      for (int j = 0; same && j < l->directions; j++)
        same = fabs(l->g[(size_t)of[i] * l->directions + j]) == fabs(l->g[(size_t)k * l->directions + j]);
    }
    if (!same)
      of[n++] = k;
  }
  return n;
}

/* Whether all are finite; *least: the least of them, or 0. Eight lanes, so that the compiler can run them side by side. */
ED_CLONES static int without_nan_or_infinity(size_t n, const double *x, double *least)
{
  double sum[8] = {0.0}, low[8] = {0.0}, all = 0.0;
  for (size_t i = 0; i < n; i++) {
    sum[i & 7] += 0.0 * x[i];
    low[i & 7] = smaller(low[i & 7], x[i]);
  }
  *least = 0.0;
  for (int i = 0; i < 8; i++)
    all += sum[i], *least = smaller(*least, low[i]);
  return all == 0.0;
}

static int valid_members(int members, const double *constants, const int *kind)
{
  for (int i = 0; i < members; i++) {
    const double *c = constants + (size_t)i * ED_N_CONSTANTS;
    static const int positive[] = {ED_N_RD,  ED_V_Y_RD, ED_V_Z_RD, ED_M_Y_RD, ED_M_Z_RD,  ED_N_B_Y,
                                   ED_N_B_Z, ED_M_B,    ED_M_Z_RK, ED_C_MY,   ED_C_MZ,    ED_C_MLT};
    for (size_t j = 0; j < sizeof positive / sizeof *positive; j++)
      if (!(c[positive[j]] > 0.0))
        return 0;
    if (!(c[ED_C_MLT] > 0.25) || !(c[ED_M_Y_SHEAR] >= 0.0 && c[ED_M_Y_SHEAR] <= c[ED_M_Y_RD]) || !(c[ED_N_WEB] >= 0.0) ||
        !(c[ED_WEB_SHARE_Y] >= 0.0 && c[ED_WEB_SHARE_Y] <= 0.5) || !(c[ED_WEB_SHARE_Z] >= 0.0 && c[ED_WEB_SHARE_Z] <= 0.5) || !(c[ED_LAMBDA_Y] >= 0.0) ||
        !(c[ED_LAMBDA_Z] >= 0.0) || !(c[ED_V_M] >= 0.0))
      return 0;
    if (kind[i] < 0 || kind[i] > (KIND_SHAPE | ED_CLASS_3 | ED_NO_TWIST) || (kind[i] & KIND_SHAPE) > ED_CHS)
      return 0;
  }
  return 1;
}

static int all_finite(const loads *l, const double *constants, double *least_response)
{
  const size_t n = (size_t)l->members * l->stations * FORCES;
  double any;
  return without_nan_or_infinity(n * l->cases, l->statics, &any) &&
         without_nan_or_infinity((size_t)l->combinations * l->cases, l->f, &any) &&
         without_nan_or_infinity((size_t)l->combinations * l->directions, l->g, &any) &&
         without_nan_or_infinity((size_t)l->members * ED_N_CONSTANTS, constants, &any) &&
         without_nan_or_infinity(n * l->directions, l->spectral, least_response);
}

int ed_member_checks(int n_cases, int n_directions, int n_members, int n_stations, int n_combinations, int n_sets,
                     const double *statics, const double *spectral, const double *static_factors,
                     const double *spectral_factors, const int *set, const int *gravity, const double *constants,
                     const int *kind, const int *masks, int every, double *utilisation, int *combination, int *station)
{
  if (n_cases < 0 || n_directions < 0 || n_members < 0 || n_stations < 1 || n_combinations < 0 || n_sets < 1 ||
      n_cases + n_directions > ED_MAX_LOADS)
    return ED_E_ARGUMENT;
  const loads l = {n_cases, n_directions, n_members, n_stations, n_combinations, n_sets,
                   statics, spectral,     static_factors, spectral_factors, set, gravity};
  double least_response;
  if (!all_finite(&l, constants, &least_response))
    return ED_E_NOT_FINITE;
  if (least_response < 0.0 || !valid_members(n_members, constants, kind))
    return ED_E_ARGUMENT;
  for (int i = 0; i < n_combinations; i++)
    if (set[i] < 0 || set[i] >= n_sets)
      return ED_E_ARGUMENT;
  const size_t k = n_combinations, all = (size_t)n_cases + n_directions, rows = (2 * FORCES + 1) * (size_t)n_stations;
  double *block = malloc(sizeof *block * (k * (all + FORCES + 1 + ED_N_CHECKS) + all * FORCES + rows));
  int *of = malloc(sizeof *of * (3 * k + 1));
  if (!block || !of) {
    free(block);
    free(of);
    return ED_E_MEMORY;
  }
  workspace w = {.of = of, .mask = of + k, .open = of + 2 * k, .factor = block};
  w.n = distinct(&l, of);
  w.force = w.factor + all * w.n;
  w.bound = w.force + (size_t)(FORCES + 1) * w.n;
  w.top = w.bound + (size_t)ED_N_CHECKS * w.n;
  w.steady = w.top + all * FORCES;
  w.swing = w.steady + (size_t)n_stations * FORCES;
  w.gravity = w.swing + (size_t)n_stations * FORCES;
  for (size_t i = 0; i < all; i++)
    for (int j = 0; j < w.n; j++)
      w.factor[i * w.n + j] = fabs(i < (size_t)n_cases ? static_factors[(size_t)of[j] * n_cases + i]
                                                        : spectral_factors[(size_t)of[j] * n_directions + i - n_cases]);
  worst found;
  for (int i = 0; i < ED_N_CHECKS; i++)
    found.combination[i] = -1;
  for (int m = 0; m < n_members; m++) {
    member b = {.c = constants + (size_t)m * ED_N_CONSTANTS, .shape = kind[m] & KIND_SHAPE,
                .elastic = kind[m] & ED_CLASS_3, .twists = !(kind[m] & ED_NO_TWIST)};
    for (int i = 0; i < ED_N_CONSTANTS; i++)
      b.per[i] = b.c[i] > 0.0 ? 1.0 / b.c[i] : HUGE_VAL;
    check_member(&l, &b, m, masks + (size_t)m * n_sets, &w, every, &found);
    for (int i = 0; i < ED_N_CHECKS; i++) {
      const size_t to = (size_t)m * ED_N_CHECKS + i;
      utilisation[to] = larger(found.utilisation[i], 0.0);
      combination[to] = found.combination[i];
      station[to] = found.station[i];
    }
  }
  free(block);
  free(of);
  return ED_OK;
}
