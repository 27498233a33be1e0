/* Effects that multiply the force of the law. */
#include "damper/effect.h"

#include <math.h>

/* The envelope of the deformation, which fades with time constant tau. */
static double envelope(double tau, double before, const ed_ends *ends, double *after, double *by_u1)
{
  const double now = fabs(ends->u1), faded = before * exp(-ends->h / tau);
  *after = fmax(now, faded);
  *by_u1 = now >= faded ? ed_sign(ends->u1) : 0.0;
  return *after;
}

double ed_payne_share(double a0, double m, double tau, double before, const ed_ends *ends, double *after, double *by_u1)
{
  double a_by_u1;
  const double a = envelope(tau, before, ends, after, &a_by_u1), power = pow(a / a0, m), g = power / (1.0 + power);
  *by_u1 = a > 0.0 ? m * g / (1.0 + power) / a * a_by_u1 : 0.0;
  return g;
}

double ed_path_share(double s0, double q, double before, const ed_ends *ends, double *after, double *by_u1)
{
  *after = before + fabs(ends->du);
  const double power = q == 1.0 ? *after / s0 : pow(*after / s0, q), share = exp(-power);
  *by_u1 = *after > 0.0 ? -share * q * power / *after * ed_sign(ends->du) : 0.0;
  return share;
}

static void constant(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_CONSTANT_PARAMETERS };
  (void)before, (void)ends, (void)after;
  out->value = p[FACTOR];
}

const ed_effect_form ed_effect_constant = {.name = "constant", .is_factor = 1, .at_end = constant};

static void payne_whole(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_PAYNE_WHOLE_PARAMETERS };
  out->value = 1.0 - p[D] * ed_payne_share(p[A0], p[M], p[TAU_A], before, ends, after, &out->by_u1);
  out->by_u1 *= -p[D];
}

const ed_effect_form ed_effect_payne_whole = {
    .name = "payne.whole", .is_factor = 1, .has_state = 1, .on_speed = 1, .at_end = payne_whole};

static void payne_exponential(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_PAYNE_EXPONENTIAL_PARAMETERS };
  double by_u1;
  const double a = envelope(p[TAU_A], before, ends, after, &by_u1), power = pow(a / p[A0], p[M]);
  out->value = 1.0 + p[D] * expm1(-power);
  out->by_u1 = a > 0.0 ? -p[D] * exp(-power) * p[M] * power / a * by_u1 : 0.0;
}

const ed_effect_form ed_effect_payne_exponential = {
    .name = "payne.exponential", .is_factor = 1, .has_state = 1, .on_speed = 1, .at_end = payne_exponential};

/* The filler network breaks along the path and heals in time, the speed constant over the step: x' = (1 - x) |du|/(h s0) - x/tau. */
static void payne_network(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_PAYNE_NETWORK_PARAMETERS };
  const double breaking = fabs(ends->du) / p[S0], both = breaking + ends->h / p[TAU];
  const double decay = exp(-both), gone = -expm1(-both), share = breaking / both;
  *after = decay * before + share * gone;
  out->value = 1.0 - p[D] * *after;
  out->by_u1 = -p[D] * ((share - before) * decay + (1.0 - share) * gone / both) * ed_sign(ends->du) / p[S0];
}

const ed_effect_form ed_effect_payne_network = {
    .name = "payne.network", .is_factor = 1, .has_state = 1, .on_speed = 1, .at_end = payne_network};

/* exp(-(s'/s0)^q) = left + recovery (1 - left), left = exp(-(s/s0)^q) */
double ed_path_rested(double s0, double q, double recovery, double before)
{
  return recovery > 0.0 ? s0 * pow(fmax(-log(recovery + (1.0 - recovery) * exp(-pow(before / s0, q))), 0.0), 1.0 / q) : before;
}

static void mullins_path(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_MULLINS_PATH_PARAMETERS };
  out->value = 1.0 + p[M] * ed_path_share(p[S0], p[Q], before, ends, after, &out->by_u1);
  out->by_u1 *= p[M];
}

static double mullins_path_rested(const double *p, double before)
{
  enum { ED_EFFECT_MULLINS_PATH_PARAMETERS };
  return ed_path_rested(p[S0], p[Q], p[RECOVERY], before);
}

const ed_effect_form ed_effect_mullins_path = {
    .name = "mullins.path", .is_factor = 1, .has_state = 1, .at_end = mullins_path, .rested = mullins_path_rested};

/* Pseudo-elasticity [Ogden & Roxburgh 1999; beta: Abaqus Theory Manual, section 4.7.1] with u^2 for the energy, as of a linear spring. */
static void mullins_maximum(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_MULLINS_MAXIMUM_PARAMETERS };
  const double u = fabs(ends->u1), largest = fmax(before, u), width = p[R] * p[R] + p[BETA] * largest * largest;
  const double below = (largest - u) * (largest + u) / width;
  *after = largest;
  out->value = 1.0 - p[M] * erf(below);
  out->by_u1 = u < before ? p[M] * M_2_SQRTPI * exp(-below * below) * 2.0 * ends->u1 / width : 0.0;
}

static double mullins_maximum_rested(const double *p, double before)
{
  enum { ED_EFFECT_MULLINS_MAXIMUM_PARAMETERS };
  return (1.0 - p[RECOVERY]) * before;
}

const ed_effect_form ed_effect_mullins_maximum = {
    .name = "mullins.maximum", .is_factor = 1, .has_state = 1, .at_end = mullins_maximum, .rested = mullins_maximum_rested};

/* Discontinuous damage [Simo 1987] with the deformation in place of the energy. */
static void mullins_damage(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_MULLINS_DAMAGE_PARAMETERS };
  const double u = fabs(ends->u1), largest = fmax(before, u), power = pow(largest / p[R], p[P]);
  *after = largest;
  out->value = 1.0 + p[M] * expm1(-power);
  out->by_u1 = u >= before && u > 0.0 ? -p[M] * exp(-power) * p[P] * power / u * ed_sign(ends->u1) : 0.0;
}

static double mullins_damage_rested(const double *p, double before)
{
  enum { ED_EFFECT_MULLINS_DAMAGE_PARAMETERS };
  return (1.0 - p[RECOVERY]) * before;
}

const ed_effect_form ed_effect_mullins_damage = {
    .name = "mullins.damage", .is_factor = 1, .has_state = 1, .at_end = mullins_damage, .rested = mullins_damage_rested};

/* Slip through the middle of the loops [Baber & Noori 1986]: its zone grows with the largest deformation so far. */
static void pinching_slip(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_PINCHING_SLIP_PARAMETERS };
  const double u = fabs(ends->u1), largest = fmax(before, u), x = largest > 0.0 ? u / (p[W] * largest) : 1.0 / p[W];
  const double slips = p[D] * exp(-x * x);
  *after = largest;
  out->value = 1.0 - slips;
  out->by_u1 = u < before ? 2.0 * x * slips / (p[W] * largest) * ed_sign(ends->u1) : 0.0;
}

const ed_effect_form ed_effect_pinching_slip = {
    .name = "pinching.slip", .is_factor = 1, .has_state = 1, .at_end = pinching_slip};

static void degradation_path(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_DEGRADATION_PATH_PARAMETERS };
  const double left = ed_path_share(p[S0], p[Q], before, ends, after, &out->by_u1);
  out->value = 1.0 - p[D] * (1.0 - left);
  out->by_u1 *= p[D];
}

const ed_effect_form ed_effect_degradation_path = {
    .name = "degradation.path", .is_factor = 1, .has_state = 1, .at_end = degradation_path};

/* Work and heat grow slowly: the factor takes those of the beginning of the step. */
static void degradation_energy(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_DEGRADATION_ENERGY_PARAMETERS };
  (void)ends, (void)after;
  out->value = 1.0 - p[D] * (1.0 - exp(-pow(fmax(before, 0.0) / p[E0], p[Q])));
}

static double add_work(const double *p, double before, double h, double work)
{
  (void)p, (void)h;
  return before + work;
}

const ed_effect_form ed_effect_degradation_energy = {
    .name = "degradation.energy", .is_factor = 1, .has_state = 1, .at_end = degradation_energy, .worked = add_work};

static void self_heating_rate(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  (void)p, (void)ends, (void)after;
  out->value = exp(-before);
}

static double add_heat(const double *p, double before, double h, double work)
{
  enum { ED_EFFECT_SELF_HEATING_RATE_PARAMETERS };
  return before * exp(-h / p[TAU_H]) + p[BETA] * work;
}

const ed_effect_form ed_effect_self_heating_rate = {
    .name = "self_heating.rate", .is_factor = 1, .has_state = 1, .on_speed = 1, .at_end = self_heating_rate, .worked = add_heat};

static void one_sided_factor(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_ONE_SIDED_FACTOR_PARAMETERS };
  (void)before, (void)after;
  const double u = p[SIDE] * ends->u1;
  const int rises = u > 0.0 && u < ends->jump;
  out->value = 1.0 + (rises ? p[B] * u / ends->jump : u > 0.0 ? p[B] : 0.0);
  out->by_u1 = rises ? p[B] * p[SIDE] / ends->jump : 0.0;
}

const ed_effect_form ed_effect_one_sided_factor = {.name = "one_sided.factor", .is_factor = 1, .at_end = one_sided_factor};

/* Valves of the two directions: over v0 the factor rises from rest, so that laws that carry a force there have no jump. */
static void one_sided_valve(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_ONE_SIDED_VALVE_PARAMETERS };
  (void)before, (void)after;
  const double x = p[SIDE] * ends->v1 / p[V0], near = 1.0 / cosh(x);
  out->value = 1.0 + (x > 0.0 ? p[B] * tanh(x) : 0.0);
  out->by_v1 = x > 0.0 ? p[B] * p[SIDE] / p[V0] * near * near : 0.0;
}

const ed_effect_form ed_effect_one_sided_valve = {
    .name = "one_sided.valve", .is_factor = 1, .on_speed = 1, .at_end = one_sided_valve};

/* The force with its factor has no jump, as the law's force is zero where the factor changes. */
static void one_sided_force(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_ONE_SIDED_FORCE_PARAMETERS };
  (void)before, (void)after;
  out->value = 1.0 + (p[SIDE] * ends->law > 0.0 ? p[B] : 0.0);
}

const ed_effect_form ed_effect_one_sided_force = {
    .name = "one_sided.force", .is_factor = 1, .by_force = 1, .at_end = one_sided_force};

/* Beyond F_l the share s of the law's force is lost: phi F = F - s max(|F| - F_l, 0) sgn F. */
static void limit_force(const double *p, double before, const ed_ends *ends, double *after, ed_effect_value *out)
{
  enum { ED_EFFECT_LIMIT_FORCE_PARAMETERS };
  (void)before, (void)after;
  const double law = ends->law, size = fabs(law), over = size - p[F_L];
  const int limits = over > 0.0 && p[SIDE] * law >= 0.0;
  out->value = limits ? 1.0 - p[S] * over / size : 1.0;
  out->by_law = limits ? -p[S] * p[F_L] / (size * law) : 0.0;
}

const ed_effect_form ed_effect_limit_force = {.name = "limit.force", .is_factor = 1, .by_force = 1, .at_end = limit_force};
