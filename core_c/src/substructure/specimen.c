#include "substructure/specimen.h"

#include <math.h>
#include <string.h>

enum { MOST_ITERATIONS = 200 };

/* Error of a specimen's displacement in series, of the largest so far: below the resolution of any encoder. */
static const double SETTLED = 1e-6;

void ed_specimen_start(ed_specimen *s)
{
  ed_damper_start(s->damper, s->law);
  s->force = s->deformation = 0.0;
  s->tangent = s->largest = 0.0;
}

/* The law over a path of its own size, from the committed state; force and, to the direction, its derivative at the size of the device. */
static int try_path(ed_specimen *s, const ed_path *path, const ed_path direction[2], double *force, double *slope)
{
  ed_damper_force out = {0};
  memcpy(s->trial, s->law, sizeof *s->trial * (size_t)ed_damper_state_size(s->damper));
  const int status = ed_damper_advance(s->damper, s->system, s->law, path, direction, s->trial, &out);
  *force = s->force_scale * out.force;
  *slope = s->force_scale * out.slope[0];
  return status != ED_OK || isfinite(*force) ? status : ED_E_NOT_FINITE;
}

int ed_specimen_follow(ed_specimen *s, double from, double start, double to, double end)
{
  const double scale = s->deformation_scale;
  const ed_path none[2] = {{0}};
  ed_path path;
  double slope;
  ed_path_hermite(&path, s->h, scale * from, scale * start, scale * to, scale * end);
  const int status = try_path(s, &path, none, &s->force, &slope);
  s->deformation = to;
  return status;
}

int ed_specimen_in_series(ed_specimen *s, double flexibility, double drive)
{
  const double stiffness = flexibility > 0.0 ? 1.0 / flexibility : 0.0, from = s->deformation, scale = s->deformation_scale;
  double low = -HUGE_VAL, high = HUGE_VAL, last = HUGE_VAL;
  double x = drive;
  if (flexibility > 0.0)
    x = from + (stiffness * (drive - from) - s->force) / (stiffness + fmax(s->tangent, 0.0));
  for (int i = 0; i < MOST_ITERATIONS; i++) {
    const ed_path path = {.h = s->h, .c = {scale * from, scale * (x - from) / s->h}}, along[2] = {{.h = s->h, .c = {0.0, scale / s->h}}};
    double force, slope;
    const int status = try_path(s, &path, along, &force, &slope);
    if (status != ED_OK)
      return status;
    const double rest = flexibility > 0.0 ? stiffness * (drive - x) - force : 0.0;
    s->largest = fmax(s->largest, fabs(x));
    if (fabs(rest) <= SETTLED * stiffness * s->largest || x == low || x == high) {
      s->tangent = isfinite(slope) ? slope : 0.0;
      s->force = force;
      s->deformation = x;
      return ED_OK;
    }
    *(rest > 0.0 ? &low : &high) = x;
    /* a power of the velocity has an infinite slope at rest */
    const double change = rest / (stiffness + (isfinite(slope) ? fmax(slope, 0.0) : 0.0));
    const int slow = fabs(change) > 0.5 * last && isfinite(high - low);
    last = fabs(change);
    x = slow || !(x + change > low && x + change < high) ? 0.5 * (low + high) : x + change;
  }
  return ED_E_NOT_CONVERGED;
}

void ed_specimen_commit(ed_specimen *s)
{
  double *swap = s->law;
  s->law = s->trial;
  s->trial = swap;
}
