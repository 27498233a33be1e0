/* Springs, dashpots and Maxwell branches: closed forms of ramp and hold and of steady harmonic motion; and what holds for the
 * fractional laws as well, which share the step: the cut of a path into pieces does not matter, slopes, long rest. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"
#include "numbers.h"

#include <complex.h>
#include <math.h>

enum { MOST = 7 };

/* A law, and its series as the parameters give it. */
typedef struct {
  int law, n;
  double parameter[MOST];
  double spring, dashpot;
  int branches;
  double k[3], c[3];
} series;

static const series LAWS[] = {
    {ED_LAW_KELVIN_VOIGT, 2, {3e6, 4e5}, 3e6, 4e5, 0, {0}, {0}},
    {ED_LAW_KELVIN_VOIGT, 2, {0.0, 4e5}, 0.0, 4e5, 0, {0}, {0}},
    {ED_LAW_VISCOUS, 1, {4e5}, 0.0, 4e5, 0, {0}, {0}},
    {ED_LAW_LINEARISED, 3, {3e6, 0.2, 8.0}, 3e6, 1.5e5, 0, {0}, {0}},
    {ED_LAW_MAXWELL, 2, {4e5, 0.05}, 0.0, 0.0, 1, {8e6}, {4e5}},
    {ED_LAW_ZENER, 3, {3e6, 8e6, 4e5}, 3e6, 0.0, 1, {8e6}, {4e5}},
    {ED_LAW_GENERALISED_MAXWELL, 7, {3e6, 5e6, 1e3, 8e6, 4e5, 2e6, 9e6}, 3e6, 0.0, 3, {5e6, 8e6, 2e6}, {1e3, 4e5, 9e6}},
};
enum { N_LAWS = sizeof LAWS / sizeof *LAWS };

/* Force at time t when u rises with speed 1 until `stop` and is held. */
static double ramp_and_hold(const series *law, double stop, double t)
{
  double force = law->spring * fmin(t, stop) + (t <= stop ? law->dashpot : 0.0);
  for (int i = 0; i < law->branches; i++) {
    const double rate = law->k[i] / law->c[i];
    force += t <= stop ? -law->c[i] * expm1(-rate * t) : -law->c[i] * expm1(-rate * stop) * exp(-rate * (t - stop));
  }
  return force;
}

static void check_ramp_and_hold(const series *law)
{
  const double stop = 0.3, size = law->spring * stop + law->dashpot + law->c[0] + law->c[1] + law->c[2];
  rig device = new_rig(law->law, law->n, law->parameter, 0.0);
  device.v = 1.0; /* from the start */
  double t = 0.0;
  for (int i = 1; i <= 6; i++) {
    t = stop * i * i / 36.0;
    CHECK_NEAR(move(&device, t - device.u, t, 1.0), ramp_and_hold(law, stop, t), 1e-13 * size);
  }
  for (double h = 1e-6; t < 1e8; h *= 10.0) { /* to long after */
    device.v = 0.0;
    const double force = move(&device, h, stop, 0.0);
    t += h;
    CHECK_NEAR(force, ramp_and_hold(law, stop, t), 1e-13 * size);
  }
  CHECK_NEAR(device.u, stop, 0.0);
  free_rig(&device);
}

/* Complex stiffness k + i w c + sum k_i i w / (r_i + i w), from the first harmonic in the cycle after the transient; 400 cubics a
 * cycle are (2 pi / 400)^4 / 384 = 2e-10 off a sine. */
static void check_harmonic(const series *law, double omega)
{
  enum { CYCLE = 400 };
  double complex expected = law->spring + I * omega * law->dashpot, found = 0.0;
  double slowest = 1e9;
  for (int i = 0; i < law->branches; i++) {
    const double rate = law->k[i] / law->c[i];
    expected += law->k[i] * I * omega / (rate + I * omega);
    slowest = fmin(slowest, rate);
  }
  const double h = 2.0 * M_PI / omega / CYCLE;
  const int cycles = 1 + (int)ceil(25.0 / slowest / (h * CYCLE)); /* exp(-25) = 1e-11 */
  rig device = new_rig(law->law, law->n, law->parameter, 0.0);
  device.v = omega;
  for (int i = 1; i <= cycles * CYCLE; i++) {
    const double phase = 2.0 * M_PI * (i % CYCLE) / CYCLE;
    const double force = move(&device, h, sin(phase), omega * cos(phase));
    if (i > (cycles - 1) * CYCLE)
      found += 2.0 * I * force * cexp(-I * phase) / CYCLE;
  }
  CHECK_NEAR(cabs(found / expected - 1.0), 0.0, 1e-8);
  free_rig(&device);
}

typedef struct {
  int law, n;
  double parameter[MOST];
} choice;

static const choice ALL[] = {
    {ED_LAW_KELVIN_VOIGT, 2, {3e6, 4e5}},
    {ED_LAW_ZENER, 3, {3e6, 8e6, 4e5}},
    {ED_LAW_MAXWELL, 2, {4e5, 0.05}},
    {ED_LAW_GENERALISED_MAXWELL, 7, {3e6, 5e6, 1e3, 8e6, 4e5, 2e6, 9e6}},
    {ED_LAW_FRACTIONAL_KELVIN, 3, {3e6, 0.4, 0.3}},
    {ED_LAW_FRACTIONAL_ZENER, 4, {3e6, 0.05, 0.8, 0.6}},
    {ED_LAW_FRACTIONAL_MAXWELL, 3, {4e5, 0.1, 0.8}},
};

static double cubic(const double c[4], double s)
{
  return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
}

static double cubic_slope(const double c[4], double s)
{
  return c[1] + s * (2.0 * c[2] + s * 3.0 * c[3]);
}

/* A cubic in one step and in random pieces, after random steps that fill the state. */
static void check_pieces(const choice *law, double duration)
{
  numbers source = {5};
  rig device = new_rig(law->law, law->n, law->parameter, 0.0);
  for (int i = 0; i < 20; i++)
    move(&device, next_number(&source, 0.001, 0.2), next_number(&source, -0.1, 0.1), next_number(&source, -1.0, 1.0));
  const double c[4] = {device.u, device.v, next_number(&source, -1.0, 1.0) / duration / duration,
                       next_number(&source, -1.0, 1.0) / pow(duration, 3.0)};
  rig pieces = device;
  const double whole = move(&device, duration, cubic(c, duration), cubic_slope(c, duration));
  double at = 0.0, force = 0.0;
  for (int i = 1; i <= 30; i++) {
    const double next = i < 30 ? at + next_number(&source, 0.0, 2.0) * (duration - at) / (31 - i) : duration;
    force = move(&pieces, next - at, cubic(c, next), cubic_slope(c, next));
    at = next;
  }
  const int size = ed_damper_state_size(device.damper);
  const double scale = largest_of(device.state, size) + fabs(whole);
  /* rounding of u in a piece of `duration` / 1000 gives a velocity of 1e-13 */
  CHECK_NEAR(force, whole, 1e-11 * scale);
  for (int i = 0; i < size; i++)
    CHECK_NEAR(pieces.state[i], device.state[i], 1e-11 * scale);
  free_rig(&device); /* the damper is shared */
}

/* The laws are linear: central differences have no error but rounding, whatever their width. */
static void check_tangents(const choice *law)
{
  numbers source = {9};
  rig device = new_rig(law->law, law->n, law->parameter, 0.0);
  for (int i = 0; i < 60; i++) {
    const double h = pow(10.0, next_number(&source, -5.0, 3.0));
    const double u = next_number(&source, -0.1, 0.1), v = next_number(&source, -0.1, 0.1) / h;
    device.v = next_number(&source, -0.1, 0.1) / h; /* may jump between steps */
    check_slopes(&device, h, u, v, 0.1, 0.1 / h, 1e-11 * (2e7 + 4e5 / h));
    move(&device, h, u, v);
  }
  free_rig(&device);
}

/* One very long step, and one very short one after it that no branch notices. */
static void check_long_step(const choice *law)
{
  rig device = new_rig(law->law, law->n, law->parameter, 0.0);
  const int solid = law->law != ED_LAW_MAXWELL && law->law != ED_LAW_FRACTIONAL_MAXWELL;
  const double rest = solid ? law->parameter[0] * 0.1 : 0.0;
  /* of the slowest branches, of up to 1e5 s, a ramp in 1e8 s leaves 6 (1e-3)^2 for it ends at rest */
  CHECK_NEAR(move(&device, 1e8, 0.1, 0.0), rest, 1e-5 * 3e6 * 0.1);
  CHECK_NEAR(move(&device, 1e-12, 0.1, 0.0), rest, 1e-5 * 3e6 * 0.1);
  free_rig(&device);
}

static void check_overflow(void)
{
  const double parameter[] = {1e200, 1e200, 1e200};
  int status;
  char message[256];
  double state = 0.0, trial, force, slope[2];
  ed_damper *damper = ed_damper_new(ED_LAW_ZENER, 3, parameter, 0.0, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_BEST, 1e-6, &state, 1.0, 0.0, 0.0, 1e150, 0.0, &trial, &force, slope),
               ED_E_NOT_FINITE);
  ed_damper_free(damper);
}

static void check_parameters(void)
{
  check_refused(ED_LAW_KELVIN_VOIGT, 2, (const double[]){-1.0, 1.0}, "k = -1 is not allowed");
  check_refused(ED_LAW_KELVIN_VOIGT, 2, (const double[]){1.0, -2.0}, "c = -2 is not allowed");
  check_refused(ED_LAW_ZENER, 3, (const double[]){1.0, 0.0, 1.0}, "k1 = 0 is not allowed");
  check_refused(ED_LAW_GENERALISED_MAXWELL, 4, (const double[]){1.0, 1.0, 1.0, 1.0}, "number of parameters = 4 is not allowed: k0, then k, c of each of 1 to 16 branches");
  check_refused(ED_LAW_GENERALISED_MAXWELL, 5, (const double[]){1.0, 1.0, 1.0, 1.0, -3.0}, "c2 = -3 is not allowed");
  check_refused(ED_LAW_VISCOUS, 1, (const double[]){0.0}, "c = 0 is not allowed");
  check_refused(ED_LAW_MAXWELL, 2, (const double[]){1.0, 1e-310}, "relaxation rate = inf");
  check_refused(ED_LAW_LINEARISED, 3, (const double[]){1.0, 0.1, -1.0}, "omega = -1 is not allowed");
}

int main(void)
{
  static const double omega[] = {0.5, 6.0, 80.0};
  for (int i = 0; i < N_LAWS; i++) {
    check_ramp_and_hold(&LAWS[i]);
    for (int j = 0; j < 3; j++)
      check_harmonic(&LAWS[i], omega[j]);
  }
  for (int i = 0; i < (int)(sizeof ALL / sizeof *ALL); i++) {
    check_pieces(&ALL[i], 0.01);
    check_pieces(&ALL[i], 5.0);
    check_tangents(&ALL[i]);
    check_long_step(&ALL[i]);
  }
  check_overflow();
  check_parameters();
  return checks_end("Prony series");
}
