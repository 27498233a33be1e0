/* A member in bending and compression, EN 1993-1-1, 6.3.3, Annex A. */
#ifndef ED_ANNEX_A_H
#define ED_ANNEX_A_H

#include "space/member_strength.h"

/* k m, where what is infinite asks nothing of a moment that is none */
static inline double times(double k, double m)
{
  return m > 0.0 ? k * m : 0.0;
}

/* C_yy, C_zz of Table A.1; less: b_LT, or e_LT n_pl */
static inline double own_C(double w, double C, double most, double n_pl, double less, double elastic)
{
  return larger(1.0 + (w - 1.0) * ((2.0 - 1.6 / w * C * C * (most + most * most)) * n_pl - less), elastic);
}

/* C_yz, C_zy; less: c_LT or d_LT */
static inline double other_C(double w, double C, double most, double n_pl, double less, double least)
{
  const double w5 = w * w * w * w * w;
  return larger(1.0 + (w - 1.0) * ((2.0 - 14.0 * C * C * most * most / w5) * n_pl - less), least);
}

/* Table A.1; infinite where N reaches an elastic critical force. m_y, m_z: M_y / (chi_LT M_y,Rk), M_z / M_z,Rk by gamma_M1. */
static inline factors annex_a(const member *b, double N_Ed, double M_y_Ed, double m_y, double m_z)
{
  const double *c = b->c;
  const double by_y = N_Ed * c[ED_PER_N_CR_Y], by_z = N_Ed * c[ED_PER_N_CR_Z], by_T = N_Ed * c[ED_PER_N_CR_T];
  if (!(by_y < 1.0 && by_z < 1.0 && by_T < 1.0))
    return (factors){HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
  const double mu_y = (1.0 - by_y) / (1.0 - c[ED_N_B_Y] / c[ED_N_RK] * by_y), mu_z = (1.0 - by_z) / (1.0 - c[ED_CHI_Z] * by_z);
  const double lateral = (1.0 - by_z) * (1.0 - by_T), a_LT = c[ED_A_LT], C_mz = c[ED_C_MZ] + c[ED_C_MZ_N] * by_z;
  double C_my = c[ED_C_MY] + c[ED_C_MY_N] * by_y, C_mLT = 1.0, l_0 = 0.0; /* without lateral torsional buckling */
  if (c[ED_LAMBDA_0] > c[ED_LT_LIMIT] * sqrt(sqrt(lateral))) {
    const double root = N_Ed > 0.0 ? a_LT * sqrt(M_y_Ed / N_Ed * c[ED_AREA_BY_MODULUS]) : HUGE_VAL;
    C_my += (1.0 - C_my) * (root < HUGE_VAL ? root / (1.0 + root) : 1.0);
    C_mLT = larger(C_my * C_my * a_LT / sqrt(lateral), 1.0);
    l_0 = c[ED_LAMBDA_0];
  }
  const double y = C_my * C_mLT / (1.0 - by_y), z = C_mz / (1.0 - by_z);
  if (b->elastic)
    return (factors){y * mu_y, z * mu_y, y * mu_z, z * mu_z};
  const double l_z = c[ED_LAMBDA_Z], most = larger(c[ED_LAMBDA_Y], l_z), n_pl = N_Ed / c[ED_N_RK];
  const double e_y = c[ED_ELASTIC_Y], e_z = c[ED_ELASTIC_Z], w_y = smaller(1.0 / e_y, 1.5), w_z = smaller(1.0 / e_z, 1.5);
  const double l_z4 = l_z * l_z * l_z * l_z, turn = 0.6 * sqrt(w_z / w_y), back = 0.6 * sqrt(w_y / w_z);
  const double b_LT = 0.5 * a_LT * l_0 * l_0 * m_y * m_z;
  const double c_LT = 10.0 * a_LT * l_0 * l_0 / (5.0 + l_z4) * m_y / C_my;
  const double d_LT = 2.0 * a_LT * l_0 / (0.1 + l_z4) * m_y / C_my * m_z / C_mz;
  const double e_LT = 1.7 * a_LT * l_0 / (0.1 + l_z4) * m_y / C_my;
  return (factors){y * mu_y / own_C(w_y, C_my, most, n_pl, b_LT, e_y),
                   z * mu_y / other_C(w_z, C_mz, most, n_pl, c_LT, turn * e_z) * turn,
                   y * mu_z / other_C(w_y, C_my, most, n_pl, d_LT, back * e_y) * back,
                   z * mu_z / own_C(w_z, C_mz, most, n_pl, e_LT * n_pl, e_z)};
}

#endif
