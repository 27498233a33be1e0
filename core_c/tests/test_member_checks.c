/* Checks of steel members: utilisations by hand, signs of responses, ties, combinations together and alone, arguments. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

enum { CASES = 2, DIRECTIONS = 2, MEMBERS = 9, STATIONS = 4, COMBINATIONS = 17, SETS = 2, F = 6 };

/* A member with simple numbers: N 100, V 50 and 40, M 20 and 10; buckling 80 and 50, 16. */
static const double SIMPLE[ED_N_CONSTANTS] = {
  [ED_N_RD] = 100.0,  [ED_V_Y_RD] = 50.0,  [ED_V_Z_RD] = 40.0,  [ED_M_Y_RD] = 20.0,  [ED_M_Z_RD] = 10.0,
  [ED_M_Y_SHEAR] = 8.0, [ED_N_WEB] = 40.0, [ED_WEB_SHARE_Y] = 0.4,      [ED_WEB_SHARE_Z] = 0.4,      [ED_N_B_Y] = 80.0,
  [ED_N_B_Z] = 50.0,  [ED_M_B] = 16.0,     [ED_M_Z_RK] = 10.0,  [ED_LAMBDA_Y] = 0.7, [ED_LAMBDA_Z] = 1.2,
  [ED_C_MY] = 0.9,    [ED_C_MZ] = 0.8,     [ED_C_MLT] = 0.65,   [ED_V_M] = 12.0,
  [ED_N_RK] = 100.0,  [ED_PER_N_CR_Y] = 0.004, [ED_PER_N_CR_Z] = 0.01, [ED_PER_N_CR_T] = 0.005, [ED_CHI_Z] = 0.5,
  [ED_ELASTIC_Y] = 0.88, [ED_ELASTIC_Z] = 0.64, [ED_A_LT] = 0.75, [ED_LAMBDA_0] = 0.6, [ED_LT_LIMIT] = 0.2,
  [ED_AREA_BY_MODULUS] = 4.0, [ED_C_MY_N] = 0.5, [ED_C_MZ_N] = -0.5};

static void one(const double *constants, int kind, const double *force, const double *response, int mask, double *u)
{
  const double f = 1.0, g = -1.0;
  const int set = 0, gravity = 1;
  int combination[ED_N_CHECKS], station[ED_N_CHECKS];
  CHECK_STATUS(ed_member_checks(1, 1, 1, 1, 1, 1, force, response, &f, &g, &set, &gravity, constants, &kind, &mask, NULL, u,
                                combination, station), ED_OK);
  for (int i = 0; i < ED_N_CHECKS; i++) {
    CHECK_INT(combination[i], mask >> i & 1 ? 0 : -1);
    CHECK_INT(station[i], mask >> i & 1 ? 0 : -1);
  }
}

static void check_by_hand(void)
{
  const double force[F] = {-20.0, 5.0, 30.0, 1e9, -6.0, 2.0}, none[F] = {0.0};
  double u[ED_N_CHECKS];
  one(SIMPLE, ED_I, force, none, (1 << ED_N_CHECKS) - 1, u);
  CHECK_NEAR(u[ED_CHECK_N], 0.2, 1e-15);
  CHECK_NEAR(u[ED_CHECK_V_Y], 0.1, 1e-15);
  CHECK_NEAR(u[ED_CHECK_V_Z], 0.75, 1e-15);
  const double m_y = 6.0 / (20.0 - 0.25 * 8.0); /* rho = (1.5 - 1)^2 */
  CHECK_NEAR(u[ED_CHECK_M_Y], m_y, 1e-15);
  CHECK_NEAR(u[ED_CHECK_M_Z], 0.2, 1e-15);
  const double n = 20.0 / (100.0 - sqrt(3.0) * 0.25 * 40.0), r_y = m_y; /* 20 > 0.5 x 0.75 x 40: not ignored */
  const double left = (1.0 - n) / 0.8;
  CHECK_NEAR(u[ED_CHECK_N_M], fmax(r_y / fmin(left, 1.0), pow(r_y / fmin(left, 1.0), 2.0) + pow(0.2, fmax(5.0 * n, 1.0))), 1e-14);
  CHECK_NEAR(u[ED_CHECK_N_B], 0.4, 1e-15);
  CHECK_NEAR(u[ED_CHECK_M_B], 0.375, 1e-15);
  const double k_yy = 0.9 * (1.0 + 0.5 * 0.25), k_zz = 0.8 * (1.0 + 1.4 * 0.4), k_zy = 1.0 - 0.1 / 0.4 * 0.4;
  CHECK_NEAR(u[ED_CHECK_6_61], 0.25 + k_yy * 0.375 + 0.6 * k_zz * 0.2, 1e-15);
  CHECK_NEAR(u[ED_CHECK_6_62], 0.4 + k_zy * 0.375 + k_zz * 0.2, 1e-15);
  CHECK_NEAR(u[ED_CHECK_BEAM_M], 0.3, 1e-15);
  CHECK_NEAR(u[ED_CHECK_BEAM_N], 0.2 / 0.15, 1e-15);
  CHECK_NEAR(u[ED_CHECK_BEAM_V], 42.0 / 20.0, 1e-15);
  CHECK_NEAR(u[ED_CHECK_COLUMN_V], 1.5, 1e-15);

  one(SIMPLE, ED_CHS | ED_CLASS_3 | ED_NO_TWIST, force, none, 1 << ED_CHECK_N_M | 1 << ED_CHECK_6_62, u);
  CHECK_NEAR(u[ED_CHECK_N_M], n + m_y + 0.2, 1e-15);
  const double e_yy = 0.9 * (1.0 + 0.6 * 0.7 * 0.25), e_zz = 0.8 * (1.0 + 0.6 * 0.4);
  CHECK_NEAR(u[ED_CHECK_6_62], 0.4 + 0.8 * e_yy * 0.375 + e_zz * 0.2, 1e-15);
  CHECK_NEAR(u[ED_CHECK_N], 0.0, 0.0); /* not asked for */
}

/* Annex A with N 20, M_y 6, M_z 2: N / N_cr 0.08, 0.2, 0.1; class 3, then without lateral torsional buckling, then beyond N_cr. */
static void check_annex_a(void)
{
  const double force[F] = {-20.0, 0.0, 0.0, 0.0, -6.0, 2.0}, beyond[F] = {-120.0, 0.0, 0.0, 0.0, 0.0, 2.0}, none[F] = {0.0};
  const int mask = 1 << ED_CHECK_6_61 | 1 << ED_CHECK_6_62;
  const double m_y = 0.375, m_z = 0.2, mu_y = 0.92 / (1.0 - 0.8 * 0.08), mu_z = 0.8 / (1.0 - 0.5 * 0.2);
  const double root = 0.75 * sqrt(6.0 / 20.0 * 4.0);
  const double C_my = 0.94 + 0.06 * root / (1.0 + root), C_mz = 0.7; /* 0.9 + 0.5 x 0.08, 0.8 - 0.5 x 0.2 */
  const double C_mLT = fmax(C_my * C_my * 0.75 / sqrt(0.8 * 0.9), 1.0), y = C_my * C_mLT / 0.92, z = C_mz / 0.8;
  double u[ED_N_CHECKS], constants[ED_N_CONSTANTS];
  one(SIMPLE, ED_I | ED_CLASS_3 | ED_ANNEX_A, force, none, mask, u);
  CHECK_NEAR(u[ED_CHECK_6_61], 0.25 + mu_y * (y * m_y + z * m_z), 1e-15);
  CHECK_NEAR(u[ED_CHECK_6_62], 0.4 + mu_z * (y * m_y + z * m_z), 1e-15);

  memcpy(constants, SIMPLE, sizeof SIMPLE);
  constants[ED_LAMBDA_0] = 0.0;
  one(constants, ED_I | ED_ANNEX_A, force, none, mask, u);
  const double w_y = 1.0 / 0.88, w_z = 1.5, most = 1.2, by = 0.94 / 0.92, turn = 0.6 * sqrt(w_z / w_y), back = 0.6 * sqrt(w_y / w_z);
  const double C_yy = fmax(1.0 + (w_y - 1.0) * (2.0 - 1.6 / w_y * 0.94 * 0.94 * (most + most * most)) * 0.2, 0.88);
  const double C_zz = fmax(1.0 + (w_z - 1.0) * (2.0 - 1.6 / w_z * 0.7 * 0.7 * (most + most * most)) * 0.2, 0.64);
  const double C_yz = fmax(1.0 + (w_z - 1.0) * (2.0 - 14.0 * 0.49 * most * most / pow(w_z, 5.0)) * 0.2, turn * 0.64);
  const double C_zy = fmax(1.0 + (w_y - 1.0) * (2.0 - 14.0 * 0.94 * 0.94 * most * most / pow(w_y, 5.0)) * 0.2, back * 0.88);
  CHECK_NEAR(u[ED_CHECK_6_61], 0.25 + mu_y * (by * m_y / C_yy + z * m_z * turn / C_yz), 1e-14);
  CHECK_NEAR(u[ED_CHECK_6_62], 0.4 + mu_z * (by * m_y * back / C_zy + z * m_z / C_zz), 1e-14);

  one(SIMPLE, ED_I | ED_ANNEX_A, beyond, none, mask, u);
  CHECK(isinf(u[ED_CHECK_6_61]) && isinf(u[ED_CHECK_6_62]));
}

/* A response adds to moments and shears, and to N in tension and in compression. */
static void check_signs(void)
{
  const double force[F] = {10.0, -5.0, 8.0, 0.0, -6.0, 2.0}, response[F] = {30.0, 1.0, 2.0, 0.0, 3.0, 1.0};
  double u[ED_N_CHECKS];
  one(SIMPLE, ED_RHS, force, response, (1 << ED_N_CHECKS) - 1, u);
  CHECK_NEAR(u[ED_CHECK_N], 0.4, 1e-15);
  CHECK_NEAR(u[ED_CHECK_N_B], 20.0 / 50.0, 1e-15);
  CHECK_NEAR(u[ED_CHECK_V_Y], 6.0 / 50.0, 1e-15);
  CHECK_NEAR(u[ED_CHECK_M_B], 9.0 / 16.0, 1e-15);
  CHECK_NEAR(u[ED_CHECK_BEAM_V], 20.0 / 20.0, 1e-15); /* V by gravity, without the response */
}

/* Shear that uses up a section leaves nothing for bending about z; without bending nothing is asked for. */
static void check_used_up(void)
{
  const double force[F] = {0.0, 60.0, 0.0, 0.0, 0.0, 1.0}, no_moment[F] = {0.0, 60.0, 0.0, 0.0, 0.0, 0.0}, none[F] = {0.0};
  double u[ED_N_CHECKS];
  one(SIMPLE, ED_I, force, none, (1 << ED_N_CHECKS) - 1, u);
  CHECK(isinf(u[ED_CHECK_M_Z]) && isinf(u[ED_CHECK_N_M]));
  one(SIMPLE, ED_I, no_moment, none, (1 << ED_N_CHECKS) - 1, u);
  CHECK_NEAR(u[ED_CHECK_M_Z], 0.0, 0.0);
  CHECK_NEAR(u[ED_CHECK_N_M], 0.0, 0.0);
}

/* All shapes and classes under random loads: the pass has the bits of the first combination that gives the most alone. */
static void check_combinations(void)
{
  static double statics[CASES][MEMBERS][STATIONS][F], spectral[DIRECTIONS][MEMBERS][STATIONS][F];
  static double constants[MEMBERS][ED_N_CONSTANTS], u[MEMBERS][ED_N_CHECKS], alone[MEMBERS][ED_N_CHECKS], most[MEMBERS][ED_N_CHECKS];
  static int combination[MEMBERS][ED_N_CHECKS], station[MEMBERS][ED_N_CHECKS], at[MEMBERS][ED_N_CHECKS], of[MEMBERS][ED_N_CHECKS];
  static int first[MEMBERS][ED_N_CHECKS], place[MEMBERS][ED_N_CHECKS];
  static const double scale[F] = {100.0, 50.0, 40.0, 1.0, 20.0, 10.0};
  static double M_b[MEMBERS][COMBINATIONS];
  double f[COMBINATIONS][CASES], g[COMBINATIONS][DIRECTIONS];
  int set[COMBINATIONS], gravity[CASES] = {1, 0}, kind[MEMBERS], masks[MEMBERS][SETS];
  numbers random = {7};
  for (int trial = 0; trial < 100; trial++) {
    const double size = 0.02 * pow(1.04, trial);
    for (int m = 0; m < MEMBERS; m++) {
      memcpy(constants[m], SIMPLE, sizeof SIMPLE);
      kind[m] = m % 3 | (m / 3 == 1 ? ED_CLASS_3 : 0) | (m / 3 == 2 ? ED_NO_TWIST : 0) | (trial % 2 ? ED_ANNEX_A : 0);
      for (int s = 0; s < SETS; s++)
        masks[m][s] = (int)(next_number(&random, 0.0, 1.0) * (1 << ED_N_CHECKS));
      for (int s = 0; s < STATIONS; s++)
        for (int j = 0; j < F; j++) {
          for (int i = 0; i < CASES; i++)
            statics[i][m][s][j] = size * scale[j] * (2.0 * next_number(&random, 0.0, 1.0) - 1.0);
          for (int i = 0; i < DIRECTIONS; i++)
            spectral[i][m][s][j] = size * scale[j] * next_number(&random, 0.0, 1.0);
        }
    }
    for (int k = 0; k < COMBINATIONS; k++) {
      for (int i = 0; i < CASES; i++)
        f[k][i] = k % 5 == 4 ? f[k - 1][i] : 3.0 * next_number(&random, 0.0, 1.0) - 1.5;
      for (int i = 0; i < DIRECTIONS; i++)
        g[k][i] = k % 5 == 4 ? -g[k - 1][i] : k % 3 ? next_number(&random, 0.0, 1.0) : 0.0;
      set[k] = k % 5 == 4 ? set[k - 1] : k % 2;
      for (int m = 0; m < MEMBERS; m++)
        M_b[m][k] = k % 5 == 4 ? M_b[m][k - 1] : SIMPLE[ED_M_B] * (1.0 + next_number(&random, 0.0, 1.0));
    }
    CHECK_STATUS(ed_member_checks(CASES, DIRECTIONS, MEMBERS, STATIONS, COMBINATIONS, SETS, statics[0][0][0], spectral[0][0][0], f[0],
                                  g[0], set, gravity, constants[0], kind, masks[0], trial % 3 ? NULL : M_b[0], u[0], combination[0],
                                  station[0]), ED_OK);
    memset(most, 0, sizeof most);
    memset(first, -1, sizeof first);
    memset(place, -1, sizeof place);
    for (int k = 0; k < COMBINATIONS; k++) {
      double M_b_k[MEMBERS];
      for (int m = 0; m < MEMBERS; m++)
        M_b_k[m] = M_b[m][k];
      CHECK_STATUS(ed_member_checks(CASES, DIRECTIONS, MEMBERS, STATIONS, 1, SETS, statics[0][0][0], spectral[0][0][0], f[k], g[k],
                                    &set[k], gravity, constants[0], kind, masks[0], trial % 3 ? NULL : M_b_k, alone[0], at[0], of[0]),
                   ED_OK);
      for (int m = 0; m < MEMBERS; m++)
        for (int i = 0; i < ED_N_CHECKS; i++)
          if (at[m][i] == 0 && (first[m][i] < 0 || alone[m][i] > most[m][i]))
            most[m][i] = alone[m][i], first[m][i] = k, place[m][i] = of[m][i];
    }
    CHECK_SAME(u[0], most[0], MEMBERS * ED_N_CHECKS);
    for (int m = 0; m < MEMBERS; m++)
      for (int i = 0; i < ED_N_CHECKS; i++) {
        CHECK_INT(combination[m][i], first[m][i]);
        CHECK_INT(station[m][i], place[m][i]);
        CHECK(combination[m][i] % 5 != 4); /* a repetition of the one before it */
      }
  }
}

static void check_arguments(void)
{
  const double force[F] = {1.0}, response[F] = {1.0}, wrong[F] = {INFINITY}, negative[F] = {-1.0}, f = 1.0, g = 1.0;
  double constants[ED_N_CONSTANTS], u[ED_N_CHECKS];
  int set = 0, gravity = 1, kind = ED_I, mask = 1, combination[ED_N_CHECKS], station[ED_N_CHECKS];
  memcpy(constants, SIMPLE, sizeof SIMPLE);
#define CALL(force, response, stations, sets, kinds) \
  ed_member_checks(1, 1, 1, stations, 1, sets, force, response, &f, &g, &set, &gravity, constants, kinds, &mask, NULL, u, combination, \
                   station)
  CHECK_STATUS(CALL(force, response, 1, 1, &kind), ED_OK);
  CHECK_STATUS(CALL(wrong, response, 1, 1, &kind), ED_E_NOT_FINITE);
  CHECK_STATUS(CALL(force, negative, 1, 1, &kind), ED_E_ARGUMENT);
  CHECK_STATUS(CALL(force, response, 0, 1, &kind), ED_E_ARGUMENT);
  CHECK_STATUS(CALL(force, response, 1, 0, &kind), ED_E_ARGUMENT);
  static const int unknown[] = {3, 32, -1};
  for (int i = 0; i < 3; i++)
    CHECK_STATUS(CALL(force, response, 1, 1, &unknown[i]), ED_E_ARGUMENT);
  set = 1;
  CHECK_STATUS(CALL(force, response, 1, 1, &kind), ED_E_ARGUMENT);
  set = 0;
  kind = ED_I | ED_ANNEX_A;
  for (int i = 0; i < ED_N_CONSTANTS; i++) {
    const double kept = constants[i];
    constants[i] = -1.0;
    CHECK_STATUS(CALL(force, response, 1, 1, &kind), ED_E_ARGUMENT);
    constants[i] = NAN;
    CHECK_STATUS(CALL(force, response, 1, 1, &kind), ED_E_NOT_FINITE);
    constants[i] = kept;
  }
  const double none_left = 0.0, infinite = INFINITY, more = 2.0 * SIMPLE[ED_M_B];
#define WITH(M_b) \
  ed_member_checks(1, 1, 1, 1, 1, 1, force, response, &f, &g, &set, &gravity, constants, &kind, &mask, M_b, u, combination, station)
  CHECK_STATUS(WITH(&none_left), ED_E_ARGUMENT);
  CHECK_STATUS(WITH(&infinite), ED_E_ARGUMENT);
  mask = 1 << ED_CHECK_M_B;
  const double bent[F] = {[4] = 8.0}, none[F] = {0.0};
  CHECK_STATUS(ed_member_checks(1, 1, 1, 1, 1, 1, bent, none, &f, &g, &set, &gravity, constants, &kind, &mask, &more, u, combination,
                                station), ED_OK);
  CHECK_NEAR(u[ED_CHECK_M_B], 0.25, 1e-15);
  constants[ED_C_MLT] = 0.25;
  CHECK_STATUS(CALL(force, response, 1, 1, &kind), ED_E_ARGUMENT);
  CHECK_STATUS(ed_member_checks(0, 0, 0, 1, 0, 1, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL), ED_OK);
}

int main(void)
{
  check_by_hand();
  check_annex_a();
  check_signs();
  check_used_up();
  check_combinations();
  check_arguments();
  return checks_end("member checks");
}
