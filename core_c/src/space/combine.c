/* Combination of modal values: quadratic forms of many quantities at once (CQC: Wilson, Der Kiureghian & Bayo 1981; with rho = 1 SRSS). */
#include "base/clones.h"
#include "edcore.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* Quantities side by side: ten vectors of four, whose sums do not wait for each other and stay in registers. Of a member N, V_y, V_z, T
 * and both moments at both ends and in the middle are combined. */
enum { LANES = 40, GROUP = 8, OF_MEMBER = 10, OF_GROUP = GROUP * OF_MEMBER };
_Static_assert(OF_GROUP % LANES == 0, "groups of members are whole blocks");

/* root[l] = sqrt(r_l^T rho r_l) for LANES quantities; `values`: those of each mode, `stride` apart. The lower triangle of rho is read.
 * Rounding may leave a form of what cancels a little below zero. */
ED_CLONES static void combine_lanes(int n_modes, const double *restrict values, size_t stride, const double *restrict rho,
                                    double *restrict root)
{
  double sum[LANES] = {0.0};
  for (int i = 0; i < n_modes; i++) {
    const double *own = values + (size_t)i * stride, *factor = rho + (size_t)i * (size_t)n_modes;
    double inner[LANES];
    for (int l = 0; l < LANES; l++)
      inner[l] = 0.5 * factor[i] * own[l];
    for (int j = 0; j < i; j++)
      for (int l = 0; l < LANES; l++)
        inner[l] += factor[j] * values[(size_t)j * stride + (size_t)l];
    for (int l = 0; l < LANES; l++)
      sum[l] += own[l] * inner[l];
  }
  for (int l = 0; l < LANES; l++)
    root[l] = sqrt(sum[l] <= 0.0 ? 0.0 : 2.0 * sum[l]);
}

/* Of two coefficients: formulas for rho differ by their rounding from one side to the other, wrong input by its digits. */
static const double SYMMETRIC = 1e-9;

/* Finite, and symmetric but for rounding. */
static int usable(int n_modes, const double *rho)
{
  for (int i = 0; i < n_modes; i++)
    for (int j = 0; j <= i; j++) {
      const double a = rho[(size_t)i * (size_t)n_modes + (size_t)j], b = rho[(size_t)j * (size_t)n_modes + (size_t)i];
      if (!(fabs(a - b) <= SYMMETRIC * (fabs(a) + fabs(b))))
        return 0;
    }
  return 1;
}

int ed_combine(int n, int n_modes, const double *values, const double *rho, double *result)
{
  if (n < 0 || n_modes < 1 || !usable(n_modes, rho))
    return ED_E_ARGUMENT;
  double *side = calloc((size_t)n_modes, LANES * sizeof *side), root[LANES];
  int finite = 1;
  if (!side)
    return ED_E_MEMORY;
  for (int first = 0; first < n; first += LANES) {
    const int count = n - first < LANES ? n - first : LANES;
    for (int k = 0; k < n_modes; k++)
      for (int l = 0; l < count; l++)
        side[k * LANES + l] = values[(size_t)k * (size_t)n + (size_t)(first + l)];
    combine_lanes(n_modes, side, LANES, rho, root);
    for (int l = 0; l < count; l++) {
      result[first + l] = root[l];
      finite &= isfinite(root[l]) != 0;
    }
  }
  free(side);
  return finite ? ED_OK : ED_E_NOT_FINITE;
}

/* The square of a moment between the ends is the parabola through those at the start, in the middle and at the end. */
static double between(double x, const double *root)
{
  const double start = root[0] * root[0], middle = root[1] * root[1], end = root[2] * root[2];
  const double square = (1.0 - x) * (1.0 - 2.0 * x) * start + 4.0 * x * (1.0 - x) * middle + x * (2.0 * x - 1.0) * end;
  return sqrt(square <= 0.0 ? 0.0 : square);
}

/* What is combined of a member: see OF_MEMBER. Forces on faces whose normal is +x: at the start what acts there has the other sign. */
static void spread_member(const double *force, double *value)
{
  for (int i = 0; i < 4; i++)
    value[i] = force[6 + i];
  for (int i = 0; i < 2; i++) {
    const double start = -force[4 + i], end = force[10 + i];
    value[4 + 3 * i] = start;
    value[5 + 3 * i] = 0.5 * (start + end);
    value[6 + 3 * i] = end;
  }
}

int ed_combine_stations(int n_members, int n_modes, const double *end_forces, const double *rho, int n_stations, const double *stations,
                        double *result)
{
  if (n_members < 0 || n_modes < 1 || n_stations < 0 || !usable(n_modes, rho))
    return ED_E_ARGUMENT;
  for (int i = 0; i < n_stations; i++)
    if (!(stations[i] >= 0.0 && stations[i] <= 1.0))
      return ED_E_ARGUMENT;
  double *side = calloc((size_t)n_modes, OF_GROUP * sizeof *side), root[OF_GROUP];
  int finite = 1;
  if (!side)
    return ED_E_MEMORY;
  for (int first = 0; first < n_members; first += GROUP) {
    const int count = n_members - first < GROUP ? n_members - first : GROUP;
    for (int k = 0; k < n_modes; k++)
      for (int m = 0; m < count; m++)
        spread_member(end_forces + 12 * ((size_t)k * (size_t)n_members + (size_t)(first + m)), side + k * OF_GROUP + m * OF_MEMBER);
    for (int l = 0; l < count * OF_MEMBER; l += LANES)
      combine_lanes(n_modes, side + l, OF_GROUP, rho, root + l);
    for (int m = 0; m < count; m++)
      for (int s = 0; s < n_stations; s++) {
        const double *own = root + m * OF_MEMBER;
        double *to = result + 6 * ((size_t)(first + m) * (size_t)n_stations + (size_t)s);
        for (int i = 0; i < 4; i++)
          to[i] = own[i];
        to[4] = between(stations[s], own + 4);
        to[5] = between(stations[s], own + 7);
        for (int i = 0; i < 6; i++)
          finite &= isfinite(to[i]) != 0;
      }
  }
  free(side);
  return finite ? ED_OK : ED_E_NOT_FINITE;
}
