/* Response spectra against closed solutions of the oscillator's equation (Chopra 2012, 3.2 and 4.4 to 4.6), and what must not
 * change a bit: the other oscillators, zeros at the end, outputs that are not asked for. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"

#include <math.h>
#include <stdlib.h>

enum { N = 20000 };
static const double DT = 0.01;
static const double ROUNDING = 1e-11; /* of 20 000 steps */

static double sd_of(int n, const double *a, double period, double damping)
{
  double sd = NAN;
  CHECK_STATUS(ed_response_spectrum(n, DT, a, 1, &period, &damping, &sd, NULL, NULL, NULL), ED_OK);
  return sd;
}

static double squared(double x)
{
  return x * x;
}

/* Constant acceleration from rest: peak (1 + exp(-pi zeta / sqrt(1 - zeta^2))) / omega^2; undamped also velocity 1 / omega and
 * absolute acceleration 2 (the load ends after whole cycles and leaves nothing). Damped peaks lie between samples: the harmonic
 * through three of them misses by (2 pi / 50)^4 zeta. */
static void check_step(double *a)
{
  for (int i = 0; i < N; i++)
    a[i] = 1.0;
  for (double zeta = 0.0; zeta < 0.95; zeta += 0.1) {
    const double period = 0.5123, expected = 1.0 + exp(-M_PI * zeta / sqrt(1.0 - zeta * zeta));
    CHECK_NEAR(sd_of(N, a, period, zeta) * squared(2.0 * M_PI / period) / expected, 1.0, zeta == 0.0 ? ROUNDING : 1e-4);
  }
  const double period[2] = {0.25, 40.0}, damping[2] = {0.0, 0.0};
  double sd[2], sv[2], sa[2];
  CHECK_STATUS(ed_response_spectrum(N, DT, a, 2, period, damping, sd, sv, sa, NULL), ED_OK);
  for (int i = 0; i < 2; i++) {
    CHECK_NEAR(sv[i] * 2.0 * M_PI / period[i], 1.0, ROUNDING);
    CHECK_NEAR(sa[i], 2.0, 2.0 * ROUNDING);
  }
}

/* A ramp to 1 in t1, then constant: 1 + |sin(pi t1 / T)| / (pi t1 / T), undamped. */
static void check_ramp(double *a)
{
  for (int steps = 3; steps < 200; steps += 7) {
    for (int i = 0; i < N; i++)
      a[i] = i < steps ? (double)i / steps : 1.0;
    const double period = 0.77, x = M_PI * steps * DT / period;
    CHECK_NEAR(sd_of(N, a, period, 0.0) * squared(2.0 * M_PI / period), 1.0 + fabs(sin(x)) / x, ROUNDING);
  }
}

/* Resonance: the amplitude under sin(omega t) grows to (1 - exp(-zeta omega t)) / (2 zeta omega^2), or omega t / 2 / omega^2.
 * Linear interpolation of a harmonic with `steps` samples a period has (sin x / x)^2 of it, x = pi / steps. */
static void check_resonance(double *a)
{
  const int steps = 100, cycles = 50;
  const double period = steps * DT, omega = 2.0 * M_PI / period, share = squared(sin(M_PI / steps) / (M_PI / steps));
  for (int i = 0; i < N; i++)
    a[i] = sin(omega * i * DT);
  const int n = steps * cycles + 1;
  /* undamped, the extremum before the end: u = (sin - omega t cos) / 2 / omega^2 at omega t = 2 pi cycles */
  CHECK_NEAR(sd_of(n, a, period, 0.0) * omega * omega / share, M_PI * cycles, 1e-4 * M_PI * cycles);
  CHECK_NEAR(sd_of(N, a, period, 0.05) * omega * omega / share, 10.0, 10.0 * 1e-5);
}

/* After a short pulse the undamped oscillator vibrates with |integral of a exp(i omega t)| / omega: n samples of 1, and the fall to
 * zero in the step after them. */
static void check_free_vibration(double *a)
{
  for (int n = 2; n < 40; n++) {
    for (int i = 0; i < n; i++)
      a[i] = 1.0;
    const double period = 3.0, omega = 2.0 * M_PI / period, t = (n - 1) * DT, w = omega * DT;
    double real = sin(omega * t) / omega, imaginary = (1.0 - cos(omega * t)) / omega;
    const double c = (1.0 - cos(w)) / (w * w) * DT, s = (w - sin(w)) / (w * w) * DT; /* integral of (1 - x) exp(i w x) */
    real += c * cos(omega * t) - s * sin(omega * t);
    imaginary += c * sin(omega * t) + s * cos(omega * t);
    CHECK_NEAR(sd_of(n, a, period, 0.0) * omega / hypot(real, imaginary), 1.0, ROUNDING);
  }
}

/* 77 oscillators together, one by one, and without the outputs that are not asked for; zeros after the end. */
static void check_same_bits(double *a)
{
  enum { M = 77, LENGTH = 3000 };
  double period[M], damping[M], sd[M], sv[M], sa[M], one[3], alone[M], longer[M];
  numbers source = {7};
  for (int i = 0; i < N; i++)
    a[i] = i < LENGTH ? next_number(&source, -1.0, 1.0) : 0.0;
  for (int i = 0; i < M; i++)
    period[i] = ED_MIN_PERIOD_STEPS * DT * exp(0.1 * i), damping[i] = i % 4 * 0.1;
  CHECK_STATUS(ed_response_spectrum(LENGTH, DT, a, M, period, damping, sd, sv, sa, NULL), ED_OK);
  CHECK_STATUS(ed_response_spectrum(LENGTH, DT, a, M, period, damping, alone, NULL, NULL, NULL), ED_OK);
  CHECK_SAME(alone, sd, M);
  CHECK_STATUS(ed_response_spectrum(N, DT, a, M, period, damping, longer, NULL, NULL, NULL), ED_OK);
  CHECK_SAME(longer, sd, M);
  for (int i = 0; i < M; i++) {
    CHECK_STATUS(ed_response_spectrum(LENGTH, DT, a, 1, period + i, damping + i, one, one + 1, one + 2, NULL), ED_OK);
    CHECK_SAME(one, sd + i, 1);
    CHECK_SAME(one + 1, sv + i, 1);
    CHECK_SAME(one + 2, sa + i, 1);
  }
}

/* A silent hour in the record, over which states decay past the smallest numbers, changes nothing. */
static void check_silence(void)
{
  enum { LONG = 360000 };
  double *a = calloc(LONG, sizeof *a);
  if (!a)
    return;
  a[10] = 1.0;
  a[2000] = 1e-3;
  const double before = sd_of(2001, a, 0.1, 0.05);
  a[2000] = 0.0;
  a[LONG - 1] = 1e-3;
  const double after = sd_of(LONG, a, 0.1, 0.05);
  CHECK_SAME(&after, &before, 1);
  free(a);
}

/* Components cos(phi) a and sin(phi) a: the peak towards theta is |cos(theta - phi)| of that along the motion. */
static void check_rotated(double *a, double *b)
{
  enum { M = 40, ANGLES = 180, LENGTH = 2000 };
  static double sd[M * ANGLES];
  double period[M], damping[M], along[M];
  const double phi = 0.6;
  numbers source = {3};
  for (int i = 0; i < M; i++)
    period[i] = 0.05 * exp(0.12 * i), damping[i] = 0.05;
  for (int i = 0; i < LENGTH; i++)
    a[i] = next_number(&source, -1.0, 1.0);
  CHECK_STATUS(ed_response_spectrum(LENGTH, DT, a, M, period, damping, along, NULL, NULL, NULL), ED_OK);
  for (int i = 0; i < LENGTH; i++)
    b[i] = sin(phi) * a[i], a[i] *= cos(phi);
  CHECK_STATUS(ed_rotated_spectrum(LENGTH, DT, a, b, M, period, damping, ANGLES, sd, NULL), ED_OK);
  for (int i = 0; i < M; i++)
    for (int k = 0; k < ANGLES; k++)
      CHECK_NEAR(sd[i * ANGLES + k] / along[i], fabs(cos(M_PI * k / ANGLES - phi)), ROUNDING);
}

static void check_errors(double *a)
{
  const double good[2] = {1.0, 0.05};
  double sd = -1.0, sv;
  for (int i = 0; i < 10; i++)
    a[i] = 1.0;
  CHECK_STATUS(ed_response_spectrum(0, DT, a, 1, good, good + 1, &sd, NULL, NULL, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_response_spectrum(10, DT, a, 1, good, good + 1, NULL, NULL, NULL, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_response_spectrum(10, DT, a, 1, good, good + 1, &sd, &sv, NULL, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_response_spectrum(10, DT, a, -1, good, good + 1, &sd, NULL, NULL, NULL), ED_E_ARGUMENT);
  const double steps[] = {0.0, -0.01, NAN, INFINITY};
  for (int i = 0; i < 4; i++)
    CHECK_STATUS(ed_response_spectrum(10, steps[i], a, 1, good, good + 1, &sd, NULL, NULL, NULL), ED_E_ARGUMENT);
  const double periods[] = {0.0, -1.0, 0.039, NAN, INFINITY};
  for (int i = 0; i < 5; i++)
    CHECK_STATUS(ed_response_spectrum(10, DT, a, 1, periods + i, good + 1, &sd, NULL, NULL, NULL), ED_E_ARGUMENT);
  const double dampings[] = {-0.01, 1.0, 5.0, NAN};
  for (int i = 0; i < 4; i++)
    CHECK_STATUS(ed_response_spectrum(10, DT, a, 1, good, dampings + i, &sd, NULL, NULL, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_rotated_spectrum(10, DT, a, a, 1, good, good + 1, 0, &sd, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_rotated_spectrum(10, DT, a, a, 1, good, good + 1, ED_MAX_ANGLES + 1, &sd, NULL), ED_E_ARGUMENT);
  CHECK(sd == -1.0);
  CHECK_STATUS(ed_response_spectrum(10, DT, a, 0, good, good + 1, &sd, NULL, NULL, NULL), ED_OK);
  const double wrong[] = {NAN, INFINITY, -INFINITY};
  for (int i = 0; i < 3; i++)
    for (int at = 0; at < 10; at += 3) {
      a[at] = wrong[i];
      CHECK_STATUS(ed_response_spectrum(10, DT, a, 1, good, good + 1, &sd, NULL, NULL, NULL), ED_E_NOT_FINITE);
      CHECK_STATUS(ed_rotated_spectrum(10, DT, a, a, 1, good, good + 1, 1, &sd, NULL), ED_E_NOT_FINITE);
      a[at] = 1.0;
    }
}

int main(void)
{
  static double a[N], b[N];
  check_step(a);
  check_ramp(a);
  check_resonance(a);
  check_free_vibration(a);
  check_same_bits(a);
  check_silence();
  check_rotated(a, b);
  check_errors(a);
  return checks_end("response_spectrum");
}
