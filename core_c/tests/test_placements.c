/* Effects of the springs and dashpots of a law alone: against what laws are made of, the differential equation of the linear MGMM, other
 * placements of the same; true tangents, braces, refusals. */
#include "checks.h"
#include "damper_rig.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

typedef struct {
  int form, n;
  double parameter[5];
} effect;

static const effect PATH = {ED_EFFECT_MULLINS_PATH, 4, {0.4, 2.0, 1.0, 0.0}}, DAMAGE = {ED_EFFECT_MULLINS_DAMAGE, 4, {0.3, 0.7, 1.4, 0.0}},
                       CONSTANT = {ED_EFFECT_CONSTANT, 1, {0.7}}, HEAT = {ED_EFFECT_SELF_HEATING_RATE, 2, {0.03, 4.0}},
                       SPRING = {ED_EFFECT_HARDENING_POWER, 3, {0.7, 3.0, 1.1}};
static const effect FACTORS[] = {
    {ED_EFFECT_CONSTANT, 1, {0.8}},
    {ED_EFFECT_PAYNE_WHOLE, 4, {0.3, 0.4, 1.3, 2.0}},
    {ED_EFFECT_PAYNE_EXPONENTIAL, 4, {0.25, 0.5, 1.2, 1.5}},
    {ED_EFFECT_PAYNE_NETWORK, 3, {0.4, 1.5, 2.0}},
    {ED_EFFECT_MULLINS_PATH, 4, {0.4, 6.0, 1.2, 0.3}},
    {ED_EFFECT_MULLINS_MAXIMUM, 4, {0.35, 0.6, 0.3, 0.0}},
    {ED_EFFECT_MULLINS_DAMAGE, 4, {0.3, 0.7, 1.4, 0.5}},
    {ED_EFFECT_DEGRADATION_ENERGY, 3, {0.25, 3.0, 1.0}},
    {ED_EFFECT_DEGRADATION_PATH, 3, {0.2, 4.0, 1.0}},
    {ED_EFFECT_SELF_HEATING_RATE, 2, {0.03, 4.0}},
    {ED_EFFECT_ONE_SIDED_FACTOR, 2, {0.2, -1.0}},
    {ED_EFFECT_ONE_SIDED_VALVE, 3, {0.3, 0.5, 1.0}},
};
enum { N_FACTORS = sizeof FACTORS / sizeof *FACTORS };

/* Laws that are a spring k u beside the rest, k first. */
static const struct {
  int law, n;
  double parameter[5];
} SUMS[] = {
    {ED_LAW_KELVIN_VOIGT, 2, {2.0, 0.6}},
    {ED_LAW_LINEARISED, 3, {2.0, 0.3, 4.0}},
    {ED_LAW_ZENER, 3, {2.0, 5.0, 0.4}},
    {ED_LAW_GENERALISED_MAXWELL, 5, {2.0, 5.0, 0.4, 3.0, 2.0}},
    {ED_LAW_FRACTIONAL_KELVIN, 3, {2.0, 0.4, 0.5}},
    {ED_LAW_FRACTIONAL_ZENER, 4, {2.0, 0.1, 0.6, 0.5}},
};
enum { N_SUMS = sizeof SUMS / sizeof *SUMS };
/* k1 c1 k0 c_NL alpha k_a k_b u_ref c_a c_b v_ref consistent: tau = 0.4 s */
static const double MGMM[] = {2.5, 1.0, 2.0, 0.4, 0.6, 1.0, 0.5, 0.5, 0.3, 0.2, 1.0, 0.0};
static const double CONSISTENT[] = {2.5, 1.0, 2.0, 0.4, 0.6, 1.0, 0.5, 0.5, 0.3, 0.2, 1.0, 1.0};
static const double LINEAR_MGMM[] = {2.5, 1.0, 2.0, 0.0, 0.6, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0, 0.0};
static const double TAU = 0.4;

static void place(rig *r, const effect *one, int placement)
{
  char message[256] = "";
  CHECK_STATUS(ed_damper_add_effect(r->damper, one->form, placement, one->n, one->parameter, message, sizeof message), ED_OK);
  CHECK(ed_damper_state_size(r->damper) <= LARGEST_DAMPER_STATE);
  ed_damper_start(r->damper, r->state);
}

static double u_at(double t)
{
  return sin(2.1 * t) * (0.5 + 0.1 * t);
}

static double v_at(double t)
{
  return 2.1 * cos(2.1 * t) * (0.5 + 0.1 * t) + 0.1 * sin(2.1 * t);
}

/* phi (phi_s k u + phi_d (F - k u)), with factors of path, largest deformation and heat by their formulas. */
static void check_sums(void)
{
  for (int i = 0; i < N_SUMS; i++) {
    const double *p = SUMS[i].parameter;
    rig with_effects = new_rig(SUMS[i].law, SUMS[i].n, p, 0.0), bare = new_rig(SUMS[i].law, SUMS[i].n, p, 0.0);
    place(&with_effects, &PATH, ED_PLACE_SPRINGS);
    place(&with_effects, &DAMAGE, ED_PLACE_DASHPOTS);
    place(&with_effects, &HEAT, ED_PLACE_DASHPOTS);
    place(&with_effects, &CONSTANT, ED_PLACE_WHOLE);
    double path = 0.0, largest = 0.0, heat = 0.0, last = 0.0, before = 0.0;
    for (int step = 1; step <= 150; step++) {
      const double h = step % 3 ? 0.05 : 0.02, t = 0.04 * step, u = u_at(t), v = v_at(t);
      const double law = move(&bare, h, u, v);
      path += fabs(u - last);
      largest = fmax(largest, fabs(u));
      const double of_springs = 1.0 + 0.4 * exp(-path / 2.0);
      const double of_dashpots = (1.0 - 0.3 * (1.0 - exp(-pow(largest / 0.7, 1.4)))) * exp(-heat);
      const double force = 0.7 * (of_springs * p[0] * u + of_dashpots * (law - p[0] * u));
      CHECK_NEAR(move(&with_effects, h, u, v), force, 1e-12 * (1.0 + fabs(force)));
      heat = heat * exp(-h / 4.0) + 0.03 * 0.5 * (before + force) * (u - last);
      before = force;
      last = u;
    }
    free_rig(&with_effects);
    free_rig(&bare);
  }
}

/* The same factor on both sides is one inside the law, also of an MGMM whose moduli soften; where nothing relaxes, one of the whole law. */
static void check_both_sides(int law, int n, const double *parameters, int same)
{
  for (int i = 0; i < N_FACTORS; i++) {
    rig sides = new_rig(law, n, parameters, 0.0), all = new_rig(law, n, parameters, 0.0);
    place(&sides, &FACTORS[i], ED_PLACE_SPRINGS);
    place(&sides, &FACTORS[i], ED_PLACE_DASHPOTS);
    place(&all, &FACTORS[i], same);
    for (int step = 1; step <= 100; step++) {
      const double t = 0.05 * step, force = move(&all, 0.05, u_at(t), v_at(t));
      CHECK_NEAR(move(&sides, 0.05, u_at(t), v_at(t)), force, 1e-12 * (1.0 + fabs(force)));
    }
    free_rig(&sides);
    free_rig(&all);
  }
}

/* Of the linear MGMM F + tau F' = phi_s k0 u + phi_d (tau k0 + c1) v, by the classical Runge-Kutta method in steps of a hundredth. Path and
 * largest deformation are u here. */
static double rate_of(double t, double force)
{
  const double u = 0.1 * t * t, v = 0.2 * t, of_springs = 1.0 + 0.4 * exp(-u / 2.0);
  const double of_dashpots = 1.0 - 0.3 * (1.0 - exp(-pow(u / 0.7, 1.4)));
  return (of_springs * 2.0 * u + of_dashpots * (TAU * 2.0 + 1.0) * v - force) / TAU;
}

static void check_by_equation(void)
{
  double error[2];
  for (int fine = 0; fine < 2; fine++) {
    const double h = fine ? 0.01 : 0.02, dt = 0.01 * h;
    double force = 0.0, most = 0.0, changed = 0.0;
    rig with_effects = new_rig(ED_LAW_MGMM, 12, LINEAR_MGMM, 0.0), bare = new_rig(ED_LAW_MGMM, 12, LINEAR_MGMM, 0.0);
    place(&with_effects, &PATH, ED_PLACE_SPRINGS);
    place(&with_effects, &DAMAGE, ED_PLACE_DASHPOTS);
    for (int step = 1; step * h < 2.2; step++) {
      for (int k = 0; k < 100; k++) {
        const double t = (step - 1) * h + k * dt, k1 = rate_of(t, force), k2 = rate_of(t + 0.5 * dt, force + 0.5 * dt * k1);
        const double k3 = rate_of(t + 0.5 * dt, force + 0.5 * dt * k2), k4 = rate_of(t + dt, force + dt * k3);
        force += dt * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
      }
      const double t = step * h, u = 0.1 * t * t, v = 0.2 * t;
      most = fmax(most, fabs(move(&with_effects, h, u, v) - force));
      changed = fmax(changed, fabs(move(&bare, h, u, v) - force));
    }
    CHECK(changed > 0.02);
    error[fine] = most / changed;
    free_rig(&with_effects);
    free_rig(&bare);
  }
  CHECK(error[0] < 2e-4 && error[1] < 0.3 * error[0]); /* linear over a step: second order */
}

/* What stands for the springs alone knows what the damper went through, whichever is said first. */
static void check_prior_extremes(void)
{
  const double prior_extremes[] = {0.5, -0.6, 2.0, -2.0};
  rig one = new_rig(ED_LAW_MGMM, 12, MGMM, 0.0), other = new_rig(ED_LAW_MGMM, 12, MGMM, 0.0), bare = new_rig(ED_LAW_MGMM, 12, MGMM, 0.0);
  CHECK_STATUS(ed_damper_set_prior_extremes(one.damper, prior_extremes), ED_OK);
  place(&one, &CONSTANT, ED_PLACE_SPRINGS);
  place(&one, &CONSTANT, ED_PLACE_DASHPOTS);
  place(&other, &CONSTANT, ED_PLACE_SPRINGS);
  place(&other, &CONSTANT, ED_PLACE_DASHPOTS);
  CHECK_STATUS(ed_damper_set_prior_extremes(other.damper, prior_extremes), ED_OK);
  CHECK_STATUS(ed_damper_set_prior_extremes(bare.damper, prior_extremes), ED_OK);
  ed_damper_start(other.damper, other.state);
  ed_damper_start(bare.damper, bare.state);
  for (int step = 1; step <= 60; step++) {
    const double t = 0.05 * step, force = move(&one, 0.05, u_at(t), v_at(t));
    CHECK_NEAR(move(&other, 0.05, u_at(t), v_at(t)), force, 0.0);
    CHECK_NEAR(0.7 * move(&bare, 0.05, u_at(t), v_at(t)), force, 1e-13 * (1.0 + fabs(force)));
  }
  free_rig(&one);
  free_rig(&other);
  free_rig(&bare);
}

/* Derivatives against central differences; not near corners of the definitions, nor where a power of the velocity bends within the
 * difference. */
static void check_tangents(int law, int n, const double *parameters, double brace, int steps)
{
  for (int i = 0; i < N_FACTORS; i++)
    for (int placement = ED_PLACE_SPRINGS; placement <= ED_PLACE_DASHPOTS; placement++) {
      rig r = new_rig(law, n, parameters, brace);
      place(&r, &FACTORS[i], placement);
      place(&r, &FACTORS[1], ED_PLACE_WHOLE);
      for (int step = 1; step < steps; step++) {
        const double h = 0.04, t = h * step + 0.003, u = u_at(t), v = v_at(t);
        const int corner = (brace > 0.0 && FACTORS[i].form == ED_EFFECT_ONE_SIDED_FACTOR && fabs(u) < 0.1) || fabs(v) < 0.1;
        if (!corner)
          check_slopes(&r, h, u, v, 1e-5, 1e-4, brace > 0.0 ? 1e-4 : 5e-6);
        move(&r, h, u, v);
      }
      free_rig(&r);
    }
}

/* The spring of a Kelvin damper without dashpot, softened and in series with a brace: two springs. */
static void check_brace(void)
{
  const double kelvin[] = {3.0, 0.0}, kb = 4.0, k = 0.7 * kelvin[0];
  rig r = new_rig(ED_LAW_KELVIN_VOIGT, 2, kelvin, kb);
  place(&r, &CONSTANT, ED_PLACE_SPRINGS);
  for (int step = 1; step < 100; step++) {
    const double t = 0.05 * step, u = u_at(t);
    CHECK_NEAR(move(&r, 0.05, u, v_at(t)), u * k * kb / (k + kb), 1e-8 * kb); /* of the balance: 1e-9 */
  }
  free_rig(&r);
}

static void refused(int law, int n, const double *parameters, const effect *one, int placement, int status, const char *text)
{
  rig r = new_rig(law, n, parameters, 0.0);
  char message[256] = "";
  const int size = ed_damper_state_size(r.damper);
  CHECK_STATUS(ed_damper_add_effect(r.damper, one->form, placement, one->n, one->parameter, message, sizeof message), status);
  CHECK_CONTAINS(message, text);
  CHECK(ed_damper_state_size(r.damper) == size);
  free_rig(&r);
}

static void check_refusals(void)
{
  const double bouc_wen[] = {1.5, 0.1, 0.1, 1.0, 0.5, 0.5, 2.0}, viscous[] = {1.0};
  refused(ED_LAW_KELVIN_VOIGT, 2, SUMS[0].parameter, &PATH, 4, ED_E_ID, "effect mullins.path: there is no placement 4");
  refused(ED_LAW_KELVIN_VOIGT, 2, SUMS[0].parameter, &PATH, -1, ED_E_ID, "there is no placement -1");
  refused(ED_LAW_KELVIN_VOIGT, 2, SUMS[0].parameter, &SPRING, ED_PLACE_DASHPOTS, ED_E_ARGUMENT,
          "effect hardening.power: it is a force of its own, and only factors act on springs or dashpots alone");
  refused(ED_LAW_KELVIN_VOIGT, 2, SUMS[0].parameter, &(effect){ED_EFFECT_ONE_SIDED_FORCE, 2, {0.3, 1.0}}, ED_PLACE_SPRINGS,
          ED_E_ARGUMENT, "is proportional to the law's force");
  refused(ED_LAW_BOUC_WEN, 7, bouc_wen, &PATH, ED_PLACE_SPRINGS, ED_E_ARGUMENT, "that of law bouc_wen is not");
  refused(ED_LAW_VISCOUS, 1, viscous, &PATH, ED_PLACE_DASHPOTS, ED_E_ARGUMENT, "that of law viscous is not");
  refused(ED_LAW_MGMM, 12, MGMM, &(effect){ED_EFFECT_CONSTANT, 1, {-1.0}}, ED_PLACE_SPRINGS, ED_E_ARGUMENT, "greater than 0");
}

int main(void)
{
  check_sums();
  check_both_sides(ED_LAW_MGMM, 12, MGMM, ED_PLACE_INSIDE);
  check_both_sides(ED_LAW_MGMM, 12, CONSISTENT, ED_PLACE_INSIDE);
  for (int i = 0; i < N_SUMS; i++)
    check_both_sides(SUMS[i].law, SUMS[i].n, SUMS[i].parameter, ED_PLACE_WHOLE);
  check_by_equation();
  check_prior_extremes();
  check_tangents(ED_LAW_ZENER, 3, SUMS[2].parameter, 0.0, 80);
  check_tangents(ED_LAW_ZENER, 3, SUMS[2].parameter, 20.0, 80);
  check_tangents(ED_LAW_MGMM, 12, MGMM, 0.0, 17); /* on the way out, along which moduli soften without a corner */
  check_tangents(ED_LAW_MGMM, 12, LINEAR_MGMM, 20.0, 80);
  check_brace();
  check_refusals();
  return checks_end("placements");
}
