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
  const double *c; /* constants, ED_N_RD ... */
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

/* load / resistance, where a resistance that is used up carries nothing */
static inline double ratio(double load, double resistance)
{
  return load <= 0.0 ? 0.0 : resistance > 0.0 ? load / resistance : HUGE_VAL;
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
  const double N_web = 0.5 * (1.0 - z) * c[ED_N_WEB];
  return (sheared){ratio(M_y, c[ED_M_Y_RD] - z * c[ED_M_Y_SHEAR]), ratio(M_z, (1.0 - y) * c[ED_M_Z_RD]),
                   N_V > 0.0 ? 1.0 / N_V : HUGE_VAL, N_web > 0.0 ? 1.0 / N_web : HUGE_VAL};
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

/* 6.2.9.1(2) and (6), 6.2.1(7), 6.2.9.2 */
static double section(const member *b, const sheared *s, double N_Ed)
{
  const double n = N_Ed > 0.0 ? N_Ed * s->n_scale : 0.0;
  const double linear = n + s->m_y + s->m_z;
  if (b->elastic || !(n < 1.0))
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

/* Not less than `section` for any smaller forces. */
static inline double section_bound(const member *b, const sheared *s, double N_Ed)
{
  const double n = N_Ed > 0.0 ? N_Ed * s->n_scale : 0.0;
  const double linear = n + s->m_y + s->m_z;
  if (b->elastic || !(n < 1.0) || linear > 1e3)
    return linear;
  double y, z;
  with_axial_force(b, n, N_Ed * s->n_web_scale, &y, &z);
  const double r_y = ratio(s->m_y, y), r_z = ratio(s->m_z, z);
  if (!(r_y <= 1.0 && r_z <= 1.0))
    return linear;
  /* exponents are at least 2 and 1 (I), 2 (CHS), 1.66 (RHS, taken as 1.5) */
  const double both = b->shape == ED_I     ? r_y * r_y + r_z
                      : b->shape == ED_CHS ? r_y * r_y + r_z * r_z
                                           : r_y * sqrt(r_y) + r_z * sqrt(r_z);
  return smaller(larger(larger(r_y, r_z), both), linear);
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

/* The largest factors for compression between none and this one: they are linear in it. */
static inline factors annex_b_bound(const member *b, const factors *none, double n_y, double n_z)
{
  const factors k = annex_b(b, n_y, n_z);
  return (factors){larger(none->yy, k.yy), larger(none->yz, k.yz), larger(none->zy, k.zy), larger(none->zz, k.zz)};
}

/* ---- exact evaluation of one combination ------------------------------------------------------------------------ */

static inline void keep(worst *w, int check, double value, int combination, int station)
{
  if (value > w->utilisation[check] || (value == w->utilisation[check] && combination < w->combination[check]))
    w->utilisation[check] = value, w->combination[check] = combination, w->station[check] = station;
}

#define HAS(check) (mask >> (check) & 1)

static void evaluate(const loads *l, const member *b, int at, int k, int mask, worst *w)
{
  const double *c = b->c;
  const double *f = l->f + (size_t)k * l->cases, *g = l->g + (size_t)k * l->directions;
  const size_t row = (size_t)l->stations * FORCES, all = row * l->members, own = row * at;
  double compression = 0.0, most_y = 0.0, most_z = 0.0;
  int at_compression = 0, at_y = 0;
  for (int s = 0; s < l->stations; s++) {
    double steady[FORCES] = {0.0}, swing[FORCES] = {0.0}, gravity = 0.0, F[FORCES];
    for (int i = 0; i < l->cases; i++) {
      const double *of = l->statics + i * all + own + (size_t)s * FORCES;
      for (int j = 0; j < FORCES; j++)
        steady[j] += f[i] * of[j];
      if (l->gravity[i])
        gravity += f[i] * of[V_Z];
    }
    for (int i = 0; i < l->directions; i++) {
      const double *of = l->spectral + i * all + own + (size_t)s * FORCES;
      for (int j = 0; j < FORCES; j++)
        swing[j] += fabs(g[i]) * of[j];
    }
    for (int j = 0; j < FORCES; j++)
      F[j] = fabs(steady[j]) + swing[j];
    const double v_y = F[V_Y] / c[ED_V_Y_RD], v_z = F[V_Z] / c[ED_V_Z_RD];
    if (HAS(ED_CHECK_N))
      keep(w, ED_CHECK_N, F[N] / c[ED_N_RD], k, s);
    if (HAS(ED_CHECK_V_Y))
      keep(w, ED_CHECK_V_Y, v_y, k, s);
    if (HAS(ED_CHECK_V_Z))
      keep(w, ED_CHECK_V_Z, v_z, k, s);
    if (mask & (1 << ED_CHECK_M_Y | 1 << ED_CHECK_M_Z | 1 << ED_CHECK_N_M)) {
      const sheared m = with_shear(b, v_y, v_z, F[M_Y], F[M_Z]);
      if (HAS(ED_CHECK_M_Y))
        keep(w, ED_CHECK_M_Y, m.m_y, k, s);
      if (HAS(ED_CHECK_M_Z))
        keep(w, ED_CHECK_M_Z, m.m_z, k, s);
      if (HAS(ED_CHECK_N_M)) {
        keep(w, ED_CHECK_N_M, section(b, &m, F[N]), k, s);
        if (swing[N] > 0.0 && m.m_z > 0.0) /* the other sign: a larger N may raise the exponent of m_z */
          keep(w, ED_CHECK_N_M, section(b, &m, fabs(fabs(steady[N]) - swing[N])), k, s);
      }
    }
    if (HAS(ED_CHECK_BEAM_M))
      keep(w, ED_CHECK_BEAM_M, F[M_Y] / c[ED_M_Y_RD], k, s);
    if (HAS(ED_CHECK_BEAM_N))
      keep(w, ED_CHECK_BEAM_N, F[N] / (0.15 * c[ED_N_RD]), k, s);
    if (HAS(ED_CHECK_BEAM_V))
      keep(w, ED_CHECK_BEAM_V, (fabs(gravity) + c[ED_V_M]) / (0.5 * c[ED_V_Z_RD]), k, s);
    if (HAS(ED_CHECK_COLUMN_V))
      keep(w, ED_CHECK_COLUMN_V, larger(v_y, v_z) / 0.5, k, s);
    if (swing[N] - steady[N] > compression)
      compression = swing[N] - steady[N], at_compression = s;
    if (F[M_Y] > most_y)
      most_y = F[M_Y], at_y = s;
    most_z = larger(most_z, F[M_Z]);
  }
  const double n_y = compression / c[ED_N_B_Y], n_z = compression / c[ED_N_B_Z];
  const double m_y = most_y / c[ED_M_B], m_z = most_z / c[ED_M_Z_RK];
  if (HAS(ED_CHECK_N_B))
    keep(w, ED_CHECK_N_B, larger(n_y, n_z), k, at_compression);
  if (HAS(ED_CHECK_M_B))
    keep(w, ED_CHECK_M_B, m_y, k, at_y);
  if (mask & (1 << ED_CHECK_6_61 | 1 << ED_CHECK_6_62)) {
    const factors a = annex_b(b, n_y, n_z);
    if (HAS(ED_CHECK_6_61))
      keep(w, ED_CHECK_6_61, n_y + a.yy * m_y + a.yz * m_z, k, at_y);
    if (HAS(ED_CHECK_6_62))
      keep(w, ED_CHECK_6_62, n_z + a.zy * m_y + a.zz * m_z, k, at_y);
  }
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

typedef struct {
  int n;          /* distinct combinations */
  int *of;        /* n: their numbers, the first of equal ones */
  double *factor; /* (cases + directions) x n: magnitudes */
  double *force;  /* (FORCES + 1) x n: bounds of N ... M_z, and of V_z by gravity in place FORCES */
  double *bound;  /* ED_N_CHECKS x n */
  double *top;    /* (cases + directions) x FORCES */
} workspace;

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

static void check_bounds(const member *b, const workspace *w)
{
  const double *c = b->c;
  const factors none = annex_b(b, 0.0, 0.0);
  const double *force[FORCES + 1];
  double *u[ED_N_CHECKS];
  for (int j = 0; j <= FORCES; j++)
    force[j] = w->force + (size_t)j * w->n;
  for (int i = 0; i < ED_N_CHECKS; i++)
    u[i] = w->bound + (size_t)i * w->n;
  for (int k = 0; k < w->n; k++) {
    const double v_y = force[V_Y][k] / c[ED_V_Y_RD], v_z = force[V_Z][k] / c[ED_V_Z_RD];
    const sheared m = with_shear(b, v_y, v_z, force[M_Y][k], force[M_Z][k]);
    const double n_y = force[N][k] / c[ED_N_B_Y], n_z = force[N][k] / c[ED_N_B_Z];
    const double m_y = force[M_Y][k] / c[ED_M_B], m_z = force[M_Z][k] / c[ED_M_Z_RK];
    const factors a = annex_b_bound(b, &none, n_y, n_z);
    u[ED_CHECK_N][k] = force[N][k] / c[ED_N_RD];
    u[ED_CHECK_V_Y][k] = v_y;
    u[ED_CHECK_V_Z][k] = v_z;
    u[ED_CHECK_M_Y][k] = m.m_y;
    u[ED_CHECK_M_Z][k] = m.m_z;
    u[ED_CHECK_N_M][k] = section_bound(b, &m, force[N][k]);
    u[ED_CHECK_N_B][k] = larger(n_y, n_z);
    u[ED_CHECK_M_B][k] = m_y;
    u[ED_CHECK_6_61][k] = n_y + a.yy * m_y + a.yz * m_z;
    u[ED_CHECK_6_62][k] = n_z + a.zy * m_y + a.zz * m_z;
    u[ED_CHECK_BEAM_M][k] = force[M_Y][k] / c[ED_M_Y_RD];
    u[ED_CHECK_BEAM_N][k] = force[N][k] / (0.15 * c[ED_N_RD]);
    u[ED_CHECK_BEAM_V][k] = (force[FORCES][k] + c[ED_V_M]) / (0.5 * c[ED_V_Z_RD]);
    u[ED_CHECK_COLUMN_V][k] = larger(v_y, v_z) / 0.5;
  }
}

/* Whether a combination may still govern one of its checks. */
static int may_govern(const workspace *w, int k, int mask, const worst *found)
{
  for (int i = 0; i < ED_N_CHECKS; i++)
    if (HAS(i) && !(w->bound[(size_t)i * w->n + k] * (1.0 + ROUNDING) < found->utilisation[i]))
      return 1;
  return 0;
}

static void check_member(const loads *l, const member *b, int at, const int *masks, const workspace *w, int every, worst *found)
{
  const int n = w->n;
  for (int i = 0; i < ED_N_CHECKS; i++)
    found->utilisation[i] = -1.0, found->combination[i] = found->station[i] = -1;
  if (!every) {
    largest(l, at, w->top);
    force_bounds(l, w);
    check_bounds(b, w);
    for (int i = 0; i < ED_N_CHECKS; i++) { /* of each check first the combination that promises most */
      int first = -1;
      for (int k = 0; k < n; k++)
        if (masks[l->set[w->of[k]]] >> i & 1 && (first < 0 || w->bound[(size_t)i * n + k] > w->bound[(size_t)i * n + first]))
          first = k;
      if (first >= 0 && may_govern(w, first, 1 << i, found))
        evaluate(l, b, at, w->of[first], masks[l->set[w->of[first]]], found);
    }
  }
  for (int k = 0; k < n; k++) {
    const int mask = masks[l->set[w->of[k]]];
    if (mask && (every || may_govern(w, k, mask, found)))
      evaluate(l, b, at, w->of[k], mask, found);
  }
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

static int without_nan_or_infinity(size_t n, const double *x)
{
  double sum = 0.0;
  for (size_t i = 0; i < n; i++)
    sum += 0.0 * x[i];
  return sum == 0.0;
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

static int valid_loads(const loads *l)
{
  for (int i = 0; i < l->combinations; i++)
    if (l->set[i] < 0 || l->set[i] >= l->sets)
      return 0;
  const size_t n = (size_t)l->directions * l->members * l->stations * FORCES;
  for (size_t i = 0; i < n; i++)
    if (l->spectral[i] < 0.0)
      return 0;
  return 1;
}

static int all_finite(const loads *l, const double *constants)
{
  const size_t n = (size_t)l->members * l->stations * FORCES;
  return without_nan_or_infinity(n * l->cases, l->statics) && without_nan_or_infinity(n * l->directions, l->spectral) &&
         without_nan_or_infinity((size_t)l->combinations * l->cases, l->f) && without_nan_or_infinity((size_t)l->combinations * l->directions, l->g) &&
         without_nan_or_infinity((size_t)l->members * ED_N_CONSTANTS, constants);
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
  if (!all_finite(&l, constants))
    return ED_E_NOT_FINITE;
  if (!valid_loads(&l) || !valid_members(n_members, constants, kind))
    return ED_E_ARGUMENT;
  const size_t k = n_combinations, all = (size_t)n_cases + n_directions;
  double *block = malloc(sizeof *block * (k * (all + FORCES + 1 + ED_N_CHECKS) + all * FORCES + 1));
  int *of = malloc(sizeof *of * (k + 1));
  if (!block || !of) {
    free(block);
    free(of);
    return ED_E_MEMORY;
  }
  workspace w = {.of = of, .factor = block};
  w.n = distinct(&l, of);
  w.force = w.factor + all * w.n;
  w.bound = w.force + (size_t)(FORCES + 1) * w.n;
  w.top = w.bound + (size_t)ED_N_CHECKS * w.n;
  for (size_t i = 0; i < all; i++)
    for (int j = 0; j < w.n; j++)
      w.factor[i * w.n + j] = fabs(i < (size_t)n_cases ? static_factors[(size_t)of[j] * n_cases + i]
                                                        : spectral_factors[(size_t)of[j] * n_directions + i - n_cases]);
  for (int m = 0; m < n_members; m++) {
    const member b = {constants + (size_t)m * ED_N_CONSTANTS, kind[m] & KIND_SHAPE, kind[m] & ED_CLASS_3,
                      !(kind[m] & ED_NO_TWIST)};
    worst found;
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
