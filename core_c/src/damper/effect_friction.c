/* Effects that rub, beside the law. */
#include "damper/bouc_wen.h"
#include "damper/effect.h"
#include "edcore.h"

#include <math.h>

/* A force of the velocity alone, with its slope and its chord from rest. */
static void of_velocity(double force, double slope, double v, ed_effect_value *out)
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

static void coulomb(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_FRICTION_COULOMB_PARAMETERS };
  (void)before, (void)after;
  double slope;
  const double v = ends->v1, size = rise(v / p[V0], &slope);
  of_velocity(p[F_C] * size, p[F_C] * slope / p[V0], v, out);
}

const ed_effect_form ed_effect_friction_coulomb = {.name = "friction.coulomb", .on_speed = 1, .at_end = coulomb};

static void stribeck(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_FRICTION_STRIBECK_PARAMETERS };
  static const double STEEP = 10.0; /* it breaks away within a tenth of v_s */
  (void)before, (void)after;
  double slope;
  const double v = ends->v1, x = v / p[V_S], size = rise(STEEP * x, &slope), more = p[S] * exp(-x * x);
  of_velocity(p[F_C] * (1.0 + more) * size, p[F_C] * ((1.0 + more) * STEEP * slope - 2.0 * x * more * size) / p[V_S], v, out);
}

const ed_effect_form ed_effect_friction_stribeck = {.name = "friction.stribeck", .on_speed = 1, .at_end = stribeck};

/* Guides or seals that the law's force loads. */
static void loaded(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_FRICTION_LOADED_PARAMETERS };
  (void)before, (void)after;
  double slope;
  const double v = ends->v1, size = rise(v / p[V0], &slope), most = p[F_C] + p[MU] * fabs(ends->law);
  of_velocity(most * size, most * slope / p[V0], v, out);
  out->by_law = p[MU] * ed_sign(ends->law) * size;
}

const ed_effect_form ed_effect_friction_loaded = {.name = "friction.loaded", .on_speed = 1, .at_end = loaded};

/* A state at the end of a way that does not turn, with its derivatives to the state before it and to the way. */
typedef struct {
  double z, by_before, by_way;
} ed_gone;

/* A force times a state z, from the state before the step over the ways between the turning points of the path. The derivatives to the
 * two unknowns of the path are those of the state; the force is the caller's. */
static void times_state(
    double force, const double *p, ed_gone (*go)(const double *p, double z, double way), double z, const ed_ends *ends, double *after,
    ed_effect_value *out)
{
  double at[3], by[2] = {0.0}, from = 0.0, from_by[2] = {0.0};
  int n = 0;
  if (ends->path) {
    n = ed_path_reversals(ends->path, at);
    at[n++] = ends->h;
    from = ends->path->c[0];
    for (int j = 0; j < 2; j++)
      from_by[j] = ends->direction[j].c[0];
  }
  for (int i = 0; i < n; i++) {
    const double to = ed_path_u(ends->path, at[i]);
    const ed_gone gone = go(p, z, to - from);
    z = gone.z;
    for (int j = 0; j < 2; j++) { /* a turning point is where the path is at rest: it moves as the path does there */
      const double to_by = ed_path_u(&ends->direction[j], at[i]);
      by[j] = gone.by_before * by[j] + gone.by_way * (to_by - from_by[j]);
      from_by[j] = to_by;
    }
    from = to;
  }
  *after = z;
  out->value = force * z;
  for (int j = 0; j < 2; j++)
    out->by_path[j] = force * by[j];
}

/* State z/x0: on a way it comes near to 1 or -1 by exp(-way/x0), however fast. */
static ed_gone dahl(double x0, double z, double way)
{
  const double sign = ed_sign(way), left = exp(-fabs(way) / x0);
  return (ed_gone){left * z - sign * expm1(-fabs(way) / x0), left, (1.0 - sign * z) * left / x0};
}

static ed_gone presliding_way(const double *p, double z, double way)
{
  enum { ED_EFFECT_FRICTION_PRESLIDING_PARAMETERS };
  return dahl(p[X0], z, way);
}

/* z' = v - |v| z |z|^(n-1)/x0 [Dahl 1968]: of n = 1 exponential, of a large one elastic and plastic. */
static void presliding(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_FRICTION_PRESLIDING_PARAMETERS };
  if (p[N] == 1.0) {
    times_state(p[F_C], p, presliding_way, before, ends, after, out);
    return;
  }
  const ed_bouc_wen_shape shape = {.Y = p[X0], .A = 1.0, .beta = 0.0, .gamma = 1.0, .n = p[N]};
  double z = before, slope[2] = {0.0};
  if (ends->path && ed_bouc_wen_follow(&shape, ends->path, ends->direction, &z, slope) != ED_OK)
    z = NAN;
  *after = z;
  out->value = p[F_C] * z;
  for (int j = 0; j < 2; j++)
    out->by_path[j] = p[F_C] * slope[j];
}

/* Who lets go of the damper takes the strain out of it. */
static double let_go(const double *p, double before)
{
  (void)p, (void)before;
  return 0.0;
}

const ed_effect_form ed_effect_friction_presliding = {
    .name = "friction.presliding", .has_state = 1, .at_end = presliding, .rested = let_go};

static ed_gone stretch_way(const double *p, double z, double way)
{
  enum { ED_EFFECT_HYSTERESIS_STRETCH_PARAMETERS };
  return dahl(p[Y], z, way);
}

static void stretch(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_HYSTERESIS_STRETCH_PARAMETERS };
  const double u = fabs(ends->u1);
  times_state(p[F_Y] * pow(u / p[R], p[N]), p, stretch_way, before, ends, after, out);
  out->by_u1 = u > 0.0 ? p[N] * out->value / ends->u1 : 0.0;
}

const ed_effect_form ed_effect_hysteresis_stretch = {
    .name = "hysteresis.stretch", .has_state = 1, .at_end = stretch, .rested = let_go};

/* y = z sgn v: y' = 1 - (gamma + beta) y where the force grows, before it y' = 1 + (gamma - beta) |y|, y of the way. */
static ed_gone bouc_wen_way(const double *p, double z, double way)
{
  enum { ED_EFFECT_HYSTERESIS_BOUC_WEN_PARAMETERS };
  const double sign = way < 0.0 ? -1.0 : 1.0, grows = p[GAMMA] + p[BETA], falls = p[GAMMA] - p[BETA]; /* no way: z stays */
  double y = sign * z, length = fabs(way), left = 1.0;
  if (y < 0.0) {
    const double bend = -falls * y, to_zero = bend > -1.0 ? (falls != 0.0 ? log1p(bend) / falls : -y) : INFINITY;
    const double part = fmin(length, to_zero);
    left = exp(-falls * part);
    y = part < to_zero ? left * y + (falls != 0.0 ? -expm1(-falls * part) / falls : part) : 0.0;
    length -= part;
  }
  if (length > 0.0) {
    const double rest = exp(-grows * length);
    y = rest * y + (grows != 0.0 ? -expm1(-grows * length) / grows : length);
    left *= rest;
  }
  return (ed_gone){sign * y, left, y < 0.0 ? 1.0 - falls * y : 1.0 - grows * y};
}

static void bouc_wen(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_HYSTERESIS_BOUC_WEN_PARAMETERS };
  times_state(p[K], p, bouc_wen_way, before, ends, after, out);
}

const ed_effect_form ed_effect_hysteresis_bouc_wen = {
    .name = "hysteresis.bouc_wen", .has_state = 1, .at_end = bouc_wen, .rested = let_go};
