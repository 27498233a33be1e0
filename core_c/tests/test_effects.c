/* Effects of laws: forces against the formulas evaluated here from the samples, true tangents, work, and braces in series; inside the
 * MGMM against its own terms and against its differential equation. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

typedef struct {
  int form, n;
  double parameter[5];
} effect;

static const effect EACH[] = {
    {ED_EFFECT_CONSTANT, 1, {0.8}},
    {ED_EFFECT_PAYNE_WHOLE, 4, {0.3, 0.4, 1.3, 2.0}},
    {ED_EFFECT_PAYNE_ELASTIC, 4, {1.5, 0.4, 0.8, 0.7}},
    {ED_EFFECT_MULLINS_PATH, 4, {0.4, 6.0, 1.3, 0.3}},
    {ED_EFFECT_MULLINS_MAXIMUM, 4, {0.35, 0.6, 0.3, 0.0}},
    {ED_EFFECT_MULLINS_ELASTIC, 4, {2.0, 5.0, 0.6, 1.0}},
    {ED_EFFECT_DEGRADATION_ENERGY, 3, {0.25, 3.0, 0.8}},
    {ED_EFFECT_SELF_HEATING_RATE, 2, {0.03, 4.0}},
    {ED_EFFECT_HARDENING_POWER, 3, {0.7, 3.0, 1.1}},
    {ED_EFFECT_HARDENING_THRESHOLD, 2, {3.0, 0.6}},
    {ED_EFFECT_ONE_SIDED_FACTOR, 2, {0.2, -1.0}},
    {ED_EFFECT_ONE_SIDED_SPRING, 3, {2.5, 0.5, -1.0}},
    {ED_EFFECT_RELAXATION_BRANCH_MAXWELL, 2, {3.0, 0.25}},
    {ED_EFFECT_VELOCITY_EXPONENT_DASHPOT, 2, {0.6, 0.4}},
    {ED_EFFECT_PAYNE_NETWORK, 3, {0.4, 1.5, 2.0}},
    {ED_EFFECT_MULLINS_DAMAGE, 4, {0.3, 0.7, 1.4, 0.5}},
    {ED_EFFECT_VELOCITY_EXPONENT_FLOW, 2, {0.5, 0.3}},
    {ED_EFFECT_DEGRADATION_PATH, 3, {0.2, 4.0, 1.6}},
    {ED_EFFECT_ONE_SIDED_CONTACT, 5, {1.4, 0.2, 1.5, -1.0, 0.8}},
    {ED_EFFECT_ONE_SIDED_EVEN, 3, {0.9, 2.2, 0.7}},
    {ED_EFFECT_PAYNE_EXPONENTIAL, 4, {0.25, 0.5, 1.2, 1.5}},
    {ED_EFFECT_HARDENING_EXPONENTIAL, 2, {0.4, 1.1}},
    {ED_EFFECT_FRICTION_COULOMB, 2, {0.5, 0.5}},
    {ED_EFFECT_FRICTION_PRESLIDING, 3, {0.4, 0.15, 1.0}},
    {ED_EFFECT_FRICTION_STRIBECK, 3, {0.3, 0.8, 4.0}},
    {ED_EFFECT_ONE_SIDED_VALVE, 3, {0.3, 0.5, -1.0}},
    {ED_EFFECT_GAS_SPRING_POLYTROPIC, 3, {0.6, -0.55, 1.3}},
    {ED_EFFECT_ONE_SIDED_FORCE, 2, {0.3, -1.0}},
    {ED_EFFECT_HARDENING_SATURATING, 2, {1.2, 0.5}},
    {ED_EFFECT_VELOCITY_EXPONENT_POSITION, 4, {0.5, 0.6, 1.4, 0.8}},
    {ED_EFFECT_HYSTERESIS_STRETCH, 4, {0.4, 0.2, 1.3, 0.7}},
    {ED_EFFECT_HYSTERESIS_BOUC_WEN, 3, {1.1, -1.8, 1.2}}, /* it stiffens on its way out */
    {ED_EFFECT_PINCHING_SLIP, 2, {0.4, 0.35}},
    {ED_EFFECT_FRICTION_LOADED, 3, {0.2, 0.3, 0.5}},
    {ED_EFFECT_LIMIT_FORCE, 3, {0.7, 1.5, 0.0}},
};
enum { FORMS = sizeof EACH / sizeof *EACH };

static const double ZENER[] = {2.0, 5.0, 0.4};
/* k1 c1 k0 c_NL alpha k_a k_b u_ref c_a c_b v_ref consistent: tau = 0.4 s */
static const double MGMM[] = {2.5, 1.0, 2.0, 0.4, 0.6, 1.0, 0.5, 0.5, 0.3, 0.2, 1.0, 0.0};
static const double TAU = 0.4;
/* F + tau F' = k0 u + (tau k0 + c1) v */
static const double LINEAR_MGMM[] = {2.5, 1.0, 2.0, 0.0, 0.6, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0};

static void place(rig *r, const effect *one, int inside)
{
  char message[256] = "";
  CHECK_STATUS(ed_damper_add_effect(r->damper, one->form, inside, one->n, one->parameter, message, sizeof message), ED_OK);
  CHECK(ed_damper_state_size(r->damper) <= LARGEST_DAMPER_STATE);
  ed_damper_start(r->damper, r->state);
}

static void add_effect(rig *r, const effect *one)
{
  place(r, one, 0);
}

/* Drivers and forces by the definitions, with memories of their own. */
typedef struct {
  double u, v, envelope[FORMS], largest, path, work, heat, branch, network, friction, stretch, hysteresis, force;
} memory;

static double broken(const double *p, double *envelope, double h, double u)
{
  *envelope = fmax(fabs(u), *envelope * exp(-h / p[3]));
  return pow(*envelope / p[1], p[2]);
}

static double payne(const double *p, double *envelope, double h, double u)
{
  const double power = broken(p, envelope, h, u);
  return power / (1.0 + power);
}

/* Velocity of the cubic over a step, at s of 0 to 1; and its deformation. */
static double cubic_v(const memory *m, double h, double u, double v, double s)
{
  const double w = (u - m->u) / h;
  return m->v + s * (6.0 * w - 4.0 * m->v - 2.0 * v) + s * s * (3.0 * m->v + 3.0 * v - 6.0 * w);
}

static double cubic_u(const memory *m, double h, double u, double v, double s)
{
  return (1.0 - s) * (1.0 - s) * ((1.0 + 2.0 * s) * m->u + s * h * m->v) + s * s * ((3.0 - 2.0 * s) * u - (1.0 - s) * h * v);
}

/* z/x0 of Dahl's model after a way that does not turn. */
static double dahl(const double *p, double z, double way)
{
  const double steady = way > 0.0 ? 1.0 : -1.0;
  return steady + (z - steady) * exp(-fabs(way) / p[1]);
}

/* z of Bouc and Wen: with the signs of u' and of z fixed dz/dw = s - (gamma + beta s sgn z) z along the way w, which is linear. */
static double bouc_wen(const double *p, double z, double way)
{
  const double s = way > 0.0 ? 1.0 : -1.0;
  double left = fabs(way);
  if (s * z < 0.0) { /* until it has passed zero */
    const double rate = p[2] - p[1], steady = s / rate, zero = log(1.0 - z / steady) / rate;
    if (left <= zero)
      return steady + (z - steady) * exp(-rate * left);
    left -= zero;
    z = 0.0;
  }
  const double rate = p[2] + p[1], steady = s / rate;
  return steady + (z - steady) * exp(-rate * left);
}

/* A state after a way from one turn of the cubic to the next, by bisection between a hundred places. */
static double along(const memory *m, double h, double u, double v, const double *p, double z, double (*go)(const double *p, double z, double way))
{
  double from = m->u;
  for (int i = 0; i <= 100; i++) {
    double low = 0.01 * i, high = fmin(0.01 * (i + 1), 1.0);
    if (i < 100 && cubic_v(m, h, u, v, low) * cubic_v(m, h, u, v, high) >= 0.0)
      continue;
    for (int k = 0; i < 100 && k < 60; k++) {
      const double middle = 0.5 * (low + high);
      *(cubic_v(m, h, u, v, middle) * cubic_v(m, h, u, v, low) > 0.0 ? &low : &high) = middle;
    }
    const double to = i < 100 ? cubic_u(m, h, u, v, low) : u;
    z = go(p, z, to - from);
    from = to;
  }
  return z;
}

/* The force with effects at (u, v) after h, given the law's; `used`: which of EACH act. */
static double expected(memory *m, const int *used, double h, double u, double v, double law)
{
  double phi = 1.0, beside = 0.0;
  m->path += fabs(u - m->u);
  m->largest = fmax(m->largest, fabs(u));
  for (int i = 0; i < FORMS; i++) {
    const double *p = EACH[i].parameter;
    if (!used[i])
      continue;
    switch (EACH[i].form) {
    case ED_EFFECT_CONSTANT: phi *= p[0]; break;
    case ED_EFFECT_PAYNE_WHOLE: phi *= 1.0 - p[0] * payne(p, &m->envelope[i], h, u); break;
    case ED_EFFECT_PAYNE_ELASTIC: beside -= p[0] * payne(p, &m->envelope[i], h, u) * u; break;
    case ED_EFFECT_MULLINS_PATH: phi *= 1.0 + p[0] * exp(-pow(m->path / p[1], p[2])); break;
    case ED_EFFECT_MULLINS_MAXIMUM:
      phi *= 1.0 - p[0] * erf((m->largest * m->largest - u * u) / (p[1] * p[1] + p[2] * m->largest * m->largest));
      break;
    case ED_EFFECT_MULLINS_ELASTIC: beside += p[0] * exp(-pow(m->path / p[1], p[2])) * u; break;
    case ED_EFFECT_DEGRADATION_ENERGY: phi *= 1.0 - p[0] * (1.0 - exp(-pow(fmax(m->work, 0.0) / p[1], p[2]))); break;
    case ED_EFFECT_SELF_HEATING_RATE: phi *= exp(-m->heat); break;
    case ED_EFFECT_HARDENING_POWER: beside += p[0] * u * pow(fabs(u) / p[2], p[1] - 1.0); break;
    case ED_EFFECT_HARDENING_THRESHOLD: beside += fabs(u) > p[1] ? p[0] * (u - copysign(p[1], u)) : 0.0; break;
    case ED_EFFECT_ONE_SIDED_FACTOR: phi *= p[1] * u > 0.0 ? 1.0 + p[0] : 1.0; break;
    case ED_EFFECT_ONE_SIDED_SPRING: beside += p[2] * u > p[1] ? p[0] * (p[2] * u - p[1]) * p[2] : 0.0; break;
    case ED_EFFECT_RELAXATION_BRANCH_MAXWELL: {
      const double tau = p[1], e = exp(-h / tau), slope = (v - m->v) / h; /* particular solution k tau (v - slope tau) */
      m->branch = e * (m->branch - p[0] * tau * (m->v - slope * tau)) + p[0] * tau * (v - slope * tau);
      beside += m->branch;
      break;
    }
    case ED_EFFECT_VELOCITY_EXPONENT_DASHPOT: beside += copysign(p[0] * pow(fabs(v), p[1]), v); break;
    case ED_EFFECT_PAYNE_NETWORK: { /* of x' = a - (a + b) x the steady a/(a + b), from which it is exp(-(a + b) h) away */
      const double a = fabs(u - m->u) / (h * p[1]), both = a + 1.0 / p[2], steady = a / both;
      m->network = steady + (m->network - steady) * exp(-both * h);
      phi *= 1.0 - p[0] * m->network;
      break;
    }
    case ED_EFFECT_MULLINS_DAMAGE: phi *= 1.0 - p[0] * (1.0 - exp(-pow(m->largest / p[1], p[2]))); break;
    case ED_EFFECT_VELOCITY_EXPONENT_FLOW: beside += p[0] * log(v / p[1] + sqrt(v * v / (p[1] * p[1]) + 1.0)); break;
    case ED_EFFECT_ONE_SIDED_CONTACT: /* k r^(1-n) x^n */
      beside += p[3] * u > p[1] ? p[3] * p[0] * pow(p[4], 1.0 - p[2]) * pow(p[3] * u - p[1], p[2]) : 0.0;
      break;
    case ED_EFFECT_ONE_SIDED_EVEN: beside += p[0] * p[2] * pow(fabs(u) / p[2], p[1]); break;
    case ED_EFFECT_DEGRADATION_PATH: phi *= 1.0 - p[0] * (1.0 - exp(-pow(m->path / p[1], p[2]))); break;
    case ED_EFFECT_PAYNE_EXPONENTIAL: phi *= 1.0 - p[0] * (1.0 - exp(-broken(p, &m->envelope[i], h, u))); break;
    case ED_EFFECT_HARDENING_EXPONENTIAL: beside += p[0] * u * (exp(u * u / (p[1] * p[1])) - 1.0); break;
    case ED_EFFECT_ONE_SIDED_VALVE: phi *= p[2] * v > 0.0 ? 1.0 + p[0] * (1.0 - 2.0 / (exp(2.0 * p[2] * v / p[1]) + 1.0)) : 1.0; break;
    case ED_EFFECT_ONE_SIDED_FORCE: phi *= p[1] * law > 0.0 ? 1.0 + p[0] : 1.0; break;
    case ED_EFFECT_LIMIT_FORCE: phi *= fabs(law) > p[1] ? (p[1] + (1.0 - p[0]) * (fabs(law) - p[1])) / fabs(law) : 1.0; break;
    case ED_EFFECT_GAS_SPRING_POLYTROPIC: { /* of P V^n = constant; straight from where a twentieth of the room is left */
      const double room = 1.0 - p[1] * u;
      beside += room > 0.05 ? p[0] / pow(room, p[2]) : p[0] / pow(0.05, p[2]) * (1.0 + p[2] * (0.05 - room) / 0.05);
      break;
    }
    case ED_EFFECT_FRICTION_COULOMB: beside += p[0] * (1.0 - 2.0 / (exp(2.0 * v / p[1]) + 1.0)); break;
    case ED_EFFECT_FRICTION_LOADED: beside += (p[1] + p[0] * fabs(law)) * (1.0 - 2.0 / (exp(2.0 * v / p[2]) + 1.0)); break;
    case ED_EFFECT_FRICTION_PRESLIDING:
      m->friction = along(m, h, u, v, p, m->friction, dahl);
      beside += p[0] * m->friction;
      break;
    case ED_EFFECT_HARDENING_SATURATING: beside += p[0] * p[1] * (1.0 - 2.0 / (exp(2.0 * u / p[1]) + 1.0)); break;
    case ED_EFFECT_VELOCITY_EXPONENT_POSITION:
      beside += copysign(p[0] * pow(fabs(u) / p[3], p[2]) * pow(fabs(v), p[1]), v);
      break;
    case ED_EFFECT_HYSTERESIS_STRETCH:
      m->stretch = along(m, h, u, v, p, m->stretch, dahl);
      beside += p[0] * pow(fabs(u) / p[3], p[2]) * m->stretch;
      break;
    case ED_EFFECT_HYSTERESIS_BOUC_WEN:
      m->hysteresis = along(m, h, u, v, p, m->hysteresis, bouc_wen);
      beside += p[0] * m->hysteresis;
      break;
    case ED_EFFECT_PINCHING_SLIP: phi *= 1.0 - p[0] * exp(-u * u / (p[1] * p[1] * m->largest * m->largest)); break;
    case ED_EFFECT_FRICTION_STRIBECK: {
      const double x = v / p[2];
      beside += p[0] * (1.0 + p[1] * exp(-x * x)) * (1.0 - 2.0 / (exp(20.0 * x) + 1.0));
      break;
    }
    }
  }
  const double force = phi * law + beside, work = 0.5 * (m->force + force) * (u - m->u);
  m->work += work;
  m->heat = m->heat * exp(-h / 4.0) + 0.03 * work; /* of EACH */
  m->force = force;
  m->u = u;
  m->v = v;
  return force;
}

static double u_at(double t)
{
  return sin(2.1 * t) * (0.5 + 0.1 * t);
}

static double v_at(double t)
{
  return 2.1 * cos(2.1 * t) * (0.5 + 0.1 * t) + 0.1 * sin(2.1 * t);
}

/* One effect after the other (only < FORMS), or all together, on a law with an exact step or one of SUNDIALS. `move` makes every step
 * twice: nothing of a trial is left behind. */
static void check_forces(int law, int n, const double *parameters, int only)
{
  rig with_effects = new_rig(law, n, parameters, 0.0), bare = new_rig(law, n, parameters, 0.0);
  int used[FORMS];
  for (int i = 0; i < FORMS; i++) {
    used[i] = only == FORMS || only == i;
    if (used[i])
      add_effect(&with_effects, &EACH[i]);
  }
  memory m = {0};
  double changed = 0.0;
  for (int step = 1; step <= 150; step++) {
    const double h = step % 3 ? 0.05 : 0.02, t = 0.04 * step, u = u_at(t), v = v_at(t);
    const double plain = move(&bare, h, u, v), force = expected(&m, used, h, u, v, plain);
    CHECK_NEAR(move(&with_effects, h, u, v), force, 1e-13 * (1.0 + fabs(force)) * 10.0); /* rounding of some ten operations */
    changed = fmax(changed, fabs(force - plain));
  }
  CHECK(changed > 0.02);
  free_rig(&with_effects);
  free_rig(&bare);
}

/* Derivatives of every effect against central differences; not near corners of the definitions, nor where the power of the velocity
 * bends within the difference. */
static void check_tangents(double brace, int inside)
{
  for (int i = 0; i < FORMS; i++) {
    rig r = inside ? new_rig(ED_LAW_MGMM, 12, LINEAR_MGMM, brace) : new_rig(ED_LAW_ZENER, 3, ZENER, brace);
    place(&r, &EACH[i], inside);
    for (int step = 1; step < 80; step++) {
      const double h = 0.04, t = h * step + 0.003, u = u_at(t), v = v_at(t);
      const int corner = (brace > 0.0 && EACH[i].form == ED_EFFECT_ONE_SIDED_FACTOR && fabs(u) < 0.1) || fabs(v) < 0.1;
      if (!corner)
        check_slopes(&r, h, u, v, 1e-5, 1e-4, brace > 0.0 ? 1e-4 : 5e-6);
      move(&r, h, u, v);
    }
    free_rig(&r);
  }
}

/* The work of a hardening spring to a deformation x and part of the way back: k x^(p + 1) / ((p + 1) r^(p - 1)). */
static void check_work(void)
{
  const double none[] = {1e-12, 0.0}, *p = EACH[8].parameter, end = 0.9;
  rig r = new_rig(ED_LAW_KELVIN_VOIGT, 2, none, 0.0);
  add_effect(&r, &EACH[8]);
  double work = 0.0, before = 0.0;
  const int n = 2000, out = 1500;
  for (int i = 1; i <= n; i++) {
    const double u = end * (i <= out ? (double)i / out : 1.0 - 0.5 * (i - out) / (n - out)), from = r.u;
    const double force = move_to(&r, u);
    work += 0.5 * (before + force) * (u - from);
    before = force;
  }
  const double x = 0.5 * end;
  CHECK_NEAR(work, p[0] * pow(x, p[1] + 1.0) / ((p[1] + 1.0) * pow(p[2], p[1] - 1.0)), 1e-6); /* (end / n)^2 of the trapezoids */
  free_rig(&r);
}

/* Of kb (u - x) = k x + c x^3 the real root (Cardano). */
static double own_deformation(double u, double k, double c, double kb)
{
  const double p = (k + kb) / c, q = -kb * u / c, root = sqrt(0.25 * q * q + p * p * p / 27.0);
  return cbrt(-0.5 * q + root) + cbrt(-0.5 * q - root);
}

/* A spring with a hardening one beside it, both in series with a brace; by the path for laws that depend on speed and by the other. */
static void check_brace_with_hardening(void)
{
  const double k = 3.0, kb = 4.0, *p = EACH[8].parameter, cubic = p[0] / (p[2] * p[2]);
  const double kelvin[] = {k, 0.0}, plastic[] = {k, 1e6, 0.0};
  rig both[] = {new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, kb), new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, kb)};
  for (int i = 0; i < 2; i++) {
    add_effect(&both[i], &EACH[8]);
    for (int step = 1; step < 100; step++) {
      const double t = 0.05 * step, u = 3.0 * u_at(t), v = 3.0 * v_at(t);
      const double x = own_deformation(u, k, cubic, kb);
      CHECK_NEAR(move(&both[i], 0.05, u, v), kb * (u - x), 1e-8 * kb * (1.0 + fabs(u))); /* of the balance: 1e-9 */
    }
    free_rig(&both[i]);
  }
}

/* A spring that is stiffer to one side, in series with a brace: two springs; the jump rises over 1e-5. */
static void check_one_sided_brace(void)
{
  const double k = 3.0, kb = 4.0, kelvin[] = {k, 0.0}, plastic[] = {k, 1e6, 0.0}, b = EACH[10].parameter[0], side = EACH[10].parameter[1];
  rig both[] = {new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, kb), new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, kb)};
  for (int i = 0; i < 2; i++) {
    add_effect(&both[i], &EACH[10]);
    for (int step = 1; step < 100; step++) {
      const double t = 0.05 * step, u = u_at(t), own = side * u > 0.0 ? k * (1.0 + b) : k;
      CHECK_NEAR(move(&both[i], 0.05, u, v_at(t)), u * own * kb / (own + kb), 1e-5 * b * k);
    }
    free_rig(&both[i]);
  }
}

/* A spring with a Maxwell branch is a Zener damper: exactly where the velocity is linear, as it is of a damper with a brace. */
static void check_branch_is_zener(double brace)
{
  const double kelvin[] = {ZENER[0], 0.0};
  const effect branch = {ED_EFFECT_RELAXATION_BRANCH_MAXWELL, 2, {ZENER[1], ZENER[2] / ZENER[1]}};
  rig one = new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, brace), other = new_rig(ED_LAW_ZENER, 3, ZENER, brace);
  add_effect(&one, &branch);
  for (int step = 1; step < 100; step++) {
    const double h = 0.03, v = cos(0.2 * step), u = one.u + 0.5 * h * (one.v + v);
    CHECK_NEAR(move(&one, h, u, v), move(&other, h, u, v), brace > 0.0 ? 1e-8 : 1e-13);
  }
  free_rig(&one);
  free_rig(&other);
}

/* A yielding damper whose force falls while it is deformed further, in series with a brace: at the own deformation u - F / kb the same
 * damper without brace carries F. */
static void check_softening_brace(double kb)
{
  const double plastic[] = {10.0, 2.0, 0.0};
  const effect soft[] = {{ED_EFFECT_MULLINS_PATH, 4, {1.0, 0.5, 1.0, 0.0}}, {ED_EFFECT_DEGRADATION_ENERGY, 3, {0.5, 1.0, 1.0}}};
  rig braced = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, kb), own = new_rig(ED_LAW_ELASTIC_PLASTIC, 3, plastic, 0.0);
  for (int i = 0; i < 2; i++) {
    add_effect(&braced, &soft[i]);
    add_effect(&own, &soft[i]);
  }
  double largest = 0.0, last = 0.0;
  for (int step = 1; step < 200; step++) {
    const double u = sin(0.05 * step), force = move_to(&braced, u);
    CHECK_NEAR(move_to(&own, u - force / kb), force, 1e-7 * kb);
    largest = fmax(largest, fabs(force));
    last = force;
  }
  CHECK(largest > 2.5 && fabs(last) < 1.5); /* of 2.0: it was stronger when new, and is weaker now */
  free_rig(&braced);
  free_rig(&own);
}

/* Steps h of a motion from rest over some seconds; the largest difference of two dampers after each. */
static double differ(rig *one, rig *other, double h, double *largest)
{
  double most = 0.0;
  *largest = 0.0;
  for (int step = 1; step * h < 5.0; step++) {
    const double u = 0.3 * sin(3.0 * step * h) - 0.9 * sin(step * h), v = 0.9 * (cos(3.0 * step * h) - cos(step * h));
    const double force = move(one, h, u, v);
    most = fmax(most, fabs(force - move(other, h, u, v)));
    *largest = fmax(*largest, fabs(force));
  }
  return most;
}

/* Terms of the MGMM as effects inside it: its power of the velocity, and k_b u. They differ by what is linear over a step there:
 * second order. */
static void check_inside_is_a_term(void)
{
  const effect terms[] = {{ED_EFFECT_VELOCITY_EXPONENT_DASHPOT, 2, {0.7, 1.5}}, {ED_EFFECT_HARDENING_POWER, 3, {0.9, 1.0, 1.0}}};
  for (int i = 0; i < 2; i++) {
    double with[12], error[2], largest;
    memcpy(with, LINEAR_MGMM, sizeof with);
    if (i == 0) {
      with[3] = 0.7;
      with[4] = 1.5;
    } else
      with[6] = 0.9;
    for (int fine = 0; fine < 2; fine++) {
      double bare[12];
      memcpy(bare, LINEAR_MGMM, sizeof bare);
      bare[4] = with[4];
      rig with_effects = new_rig(ED_LAW_MGMM, 12, bare, 0.0), own = new_rig(ED_LAW_MGMM, 12, with, 0.0);
      place(&with_effects, &terms[i], 1);
      error[fine] = differ(&with_effects, &own, fine ? 0.005 : 0.01, &largest);
      free_rig(&with_effects);
      free_rig(&own);
    }
    CHECK(error[0] < 2e-4 * largest && error[1] < 0.3 * error[0]);
  }
}

/* A constant factor inside the law is one beside it: (phi - 1)(F + tau F') relaxes to (phi - 1) F. */
static void check_constant_inside(void)
{
  rig inside = new_rig(ED_LAW_MGMM, 12, MGMM, 0.0), beside = new_rig(ED_LAW_MGMM, 12, MGMM, 0.0);
  double largest;
  place(&inside, &EACH[0], 1);
  place(&beside, &EACH[0], 0);
  CHECK(differ(&inside, &beside, 0.02, &largest) < 1e-14 * largest * 10.0);
  CHECK(largest > 1.0);
  free_rig(&inside);
  free_rig(&beside);
}

/* A factor inside the linear MGMM, of which F + tau F' is k0 u + (tau k0 + c1) v: Q' = ((phi(u) - 1)(...) - Q) / tau, by the classical
 * Runge-Kutta method in steps of a hundredth. Path and largest deformation grow with u < 0.5 here, so that phi is a formula of u. */
static double rate_of(int form, const double *p, double t, double q)
{
  const double u = 0.1 * t * t, v = 0.2 * t, everything = 2.0 * u + (TAU * 2.0 + 1.0) * v;
  const double less = form == ED_EFFECT_MULLINS_PATH     ? p[0] * exp(-pow(u / p[1], p[2]))
                      : form == ED_EFFECT_MULLINS_DAMAGE ? -p[0] * (1.0 - exp(-pow(u / p[1], p[2])))
                                                        : -p[0] * pow(u / p[1], p[2]) / (1.0 + pow(u / p[1], p[2]));
  return (less * everything - q) / TAU;
}

static void check_inside_by_equation(void)
{
  const int which[] = {1, 3, 15};
  for (int i = 0; i < 3; i++) {
    const effect *one = &EACH[which[i]];
    double error[2];
    for (int fine = 0; fine < 2; fine++) {
      const double h = fine ? 0.01 : 0.02, dt = 0.01 * h;
      double q = 0.0, most = 0.0, largest = 0.0;
      rig with_effects = new_rig(ED_LAW_MGMM, 12, LINEAR_MGMM, 0.0), bare = new_rig(ED_LAW_MGMM, 12, LINEAR_MGMM, 0.0);
      place(&with_effects, one, 1);
      for (int step = 1; step * h < 2.2; step++) {
        for (int k = 0; k < 100; k++) {
          const double t = (step - 1) * h + k * dt, k1 = rate_of(one->form, one->parameter, t, q);
          const double k2 = rate_of(one->form, one->parameter, t + 0.5 * dt, q + 0.5 * dt * k1);
          const double k3 = rate_of(one->form, one->parameter, t + 0.5 * dt, q + 0.5 * dt * k2);
          const double k4 = rate_of(one->form, one->parameter, t + dt, q + dt * k3);
          q += dt * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
        }
        const double t = step * h, u = 0.1 * t * t, v = 0.2 * t;
        most = fmax(most, fabs(move(&with_effects, h, u, v) - move(&bare, h, u, v) - q));
        largest = fmax(largest, fabs(q));
      }
      CHECK(largest > 0.02);
      error[fine] = most / largest;
      free_rig(&with_effects);
      free_rig(&bare);
    }
    CHECK(error[0] < 2e-4 && error[1] < 0.3 * error[0]); /* linear over a step: second order */
  }
}

static void refused(rig *r, const effect *one, int inside, int status, const char *text)
{
  char message[256] = "";
  const int size = ed_damper_state_size(r->damper);
  CHECK_STATUS(ed_damper_add_effect(r->damper, one->form, inside, one->n, one->parameter, message, sizeof message), status);
  CHECK_CONTAINS(message, text);
  CHECK(ed_damper_state_size(r->damper) == size);
}

static void check_refusals(void)
{
  const double power[] = {1.0, 0.5, 100.0};
  rig plain = new_rig(ED_LAW_ZENER, 3, ZENER, 0.0), braced = new_rig(ED_LAW_MAXWELL_POWER, 3, power, 5.0);
  refused(&plain, &(effect){99, 1, {1.0}}, 0, ED_E_ID, "there is no effect 99");
  refused(&plain, &(effect){ED_EFFECT_CONSTANT, 2, {1.0, 1.0}}, 0, ED_E_ARGUMENT, "effect constant: number of parameters = 2 is not allowed: factor");
  refused(&plain, &(effect){ED_EFFECT_CONSTANT, 1, {NAN}}, 0, ED_E_NOT_FINITE, "a finite number");
  refused(&plain, &(effect){ED_EFFECT_PAYNE_WHOLE, 4, {0.1, 0.0, 1.0, 1.0}}, 0, ED_E_ARGUMENT, "payne.whole: a0 = 0");
  refused(&plain, &(effect){ED_EFFECT_ONE_SIDED_FACTOR, 2, {0.1, 0.5}}, 0, ED_E_ARGUMENT, "1 or -1");
  refused(&plain, &(effect){ED_EFFECT_HARDENING_POWER, 3, {1.0, 0.5, 1.0}}, 0, ED_E_ARGUMENT, "at least 1");
  refused(&braced, &EACH[0], 0, ED_E_ARGUMENT, "the brace must be rigid");
  refused(&plain, &EACH[1], 1, ED_E_ARGUMENT, "inside a law that relaxes all of its forces, as mgmm does, but law zener does not");
  free_rig(&plain);
  free_rig(&braced);
}

int main(void)
{
  const double bouc_wen[] = {1.5, 0.1, 0.1, 1.0, 0.5, 0.5, 2.0};
  for (int only = 0; only <= FORMS; only++)
    check_forces(ED_LAW_ZENER, 3, ZENER, only);
  check_forces(ED_LAW_BOUC_WEN, 7, bouc_wen, FORMS);
  check_tangents(0.0, 0);
  check_tangents(20.0, 0);
  check_tangents(0.0, 1);
  check_tangents(20.0, 1);
  check_inside_is_a_term();
  check_constant_inside();
  check_inside_by_equation();
  check_work();
  check_brace_with_hardening();
  check_one_sided_brace();
  check_branch_is_zener(0.0);
  check_branch_is_zener(15.0);
  check_softening_brace(15.0);
  check_softening_brace(200.0);
  check_refusals();
  return checks_end("effects");
}
