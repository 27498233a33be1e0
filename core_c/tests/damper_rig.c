#include "damper_rig.h"

#include "checks.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

rig new_rig(int law, int n_parameters, const double *parameters, double brace)
{
  rig made = {0};
  int status;
  char message[256] = "";
  made.damper = ed_damper_new(law, n_parameters, parameters, brace, 0.0, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  if (!made.damper)
    printf("%s\n", message);
  else if (ed_damper_state_size(made.damper) > LARGEST_DAMPER_STATE)
    CHECK(!"the rig has room for the state");
  else
    ed_damper_start(made.damper, made.state);
  return made;
}

void free_rig(rig *rig)
{
  ed_damper_free(rig->damper);
}

static double step(const rig *rig, double h, double u, double v, double *trial, double slope[2])
{
  double force = NAN;
  CHECK_STATUS(ed_damper_step(rig->damper, ED_DAMPER_BEST, 1e-6, rig->state, h, rig->u, rig->v, u, v, trial, &force, slope), ED_OK);
  return force;
}

double move(rig *rig, double h, double u, double v)
{
  const int size = ed_damper_state_size(rig->damper);
  double before[LARGEST_DAMPER_STATE], first[LARGEST_DAMPER_STATE], second[LARGEST_DAMPER_STATE], slope[2][2], force[2];
  memcpy(before, rig->state, sizeof before);
  force[0] = step(rig, h, u, v, first, slope[0]);
  force[1] = step(rig, h, u, v, second, slope[1]);
  CHECK_SAME(rig->state, before, size);
  CHECK_SAME(second, first, size);
  CHECK_SAME(&force[1], &force[0], 1);
  CHECK_SAME(slope[1], slope[0], 2);
  memcpy(rig->state, first, (size_t)size * sizeof *first);
  rig->u = u;
  rig->v = v;
  return force[0];
}

double move_to(rig *rig, double u)
{
  rig->v = 0.0;
  return move(rig, 1.0, u, 0.0);
}

void check_slopes(const rig *rig, double h, double u, double v, double du, double dv, double tolerance)
{
  double trial[LARGEST_DAMPER_STATE], slope[2], unused[2];
  step(rig, h, u, v, trial, slope);
  const double by_u = (step(rig, h, u + du, v, trial, unused) - step(rig, h, u - du, v, trial, unused)) / (2.0 * du);
  const double by_v = (step(rig, h, u, v + dv, trial, unused) - step(rig, h, u, v - dv, trial, unused)) / (2.0 * dv);
  CHECK_NEAR(slope[0], by_u, tolerance);
  CHECK_NEAR(slope[1], by_v, tolerance * h);
}

void check_refused(int law, int n_parameters, const double *parameters, const char *text)
{
  int status;
  char message[256] = "";
  CHECK(ed_damper_new(law, n_parameters, parameters, 0.0, 0.0, &status, message, sizeof message) == NULL);
  CHECK_STATUS(status, ED_E_ARGUMENT);
  CHECK_CONTAINS(message, text);
}
