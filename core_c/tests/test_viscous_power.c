/* The power-law dashpot: F = c |v|^alpha sgn v of the velocity at the end of the path, whatever was before; its slope; rest. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"
#include "numbers.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static const double C = 4e5;
static const double AT_REST = 1e-9; /* documented: the chord from the origin below */

static double power(double alpha, double v)
{
  return copysign(C * pow(fabs(v), alpha), v);
}

static void check_force(double alpha)
{
  numbers source = {7};
  rig device = new_rig(ED_LAW_VISCOUS_POWER, 2, (const double[]){C, alpha}, 0.0);
  for (int i = 0; i < 500; i++) {
    const double h = pow(10.0, next_number(&source, -3.0, 1.0)), u = next_number(&source, -0.1, 0.1);
    const double v = copysign(pow(10.0, next_number(&source, -3.0, 1.0)), next_number(&source, -1.0, 1.0));
    /* the cubic gives v to some roundings of its terms, of size |u| / h and |v| */
    const double error = 30.0 * DBL_EPSILON * ((0.2 + fabs(device.u)) / h + fabs(device.v) + fabs(v));
    CHECK_NEAR(move(&device, h, u, v), power(alpha, v), power(alpha, fabs(v)) * (1e-14 + alpha * error / fabs(v)));
  }
  free_rig(&device);
}

/* Only the velocity counts; central differences of width 1e-4 err by the third derivative, (1e-4)^2 / 6 and some. */
static void check_slope(double alpha)
{
  numbers source = {8};
  rig device = new_rig(ED_LAW_VISCOUS_POWER, 2, (const double[]){C, alpha}, 0.0);
  for (int i = 0; i < 200; i++) {
    const double v = copysign(pow(10.0, next_number(&source, -3.0, 1.0)), next_number(&source, -1.0, 1.0));
    const double slope = alpha * C * pow(fabs(v), alpha - 1.0);
    check_slopes(&device, 0.01, 1e-4, v, 1e-3, 1e-4 * fabs(v), 1e-7 * slope / 0.01);
  }
  free_rig(&device);
}

/* At rest the slope is finite, force and slope are those of the chord, and the power begins where it ends. */
static void check_rest(double alpha)
{
  int status;
  char message[256];
  double force, slope[2], none;
  ed_damper *damper = ed_damper_new(ED_LAW_VISCOUS_POWER, 2, (const double[]){C, alpha}, 0.0, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  CHECK_INT(ed_damper_state_size(damper), 0);
  const double chord = C * pow(AT_REST, alpha - 1.0);
  for (int i = -11; i <= 11; i++) {
    const double v = 0.1 * i * AT_REST, expected = abs(i) < 10 && alpha < 1.0 ? chord * v : power(alpha, v);
    CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_BEST, 0.0, &none, 0.01, 0.0, v, 0.01 * v, v, &none, &force, slope), ED_OK);
    CHECK_NEAR(force, expected, 1e-12 * C * pow(AT_REST, alpha));
    if (abs(i) < 10 && alpha < 1.0)
      CHECK_NEAR(slope[1], chord, 1e-12 * chord);
    CHECK_NEAR(slope[0], 0.0, 1e-12 * fmax(C, chord) / 0.01);
  }
  /* and when all of the path is at rest */
  CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_BEST, 0.0, &none, 0.01, 0.0, 0.0, 0.0, 0.0, &none, &force, slope), ED_OK);
  CHECK_NEAR(force, 0.0, 0.0);
  CHECK_NEAR(slope[1], alpha < 1.0 ? chord : alpha > 1.0 ? 0.0 : C, 1e-12 * fmax(C, chord));
  ed_damper_free(damper);
}

/* Work of a steady sine: the coefficient of Constantinou & Symans (1992), lambda = 2^(2+a) Gamma(1+a/2)^2 / Gamma(2+a), times
 * c u0^(1+a) w^a. */
static void check_cycle(double alpha)
{
  enum { CYCLE = 2000 };
  const double omega = 7.0, size = 0.05, h = 2.0 * M_PI / omega / CYCLE;
  rig device = new_rig(ED_LAW_VISCOUS_POWER, 2, (const double[]){C, alpha}, 0.0);
  device.v = omega * size;
  double work = 0.0;
  for (int i = 1; i <= CYCLE; i++) {
    const double phase = 2.0 * M_PI * i / CYCLE, v = omega * size * cos(phase);
    work += move(&device, h, size * sin(phase), v) * v * h;
  }
  const double half = tgamma(1.0 + 0.5 * alpha), lambda = pow(2.0, 2.0 + alpha) * half * half / tgamma(2.0 + alpha);
  const double expected = lambda * C * pow(size, 1.0 + alpha) * pow(omega, alpha);
  CHECK_NEAR(work, expected, 2e-4 * expected); /* the sum over a kink of |v|^(1+a): (2 pi / 2000)^(1+a) */
  free_rig(&device);
}

int main(void)
{
  static const double alpha[] = {0.1, 0.3, 0.7, 1.0, 1.4, 2.0};
  for (int i = 0; i < (int)(sizeof alpha / sizeof *alpha); i++) {
    check_force(alpha[i]);
    check_slope(alpha[i]);
    check_rest(alpha[i]);
    check_cycle(alpha[i]);
  }
  check_refused(ED_LAW_VISCOUS_POWER, 2, (const double[]){-1.0, 0.5}, "c = -1 is not allowed");
  check_refused(ED_LAW_VISCOUS_POWER, 2, (const double[]){1.0, 0.0}, "alpha = 0 is not allowed");
  check_refused(ED_LAW_VISCOUS_POWER, 2, (const double[]){1.0, 2.1}, "alpha = 2.1 is not allowed");
  return checks_end("power-law dashpot");
}
