/* Strength of steel sections and members, EN 1993-1-1: clauses as functions of plain numbers. */
#ifndef ED_MEMBER_STRENGTH_H
#define ED_MEMBER_STRENGTH_H

#include "edcore.h"

#include <math.h>

enum { N, V_Y, V_Z, T, M_Y, M_Z, FORCES };

typedef struct {
  const double *c;             /* constants, ED_N_RD ... */
  double per[ED_N_CONSTANTS];  /* 1 / c of resistances */
  int shape, elastic, twists, annex_a;
} member;

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
  const double over = larger(2.0 * v - 1.0, 0.0);
  return smaller(over * over, 1.0);
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

/* Whether a smaller n, that of the other sign of a response, may give more in `section`: where its powers are less. */
static inline int powers_grow(const member *b, double n)
{
  return !b->elastic && (b->shape == ED_RHS || (b->shape == ED_I && n > 0.2));
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

#endif
