/* Bouc-Wen: closed forms of the loop for n = 1 (exponentials) and n = 2 (tanh, tan), which follow from dz/du between reversals and
 * changes of sign of z; for other n the way as the integral of dz / (A - c |z|^n), by the tanh-sinh rule; steps of any length; slopes
 * against central differences; work of steady cycles; a brace in series; what is refused. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

enum { POINTS = 41 };
static const double FY = 2.0, Y = 0.5, ALPHA = 0.1, A = 1.2, BETA = 0.3, GAMMA = 0.7;

static ed_damper *damper(double beta, double n, double brace)
{
  const double p[7] = {FY, Y, ALPHA, A, beta, GAMMA, n};
  char message[256];
  int status;
  ed_damper *made = ed_damper_new(ED_LAW_BOUC_WEN, 7, p, brace, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  return made;
}

/* z of n = 1 or 2 after going from z0 by du, z not changing its sign: dz/du = (A - c |z|^n) / Y with c of this branch. */
static double branch(int n, double c, double z0, double du)
{
  if (n == 1)
    return c == 0.0 ? z0 + A * du / Y : A / c - (A / c - z0) * exp(-c * du / Y);
  if (c > 0.0)
    return sqrt(A / c) * tanh(atanh(z0 * sqrt(c / A)) + sqrt(A * c) * du / Y);
  return sqrt(-A / c) * tan(atan(z0 * sqrt(-c / A)) + sqrt(-A * c) * du / Y);
}

/* Up to 2, down to -1.5, up to 0, in half cosines: forces against the closed form at every sample. */
static void check_loop(int n)
{
  static double time[3 * POINTS], u[3 * POINTS], v[3 * POINTS], force[3 * POINTS];
  const double turn[4] = {0.0, 2.0, -1.5, 0.0};
  ed_damper *made = damper(BETA, n, 0.0);
  int samples = 0, done;
  for (int leg = 0; leg < 3; leg++)
    for (int i = leg > 0; i < POINTS; i++, samples++) {
      const double x = M_PI * i / (POINTS - 1), middle = 0.5 * (turn[leg] + turn[leg + 1]), half = turn[leg + 1] - middle;
      time[samples] = leg + x / M_PI;
      u[samples] = middle - half * cos(x);
      v[samples] = half * M_PI * sin(x);
    }
  CHECK_STATUS(ed_damper_history(made, ED_DAMPER_BEST, 1e-8, samples, time, u, v, force, &done), ED_OK);
  CHECK_INT(done, samples);
  double start = 0.0, from = 0.0;
  for (int leg = 0, i = 0; leg < 3; leg++) {
    const double way = turn[leg + 1] > turn[leg] ? 1.0 : -1.0;
    /* mirrored so that the deformation grows: unloading while z < 0, then loading with beta + gamma */
    double z0 = way * start, zero = 0.0;
    const double c = BETA - GAMMA; /* below zero: |z| falls by d|z|/du = -(A - c |z|^n) / Y until it is zero */
    if (z0 < 0.0)
      zero = n == 1 ? Y / c * log(A / c / (A / c + z0)) : Y / sqrt(-c * A) * atan(-z0 * sqrt(-c / A));
    double z = start;
    for (; i < (leg + 1) * (POINTS - 1) + 1; i++) {
      const double gone = way * (u[i] - from);
      if (z0 < 0.0 && gone < zero)
        z = -way * branch(n, c, -z0, -gone);
      else
        z = way * branch(n, BETA + GAMMA, fmax(z0, 0.0), gone - zero);
      CHECK_NEAR(force[i], ALPHA * FY / Y * u[i] + (1.0 - ALPHA) * FY * z, 1e-14 * POINTS * FY);
    }
    start = z;
    from = turn[leg + 1];
  }
  ed_damper_free(made);
}

/* What the brace leaves for the device moves the bare device to the same force: F(u) = F_bare(u - F(u) / k_b). */
static void check_brace(void)
{
  const double brace = 9.0, h = 0.3;
  ed_damper *braced = damper(BETA, 2.0, brace), *bare = damper(BETA, 2.0, 0.0);
  const double u[4] = {0.0, 0.9, -0.4, 1.1};
  double state[2][LARGEST_DAMPER_STATE], trial[2][LARGEST_DAMPER_STATE], force, own = 0.0, slope[2];
  ed_damper_start(braced, state[0]);
  ed_damper_start(bare, state[1]);
  for (int i = 0; i < 3; i++) {
    CHECK_STATUS(ed_damper_step(braced, 0, 1e-9, state[0], h, u[i], 0.0, u[i + 1], 0.0, trial[0], &force, slope), ED_OK);
    const double next = u[i + 1] - force / brace;
    double alone;
    CHECK_STATUS(ed_damper_step(bare, 0, 1e-9, state[1], h, own, 0.0, next, 0.0, trial[1], &alone, slope), ED_OK);
    CHECK_NEAR(alone, force, 1e-8 * FY); /* balance to 1e-9 of the forces, brace k_b u among them */
    memcpy(state, trial, sizeof state);
    own = next;
  }
  ed_damper_free(braced);
  ed_damper_free(bare);
}

/* int_0^q dz / (A - c z^n) by the tanh-sinh rule: the power at 0 and, towards yielding, the pole are near or at its ends. */
static double way_to(double n, double c, double q)
{
  double sum = 0.0;
  const double h = 1.0 / 64.0;
  for (int i = -256; i <= 256; i++) {
    const double t = i * h, x = 0.5 * M_PI * sinh(t), z = q / (1.0 + exp(-2.0 * x)), weight = 0.5 * M_PI * cosh(t) / (cosh(x) * cosh(x));
    if (weight > 0.0)
      sum += weight / (A - c * pow(z, n));
  }
  return 0.5 * q * h * sum;
}

/* From rest to q, back to -q and to rest: each way by its integral, in one step and in many. beta: of loading and unloading, which may
 * also harden (beta < gamma) or soften. */
static void check_general(double beta, double n)
{
  const double limit = pow(A / (beta + GAMMA), 1.0 / n), share[] = {0.05, 0.4, 0.9, 0.999};
  for (int i = 0; i < 4; i++)
    for (int steps = 1; steps <= 64; steps *= 64) {
      const double q = share[i] * limit, loading = Y * way_to(n, beta + GAMMA, q), unloading = Y * way_to(n, beta - GAMMA, q);
      const double turn[] = {loading, -unloading, 0.0}, z[] = {q, -q, 0.0};
      const double p[7] = {FY, Y, 0.0, A, beta, GAMMA, n};
      rig r = new_rig(ED_LAW_BOUC_WEN, 7, p, 0.0);
      for (int leg = 0; leg < 3; leg++) {
        const double from = r.u, to = leg == 2 ? from + unloading : leg == 1 ? from - unloading - loading : turn[0];
        double force = 0.0;
        for (int k = 1; k <= steps; k++)
          force = move_to(&r, from + (to - from) * k / steps);
        CHECK_NEAR(force, FY * z[leg], 1e-12 * FY);
      }
      free_rig(&r);
    }
}

/* So far that nothing is left of where it began. */
static void check_far(double n)
{
  const double p[7] = {FY, Y, 0.0, A, BETA, GAMMA, n}, limit = pow(A / (BETA + GAMMA), 1.0 / n);
  rig r = new_rig(ED_LAW_BOUC_WEN, 7, p, 0.0);
  for (int i = 0; i < 3; i++) {
    const double way = i == 1 ? -1.0 : 1.0;
    CHECK_NEAR(move_to(&r, way * 1e9), way * FY * limit, 1e-14 * FY);
  }
  free_rig(&r);
}

/* Along a step without turn, with one, with two, through zero and while it yields. */
static void check_tangents(double n)
{
  static const double way[][3] = {{0.4, 0.3, 1.0}, {0.4, 0.2, -2.0}, {0.4, 0.21, 3.0}, {1.0, -0.9, -0.5}, {1.0, 2.5, 1.0}, {1.0, 2.0, 8.0}};
  const double p[7] = {FY, Y, ALPHA, A, BETA, GAMMA, n};
  rig r = new_rig(ED_LAW_BOUC_WEN, 7, p, 0.0);
  for (int i = 0; i < 6; i++) {
    check_slopes(&r, way[i][0], way[i][1], way[i][2], 1e-5, 1e-5 / way[i][0], 1e-7);
    move(&r, way[i][0], way[i][1], way[i][2]);
  }
  free_rig(&r);
}

/* Work of a steady cycle of amplitude a. Every z is passed up and down; going from 0 to its peak and back takes
 * Y int dz (1/(A - (beta + gamma) z) + 1/(A - (beta - gamma) z)) = 2 a, and leaves twice the integral of z times their difference,
 * which is above zero for every beta: also outside of -gamma <= beta <= gamma no closed cycle makes energy. */
static void check_energy(double beta)
{
  enum { CYCLES = 25, PER = 1000, N = CYCLES * PER + 1 };
  static double time[N], u[N], v[N], force[N];
  const double a = 0.6, loading = beta + GAMMA, unloading = beta - GAMMA;
  ed_damper *made = damper(beta, 1.0, 0.0);
  int done;
  for (int i = 0; i < N; i++) {
    time[i] = (double)i / PER;
    u[i] = a * sin(2.0 * M_PI * time[i]);
    v[i] = 2.0 * M_PI * a * cos(2.0 * M_PI * time[i]);
  }
  CHECK_STATUS(ed_damper_history(made, ED_DAMPER_BEST, 1e-9, N, time, u, v, force, &done), ED_OK);
  double work = 0.0, low = 0.0, high = A / fmax(loading, 0.1), expected = 0.0;
  for (int i = N - PER; i < N; i++) /* periodic, so that the trapezoidal rule is nearly exact */
    work += force[i] * v[i] / PER;
  for (int k = 0; k < 100; k++) {
    const double z = 0.5 * (low + high);
    const double back = unloading == 0.0 ? z / A : -log(1.0 - unloading * z / A) / unloading;
    if (Y * (back - log(1.0 - loading * z / A) / loading) < 2.0 * a)
      low = z;
    else
      high = z;
  }
  /* int z dz / (A - c z) = -z/c - A/c^2 ln(1 - c z/A) */
  expected = -low / loading - A / (loading * loading) * log(1.0 - loading * low / A);
  if (unloading == 0.0)
    expected -= low * low / (2.0 * A);
  else
    expected += low / unloading + A / (unloading * unloading) * log(1.0 - unloading * low / A);
  expected *= 2.0 * (1.0 - ALPHA) * FY * Y;
  CHECK(expected > 0.0);
  CHECK_NEAR(work, expected, 1e-5 * expected); /* kinks at the reversals: (2 pi / PER)^2 */
  ed_damper_free(made);
}

static void check_refusals(void)
{
  static const double wrong[][7] = {{0.0, 1.0, 0.1, 1.0, 0.5, 0.5, 1.0},  {1.0, 0.0, 0.1, 1.0, 0.5, 0.5, 1.0},
                                    {1.0, 1.0, 1.0, 1.0, 0.5, 0.5, 1.0},  {1.0, 1.0, 0.1, -1.0, 0.5, 0.5, 1.0},
                                    {1.0, 1.0, 0.1, 1.0, -0.6, 0.5, 1.0}, {1.0, 1.0, 0.1, 1.0, 0.5, 0.5, 0.5}};
  static const char *const name[] = {"Fy", "Y", "alpha", "A", "beta", "n"};
  for (int i = 0; i < 6; i++) {
    char message[256] = "";
    int status;
    CHECK(ed_damper_new(ED_LAW_BOUC_WEN, 7, wrong[i], 0.0, 0.0, &status, message, sizeof message) == 0);
    CHECK_STATUS(status, ED_E_ARGUMENT);
    CHECK_CONTAINS(message, name[i]);
  }
}

int main(void)
{
  check_loop(1);
  check_loop(2);
  static const double n[] = {1.0, 1.01, 1.5, 2.0, 3.7, 20.0, 100.0};
  for (int i = 0; i < 7; i++) {
    check_general(BETA, n[i]);
    check_general(-0.5 * GAMMA, n[i]);
    check_general(2.0 * GAMMA, n[i]);
    check_far(n[i]);
    check_tangents(n[i] > 4.0 ? 4.0 : n[i]); /* sharper corners leave differences nothing smooth */
  }
  check_brace();
  check_energy(-0.6 * GAMMA);
  check_energy(GAMMA);
  check_energy(3.0 * GAMMA);
  check_refusals();
  return checks_end("bouc_wen");
}
