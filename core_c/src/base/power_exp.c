#include "base/power_exp.h"

#include "base/clones.h"

#include <stdint.h>
#include <string.h>

/* Bits of 1, of sqrt(1/2), of the mantissa, and of 2^52, in whose last bits a small whole number stands. */
static const uint64_t ONE = 0x3ff0000000000000u, HALF_ROOT = 0x3fe6a09e667f3bcdu, MANTISSA = 0x000fffffffffffffu,
                      WHOLE = 0x4330000000000000u;
static const double LN2_HIGH = 0x1.62e42fefa38p-1, LN2_LOW = 0x1.ef35793c7673p-45, LOG2_E = 0x1.71547652b82fep+0;
/* Adding and taking away 1.5 2^52 rounds to a whole number, which stands in the last bits in between. */
static const double ROUNDER = 0x1.8p52;
static const double LARGEST = 700.0, LEAST = 1e-300;
static const uint64_t SIZE = 0x7fffffffffffffffu;

static inline uint64_t bits_of(double x)
{
  uint64_t bits;
  memcpy(&bits, &x, sizeof bits);
  return bits;
}

static inline double of_bits(uint64_t bits)
{
  double x;
  memcpy(&x, &bits, sizeof x);
  return x;
}

/* Positive numbers are in the order of their bits. Comparing these leaves no branch that would keep the loop from becoming vectors. */
static inline double at_least(double x, double least)
{
  const int64_t own = (int64_t)bits_of(x), bound = (int64_t)bits_of(least);
  return of_bits((uint64_t)(own > bound ? own : bound));
}

static inline double within(double x, double largest)
{
  const uint64_t bits = bits_of(x);
  const int64_t own = (int64_t)(bits & SIZE), bound = (int64_t)bits_of(largest);
  return of_bits((bits & ~SIZE) | (uint64_t)(own < bound ? own : bound));
}

/* x = 2^k m with m between sqrt(1/2) and sqrt(2); ln m = 2 artanh((m - 1) / (m + 1)), a series in the square of that. */
static inline double natural_log(double x)
{
  const uint64_t moved = bits_of(x) + (ONE - HALF_ROOT);
  const double k = of_bits((moved >> 52) | WHOLE) - (0x1p52 + 1023.0);
  const double m = of_bits((moved & MANTISSA) + HALF_ROOT), t = (m - 1.0) / (m + 1.0), s = t * t, s2 = s * s, s4 = s2 * s2;
  const double low = 1.0 / 3.0 + s * (1.0 / 5.0) + s2 * (1.0 / 7.0 + s * (1.0 / 9.0));
  const double high = 1.0 / 11.0 + s * (1.0 / 13.0) + s2 * (1.0 / 15.0 + s * (1.0 / 17.0)) + s4 * (1.0 / 19.0 + s * (1.0 / 21.0));
  return k * LN2_HIGH + (2.0 * t + (2.0 * t * s * (low + s4 * high) + k * LN2_LOW));
}

/* x = n ln 2 + r, and e^r by its series. */
static inline double exponential(double x)
{
  const double rounded = x * LOG2_E + ROUNDER, n = rounded - ROUNDER;
  const double r = (x - n * LN2_HIGH) - n * LN2_LOW, r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
  const double low = 1.0 / 2.0 + r * (1.0 / 6.0) + r2 * (1.0 / 24.0 + r * (1.0 / 120.0));
  const double middle = 1.0 / 720.0 + r * (1.0 / 5040.0) + r2 * (1.0 / 40320.0 + r * (1.0 / 362880.0));
  const double high = 1.0 / 3628800.0 + r * (1.0 / 39916800.0) + r2 * (1.0 / 479001600.0 + r * (1.0 / 6227020800.0));
  return (1.0 + (r + r2 * (low + r4 * middle + r8 * high))) * of_bits((bits_of(rounded) << 52) + ONE);
}

ED_CLONES void ed_power_exp(int n, double power, const double *restrict base, const double *restrict rise,
                            double *restrict result)
{
  for (int from = 0; from < n; from += ED_POWER_BLOCK)
    for (int i = from; i < from + ED_POWER_BLOCK; i++)
      result[i] = exponential(within(power * natural_log(at_least(base[i], LEAST)) + rise[i], LARGEST));
}
