/* Four doubles as one vector: the widest whose comparisons every instruction set with doubles has. Where a processor has no such
 * vectors the compiler splits them; the operations and their order are the same, and so are the bits.
 *
 * Vectors go by address: by value they would be passed otherwise with AVX than without. */
#ifndef ED_LANES_H
#define ED_LANES_H

enum { ED_LANE_WIDTH = 4 };

typedef double ed_lanes __attribute__((vector_size(ED_LANE_WIDTH * sizeof(double))));
typedef long long ed_mask __attribute__((vector_size(ED_LANE_WIDTH * sizeof(long long))));
typedef unsigned long long ed_bits __attribute__((vector_size(ED_LANE_WIDTH * sizeof(unsigned long long))));
/* From and to anywhere. */
typedef double ed_loose __attribute__((vector_size(ED_LANE_WIDTH * sizeof(double)), aligned(sizeof(double)), may_alias));

#define ED_LOAD(from) (*(const ed_loose *)(const void *)(from))
#define ED_STORE(to, what) (*(ed_loose *)(void *)(to) = (what))
#define ED_SELECT(condition, yes, no) ((ed_lanes)(((condition) & (ed_mask)(yes)) | (~(condition) & (ed_mask)(no))))
#define ED_INLINE static inline __attribute__((always_inline))
/* Whether any lane holds. */
#define ED_ANY(condition) (ed_lanes_bits(&(condition)) != 0)

/* Bits of 1, of sqrt(1/2), of the mantissa, of the sign, and of 2^52, in whose last bits a small whole number stands. */
#define ED_ONE 0x3ff0000000000000u
#define ED_HALF_ROOT 0x3fe6a09e667f3bcdu
#define ED_MANTISSA 0x000fffffffffffffu
#define ED_SIGN 0x8000000000000000u
#define ED_WHOLE 0x4330000000000000u

/* y = |x|. */
ED_INLINE void ed_lanes_size(const ed_lanes *x, ed_lanes *y)
{
  *y = (ed_lanes)((ed_bits)*x & ~ED_SIGN);
}

/* Lanes where a condition holds, as bits 1, 2, 4, 8 times `weight`. */
#define ED_WEIGHTED(condition, weight) ((condition) & (ed_mask){1 * (weight), 2 * (weight), 4 * (weight), 8 * (weight)})

/* The sum of the bits of all lanes, where no two have one in common. */
ED_INLINE int ed_lanes_bits(const ed_mask *weighted)
{
  typedef long long half __attribute__((vector_size(2 * sizeof(long long))));
  half low, high;
  __builtin_memcpy(&low, weighted, sizeof low);
  __builtin_memcpy(&high, (const char *)weighted + sizeof low, sizeof high);
  low |= high;
  return (int)(low[0] | low[1]);
}

/* y = log2 x, x positive and normal. x = 2^k m with m between sqrt(1/2) and sqrt(2); ln m = 2 artanh((m - 1) / (m + 1)), a series in
 * the square of that. */
ED_INLINE void ed_lanes_log2(const ed_lanes *x, ed_lanes *y)
{
  static const double C[] = {
      0x1.71547652b82fep+1, 0x1.ec709dc3a03fep-1, 0x1.2776c50ef9bfep-1, 0x1.a61762a7adedap-2,
      0x1.484b13d7c02a9p-2, 0x1.0c9a84994022dp-2, 0x1.c68f568d31761p-3, 0x1.89f3b1694cffep-3,
      0x1.5b9ac9b743f0dp-3, 0x1.3703c1f4d0ffep-3, 0x1.1964ec6fc9491p-3};
  const ed_bits moved = (ed_bits)*x + (ED_ONE - ED_HALF_ROOT);
  const ed_lanes k = (ed_lanes)((moved >> 52) | ED_WHOLE) - (0x1p52 + 1023.0);
  const ed_lanes m = (ed_lanes)((moved & ED_MANTISSA) + ED_HALF_ROOT), t = (m - 1.0) / (m + 1.0), s = t * t, s2 = s * s, s4 = s2 * s2;
  const ed_lanes low = C[1] + s * C[2] + s2 * (C[3] + s * C[4]);
  const ed_lanes high = C[5] + s * C[6] + s2 * (C[7] + s * C[8]) + s4 * (C[9] + s * C[10]);
  *y = k + (C[0] * t + t * s * (low + s4 * high));
}

/* y = 2^x, |x| <= 1000. x = n + f with n whole, and 2^f by its series. */
ED_INLINE void ed_lanes_exp2(const ed_lanes *x, ed_lanes *y)
{
  /* ln(2)^k / k!, k from 1 */
  static const double C[] = {
      0x1.62e42fefa39efp-1, 0x1.ebfbdff82c58ep-3, 0x1.c6b08d704a0bfp-5, 0x1.3b2ab6fba4e77p-7,
      0x1.5d87fe78a6730p-10, 0x1.430912f86c786p-13, 0x1.ffcbfc588b0c5p-17, 0x1.62c0223a5c822p-20,
      0x1.b5253d395e7c1p-24, 0x1.e4cf5158b8ec7p-28, 0x1.e8cac7351bb22p-32, 0x1.c3bd650fc2983p-36,
      0x1.816193166d0f7p-40};
  /* Adding and taking away 1.5 2^52 rounds to a whole number, which stands in the last bits in between. */
  static const double ROUNDER = 0x1.8p52;
  const ed_lanes rounded = *x + ROUNDER, f = *x - (rounded - ROUNDER), f2 = f * f, f4 = f2 * f2, f8 = f4 * f4;
  const ed_lanes low = C[1] + f * C[2] + f2 * (C[3] + f * C[4]);
  const ed_lanes middle = C[5] + f * C[6] + f2 * (C[7] + f * C[8]);
  const ed_lanes high = C[9] + f * C[10] + f2 * (C[11] + f * C[12]);
  *y = (1.0 + (f * C[0] + f2 * (low + f4 * middle + f8 * high))) * (ed_lanes)(((ed_bits)rounded << 52) + ED_ONE);
}

#endif
