/* A damped oscillator under ground acceleration that is linear between samples, advanced exactly from sample to sample
 * (Nigam & Jennings 1969). Time is in steps, displacement u in acceleration times step^2: u'' + 2 zeta h u' + h^2 u = -a. */
#ifndef ED_OSCILLATOR_H
#define ED_OSCILLATOR_H

/* x = (u, v): x_next = E x + P a + Q a_next */
typedef struct {
  double h, zeta; /* circular frequency in rad a step, ratio of critical damping */
  double E[2][2], P[2], Q[2];
  double fit[2]; /* 1 / (1 - cos h), 1 / sin h */
  double worth;  /* share of the largest sample so far from which another may have a larger value beside it */
} ed_oscillator;

/* Whether there is a motion and all periods (at least ED_MIN_PERIOD_STEPS dt) and dampings (0 <= zeta < 1) are in range. */
int ed_oscillators_valid(int n_samples, double dt, int n, const double *period, const double *damping);

void ed_oscillator_set(ed_oscillator *oscillator, double period_in_steps, double zeta);

/* Largest |x| of a free vibration that starts at x with the rate x'; x may be u, v or the absolute acceleration. */
double ed_free_peak(const ed_oscillator *oscillator, double x, double rate);

/* Largest |y| beside the middle one of three samples, which is not less than the others, of the curve A cos + B sin + C of the
 * oscillator's frequency through them. */
double ed_peak_between(const ed_oscillator *oscillator, double before, double middle, double after);

#endif
