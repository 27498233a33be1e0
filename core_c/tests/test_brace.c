/* Braces in series: identities with softer laws, true tangents, and guesses that do not change the answer. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

/* Maxwell dampers in series with a spring are Maxwell dampers. */
static void check_maxwell(void)
{
  const double c = 0.6, k = 8.0, kb = 30.0, soft = 1.0 / (1.0 / k + 1.0 / kb);
  const double braced[] = {c, c / k}, softer[] = {c, c / soft};
  double worst[2];
  for (int fine = 0; fine < 2; fine++) {
    rig a = new_rig(ED_LAW_MAXWELL, 2, braced, kb), b = new_rig(ED_LAW_MAXWELL, 2, softer, 0.0);
    const double h = fine ? 0.01 : 0.02;
    worst[fine] = 0.0;
    for (double t = h; t < 2.0; t += h) {
      const double u = sin(5.0 * t) * t, v = 5.0 * cos(5.0 * t) * t + sin(5.0 * t);
      worst[fine] = fmax(worst[fine], fabs(move(&a, h, u, v) - move(&b, h, u, v)));
    }
    free_rig(&a);
    free_rig(&b);
  }
  CHECK_NEAR(worst[1], 0.0, 1e-4 * 6.0);                 /* of the largest force, 6 */
  CHECK_NEAR(log2(worst[0] / worst[1]), 3.0, 0.4);       /* Radau IIA with two stages */
}

/* An elastic-plastic damper in series with a spring is one, with a reversal inside the steps too. */
static void check_elastic_plastic(void)
{
  const double k = 10.0, fy = 2.0, b = 0.1, kb = 15.0, soft = k * kb / (k + kb), after = b * k * kb / (b * k + kb);
  const double braced[] = {k, fy, b}, softer[] = {soft, fy, after / soft};
  rig one = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, braced, kb), other = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, softer, 0.0);
  double largest = 0.0;
  for (double t = 0.07; t < 20.0; t += 0.07) {
    const double u = sin(3.0 * t) * (0.5 + 0.2 * t), v = 3.0 * cos(3.0 * t) * (0.5 + 0.2 * t) + 0.2 * sin(3.0 * t);
    const double force = move(&other, 0.07, u, v);
    CHECK_NEAR(move(&one, 0.07, u, v), force, 1e-7);
    largest = fmax(largest, fabs(force));
  }
  CHECK(largest > 1.5 * fy);
  free_rig(&one);
  free_rig(&other);
}

/* A step that turns twice and ends beyond where it turned first; elastic, and yielding at its end. */
static void check_two_turns(void)
{
  const double k = 10.0, fy = 2.0, b = 0.1, kb = 15.0, soft = k * kb / (k + kb), after = b * k * kb / (b * k + kb);
  const double braced[] = {k, fy, b}, softer[] = {soft, fy, after / soft};
  for (double size = 0.1; size < 2.0; size += 0.1) {
    rig one = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, braced, kb), other = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, softer, 0.0);
    one.v = other.v = size; /* u = size (s - 2.1 s^2 + 1.4 s^3), by way of 0.154 and 0.146 to 0.3 of size */
    CHECK_NEAR(move(&one, 1.0, 0.3 * size, size), move(&other, 1.0, 0.3 * size, size), 1e-7);
    free_rig(&one);
    free_rig(&other);
  }
}

/* Tangents, with reversals inside the step and without. */
static void check_tangents(void)
{
  static const double zener[] = {2.0, 5.0, 0.4}, plastic[] = {10.0, 2.0, 0.1};
  static const double mgmm[] = {0.515, 0.0151, 0.107, 1.585, 0.374, 3.741, 3.613, 7.966, 0.902, 0.190, 13.468, 0.0};
  static const struct {
    int law, n;
    const double *parameters;
    double brace, size, tolerance;
  } each[] = {{ED_LAW_ZENER, 3, zener, 20.0, 1.0, 1e-6},
              {ED_LAW_ELASTIC_PLASTIC, 3, plastic, 15.0, 1.0, 1e-5},
              {ED_LAW_MGMM, 12, mgmm, 40.0, 6.0, 2e-3}};
  for (int i = 0; i < 3; i++) {
    rig r = new_rig(each[i].law, each[i].n, each[i].parameters, each[i].brace);
    const double size = each[i].size;
    for (int step = 1; step < 60; step++) {
      const double t = 0.05 * step, h = 0.05;
      const double u = size * sin(4.0 * t), v = size * 4.0 * cos(4.0 * t);
      check_slopes(&r, h, u, v, 1e-5 * size, 1e-4 * size, each[i].tolerance * each[i].brace);
      move(&r, h, u, v);
    }
    free_rig(&r);
  }
}

/* The state of another trial as a first guess changes nothing beyond the tolerance of the balance. */
static void check_guess(void)
{
  static const double mgmm[] = {0.515, 0.0151, 0.107, 1.585, 0.374, 3.741, 3.613, 7.966, 0.902, 0.190, 13.468, 0.0};
  rig r = new_rig(ED_LAW_MGMM, 12, mgmm, 40.0);
  for (int step = 1; step < 40; step++)
    move(&r, 0.01, 5.0 * sin(0.1 * step), 50.0 * cos(0.1 * step));
  double trial[LARGEST_DAMPER_STATE], force, slope[2];
  CHECK_STATUS(ed_damper_step(r.damper, ED_DAMPER_BEST, 1e-6, r.state, 0.01, r.u, r.v, r.u + 0.3, r.v, trial, &force, slope), ED_OK);
  const double first = force, tangent = slope[0];
  CHECK_STATUS(ed_damper_step(r.damper, ED_DAMPER_BEST, 1e-6, r.state, 0.01, r.u, r.v, r.u + 0.3, r.v, trial, &force, slope), ED_OK);
  CHECK_SAME(&force, &first, 1);
  CHECK_SAME(&slope[0], &tangent, 1);
  free_rig(&r);
}

/* A linear device is moved by a step so short that its deformation differs only in the last digits: the dashpot gives what the brace
 * takes, kb (u - u_d), from a deformation already there. */
static void check_short_steps(void)
{
  const double k = 1e6, c = 1e7, kb = 5e4, speed = 0.5;
  const double kelvin[] = {k, c};
  rig r = new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, kb);
  const double held = move(&r, 1e8, 0.1, 0.0);
  CHECK_NEAR(held, 0.1 * k * kb / (k + kb), 1e-6 * held);
  r.v = speed;
  for (double h = 1e-3; h > 1e-13; h *= 0.1) {
    const double before = r.u, rise = kb * speed * h; /* the dashpot has not moved yet */
    rig other = r;
    CHECK_NEAR(move(&other, h, before + speed * h, speed) - held, rise, 1e-2 * rise + 1e-8 * held);
  }
  free_rig(&r);
}

/* MGMM behind a brace softer than itself, a millimetre or more in a hundredth of a second: tangents alone went round in circles. Every
 * step balances: the own deformation is u - F / kb, and the law alone along it ends at the same force when the steps are fine. */
static void check_sudden(void)
{
  static const double mgmm[] = {515e3, 15.1e3, 107e3, 21e3, 0.708, 3741e3, 3613e3, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0};
  static const double braces[] = {11.6e3, 115e3, 537e3};
  for (int b = 0; b < 3; b++)
    for (double size = 1e-3; size < 0.2; size *= 10.0) {
      double last[2] = {0.0};
      for (int fine = 0; fine < 2; fine++) {
        rig r = new_rig(ED_LAW_MGMM, 12, mgmm, braces[b]);
        for (int i = 0; i < 20; i++) {
          const int parts = fine ? 16 : 1;
          const double from = r.u, rise = i % 3 == 2 ? size : 0.0;
          for (int j = 1; j <= parts; j++) {
            const double x = (double)j / parts; /* the cubic from rest to rest, in pieces */
            last[fine] = move(&r, 0.01 / parts, from + rise * x * x * (3.0 - 2.0 * x), rise * 6.0 * x * (1.0 - x) / 0.01);
          }
        }
        free_rig(&r);
      }
      CHECK_NEAR(last[0], last[1], 0.01 * fabs(last[1])); /* one step against sixteen, of a method of order 3 */
    }
  rig r = new_rig(ED_LAW_MGMM, 12, mgmm, braces[0]);
  double trial[LARGEST_DAMPER_STATE], force, slope[2];
  /* the third of the shortest step is none, and has no path */
  CHECK_STATUS(ed_damper_step(r.damper, ED_DAMPER_BEST, 1e-6, r.state, 5e-324, r.u, r.v, r.u, r.v, trial, &force, slope), ED_E_ARGUMENT);
  free_rig(&r);
}

/* The law with asymptotes without dashpot, behind a brace, moved so little that it is a spring k1 (1 + kappa): a thousand million times
 * less than f0, the force keeps its digits. */
static void check_little(void)
{
  const double f0 = 5e4, k1 = 5e6, kappa = 0.4, kb = 3e7, k = k1 * (1.0 + kappa);
  const double asymptote[] = {f0, k1, 0.0, 0.0, kappa, 1.4, 0.0};
  rig r = new_rig(ED_LAW_ASYMPTOTE, 7, asymptote, kb);
  for (double u = 1e-13; u < 1e-9; u *= 3.0)
    CHECK_NEAR(move_to(&r, u), u * k * kb / (k + kb), 1e-6 * u * k);
  free_rig(&r);
}

int main(void)
{
  check_short_steps();
  check_sudden();
  check_little();
  check_maxwell();
  check_elastic_plastic();
  check_two_turns();
  check_tangents();
  check_guess();
  return checks_end("braces");
}
