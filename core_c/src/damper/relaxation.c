#include "damper/relaxation.h"

#include "base/clones.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Forces below this are nothing; arithmetic with denormal numbers would be slow, and they never reach zero. */
static const double NOTHING = 1e-290;

/* yes or no by the bits of `mask`, all of them 1 or 0: with ?: the compiler would branch. */
static inline double choose(uint64_t mask, double yes, double no)
{
  uint64_t a, b;
  double chosen;
  memcpy(&a, &yes, sizeof a);
  memcpy(&b, &no, sizeof b);
  a = (a & mask) | (b & ~mask);
  memcpy(&chosen, &a, sizeof chosen);
  return chosen;
}

/* exp(-z) = 2^-m exp(-x), x = z - m ln 2, by its power series; 0 <= z <= 708. The C library's function keeps the loop below from
 * being done several branches at a time, and its last bit differs between processors. */
static inline double decay(double z)
{
  static const double SHIFT = 6755399441055744.0; /* 1.5 * 2^52: the sum holds the integer in its lowest bits */
  static const double HIGH = 0x1.62e42fefa3800p-1, LOW = 0x1.ef35793c76730p-45; /* ln 2 */
  const double shifted = z * -1.4426950408889634 + SHIFT, m = shifted - SHIFT;
  const double x = (z + m * HIGH) + m * LOW;
  double series = 1.0 / 6227020800.0;
  series = 1.0 / 479001600.0 - x * series;
  series = 1.0 / 39916800.0 - x * series;
  series = 1.0 / 3628800.0 - x * series;
  series = 1.0 / 362880.0 - x * series;
  series = 1.0 / 40320.0 - x * series;
  series = 1.0 / 5040.0 - x * series;
  series = 1.0 / 720.0 - x * series;
  series = 1.0 / 120.0 - x * series;
  series = 1.0 / 24.0 - x * series;
  series = 1.0 / 6.0 - x * series;
  series = 0.5 - x * series;
  series = 1.0 - x * series;
  series = 1.0 - x * series;
  uint64_t bits;
  double power;
  memcpy(&bits, &shifted, sizeof bits);
  bits = (bits + 1023u) << 52;
  memcpy(&power, &bits, sizeof power);
  return series * power;
}

/* phi_3(-z) = sum (-z)^k / (k + 3)!, 0 <= z <= 1 */
static inline double phi_3(double z)
{
  double series = 1.0 / 6402373705728000.0;
  series = 1.0 / 355687428096000.0 - z * series;
  series = 1.0 / 20922789888000.0 - z * series;
  series = 1.0 / 1307674368000.0 - z * series;
  series = 1.0 / 87178291200.0 - z * series;
  series = 1.0 / 6227020800.0 - z * series;
  series = 1.0 / 479001600.0 - z * series;
  series = 1.0 / 39916800.0 - z * series;
  series = 1.0 / 3628800.0 - z * series;
  series = 1.0 / 362880.0 - z * series;
  series = 1.0 / 40320.0 - z * series;
  series = 1.0 / 5040.0 - z * series;
  series = 1.0 / 720.0 - z * series;
  series = 1.0 / 120.0 - z * series;
  series = 1.0 / 24.0 - z * series;
  return 1.0 / 6.0 - z * series;
}

/* q(h) = exp(-z) q(0) + k h sum v[j] phi_(j+1)(-z), z = r h, with phi_(j+1) = (1/j! - phi_j) / z and phi_0 = exp. That cancels for
 * small z; there the series gives phi_3 and the recursion runs backwards. Both are computed and one taken: no branches. */
ED_CLONES void ed_relax(int n, double h, const double v[3], const double *restrict rate, const double *restrict stiffness,
                        const double *restrict start, double *restrict end, double *const gain[3])
{
  const double v0 = v[0], v1 = v[1], v2 = v[2];
  double *restrict gain0 = gain[0], *restrict gain1 = gain[1], *restrict gain2 = gain[2];
  for (int i = 0; i < n; i++) {
    const double z = rate[i] * h, scale = stiffness[i] * h;
    const uint64_t is_small = z < 1.0 ? ~UINT64_C(0) : 0, is_huge = z > 708.0 ? ~UINT64_C(0) : 0;
    const double small = choose(is_small, z, 1.0), large = choose(is_small, 1.0, z);
    const double near3 = phi_3(small), near2 = 0.5 - small * near3, near1 = 1.0 - small * near2, near0 = 1.0 - small * near1;
    const double inverse = 1.0 / large, far0 = decay(choose(is_huge, 708.0, large));
    const double far1 = (1.0 - far0) * inverse, far2 = (1.0 - far1) * inverse, far3 = (0.5 - far2) * inverse;
    const double factor = choose(is_small, near0, far0);
    const double g0 = scale * choose(is_small, near1, far1);
    const double g1 = scale * choose(is_small, near2, far2);
    const double g2 = scale * choose(is_small, near3, far3);
    const double q = factor * start[i] + (g0 * v0 + g1 * v1 + g2 * v2);
    end[i] = choose(fabs(q) < NOTHING ? ~UINT64_C(0) : 0, 0.0, q);
    gain0[i] = g0;
    gain1[i] = g1;
    gain2[i] = g2;
  }
}
