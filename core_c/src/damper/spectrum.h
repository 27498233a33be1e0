/* Prony series of functions that fractional derivatives lead to: f(t) = int weight(r) exp(-r t) dr, weight > 0, by trapezoids in
 * ln r, which converge exponentially. Branches between ED_SLOWEST and ED_FASTEST are ED_SPACING apart or closer; all slower ones
 * become one with the same sum of k and of k r, all faster ones one with the same sum of k/r and of k/r^2. So every coefficient is
 * positive whatever the accuracy (the law can give no energy), nothing is left of f after a long time, and for orders near 0 and 1
 * the end branches turn into a spring and a dashpot; for orders below 1e-14 that is all there is. */
#ifndef ED_SPECTRUM_H
#define ED_SPECTRUM_H

#include "damper/prony.h"

static const double ED_SLOWEST = 1e-4, ED_FASTEST = 4e4; /* rates, 1/s */
static const double ED_SPACING = 0.9;                    /* in ln r */

/* t^-alpha / Gamma(1 - alpha), 0 < alpha < 1. Spring and dashpot of the series are zero, but for orders below 1e-14. */
void ed_spectrum_of_power(ed_prony *series, double alpha);
/* E_alpha(-t^alpha / a), or minus its derivative, 0 < alpha < 1. */
void ed_spectrum_of_mittag_leffler(ed_prony *series, double alpha, double a, int derivative);

#endif
