/* Amendments that rub, beside the law. */
#include "damper/amendment.h"

#include <math.h>

/* A force of the velocity alone, with its slope and its chord from rest. */
static void of_velocity(double force, double slope, double v, ed_amended *out)
{
  out->value = force;
  out->by_v1 = slope;
  out->chord = v != 0.0 ? fmax(force / v - slope, 0.0) : 0.0;
}

/* tanh x and its derivative. */
static double rise(double x, double *slope)
{
  const double near = 1.0 / cosh(x);
  *slope = near * near;
  return tanh(x);
}

static void coulomb(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  enum { ED_AMEND_FRICTION_COULOMB_PARAMETERS };
  (void)before, (void)after;
  double slope;
  const double v = ends->v1, size = rise(v / p[V0], &slope);
  of_velocity(p[F_C] * size, p[F_C] * slope / p[V0], v, out);
}

const ed_amendment_kind ed_amend_friction_coulomb = {.name = "friction.coulomb", .on_speed = 1, .at_end = coulomb};

static void stribeck(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  enum { ED_AMEND_FRICTION_STRIBECK_PARAMETERS };
  static const double STEEP = 10.0; /* it breaks away within a tenth of v_s */
  (void)before, (void)after;
  double slope;
  const double v = ends->v1, x = v / p[V_S], size = rise(STEEP * x, &slope), more = p[S] * exp(-x * x);
  of_velocity(p[F_C] * (1.0 + more) * size, p[F_C] * ((1.0 + more) * STEEP * slope - 2.0 * x * more * size) / p[V_S], v, out);
}

const ed_amendment_kind ed_amend_friction_stribeck = {.name = "friction.stribeck", .on_speed = 1, .at_end = stribeck};

/* State z/x0. On a way that does not turn it comes near to 1 or -1 by exp(-way/x0), however fast. */
static void presliding(const double *p, double before, const ed_ends *ends, double *after, ed_amended *out)
{
  enum { ED_AMEND_FRICTION_PRESLIDING_PARAMETERS };
  double at[3], z = before, from = 0.0, from_by[2] = {0.0}, by[2] = {0.0};
  int n = 0;
  if (ends->path) {
    n = ed_path_reversals(ends->path, at);
    at[n++] = ends->h;
    from = ends->path->c[0];
    for (int j = 0; j < 2; j++)
      from_by[j] = ends->direction[j].c[0];
  }
  for (int i = 0; i < n; i++) {
    const double to = ed_path_u(ends->path, at[i]), way = (to - from) / p[X0], sign = ed_sign(way);
    const double left = exp(-fabs(way)), rate = (1.0 - sign * z) * left / p[X0]; /* d z / d way */
    z = left * z - sign * expm1(-fabs(way));
    for (int j = 0; j < 2; j++) { /* a turning point is where the path is at rest: it moves as the path does there */
      const double to_by = ed_path_u(&ends->direction[j], at[i]);
      by[j] = left * by[j] + rate * (to_by - from_by[j]);
      from_by[j] = to_by;
    }
    from = to;
  }
  *after = z;
  out->value = p[F_C] * z;
  for (int j = 0; j < 2; j++)
    out->by_path[j] = p[F_C] * by[j];
}

/* Who lets go of the damper takes the strain out of it. */
static double let_go(const double *p, double before)
{
  (void)p, (void)before;
  return 0.0;
}

const ed_amendment_kind ed_amend_friction_presliding = {
    .name = "friction.presliding", .has_state = 1, .at_end = presliding, .rested = let_go};
