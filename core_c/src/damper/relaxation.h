/* Exact step of q' = k v - r q under a quadratic velocity, for many branches at once. */
#ifndef ED_RELAXATION_H
#define ED_RELAXATION_H

/* v(s) = v[0] + v[1] (s/h) + v[2] (s/h)^2 / 2 for 0 <= s <= h. Writes q(h) of the n branches into `end` and their gains
 * dq(h)/dv[0..2] into gain[0..2]; returns nothing that is not finite unless the input or the result is. h > 0, rate >= 0. */
void ed_relax(int n, double h, const double v[3], const double *rate, const double *stiffness, const double *start, double *end,
              double *const gain[3]);

#endif
