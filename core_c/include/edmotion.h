/* Oscillators under ground acceleration, and peaks of recursions. */
#ifndef EDMOTION_H
#define EDMOTION_H

#include "edstatus.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Largest magnitudes of relative displacement, relative velocity and absolute acceleration of oscillators that start at rest,
 * during the motion and in the free vibration after it. The acceleration (n >= 1 samples dt apart) is linear between samples and
 * falls to zero within one step after the last. Between samples the peak is that of a harmonic of the oscillator's frequency
 * through three of them. period (time), damping (ratio of critical), sd, sv, sa: n_oscillators each; sv and sa may both be NULL.
 * Periods are at least ED_MIN_PERIOD_STEPS dt; 0 <= damping < 1. The result of an oscillator is the same bit for bit whatever the
 * others are. stop: may be NULL. ED_E_ARGUMENT: one of these is out of range, and nothing is written; ED_E_NOT_FINITE: a sample or a
 * result is not finite, and what is written is of no use, as after ED_E_STOPPED. */
#define ED_MIN_PERIOD_STEPS 4
int ed_response_spectrum(int n, double dt, const double *acceleration, int n_oscillators, const double *period,
                         const double *damping, double *sd, double *sv, double *sa, const ed_stop *stop);
/* Largest displacements under two components at right angles, in the directions k pi / n_angles from the first towards the
 * second, k = 0 .. n_angles - 1 (1 <= n_angles <= ED_MAX_ANGLES). first, second: n samples each. sd: n_oscillators x n_angles,
 * the angles of an oscillator side by side. Otherwise as above; also ED_E_MEMORY. */
#define ED_MAX_ANGLES 360
int ed_rotated_spectrum(int n, double dt, const double *first, const double *second, int n_oscillators,
                        const double *period, const double *damping, int n_angles, double *sd, const ed_stop *stop);

/* Local maxima of |y|, largest first, of recursions y_i = b0 x_i + b1 x_(i-1) + b2 x_(i-2) - a1 y_(i-1) - a2 y_(i-2) from rest.
 * samples: x, n >= 3. numerator: b0 b1 b2, denominator: a1 a2 of each recursion. Those from `share` (0..1) of the largest sample on
 * are kept, at most `most` (>= 1) of each. count: n_recursions; place (in samples from the first, between them by a parabola) and
 * value (signed): n_recursions x most, of which the first `count` are set. Also ED_E_MEMORY, ED_E_NOT_FINITE, ED_E_STOPPED. */
int ed_recursion_peaks(int n, const double *samples, int n_recursions, const double *numerator, const double *denominator,
                       double share, int most, int *count, double *place, double *value, const ed_stop *stop);

#ifdef __cplusplus
}
#endif

#endif
