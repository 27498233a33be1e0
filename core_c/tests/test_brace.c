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

int main(void)
{
  check_maxwell();
  check_elastic_plastic();
  check_tangents();
  check_guess();
  return checks_end("braces");
}
