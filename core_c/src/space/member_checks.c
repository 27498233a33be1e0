/* Utilisation of steel members by EN 1993-1-1 and EN 1998-1: combinations x members x stations x checks in one pass.
 *
 * Most combinations cannot govern a member. From the largest force of each case along the member follows an upper bound of every
 * utilisation of a combination. Those that governed the member before are evaluated first, then those whose bounds reach beyond what was
 * found. Bounds count with every force at its largest place and with the worst exponent, so the shortcut changes no result. Combinations
 * with the same factors (directions have no sign) are evaluated once. */
#include "base/clones.h"
#include "edcore.h"
#include "space/annex_a.h"
#include "space/member_strength.h"
#include "space/section_bound.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KIND_SHAPE = 3 };

/* Above rounding of the sums from which bounds and results come: up to ED_MAX_LOADS terms and some tens of operations more, each of
 * them exact to 1.1e-16. */
static const double ROUNDING = 1e-12;

typedef struct {
  int cases, directions, members, stations, combinations, sets;
  const double *statics, *spectral; /* cases, directions x members x stations x FORCES */
  const double *f, *g;              /* combinations x cases, directions */
  const int *set, *gravity;
  const double *M_b;                /* members x combinations, or NULL */
} loads;

typedef struct {
  double utilisation[ED_N_CHECKS];
  int combination[ED_N_CHECKS]; /* among the distinct ones */
  int station[ED_N_CHECKS];
} worst;

typedef struct {
  int n;          /* distinct combinations */
  int *of;        /* n: their numbers, the first of equal ones */
  double *factor; /* (cases + directions) x n: magnitudes */
  double *force;  /* (FORCES + 1) x n: bounds of N ... M_z, and of V_z by gravity in place FORCES */
  double *bound;  /* ED_N_CHECKS x n */
  double *top;    /* (cases + directions) x FORCES */
  double *steady, *swing, *size;  /* stations x FORCES, of one combination */
  double *compression, *gravity; /* stations */
  int *mask;      /* n: of the member */
  int *open;      /* n: whether a combination may govern a check */
} workspace;

/* ---- exact evaluation of one combination ------------------------------------------------------------------------ */

static inline int improves(const worst *w, int check, double value, int combination)
{
  return value > w->utilisation[check] || (value == w->utilisation[check] && combination < w->combination[check]);
}

static inline void keep(worst *w, int check, double value, int combination, int station)
{
  if (improves(w, check, value, combination))
    w->utilisation[check] = value, w->combination[check] = combination, w->station[check] = station;
}

#define HAS(check) (mask >> (check) & 1)

/* Forces of one combination at all stations: the steady part with its sign, what swings and V_z by gravity without. */
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
  for (int s = 0; s < l->stations; s++)
    gravity[s] = fabs(gravity[s]);
}

/* The first station with the largest of every `step`-th number from `of` on. */
static int where(const double *of, int step, int stations)
{
  int at = 0;
  for (int s = 1; s < stations; s++)
    if (of[s * step] > of[at * step])
      at = s;
  return at;
}

/* k: among the distinct combinations. */
ED_CLONES static void evaluate(const loads *l, const member *b, int at, int k, const workspace *space, worst *w)
{
  const int mask = space->mask[k];
  const double *c = b->c, *per = b->per;
  const int stations = l->stations, row = stations * FORCES;
  double *restrict size = space->size, *restrict compression = space->compression;
  const double *restrict steady = space->steady, *restrict swing = space->swing, *restrict gravity = space->gravity;
  double top[FORCES] = {0.0}, compressed = 0.0, by_gravity = 0.0;
  combine(l, at, space->of[k], space);
  for (int i = 0; i < row; i++)
    size[i] = fabs(steady[i]) + swing[i];
  for (int s = 0; s < stations; s++) {
    for (int j = 0; j < FORCES; j++)
      top[j] = larger(top[j], size[s * FORCES + j]);
    compression[s] = larger(swing[s * FORCES + N] - steady[s * FORCES + N], 0.0);
    compressed = larger(compressed, compression[s]);
    by_gravity = larger(by_gravity, gravity[s]);
  }
  const double v_y = top[V_Y] * per[ED_V_Y_RD], v_z = top[V_Z] * per[ED_V_Z_RD];
  const int shears = v_y > 0.5 || v_z > 0.5;
  for (int s = 0; s < stations && (HAS(ED_CHECK_N_M) || (shears && mask & (1 << ED_CHECK_M_Y | 1 << ED_CHECK_M_Z))); s++) {
    const double *F = size + s * FORCES;
    const sheared m = shears ? with_shear(b, F[V_Y] * per[ED_V_Y_RD], F[V_Z] * per[ED_V_Z_RD], F[M_Y], F[M_Z])
                             : without_shear(b, F[M_Y], F[M_Z]);
    if (shears && HAS(ED_CHECK_M_Y))
      keep(w, ED_CHECK_M_Y, m.m_y, k, s);
    if (shears && HAS(ED_CHECK_M_Z))
      keep(w, ED_CHECK_M_Z, m.m_z, k, s);
    if (HAS(ED_CHECK_N_M)) {
      keep(w, ED_CHECK_N_M, section(b, &m, F[N], w->utilisation[ED_CHECK_N_M]), k, s);
      if (swing[s * FORCES + N] > 0.0 && powers_grow(b, F[N] * m.n_scale)) {
        const double other = fabs(fabs(steady[s * FORCES + N]) - swing[s * FORCES + N]);
        keep(w, ED_CHECK_N_M, section(b, &m, other, w->utilisation[ED_CHECK_N_M]), k, s);
      }
    }
  }
  const double n_y = compressed * per[ED_N_B_Y], n_z = compressed * per[ED_N_B_Z];
  const double per_M_b = l->M_b ? 1.0 / l->M_b[(size_t)at * l->combinations + space->of[k]] : per[ED_M_B];
  const double m_y = top[M_Y] * per_M_b, m_z = top[M_Z] * per[ED_M_Z_RK];
  const factors a = b->annex_a ? annex_a(b, compressed, top[M_Y], m_y, m_z) : annex_b(b, n_y, n_z);
  const double value[ED_N_CHECKS] = {
    [ED_CHECK_N] = top[N] * per[ED_N_RD],
    [ED_CHECK_V_Y] = v_y,
    [ED_CHECK_V_Z] = v_z,
    [ED_CHECK_M_Y] = shears ? -2.0 : top[M_Y] * per[ED_M_Y_RD], /* -2: kept above */
    [ED_CHECK_M_Z] = shears ? -2.0 : top[M_Z] * per[ED_M_Z_RD],
    [ED_CHECK_N_M] = -2.0,
    [ED_CHECK_N_B] = larger(n_y, n_z),
    [ED_CHECK_M_B] = m_y,
    [ED_CHECK_6_61] = n_y + times(a.yy, m_y) + times(a.yz, m_z),
    [ED_CHECK_6_62] = n_z + times(a.zy, m_y) + times(a.zz, m_z),
    [ED_CHECK_BEAM_M] = top[M_Y] * per[ED_M_Y_RD],
    [ED_CHECK_BEAM_N] = top[N] * per[ED_N_RD] / 0.15,
    [ED_CHECK_BEAM_V] = (by_gravity + c[ED_V_M]) * per[ED_V_Z_RD] / 0.5,
    [ED_CHECK_COLUMN_V] = larger(v_y, v_z) / 0.5,
  };
  static const signed char force[ED_N_CHECKS] = {N, V_Y, V_Z, M_Y, M_Z, -1, -1, M_Y, M_Y, M_Y, M_Y, N, -1, -1};
  for (int i = 0; i < ED_N_CHECKS; i++)
    if (HAS(i) && improves(w, i, value[i], k)) {
      const int s = i == ED_CHECK_N_B        ? where(compression, 1, stations)
                    : i == ED_CHECK_BEAM_V   ? where(gravity, 1, stations)
                    : i == ED_CHECK_COLUMN_V ? where(size + (v_y > v_z ? V_Y : V_Z), FORCES, stations)
                                             : where(size + force[i], FORCES, stations);
      keep(w, i, value[i], k, s);
    }
}

/* ---- bounds of all combinations of one member ------------------------------------------------------------------- */

/* Largest magnitude along the member of each force of each case and direction: (cases + directions) x FORCES. */
ED_CLONES static void largest(const loads *l, int at, double *restrict top)
{
  const size_t row = (size_t)l->stations * FORCES, all = row * l->members, own = row * at;
  for (int i = 0; i < l->cases + l->directions; i++, top += FORCES) {
    const double *of = (i < l->cases ? l->statics + i * all : l->spectral + (i - l->cases) * all) + own;
    double most[FORCES] = {0.0};
    for (int s = 0; s < l->stations; s++, of += FORCES)
      for (int j = 0; j < FORCES; j++)
        most[j] = larger(most[j], fabs(of[j]));
    memcpy(top, most, sizeof most);
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
  double *restrict u = w->bound;
  const double N_Rd = b->c[ED_N_RD], M_y_Rd = b->c[ED_M_Y_RD], M_z_Rd = b->c[ED_M_Z_RD], M_y_shear = b->c[ED_M_Y_SHEAR];
  const double V_y_Rd = sqrt(3.0) * b->c[ED_V_Y_RD], V_z_Rd = sqrt(3.0) * b->c[ED_V_Z_RD], V_M = b->c[ED_V_M];
  const double a_y = b->c[ED_WEB_SHARE_Y], a_z = b->c[ED_WEB_SHARE_Z], half_web = 0.5 * b->c[ED_N_WEB], linear_only = b->elastic ? LINEAR_ONLY : 0.0;
  /* N and V above by more than rounding: near the end of a resistance little of it is left, and rounding is much of that */
  const double above = 1.0 + ROUNDING, per_V_y = b->per[ED_V_Y_RD] * above, per_V_z = b->per[ED_V_Z_RD] * above;
  const double per_N = b->per[ED_N_RD], per_M_y = b->per[ED_M_Y_RD];
  const double per_N_b_y = b->per[ED_N_B_Y], per_N_b_z = b->per[ED_N_B_Z], per_M_b = b->per[ED_M_B], per_M_z = b->per[ED_M_Z_RK];
  /* factors of Annex B are linear in the compression, and the largest at one of its ends: none, or a unit of n */
  const factors none = annex_b(b, 0.0, 0.0), unit = annex_b(b, 1.0, 1.0);
  const double yy = larger(unit.yy - none.yy, 0.0), zz = larger(unit.zz - none.zz, 0.0), yz = none.yz / none.zz;
  const double zy = b->twists ? 0.0 : none.zy / none.yy, zy_none = b->twists ? none.zy : 0.0;
#pragma GCC ivdep
  for (int k = 0; k < n; k++) {
    const double n_y = N_Ed[k] * per_N_b_y, n_z = N_Ed[k] * per_N_b_z, m_y = M_y[k] * per_M_b, m_z = M_z[k] * per_M_z;
    const double k_yy = none.yy + yy * n_y, k_zz = none.zz + zz * n_z;
    u[ED_CHECK_N * row + k] = N_Ed[k] * per_N;
    u[ED_CHECK_V_Y * row + k] = V_y[k] * per_V_y;
    u[ED_CHECK_V_Z * row + k] = V_z[k] * per_V_z;
    u[ED_CHECK_N_B * row + k] = larger(n_y, n_z);
    u[ED_CHECK_M_B * row + k] = m_y;
    u[ED_CHECK_6_61 * row + k] = n_y + k_yy * m_y + yz * k_zz * m_z;
    u[ED_CHECK_6_62 * row + k] = n_z + (zy_none + zy * k_yy) * m_y + k_zz * m_z;
    u[ED_CHECK_BEAM_M * row + k] = M_y[k] * per_M_y;
    u[ED_CHECK_BEAM_N * row + k] = N_Ed[k] * per_N / 0.15;
    u[ED_CHECK_BEAM_V * row + k] = (V_G[k] + V_M) * per_V_z / 0.5;
    u[ED_CHECK_COLUMN_V * row + k] = larger(V_y[k] * per_V_y, V_z[k] * per_V_z) / 0.5;
  }
#pragma GCC ivdep
  for (int k = 0; k < n; k++) {
    const double over_y = positive(2.0 * V_y[k] * per_V_y - 1.0), over_z = positive(2.0 * V_z[k] * per_V_z - 1.0);
    const double y = positive(1.0 - over_y * over_y), z = positive(1.0 - over_z * over_z); /* 1 - rho */
    const double m_y = M_y[k] / positive(M_y_Rd - (1.0 - z) * M_y_shear), m_z = M_z[k] / (y * M_z_Rd);
    const double by = above * N_Ed[k] / positive(N_Rd - ((1.0 - y) * V_y_Rd + (1.0 - z) * V_z_Rd)), by_web = N_Ed[k] / (z * half_web);
    u[ED_CHECK_M_Y * row + k] = m_y;
    u[ED_CHECK_M_Z * row + k] = m_z;
    u[ED_CHECK_N_M * row + k] = section_bound(shape, a_y, a_z, by, by_web, m_y, m_z, linear_only);
  }
}

static void annex_a_bounds(const member *b, const workspace *w)
{
  const size_t row = w->n;
  for (int k = 0; k < w->n; k++) {
    const double N_Ed = w->force[N * row + k];
    const double m_y = w->force[M_Y * row + k] * b->per[ED_M_B], m_z = w->force[M_Z * row + k] * b->per[ED_M_Z_RK];
    double y, z;
    annex_a_bound(b, N_Ed * (1.0 + ROUNDING), &y, &z);
    const double moments = times(y, m_y) + times(z, m_z);
    w->bound[ED_CHECK_6_61 * row + k] = N_Ed * b->per[ED_N_B_Y] + moments;
    w->bound[ED_CHECK_6_62 * row + k] = N_Ed * b->per[ED_N_B_Z] + moments;
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
  if (b->annex_a)
    annex_a_bounds(b, w);
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
      const int k = before.combination[i];
      int seen = k < 0;
      for (int j = 0; j < i && !seen; j++)
        seen = before.combination[j] == k;
      if (!seen && may_govern(w, k, found))
        evaluate(l, b, at, k, w, found);
    }
    find_open(w, found);
  }
  for (int k = 0; k < n; k++)
    if (w->open[k] && (every || may_govern(w, k, found)))
      evaluate(l, b, at, k, w, found);
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

static int valid_for_annex_a(const double *c)
{
  static const int share[] = {ED_CHI_Z, ED_ELASTIC_Y, ED_ELASTIC_Z};
  static const int positive[] = {ED_PER_N_CR_Y, ED_PER_N_CR_Z, ED_PER_N_CR_T, ED_LAMBDA_0, ED_LT_LIMIT, ED_AREA_BY_MODULUS};
  for (size_t j = 0; j < sizeof share / sizeof *share; j++)
    if (!(c[share[j]] > 0.0 && c[share[j]] <= 1.0))
      return 0;
  for (size_t j = 0; j < sizeof positive / sizeof *positive; j++)
    if (!(c[positive[j]] >= 0.0))
      return 0;
  return c[ED_N_RK] * (1.0 + ROUNDING) >= c[ED_N_B_Y] && c[ED_A_LT] >= 0.0 && c[ED_A_LT] <= 1.0 && c[ED_C_MY] + c[ED_C_MY_N] > 0.0 &&
         c[ED_C_MZ] + c[ED_C_MZ_N] > 0.0;
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
    if (kind[i] < 0 || kind[i] > (KIND_SHAPE | ED_CLASS_3 | ED_NO_TWIST | ED_ANNEX_A) || (kind[i] & KIND_SHAPE) > ED_CHS)
      return 0;
    if (kind[i] & ED_ANNEX_A && !valid_for_annex_a(c))
      return 0;
  }
  return 1;
}

/* Bounds count on ED_M_B as the least. */
static int valid_moments(const loads *l, const double *constants)
{
  for (int m = 0; l->M_b && m < l->members; m++)
    for (int k = 0; k < l->combinations; k++) {
      const double M_b = l->M_b[(size_t)m * l->combinations + k];
      if (!(M_b >= constants[(size_t)m * ED_N_CONSTANTS + ED_M_B] && M_b < HUGE_VAL))
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
                     const int *kind, const int *masks, const double *M_b, int every, double *utilisation, int *combination,
                     int *station)
{
  if (n_cases < 0 || n_directions < 0 || n_members < 0 || n_stations < 1 || n_combinations < 0 || n_sets < 1 ||
      n_cases + n_directions > ED_MAX_LOADS)
    return ED_E_ARGUMENT;
  const loads l = {n_cases, n_directions, n_members, n_stations, n_combinations, n_sets,
                   statics, spectral,     static_factors, spectral_factors, set, gravity, M_b};
  double least_response;
  if (!all_finite(&l, constants, &least_response))
    return ED_E_NOT_FINITE;
  if (least_response < 0.0 || !valid_members(n_members, constants, kind) || !valid_moments(&l, constants))
    return ED_E_ARGUMENT;
  for (int i = 0; i < n_combinations; i++)
    if (set[i] < 0 || set[i] >= n_sets)
      return ED_E_ARGUMENT;
  const size_t k = n_combinations, all = (size_t)n_cases + n_directions, rows = (3 * FORCES + 2) * (size_t)n_stations;
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
  w.size = w.swing + (size_t)n_stations * FORCES;
  w.compression = w.size + (size_t)n_stations * FORCES;
  w.gravity = w.compression + n_stations;
  for (size_t i = 0; i < all; i++)
    for (int j = 0; j < w.n; j++)
      w.factor[i * w.n + j] = fabs(i < (size_t)n_cases ? static_factors[(size_t)of[j] * n_cases + i]
                                                        : spectral_factors[(size_t)of[j] * n_directions + i - n_cases]);
  worst found;
  for (int i = 0; i < ED_N_CHECKS; i++)
    found.combination[i] = -1;
  for (int m = 0; m < n_members; m++) {
    member b = {.c = constants + (size_t)m * ED_N_CONSTANTS, .shape = kind[m] & KIND_SHAPE,
                .elastic = kind[m] & ED_CLASS_3, .twists = !(kind[m] & ED_NO_TWIST), .annex_a = (kind[m] & ED_ANNEX_A) != 0};
    for (int i = 0; i < ED_N_CONSTANTS; i++)
      b.per[i] = b.c[i] > 0.0 ? 1.0 / b.c[i] : HUGE_VAL;
    check_member(&l, &b, m, masks + (size_t)m * n_sets, &w, every, &found);
    for (int i = 0; i < ED_N_CHECKS; i++) {
      const size_t to = (size_t)m * ED_N_CHECKS + i;
      utilisation[to] = larger(found.utilisation[i], 0.0);
      combination[to] = found.combination[i] < 0 ? -1 : of[found.combination[i]];
      station[to] = found.station[i];
    }
  }
  free(block);
  free(of);
  return ED_OK;
}
