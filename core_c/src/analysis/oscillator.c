#include "analysis/oscillator.h"

#include "edcore.h"

#include <math.h>

int ed_oscillators_valid(int n_samples, double dt, int n, const double *period, const double *damping)
{
  if (n_samples < 1 || !(dt > 0.0) || !isfinite(dt) || n < 0)
    return 0;
  for (int i = 0; i < n; i++)
    if (!(period[i] >= ED_MIN_PERIOD_STEPS * dt) || !isfinite(period[i]) || !(damping[i] >= 0.0 && damping[i] < 1.0))
      return 0;
  return 1;
}

/* Columns: start at u = 1, at v = 1, acceleration 1 - t, acceleration t. A power series of the solution after one step loses
 * nothing when h is small, where the closed forms cancel. With h <= pi/2 its terms soon fall. */
void ed_oscillator_set(ed_oscillator *o, double period, double zeta)
{
  enum { N = 4, TERMS = 40 };
  const double load[2][N] = {{0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, -1.0, 1.0}};
  const double h = 2.0 * M_PI / period, stiffness = h * h, damping = 2.0 * zeta * h;
  double c0[N] = {1.0, 0.0, 0.0, 0.0}, c1[N] = {0.0, 1.0, 0.0, 0.0}; /* coefficients of t^k and t^(k+1) */
  double u[N] = {1.0, 1.0, 0.0, 0.0}, v[N] = {0.0, 1.0, 0.0, 0.0};
  double size = 1.0;
  for (int k = 0; k < TERMS && size > 1e-18 * stiffness; k++) {
    const double share = 1.0 / ((k + 1.0) * (k + 2.0));
    size = 0.0;
    for (int j = 0; j < N; j++) {
      const double c2 = -share * (damping * (k + 1) * c1[j] + stiffness * c0[j] + (k < 2 ? load[k][j] : 0.0));
      u[j] += c2;
      v[j] += (k + 2) * c2;
      size += fabs(c1[j]) + fabs(c2);
      c0[j] = c1[j];
      c1[j] = c2;
    }
  }
  o->h = h;
  o->zeta = zeta;
  for (int j = 0; j < 2; j++)
    o->E[0][j] = u[j], o->E[1][j] = v[j];
  o->P[0] = u[2], o->P[1] = v[2];
  o->Q[0] = u[3], o->Q[1] = v[3];
  o->fit[0] = 0.5 / (sin(0.5 * h) * sin(0.5 * h));
  o->fit[1] = 1.0 / sin(h);
  o->worth = 1.0 - 0.25 * h * h; /* twice what a harmonic gains between samples, 1 - cos(h / 2) */
}

double ed_free_peak(const ed_oscillator *o, double x, double rate)
{
  const double root = sqrt(1.0 - o->zeta * o->zeta), damped = o->h * root;
  const double sine = (rate + o->zeta * o->h * x) / damped; /* x(t) = exp(-zeta h t) (x cos + sine sin)(damped t) */
  /* the rate vanishes where tan(damped t) = damped rate / (h^2 x + zeta h rate); the first extremum is the largest */
  double phase = atan2(damped * rate, o->h * o->h * x + o->zeta * o->h * rate);
  if (phase < 0.0)
    phase += M_PI;
  const double peak = exp(-o->zeta / root * phase) * (x * cos(phase) + sine * sin(phase));
  return fmax(fabs(x), fabs(peak));
}

double ed_peak_between(const ed_oscillator *o, double before, double middle, double after)
{
  const double A = (middle - 0.5 * (before + after)) * o->fit[0], B = 0.5 * (after - before) * o->fit[1];
  return fabs(middle - A + copysign(sqrt(A * A + B * B), A));
}
