/* Upper bound of the utilisation of a section in bending and axial force. */
#ifndef ED_SECTION_BOUND_H
#define ED_SECTION_BOUND_H

#include "space/member_strength.h"

static const double LINEAR_ONLY = 1e300;

/* max(x, 0) without a branch. A load by a resistance that is used up is infinite, or NaN without load, which bounds nothing. */
static inline double positive(double x)
{
  return 0.5 * (x + fabs(x));
}

/* Not less than `section` for any smaller forces: the linear sum, or what Eq. 6.41 gives for ratios up to 1, whose exponents are at
 * least 2 and 1 (I), 2 (CHS), 1.66 (RHS, taken as 1.5). n^1.7 is not more than n^1.5. `shape` is constant where this is inlined, and
 * nothing branches, so that compilers run the loop around it side by side. linear_only: 0, or so large that the linear sum remains. */
static inline __attribute__((always_inline)) double section_bound(int shape, double a_y, double a_z, double n, double by_web, double m_y,
                                                                  double m_z, double linear_only)
{
  const double left = 1.0 - n, linear = n + m_y + m_z, root = 1.0 - n * sqrt(n);
  const double y_line = 1.0 - positive(1.0 - left / (1.0 - 0.5 * a_y)), z_line = 1.0 - positive(1.0 - left / (1.0 - 0.5 * a_z));
  const double ignored = larger(4.0 * n, by_web) <= 1.0 ? 1.0 : 0.0; /* 6.2.9.1(4) */
  const double beyond = positive(n - a_z) / (1.0 - a_z);
  const double y = shape == ED_CHS ? root : shape == ED_RHS ? y_line : y_line + ignored * (1.0 - y_line);
  const double z = shape == ED_CHS ? root : shape == ED_RHS ? z_line : 1.0 - beyond * beyond;
  const double r_y = m_y / positive(y), r_z = m_z / positive(z), single = larger(r_y, r_z);
  const double p_y = shape == ED_RHS ? r_y * sqrt(r_y) : r_y * r_y;
  const double p_z = shape == ED_RHS ? r_z * sqrt(r_z) : shape == ED_CHS ? r_z * r_z : r_z;
  const double above_1 = positive(larger(n, single) - 1.0);
  return smaller(larger(single, p_y + p_z) + LINEAR_ONLY * above_1 + linear_only, linear);
}

#endif
