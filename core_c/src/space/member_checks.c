/* Utilisation of steel members by EN 1993-1-1 and EN 1998-1: combinations x members x stations x checks in one pass.
 *
 * The clauses are those of edesign/codes/ec3; tests/unit/space/test_member_checks.py compares both. The pass is written here
 * again because a search of sections runs it thousands of times, and arrays of numpy take about ten times as long.
 * Combinations with the same factors (directions have no sign) are evaluated once. */
#include "base/clones.h"
#include "edcore.h"
#include "space/annex_a.h"
#include "space/member_strength.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KIND_SHAPE = 3 };

typedef struct {
  int cases, directions, members, stations, combinations, sets;
  const double *statics, *spectral; /* cases, directions x members x stations x FORCES */
  const double *f, *g;              /* combinations x cases, directions */
  const int *set, *gravity;
  const double *M_b;                /* members x combinations, or NULL */
} loads;

typedef struct {
  double utilisation[ED_N_CHECKS];
  int combination[ED_N_CHECKS];
  int station[ED_N_CHECKS];
} worst;

typedef struct {
  double *steady, *alternating, *size; /* stations x FORCES, of one combination */
  double *compression, *gravity; /* stations */
} workspace;

/* ---- one combination -------------------------------------------------------------------------------------------- */

static inline void keep(worst *w, int check, double value, int combination, int station)
{
  if (value > w->utilisation[check])
    w->utilisation[check] = value, w->combination[check] = combination, w->station[check] = station;
}

#define HAS(check) (mask >> (check) & 1)

/* Forces of one combination at all stations: the steady part with its sign, the alternating part and V_z by gravity without. */
static inline __attribute__((always_inline)) void combine(const loads *l, int at, int k, const workspace *space)
{
  const double *f = l->f + (size_t)k * l->cases, *g = l->g + (size_t)k * l->directions;
  const int row = l->stations * FORCES;
  const size_t all = (size_t)row * l->members, own = (size_t)row * at;
  double *restrict steady = space->steady, *restrict alternating = space->alternating, *restrict gravity = space->gravity;
  for (int j = 0; j < row; j++)
    steady[j] = alternating[j] = 0.0;
  for (int s = 0; s < l->stations; s++)
    gravity[s] = 0.0;
  for (int i = 0; i < l->cases; i++) {
    const double *restrict of = l->statics + i * all + own;
    const double factor = f[i];
    if (factor == 0.0)
      continue; /* of hundreds of sway imperfections one acts */
    for (int j = 0; j < row; j++)
      steady[j] += factor * of[j];
    for (int s = 0; s < l->stations && l->gravity[i]; s++)
      gravity[s] += factor * of[s * FORCES + V_Z];
  }
  for (int i = 0; i < l->directions; i++) {
    const double *restrict of = l->spectral + i * all + own;
    const double factor = fabs(g[i]);
    for (int j = 0; j < row; j++)
      alternating[j] += factor * of[j];
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

/* mask: the checks of the member under this combination. */
ED_CLONES static void evaluate(const loads *l, const member *b, int at, int k, int mask, const workspace *space, worst *w)
{
  const double *c = b->c, *per = b->per;
  const int stations = l->stations, row = stations * FORCES;
  double *restrict size = space->size, *restrict compression = space->compression;
  const double *restrict steady = space->steady, *restrict alternating = space->alternating, *restrict gravity = space->gravity;
  double top[FORCES] = {0.0}, compressed = 0.0, by_gravity = 0.0;
  combine(l, at, k, space);
  for (int i = 0; i < row; i++)
    size[i] = fabs(steady[i]) + alternating[i];
  for (int s = 0; s < stations; s++) {
    for (int j = 0; j < FORCES; j++)
      top[j] = larger(top[j], size[s * FORCES + j]);
    compression[s] = larger(alternating[s * FORCES + N] - steady[s * FORCES + N], 0.0);
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
      if (alternating[s * FORCES + N] > 0.0 && powers_grow(b, F[N] * m.n_scale)) {
        const double other = fabs(fabs(steady[s * FORCES + N]) - alternating[s * FORCES + N]);
        keep(w, ED_CHECK_N_M, section(b, &m, other, w->utilisation[ED_CHECK_N_M]), k, s);
      }
    }
  }
  const double n_y = compressed * per[ED_N_B_Y], n_z = compressed * per[ED_N_B_Z];
  const double per_M_b = l->M_b ? 1.0 / l->M_b[(size_t)at * l->combinations + k] : per[ED_M_B];
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
    if (HAS(i) && value[i] > w->utilisation[i]) {
      const int s = i == ED_CHECK_N_B        ? where(compression, 1, stations)
                    : i == ED_CHECK_BEAM_V   ? where(gravity, 1, stations)
                    : i == ED_CHECK_COLUMN_V ? where(size + (v_y > v_z ? V_Y : V_Z), FORCES, stations)
                                             : where(size + force[i], FORCES, stations);
      keep(w, i, value[i], k, s);
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
  return c[ED_N_RK] * (1.0 + 1e-12) >= c[ED_N_B_Y] /* chi_y <= 1 but for rounding */ && c[ED_A_LT] >= 0.0 && c[ED_A_LT] <= 1.0 && c[ED_C_MY] + c[ED_C_MY_N] > 0.0 &&
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

static int valid_moments(const loads *l)
{
  for (size_t i = 0; l->M_b && i < (size_t)l->members * l->combinations; i++)
    if (!(l->M_b[i] > 0.0 && l->M_b[i] < HUGE_VAL))
      return 0;
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
                     const int *kind, const int *masks, const double *M_b, double *utilisation, int *combination, int *station)
{
  if (n_cases < 0 || n_directions < 0 || n_members < 0 || n_stations < 1 || n_combinations < 0 || n_sets < 1)
    return ED_E_ARGUMENT;
  const loads l = {n_cases, n_directions, n_members, n_stations, n_combinations, n_sets,
                   statics, spectral,     static_factors, spectral_factors, set, gravity, M_b};
  double least_response;
  if (!all_finite(&l, constants, &least_response))
    return ED_E_NOT_FINITE;
  if (least_response < 0.0 || !valid_members(n_members, constants, kind) || !valid_moments(&l))
    return ED_E_ARGUMENT;
  for (int i = 0; i < n_combinations; i++)
    if (set[i] < 0 || set[i] >= n_sets)
      return ED_E_ARGUMENT;
  const size_t row = (size_t)n_stations * FORCES;
  double *block = malloc(sizeof *block * (3 * row + 2 * (size_t)n_stations));
  int *of = malloc(sizeof *of * ((size_t)n_combinations + 1));
  if (!block || !of) {
    free(block);
    free(of);
    return ED_E_MEMORY;
  }
  const workspace space = {.steady = block, .alternating = block + row, .size = block + 2 * row, .compression = block + 3 * row,
                           .gravity = block + 3 * row + n_stations};
  const int n = distinct(&l, of);
  for (int m = 0; m < n_members; m++) {
    member b = {.c = constants + (size_t)m * ED_N_CONSTANTS, .shape = kind[m] & KIND_SHAPE,
                .elastic = kind[m] & ED_CLASS_3, .twists = !(kind[m] & ED_NO_TWIST), .annex_a = (kind[m] & ED_ANNEX_A) != 0};
    for (int i = 0; i < ED_N_CONSTANTS; i++)
      b.per[i] = b.c[i] > 0.0 ? 1.0 / b.c[i] : HUGE_VAL;
    worst found;
    for (int i = 0; i < ED_N_CHECKS; i++)
      found.utilisation[i] = -1.0, found.combination[i] = found.station[i] = -1;
    for (int i = 0; i < n; i++) {
      const int mask = masks[(size_t)m * n_sets + set[of[i]]];
      if (mask)
        evaluate(&l, &b, m, of[i], mask, &space, &found);
    }
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
