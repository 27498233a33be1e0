#include "random_calls.h"

#include "checks.h"
#include "in_series.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* One of each law, about 100 kN at 5 to 10 mm. */
static const struct {
  int n;
  double parameter[12];
} LAWS[] = {
    [ED_LAW_KELVIN_VOIGT] = {2, {8e6, 0.4e6}},
    [ED_LAW_ZENER] = {3, {5e6, 8e6, 0.8e6}},
    [ED_LAW_GENERALISED_MAXWELL] = {5, {4e6, 6e6, 0.6e6, 8e6, 0.15e6}},
    [ED_LAW_FRACTIONAL_KELVIN] = {3, {8e6, 0.3, 0.4}},
    [ED_LAW_FRACTIONAL_ZENER] = {4, {8e6, 0.02, 0.3, 0.5}},
    [ED_LAW_VISCOUS] = {1, {1e6}},
    [ED_LAW_VISCOUS_POWER] = {2, {300e3, 0.35}},
    [ED_LAW_MAXWELL] = {2, {1.5e6, 0.05}},
    [ED_LAW_MAXWELL_POWER] = {3, {300e3, 0.35, 40e6}},
    [ED_LAW_FRACTIONAL_MAXWELL] = {3, {1.5e6, 0.15, 0.6}},
    [ED_LAW_FRICTION] = {3, {0.3, 330e3, 100e6}},
    [ED_LAW_ELASTIC_PLASTIC] = {3, {50e6, 100e3, 0.03}},
    [ED_LAW_RAMBERG_OSGOOD] = {4, {50e6, 80e3, 0.5, 6.0}},
    [ED_LAW_BOUC_WEN] = {7, {100e3, 2e-3, 0.05, 1.0, 0.5, 0.5, 2.0}},
    [ED_LAW_MODIFIED_BOUC_WEN] = {11, {8e6, 6e6, 8e-3, 4e-3, 0.3, 1.0, 0.5, 0.5, 1.0, 40e3, 0.35}},
    [ED_LAW_ASYMPTOTE] = {7, {25e3, 8e6, -2e8, 1e10, 3.0, 1.5, 0.1e6}},
    [ED_LAW_LINEARISED] = {3, {8e6, 0.2, 6.28}},
    [ED_LAW_MGMM] = {12, {0.515e6, 15.1e3, 0.107e6, 20974.0, 0.374, 3.741e6, 3.613e6, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0}},
    [ED_LAW_BILINEAR_OIL] = {3, {2e6, 80e3, 0.05}},
    [ED_LAW_ASYMMETRIC_VISCOUS] = {3, {300e3, 200e3, 0.35}},
    [ED_LAW_LEAD_RUBBER] = {3, {80e3, 3e6, 2e-3}},
    [ED_LAW_FRICTION_PENDULUM] = {6, {1e6, 1.5, 0.04, 0.09, 30.0, 0.5e-3}},
    [ED_LAW_SELF_CENTRING] = {4, {50e6, 80e3, 0.05, 0.8}},
    [ED_LAW_GAP] = {4, {25e6, 2e-3, 1.0, 0.0}},
    [ED_LAW_CHABOCHE] = {8, {50e6, 60e3, 20e6, 600.0, 2e6, 40.0, 20e3, 8.0}},
    [ED_LAW_BUCKLING_RESTRAINED] = {11, {4e-4, 250e6, 200e9, 1.0, 0.6, 1.3, 0.005, 1.1, 0.01, 1.3, 1.1}},
};
enum { N_LAWS = sizeof LAWS / sizeof *LAWS };

static const struct {
  int n;
  double parameter[5];
} EFFECTS[] = {
    [ED_EFFECT_CONSTANT] = {1, {0.8}},
    [ED_EFFECT_PAYNE_WHOLE] = {4, {0.3, 5e-3, 1.0, 50.0}},
    [ED_EFFECT_PAYNE_ELASTIC] = {4, {1e6, 5e-3, 1.0, 50.0}},
    [ED_EFFECT_MULLINS_PATH] = {4, {0.3, 0.1, 0.7, 0.5}},
    [ED_EFFECT_MULLINS_MAXIMUM] = {4, {0.3, 5e-3, 0.1, 0.5}},
    [ED_EFFECT_MULLINS_ELASTIC] = {4, {1e6, 0.1, 0.7, 0.5}},
    [ED_EFFECT_DEGRADATION_ENERGY] = {3, {0.3, 1e4, 0.7}},
    [ED_EFFECT_SELF_HEATING_RATE] = {2, {1e-6, 100.0}},
    [ED_EFFECT_HARDENING_POWER] = {3, {1e6, 3.0, 5e-3}},
    [ED_EFFECT_HARDENING_THRESHOLD] = {2, {1e6, 5e-3}},
    [ED_EFFECT_ONE_SIDED_FACTOR] = {2, {0.1, 1.0}},
    [ED_EFFECT_ONE_SIDED_SPRING] = {3, {1e6, 5e-3, -1.0}},
    [ED_EFFECT_RELAXATION_BRANCH_MAXWELL] = {2, {1e6, 1.0}},
    [ED_EFFECT_VELOCITY_EXPONENT_DASHPOT] = {2, {1e5, 0.4}},
    [ED_EFFECT_PAYNE_NETWORK] = {3, {0.3, 5e-3, 1.0}},
    [ED_EFFECT_MULLINS_DAMAGE] = {4, {0.3, 5e-3, 2.0, 0.5}},
    [ED_EFFECT_VELOCITY_EXPONENT_FLOW] = {2, {1e5, 1e-2}},
    [ED_EFFECT_DEGRADATION_PATH] = {3, {0.1, 1.0, 1.5}},
    [ED_EFFECT_ONE_SIDED_CONTACT] = {5, {1e6, 5e-3, 1.5, 1.0, 1e-2}},
    [ED_EFFECT_ONE_SIDED_EVEN] = {3, {1e6, 2.0, 1e-2}},
    [ED_EFFECT_ONE_SIDED_VALVE] = {3, {0.2, 1e-2, -1.0}},
    [ED_EFFECT_ONE_SIDED_FORCE] = {2, {0.2, 1.0}},
    [ED_EFFECT_GAS_SPRING_POLYTROPIC] = {3, {1e4, 5.0, 1.2}},
    [ED_EFFECT_HARDENING_SATURATING] = {2, {1e6, 2e-3}},
    [ED_EFFECT_VELOCITY_EXPONENT_POSITION] = {4, {1e4, 0.6, 1.2, 5e-3}},
    [ED_EFFECT_HYSTERESIS_STRETCH] = {4, {2e3, 1e-3, 1.2, 5e-3}},
    [ED_EFFECT_HYSTERESIS_BOUC_WEN] = {3, {1e6, 100.0, 200.0}},
    [ED_EFFECT_PINCHING_SLIP] = {2, {0.4, 0.3}},
    [ED_EFFECT_LIMIT_FORCE] = {3, {0.6, 2e4, 0.0}},
    [ED_EFFECT_PAYNE_EXPONENTIAL] = {4, {0.3, 5e-3, 1.0, 50.0}},
    [ED_EFFECT_HARDENING_EXPONENTIAL] = {2, {1e6, 2e-2}},
    [ED_EFFECT_FRICTION_COULOMB] = {2, {1e4, 1e-3}},
    [ED_EFFECT_FRICTION_PRESLIDING] = {3, {1e4, 1e-3, 2.5}},
    [ED_EFFECT_FRICTION_STRIBECK] = {3, {1e4, 0.5, 1e-2}},
    [ED_EFFECT_FRICTION_LOADED] = {3, {0.1, 1e4, 1e-3}},
};
enum { N_EFFECTS = sizeof EFFECTS / sizeof *EFFECTS };

/* The numbers of an example, some of them larger or smaller, few absurd. */
static int altered(caller *c, int n, const double *example, double *parameters)
{
  const int alters = chance(c, 0.6);
  for (int i = 0; i < n; i++) {
    const double value = alters && chance(c, 0.5) && example[i] != 1.0 && example[i] != -1.0 ? example[i] * size_between(c, 0.3, 3.0) : example[i];
    parameters[i] = or_absurd(c, value);
  }
  return chance(c, 0.3 * c->wild) ? whole(c, -1, n + 1) : n;
}

int some_law(caller *c, int *law, double *parameters)
{
  const int sound = whole(c, 0, N_LAWS - 1);
  *law = chance(c, 0.3 * c->wild) ? some_id(c, N_LAWS) : sound;
  return altered(c, LAWS[sound].n, LAWS[sound].parameter, parameters);
}

int some_effect(caller *c, int *form, double *parameters)
{
  const int sound = whole(c, 0, N_EFFECTS - 1);
  *form = chance(c, 0.3 * c->wild) ? some_id(c, N_EFFECTS) : sound;
  return altered(c, EFFECTS[sound].n, EFFECTS[sound].parameter, parameters);
}

int some_placement(caller *c)
{
  return chance(c, 0.5) ? ED_PLACE_WHOLE : some_id(c, ED_PLACE_DASHPOTS + 1);
}

static void call_steps(caller *c, const ed_damper *damper)
{
  const int size = ed_damper_state_size(damper), method = chance(c, 0.2) ? whole(c, -1, 2) : ED_DAMPER_BEST;
  double *state = room(size), *trial = room(size), *before = room(size), u = 0.0, v = 0.0, force, slope[2];
  ed_damper_start(damper, state);
  expect_finite(ED_OK, state, size);
  for (int i = 0; i < 20; i++) {
    if (size > 0 && chance(c, 0.1 * c->wild))
      state[whole(c, 0, size - 1)] = signed_size(c, 1e-6, 1e6); /* no state that the damper has come to */
    const double h = or_absurd(c, size_between(c, 1e-4, 1.0)), u1 = signed_size(c, 1e-5, 2e-2), v1 = signed_size(c, 1e-4, 0.5);
    for (int k = 0; k < size; k++)
      before[k] = state[k];
    const int status = expect_listed(c, ed_damper_step(damper, method, or_absurd(c, 1e-6), state, h, u, v, u1, v1, trial, &force, slope));
    if (size > 0)
      CHECK(memcmp(state, before, (size_t)size * sizeof *state) == 0);
    expect_finite(status, trial, size);
    expect_finite(status, &force, 1);
    expect_finite(status, slope, 2);
    if (status != ED_OK)
      continue;
    double *swap = state;
    state = trial;
    trial = swap;
    u = u1, v = v1;
  }
  free(state), free(trial), free(before);
}

static void call_histories(caller *c, const ed_damper *damper)
{
  const int n = samples(c, 200), method = chance(c, 0.2) ? ED_DAMPER_ODE : chance(c, 0.3) ? ED_DAMPER_FIXED : ED_DAMPER_BEST;
  const double fineness = or_absurd(c, method == ED_DAMPER_FIXED ? 2e-3 : 1e-6);
  double *time = ascending(c, n, size_between(c, 1e-3, 0.1)), *u = values_between(c, n, 1e-5, 2e-2), *v = values_between(c, n, 1e-4, 0.3);
  double *force = room(n), *own = room(n);
  for (int i = 1; i < n && chance(c, 0.995); i++) { /* a smooth motion at first */
    u[i] = 1e-2 * sin(7.0 * time[i]);
    v[i] = 7e-2 * cos(7.0 * time[i]);
  }
  int done = -1;
  int status = expect_listed(c, ed_damper_history(damper, method, fineness, n, time, u, v, force, &done));
  expect_finite(status, force, n);
  CHECK(status != ED_OK || done == n);
  const int has_power = chance(c, 0.2);
  const ed_rig rig = {.stiffness = or_absurd(c, size_between(c, 1e6, 1e9)), .back = or_absurd(c, size_between(c, 0.3, 3.0)),
                      .bend = or_absurd(c, has_power ? 1e4 : chance(c, 0.5) ? 0.0 : size_between(c, 1e2, 1e6)),
                      .power = or_absurd(c, has_power ? 1.5 : 1.0), .within = or_absurd(c, chance(c, 0.5) ? 0.0 : 1e5),
                      .play = or_absurd(c, has_power || chance(c, 0.5) ? 0.0 : 1e-4), .damping = or_absurd(c, chance(c, 0.7) ? 0.0 : 1e4)};
  double *factor = chance(c, 0.5) ? room(n) : NULL, *spring = chance(c, 0.3) ? room(n) : NULL;
  double *added = chance(c, 0.5) ? values_between(c, n, 1.0, 1e4) : NULL;
  for (int i = 0; i < n; i++) {
    if (factor)
      factor[i] = size_between(c, 0.5, 1.5);
    if (spring)
      spring[i] = size_between(c, 1e3, 1e6);
  }
  status = expect_listed(c, history_in_series(damper, method, fineness, n, time, u, v, factor, added, spring, &rig, force, own, &done));
  expect_finite(status, force, n);
  expect_finite(status, own, n);
  const ed_damper *const both[2] = {damper, damper};
  const ed_test test[2] = {{n, time, u, v, factor, added, spring, chance(c, 0.5) ? &rig : NULL, 0.0, NULL},
                           {n, time, u, v, NULL, added, NULL, NULL, or_absurd(c, size_between(c, 1e-3, 1e5)),
                            chance(c, 0.5) ? both : NULL}};
  double *all = room(4 * n), *deformations = chance(c, 0.5) ? room(4 * n) : NULL;
  ed_campaign_end end[2] = {{ED_OK}, {ED_OK}};
  status = expect_listed(c, ed_damper_campaign(2, both, 2, test, method, fineness, chance(c, 0.5), all, deformations, end));
  for (int s = 0; status != ED_OK && s < 2; s++) /* of one that was given up, what came before may have lacked memory */
    c->out_of_memory += end[s].status == ED_E_MEMORY;
  for (int s = 0; status == ED_OK && s < 2; s++) {
    expect_finite(expect_listed(c, end[s].status), all + 2 * s * n, 2 * n);
    if (deformations)
      expect_finite(end[s].status, deformations + 2 * s * n, 2 * n);
  }
  free(all), free(deformations);
  free(time), free(u), free(v), free(force), free(own), free(factor), free(added), free(spring);
}

void call_damper(caller *c)
{
  double parameters[64] = {0.0};
  char message[200] = "";
  const int size = chance(c, 0.1) ? 0 : whole(c, 1, (int)sizeof message);
  int law, status;
  const int n = some_law(c, &law, parameters);
  const double brace = or_absurd(c, chance(c, 0.6) ? 0.0 : size_between(c, 1e6, 1e9));
  const double play = or_absurd(c, chance(c, 0.7) ? 0.0 : size_between(c, 1e-4, 1e-2));
  ed_damper *damper = ed_damper_new(law, n, parameters, brace, play, &status, size ? message : NULL, size);
  expect_listed(c, status);
  CHECK(!damper == (status != ED_OK));
  if (!damper) {
    CHECK(size < 2 || strlen(message) > 0);
    return;
  }
  ed_damper_ask(damper, &IMPATIENT);
  for (int i = 0; i < 3 && chance(c, 0.4); i++) {
    int form;
    const int count = some_effect(c, &form, parameters);
    expect_listed(c, ed_damper_add_effect(damper, form, some_placement(c), count, parameters, size ? message : NULL, size));
  }
  if (chance(c, 0.3)) {
    const double prior_extremes[4] = {or_absurd(c, 0.01), or_absurd(c, -0.02), or_absurd(c, 0.1), or_absurd(c, -0.1)};
    expect_listed(c, ed_damper_set_prior_extremes(damper, prior_extremes));
  }
  call_steps(c, damper);
  call_histories(c, damper);
  if (chance(c, 0.2))
    ed_damper_ask(damper, NULL);
  ed_damper_free(damper);
}
