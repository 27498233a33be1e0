/* Laws of springs: a trial is a function of the committed state alone, tangents are its differences, and what is stored and
 * dissipated is the work. References: differences and sums along random paths. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"
#include "spring/spring.h"

#include <math.h>
#include <string.h>

enum { LARGEST_STATE = ED_DETERIORATING_STATE };

static ed_spring multilinear(void)
{
  static const double p[] = {0.01, 100.0, 0.03, 150.0, 500.0};
  ed_spring spring;
  CHECK(ed_spring_set(&spring, ED_SPRING_MULTILINEAR, 5, p) == NULL);
  return spring;
}

static ed_spring contact(void)
{
  static const double p[] = {1e4, 120.0};
  ed_spring spring;
  CHECK(ed_spring_set(&spring, ED_SPRING_CONTACT, 2, p) == NULL);
  return spring;
}

static ed_spring deteriorating(void)
{
  static const double p[] = {1e4, 0.03, 0.2, 0.5, 100.0, 1.1, 0.3, 1.0, 0.02, 0.15, 0.5, 80.0, 1.05, 0.2, 0.6,
                             150.0, 150.0, 300.0, 1.0, 1.0, 1.2};
  ed_spring spring;
  CHECK(ed_spring_set(&spring, ED_SPRING_DETERIORATING, 21, p) == NULL);
  return spring;
}

static void check_path(const ed_spring *spring)
{
  enum { TURNS = 40, STEPS = 400 };
  numbers source = {11};
  double state[LARGEST_STATE] = {0}, u = 0.0, force = 0.0, work = 0.0, dissipated = 0.0, most = 0.0;
  ed_spring_initialise(spring, state);
  for (int turn = 0; turn < TURNS; turn++) {
    const double target = next_number(&source, -0.06, 0.06), step = (target - u) / STEPS;
    for (int i = 0; i < STEPS; i++) {
      double next, tangent, behind, before[LARGEST_STATE], unused;
      memcpy(before, state, sizeof before);
      ed_spring_trial(spring, state, u + step, &next, &tangent);
      ed_spring_trial(spring, state, u + step * (1.0 - 1e-6), &behind, &unused);
      CHECK(memcmp(before, state, sizeof before) == 0);
      if (unused == tangent) /* no corner in between */
        CHECK_NEAR((next - behind) / (1e-6 * step), tangent, 1e-4 * spring->stiffness);
      work += 0.5 * (force + next) * step;
      dissipated += ed_spring_commit(spring, state, u + step);
      CHECK(ed_spring_state_valid(spring, state));
      u += step;
      force = next;
      most = fmax(most, fabs(work));
    }
  }
  /* trapezoids over steps with corners: two of them a turn, each at most the force of a step times half the step */
  const double corner = 0.5 * spring->stiffness * 0.12 / STEPS * 0.12 / STEPS;
  CHECK_NEAR(ed_spring_stored(spring, state, u) + dissipated, work, 3.0 * TURNS * corner);
  CHECK(dissipated > 0.3 * most);
}

static void check_refusals(void)
{
  ed_spring spring;
  const double falling[] = {0.01, 100.0, 0.03, 50.0, 0.0}, stiffer[] = {0.01, 100.0, 2e4}, nothing[] = {0.0};
  CHECK_CONTAINS(ed_spring_set(&spring, ED_SPRING_MULTILINEAR, 5, falling), "rise");
  CHECK_CONTAINS(ed_spring_set(&spring, ED_SPRING_MULTILINEAR, 3, stiffer), "less steep");
  CHECK_CONTAINS(ed_spring_set(&spring, ED_SPRING_MULTILINEAR, 1, nothing), "positive");
  CHECK_CONTAINS(ed_spring_set(&spring, ED_SPRING_MULTILINEAR, 2, falling), "corners");
  CHECK_CONTAINS(ed_spring_set(&spring, ED_SPRING_CONTACT, 2, (double[]){1.0, -1.0}), "positive");
  CHECK_CONTAINS(ed_spring_set(&spring, 7, 1, nothing), "no such law");
  double p[] = {1e4, 0.03, 0.2, 0.5, 100.0, 1.1, 0.3, 1.0, 0.02, 0.15, 0.5, 80.0, 1.05, 0.2, 0.6, 150.0, 150.0, 300.0, 1.0, 1.0, 1.2};
  const struct {
    int index;
    double value;
    const char *says;
  } wrong[] = {{1, 0.0, "must be positive"}, {3, 0.005, "ultimate"}, {5, 0.9, "capping"},   {5, 9.0, "slope"},
               {6, 1.2, "residual"},         {7, 1.5, "rates"},      {15, 0.0, "capacities"}, {4, NAN, "not a number"}};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    const double kept = p[wrong[i].index];
    p[wrong[i].index] = wrong[i].value;
    const char *text = ed_spring_set(&spring, ED_SPRING_DETERIORATING, 21, p);
    CHECK(text != NULL);
    CHECK_CONTAINS(text ? text : "", wrong[i].says);
    p[wrong[i].index] = kept;
  }
}

int main(void)
{
  const ed_spring springs[] = {multilinear(), contact(), deteriorating()};
  for (int i = 0; i < 3; i++)
    check_path(&springs[i]);
  check_refusals();
  return checks_end("springs");
}
