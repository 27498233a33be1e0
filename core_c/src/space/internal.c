/* Internal forces between the ends of members, by equilibrium of the part before a station. */
#include "space/loads.h"
#include "space/space.h"

#include <stdlib.h>
#include <string.h>

/* What acts at the start of a part of a member, x after it: force and moment on the face at the end of the part. */
static void subtract_force(double x, const double *force, const double *moment, double *face)
{
  for (int i = 0; i < 3; i++) {
    face[i] -= force[i];
    face[3 + i] -= moment ? moment[i] : 0.0;
  }
  face[4] -= x * force[2];
  face[5] += x * force[1];
}

int ed_space_internal(ed_space *s, int n_cases, const double *end_forces, const ed_space_loads *loads, int n_stations,
                      const double *stations, double *internal)
{
  const int status = ed_space_check_loads(s, n_cases, loads);
  if (status != ED_OK)
    return status;
  if (n_stations < 0)
    return ed_space_fail(s, ED_E_ARGUMENT, "the number of stations is negative");
  for (int i = 0; i < n_stations; i++)
    if (!(stations[i] >= 0.0 && stations[i] <= 1.0))
      return ed_space_fail(s, ED_E_ARGUMENT, "station %d is %g of the length; it must be 0 to 1", i, stations[i]);
  const size_t members = (size_t)s->n_members, count = (size_t)n_stations;
  for (size_t at = 0; at < (size_t)n_cases * members; at++) {
    const ed_space_member *m = &s->member[at % members];
    const double *start = end_forces + 12 * at;
    double load[3] = {0.0};
    if (loads && loads->uniform)
      ed_member_to_local(m, loads->uniform + 3 * at, load);
    for (size_t k = 0; k < count; k++) {
      double *face = internal + 6 * (at * count + k);
      const double x = stations[k] * m->length, whole[3] = {load[0] * x, load[1] * x, load[2] * x};
      memset(face, 0, 6 * sizeof *face);
      subtract_force(x, start, start + 3, face);
      subtract_force(0.5 * x, whole, NULL, face);
    }
  }
  for (int i = 0; loads && i < loads->n_points; i++) {
    const int member = loads->point_member[i];
    const ed_space_member *m = &s->member[member];
    const double position = loads->point_position[i];
    double load[3];
    ed_member_to_local(m, loads->point_force + 3 * (size_t)i, load);
    for (size_t k = 0; k < count; k++)
      if (position < stations[k] || (position == stations[k] && position == 1.0))
        subtract_force((stations[k] - position) * m->length, load, NULL,
                       internal + 6 * (((size_t)loads->point_case[i] * members + (size_t)member) * count + k));
  }
  return ED_OK;
}
