/* Effects that act beside the law. */
#include "damper/effect.h"
#include "damper/power_dashpot.h"
#include "damper/relaxation.h"

#include <math.h>

static void payne_elastic(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_PAYNE_ELASTIC_PARAMETERS };
  double by_u1;
  const double g = ed_payne_share(p[A0], p[M], p[TAU_A], before, ends, after, &by_u1);
  out->value = -p[K] * g * ends->u1;
  out->by_u1 = -p[K] * (g + by_u1 * ends->u1);
}

const ed_effect_form ed_effect_payne_elastic = {.name = "payne.elastic", .has_state = 1, .on_speed = 1, .at_end = payne_elastic};

static void mullins_elastic(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_MULLINS_ELASTIC_PARAMETERS };
  double by_u1;
  const double share = ed_path_share(p[S0], p[Q], before, ends, after, &by_u1);
  out->value = p[K] * share * ends->u1;
  out->by_u1 = p[K] * (share + by_u1 * ends->u1);
}

static double mullins_elastic_rested(const double *p, double before)
{
  enum { ED_EFFECT_MULLINS_ELASTIC_PARAMETERS };
  return ed_path_rested(p[S0], p[Q], p[RECOVERY], before);
}

const ed_effect_form ed_effect_mullins_elastic = {
    .name = "mullins.elastic", .has_state = 1, .at_end = mullins_elastic, .rested = mullins_elastic_rested};

static void hardening_power(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_HARDENING_POWER_PARAMETERS };
  (void)before, (void)after;
  const double secant = p[K] * pow(fabs(ends->u1) / p[R], p[P] - 1.0);
  out->value = secant * ends->u1;
  out->by_u1 = p[P] * secant;
}

const ed_effect_form ed_effect_hardening_power = {.name = "hardening.power", .at_end = hardening_power};

static void hardening_exponential(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_HARDENING_EXPONENTIAL_PARAMETERS };
  (void)before, (void)after;
  const double x = ends->u1 / p[U0], more = expm1(x * x);
  out->value = p[K] * more * ends->u1;
  out->by_u1 = p[K] * (more + 2.0 * x * x * (1.0 + more));
}

const ed_effect_form ed_effect_hardening_exponential = {.name = "hardening.exponential", .at_end = hardening_exponential};

static void hardening_saturating(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_HARDENING_SATURATING_PARAMETERS };
  (void)before, (void)after;
  const double x = ends->u1 / p[U0], near = 1.0 / cosh(x);
  out->value = p[K] * p[U0] * tanh(x);
  out->by_u1 = p[K] * near * near;
}

const ed_effect_form ed_effect_hardening_saturating = {.name = "hardening.saturating", .at_end = hardening_saturating};

static void hardening_threshold(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_HARDENING_THRESHOLD_PARAMETERS };
  (void)before, (void)after;
  const double beyond = fabs(ends->u1) - p[U0];
  out->value = p[K] * fmax(beyond, 0.0) * ed_sign(ends->u1);
  out->by_u1 = beyond > 0.0 ? p[K] : 0.0;
}

const ed_effect_form ed_effect_hardening_threshold = {.name = "hardening.threshold", .at_end = hardening_threshold};

static void one_sided_spring(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_ONE_SIDED_SPRING_PARAMETERS };
  (void)before, (void)after;
  const double beyond = p[SIDE] * ends->u1 - p[U0];
  out->value = p[K] * fmax(beyond, 0.0) * p[SIDE];
  out->by_u1 = beyond > 0.0 ? p[K] : 0.0;
}

const ed_effect_form ed_effect_one_sided_spring = {.name = "one_sided.spring", .at_end = one_sided_spring};

static void one_sided_contact(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_ONE_SIDED_CONTACT_PARAMETERS };
  (void)before, (void)after;
  const double beyond = p[SIDE] * ends->u1 - p[U0];
  const double secant = beyond > 0.0 ? p[K] * pow(beyond / p[R], p[N] - 1.0) : 0.0;
  out->value = secant * fmax(beyond, 0.0) * p[SIDE];
  out->by_u1 = p[N] * secant;
}

const ed_effect_form ed_effect_one_sided_contact = {.name = "one_sided.contact", .at_end = one_sided_contact};

static void one_sided_even(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_ONE_SIDED_EVEN_PARAMETERS };
  (void)before, (void)after;
  const double size = fabs(ends->u1), secant = p[K] * pow(size / p[R], p[N] - 1.0);
  out->value = secant * size;
  out->by_u1 = p[N] * secant * ed_sign(ends->u1);
}

const ed_effect_form ed_effect_one_sided_even = {.name = "one_sided.even", .at_end = one_sided_even};

/* Q' + Q/tau = k v, v linear between the ends of the step. */
static void relaxation_branch(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_RELAXATION_BRANCH_MAXWELL_PARAMETERS };
  const double rate = 1.0 / p[TAU], velocity[3] = {ends->v0, ends->v1 - ends->v0, 0.0};
  double gain[3], *const gains[3] = {&gain[0], &gain[1], &gain[2]};
  ed_relax(1, ends->h, velocity, &rate, &p[K], &before, after, gains);
  out->value = *after;
  out->by_v0 = gain[0] - gain[1];
  out->by_v1 = gain[1];
}

const ed_effect_form ed_effect_relaxation_branch_maxwell = {
    .name = "relaxation_branch.maxwell", .has_state = 1, .on_speed = 1, .at_end = relaxation_branch};

static void dashpot(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_VELOCITY_EXPONENT_DASHPOT_PARAMETERS };
  (void)before, (void)after;
  double secant;
  ed_power_dashpot(p[C], p[ALPHA], ends->v1, &secant, &out->by_v1);
  out->value = secant * ends->v1;
  out->chord = fmax(secant - out->by_v1, 0.0);
}

const ed_effect_form ed_effect_velocity_exponent_dashpot = {.name = "velocity_exponent.dashpot", .on_speed = 1, .at_end = dashpot};

/* A dashpot whose coefficient is proportional to a power of the deformation: none at rest. */
static void dashpot_of_position(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_VELOCITY_EXPONENT_POSITION_PARAMETERS };
  (void)before, (void)after;
  double secant;
  const double size = fabs(ends->u1), at = pow(size / p[R], p[Q]);
  ed_power_dashpot(p[C] * at, p[ALPHA], ends->v1, &secant, &out->by_v1);
  out->value = secant * ends->v1;
  out->by_u1 = size > 0.0 ? p[Q] * out->value / ends->u1 : 0.0;
  out->chord = fmax(secant - out->by_v1, 0.0);
}

const ed_effect_form ed_effect_velocity_exponent_position = {
    .name = "velocity_exponent.position", .on_speed = 1, .at_end = dashpot_of_position};

/* Activated flow [Eyring 1936]. */
static void flow(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_VELOCITY_EXPONENT_FLOW_PARAMETERS };
  (void)before, (void)after;
  const double v = ends->v1;
  out->value = p[F] * asinh(v / p[V0]);
  out->by_v1 = p[F] / hypot(v, p[V0]);
  out->chord = v != 0.0 ? fmax(out->value / v - out->by_v1, 0.0) : 0.0;
}

const ed_effect_form ed_effect_velocity_exponent_flow = {.name = "velocity_exponent.flow", .on_speed = 1, .at_end = flow};

/* A gas that is compressed where c u is positive. Its room ends at c u = 1: from LAST on the force goes on straight. */
static void gas_spring_polytropic(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_GAS_SPRING_POLYTROPIC_PARAMETERS };
  static const double LAST = 0.95;
  (void)before, (void)after;
  const double x = p[C] * ends->u1, room = 1.0 - fmin(x, LAST), pressure = p[P] * pow(room, -p[N]), slope = p[N] * pressure / room;
  out->value = pressure + slope * fmax(x - LAST, 0.0);
  out->by_u1 = slope * p[C];
}

const ed_effect_form ed_effect_gas_spring_polytropic = {.name = "gas_spring.polytropic", .at_end = gas_spring_polytropic};
