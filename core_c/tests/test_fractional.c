/* Laws with fractional derivatives: their series stay positive and small for every order, and follow closed forms of ramp and
 * hold, with the power function for Kelvin, with erfc for order 1/2 (Abramowitz & Stegun 7.1). */
#include "checks.h"
#include "damper/spectrum.h"
#include "damper_rig.h"
#include "edcore.h"

#include <complex.h>
#include <math.h>

/* Documented accuracy of the series from 1e-3 to 1e2 s; ramps and holds keep it from 1e-4 s to 2e3 s. */
static const double ACCURACY = 1e-3;

static const double ORDERS[] = {1e-9, 1e-4, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 0.9999, 1.0 - 1e-12};
enum { N_ORDERS = sizeof ORDERS / sizeof *ORDERS };

static void check_series(const ed_prony *series)
{
  CHECK(series->branches >= 1 && series->branches <= 40); /* cost, and ED_MAX_ODE */
  CHECK_NEAR(series->spring, 0.0, 0.0);
  CHECK_NEAR(series->dashpot, 0.0, 0.0);
  for (int i = 0; i < series->branches; i++) {
    CHECK(series->rate[i] > 0.0 && isfinite(series->rate[i]));
    CHECK(series->stiffness[i] > 0.0 && isfinite(series->stiffness[i]));
    CHECK(i == 0 || series->rate[i] > series->rate[i - 1] * (1.0 - 1e-12));
  }
}

/* sum k_i i w / (r_i + i w) = (i w)^alpha, nearly out to both ends of the rates, where the branches there count. */
static void check_power(double alpha)
{
  ed_prony series;
  ed_spectrum_of_power(&series, alpha);
  check_series(&series);
  for (double omega = 2e-3; omega < 1e4; omega *= 1.3) {
    double complex sum = 0.0;
    for (int i = 0; i < series.branches; i++)
      sum += series.stiffness[i] * I * omega / (series.rate[i] + I * omega);
    CHECK_NEAR(cabs(sum / cpow(I * omega, alpha) - 1.0), 0.0, 1e-3);
  }
}

/* The spectrum of E_alpha(-t^alpha / a) sums to E_alpha(0) = 1, that of the derivative has the integral 1. The series keep it but
 * for what the one branch at either end leaves out, which is nothing where the spectrum is narrow and inside the range. */
static void check_sums(double alpha, double a)
{
  const double trapezoids = 1e-7; /* 4 pi^2 / 0.9 exp(-2 pi^2 / 0.9) for the density of this spectrum, orders near 1 */
  double sum[2] = {0.0};
  for (int derivative = 0; derivative < 2; derivative++) {
    ed_prony series;
    ed_spectrum_of_mittag_leffler(&series, alpha, a, derivative);
    check_series(&series);
    for (int i = 0; i < series.branches; i++)
      sum[derivative] += series.stiffness[i] / (derivative ? series.rate[i] : 1.0);
    CHECK(sum[derivative] < 1.0 + 2e-6); /* end sums of small orders */
    if (alpha > 0.95 && a > 0.01 && a < 100.0)
      CHECK_NEAR(sum[derivative], 1.0, alpha > 0.999 ? trapezoids + 1e-4 * (1.0 - alpha) : 1e-4);
  }
  /* where all of it is beyond one end, that end has all of it */
  if (alpha >= 0.1 && a == 1e300)
    CHECK_NEAR(sum[0], 1.0, 2e-6);
  if (alpha >= 0.1 && a == 1e-300)
    CHECK_NEAR(sum[1], 1.0, 2e-6);
}

/* F under u = t until `stop`, then held. */
typedef double response(const double *parameter, double t);

static void check_ramp_and_hold(int law, int n, const double *parameter, response *ramp)
{
  for (double stop = 1e-4; stop < 100.0; stop *= 4.0)
    for (double hold = 1e-3; hold < 2e3; hold *= 4.0) {
      rig device = new_rig(law, n, parameter, 0.0);
      device.v = 1.0;
      const double top = ramp(parameter, stop), after = ramp(parameter, stop + hold) - ramp(parameter, hold);
      CHECK_NEAR(move(&device, stop, stop, 1.0), top, ACCURACY * top);
      device.v = 0.0;
      CHECK_NEAR(move(&device, hold, stop, 0.0), after, ACCURACY * after);
      free_rig(&device);
    }
}

/* k0 (t + c t^(1 - alpha) / Gamma(2 - alpha)) */
static double kelvin_ramp(const double *p, double t)
{
  return p[0] * (t + p[1] * pow(t, 1.0 - p[2]) / tgamma(2.0 - p[2]));
}

/* E_1/2(-x) = exp(x^2) erfc(x); beyond x = 20 by its asymptotic series */
static double half(double x)
{
  const double y = 0.5 / (x * x);
  return x < 20.0 ? exp(x * x) * erfc(x) : (1.0 - y * (1.0 - 3.0 * y * (1.0 - 5.0 * y))) / (x * sqrt(M_PI));
}

static double zener_ramp(const double *p, double t)
{
  const double a = p[1], integral = a * a * (half(sqrt(t) / a) - 1.0) + 2.0 * a * sqrt(t / M_PI);
  return p[0] * (t + (p[2] / a - 1.0) * integral);
}

static double maxwell_ramp(const double *p, double t)
{
  return p[0] * (1.0 - half(sqrt(t) / p[1]));
}

/* Of a series; f is its Laplace transform times i w. */
static double complex modulus(const ed_prony *series, double omega)
{
  double complex sum = series->spring + I * omega * series->dashpot;
  for (int i = 0; i < series->branches; i++)
    sum += series->stiffness[i] * I * omega / (series->rate[i] + I * omega);
  return sum;
}

/* Orders down to the least double, where the power is 1 and the law a spring, and up to the last one below 1: against
 * (i w)^alpha, and (i w)^alpha / ((i w)^alpha + 1/a) of E_alpha(-t^alpha / a), from 2e-3 to 50 Hz, to the documented 1e-4. */
static void check_orders_near_the_ends(double alpha)
{
  static const double a[] = {0.05, 1.0, 20.0};
  const double least = fmin(alpha, 1.0 - alpha), loss = alpha < 0.5 ? alpha : 1.0;
  for (double omega = 2.0 * M_PI * 2e-3; omega < 2.0 * M_PI * 50.0; omega *= 1.7) {
    const double complex power = cpow(I * omega, alpha);
    ed_prony series;
    ed_spectrum_of_power(&series, alpha);
    /* what the quadrature errs by is a share of the spectrum, and that is of the size of the order or of what it lacks to 1 */
    CHECK_NEAR(cabs(modulus(&series, omega) / power - 1.0), 0.0, 2e-3 * least + 1e-12);
    for (int i = 0; i < (int)(sizeof a / sizeof *a); i++) {
      ed_spectrum_of_mittag_leffler(&series, alpha, a[i], 0);
      const double complex zener = power / (power + 1.0 / a[i]);
      CHECK_NEAR(cabs(modulus(&series, omega) / zener - 1.0), 0.0, 1e-4);
      CHECK_NEAR(cimag(modulus(&series, omega)), cimag(zener), 1e-3 * loss * cabs(zener) + 1e-13);
      ed_spectrum_of_mittag_leffler(&series, alpha, a[i], 1);
      CHECK_NEAR(cabs(modulus(&series, omega) / (I * omega / (1.0 + a[i] * power)) - 1.0), 0.0, 1e-4);
    }
  }
}

static void check_parameters(void)
{
  static const int laws[] = {ED_LAW_FRACTIONAL_KELVIN, ED_LAW_FRACTIONAL_MAXWELL};
  for (int i = 0; i < 2; i++) {
    check_refused(laws[i], 3, (const double[]){0.0, 1.0, 0.5}, "0 = 0 is not allowed");
    check_refused(laws[i], 3, (const double[]){1.0, 1.0, 0.0}, " = 0 is not allowed: greater than 0 and less than 1");
    check_refused(laws[i], 3, (const double[]){1.0, 1.0, 1.0}, " = 1 is not allowed: greater than 0 and less than 1");
  }
  check_refused(ED_LAW_FRACTIONAL_KELVIN, 3, (const double[]){1.0, -1.0, 0.5}, "c = -1 is not allowed");
  check_refused(ED_LAW_FRACTIONAL_MAXWELL, 3, (const double[]){1.0, -1.0, 0.5}, "lambda = -1 is not allowed");
  check_refused(ED_LAW_FRACTIONAL_ZENER, 4, (const double[]){1.0, 1.0, 1.0, 0.5}, "b = 1 is not allowed: it must be above a");
  check_refused(ED_LAW_FRACTIONAL_ZENER, 4, (const double[]){1.0, 1.0, 2.0, 1.5}, "alpha = 1.5 is not allowed");
}

int main(void)
{
  static const double a[] = {1e-300, 1e-9, 1e-3, 0.1, 1.0, 20.0, 1e6, 1e300};
  for (int i = 0; i < N_ORDERS; i++) {
    check_power(ORDERS[i]);
    for (int j = 0; j < (int)(sizeof a / sizeof *a); j++)
      check_sums(ORDERS[i], a[j]);
  }
  for (double size = 1e-3; size > 1e-300; size *= size > 1e-17 ? 0.3 : 1e-40) {
    check_orders_near_the_ends(size);
    if (1.0 - size < 1.0)
      check_orders_near_the_ends(1.0 - size);
  }
  check_orders_near_the_ends(5e-324);
  check_orders_near_the_ends(nextafter(1.0, 0.0));
  for (int i = 3; i <= 7; i++)
    check_ramp_and_hold(ED_LAW_FRACTIONAL_KELVIN, 3, (const double[]){3e6, 0.4, ORDERS[i]}, kelvin_ramp);
  check_ramp_and_hold(ED_LAW_FRACTIONAL_ZENER, 4, (const double[]){3e6, 0.05, 0.8, 0.5}, zener_ramp);
  check_ramp_and_hold(ED_LAW_FRACTIONAL_MAXWELL, 3, (const double[]){4e5, 0.5, 0.5}, maxwell_ramp);
  check_parameters();
  return checks_end("fractional laws");
}
