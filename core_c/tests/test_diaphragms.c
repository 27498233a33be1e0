/* What acts on a node of a diaphragm acts on its master with a lever: loads, forces of a history and dampers, with the master free and
 * with one of its degrees supported. Reference: the same written at the master by hand. */
#include "checks.h"
#include "frame.h"

#include <math.h>

enum { FEET = 3, STEPS = 40, CHANNELS = 6 };
static const double PLACE[FEET][2] = {{0.0, 0.0}, {6.0, 1.0}, {2.0, 5.0}}, CENTRE[2] = {3.0, 1.5};

typedef struct {
  int of_node; /* else of the master */
  int supported; /* degree of the master, -1: none */
  int degree;
} options;

/* Terms of a displacement of a node in plan, or by hand of the master. */
static int terms(options o, const int *top, int master, int *node, int *degree, double *coefficient)
{
  node[0] = o.of_node ? top[1] : master;
  degree[0] = o.degree;
  coefficient[0] = 1.0;
  if (o.of_node || o.degree == 5)
    return 1;
  node[1] = master;
  degree[1] = 5;
  coefficient[1] = o.degree ? PLACE[1][0] - CENTRE[0] : CENTRE[1] - PLACE[1][1];
  return 2;
}

static void shake(options o, double *last)
{
  ed_model *model = ed_model_new(3);
  const int section = ed_model_elastic_section(model, (double[]){1e9, 6e6, 3e6, 1e6});
  int top[FEET], node[2], degree[2];
  double coefficient[2];
  for (int i = 0; i < FEET; i++) {
    const int foot = ed_model_node(model, "foot", (double[]){PLACE[i][0], PLACE[i][1], 0.0});
    top[i] = ed_model_node(model, "top", (double[]){PLACE[i][0], PLACE[i][1], 3.0});
    CHECK_STATUS(ed_model_fix(model, foot, (int[]){1, 1, 1, 1, 1, 1}), ED_OK);
    CHECK(ed_model_elastic_beam(model, "column", foot, top[i], section, ED_P_DELTA, NULL, (double[]){0.6, 0.8, 0.0}) >= 0);
  }
  const int master = ed_model_node(model, "floor", (double[]){CENTRE[0], CENTRE[1], 3.0});
  CHECK_STATUS(ed_model_fix(model, master, (int[]){o.supported == 0, o.supported == 1, 1, 1, 1, o.supported == 5}), ED_OK);
  CHECK_STATUS(ed_model_diaphragm(model, master, FEET, top), ED_OK);
  CHECK_STATUS(ed_model_mass(model, master, (double[]){2e4, 2e4, 0.0, 0.0, 0.0, 1e5}), ED_OK);
  const int n = terms(o, top, master, node, degree, coefficient), pattern = ed_model_pattern(model);
  for (int k = 0; k < n; k++) {
    double force[6] = {0.0};
    force[degree[k]] = 3e3 * coefficient[k];
    CHECK_STATUS(ed_model_nodal_load(model, pattern, node[k], force), ED_OK);
  }
  const double parameters[] = {4e4, 0.7};
  CHECK(ed_model_damper(model, "damper", ED_LAW_VISCOUS_POWER, 2, parameters, 0.0, 0.0, 1.0, 1.0, n, node, degree, coefficient) >= 0);
  ed_analysis *a = frame_analysis(model);
  CHECK_STATUS(ed_set(a, ED_TOLERANCE, 1e-12), ED_OK);
  CHECK_STATUS(ed_static_begin(a, pattern, 1.0, 1), ED_OK);
  CHECK_STATUS(run_to_end(a, 1), ED_OK);
  CHECK_STATUS(ed_install_dampers(a), ED_OK);
  CHECK_INT(add_channel(a, ED_DISPLACEMENT, top[1], 0), 0);
  CHECK_INT(add_channel(a, ED_DISPLACEMENT, top[2], 1), 1);
  CHECK_INT(add_channel(a, ED_VELOCITY, master, 5), 2);
  CHECK_INT(add_channel(a, ED_DAMPER_FORCE, 0, 0), 3);
  CHECK_INT(add_channel(a, ED_GIVEN_DEFORMATION, 0, 0), 4);
  CHECK_INT(add_channel(a, ED_GIVEN_WORK, 0, 0), 5);
  double ground[STEPS + 1], unused[CHANNELS];
  ground_motion(STEPS, 0.02, 4.0, ground);
  CHECK_STATUS(ed_history_begin(a, STEPS, 0.02, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_INT(ed_history_force(a, n, node, degree, coefficient), 0);
  for (int step = 0; step < STEPS; step++) {
    CHECK_STATUS(ed_history_set_force(a, 0, 2e3 * sin(0.5 * step), 2e3 * sin(0.5 * (step + 1))), ED_OK);
    CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
  }
  ed_extremes(a, unused, unused, unused, unused, last);
  ed_run_end(a);
  ed_analysis_free(a);
  ed_model_free(model);
}

int main(void)
{
  static const double SIZE[CHANNELS] = {1e-2, 1e-2, 1e-2, 1e4, 1e-2, 1e2};
  static const int DEGREES[] = {0, 1, 5};
  for (int d = 0; d < 3; d++)
    for (int s = -1; s < 3; s++) {
      options o = {.supported = s < 0 ? -1 : DEGREES[s], .degree = DEGREES[d]};
      double by_hand[CHANNELS], of_node[CHANNELS];
      if (o.supported == o.degree && o.degree == 5)
        continue; /* it acts on a support alone */
      shake(o, by_hand);
      o.of_node = 1;
      shake(o, of_node);
      for (int k = 0; k < CHANNELS; k++) /* to which equilibrium is iterated */
        CHECK_NEAR(of_node[k], by_hand[k], 1e-9 * SIZE[k]);
      CHECK(fabs(by_hand[3]) > 1.0);
    }
  return checks_end("diaphragms");
}
