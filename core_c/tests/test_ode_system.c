/* Dampers integrated as one system: the same input gives the same bits; each damper's force does not depend on its companions; true
 * tangents; errors follow the tolerance; events of all are honoured; steps of any length; failures are reported. */
#include "checks.h"
#include "damper/law.h"
#include "damper/ode_system.h"
#include "edcore.h"

#include <math.h>
#include <string.h>

enum { LAWS = 9, SIZE = 24 };

static const struct {
  const char *name;
  int law, n;
  double parameter[11], brace;
} kinds[LAWS] = {
    {"bouc_wen n = 1", ED_LAW_BOUC_WEN, 7, {2.0, 0.5, 0.1, 1.0, 0.4, 0.6, 1.0}, 0.0},
    {"bouc_wen n = 2", ED_LAW_BOUC_WEN, 7, {2.0, 0.5, 0.1, 1.0, 0.4, 0.6, 2.0}, 0.0},
    {"bouc_wen n = 8.5, brace", ED_LAW_BOUC_WEN, 7, {2.0, 0.5, 0.1, 1.0, 0.4, 0.6, 8.5}, 20.0},
    {"maxwell_power 0.4", ED_LAW_MAXWELL_POWER, 3, {1.5, 0.4, 9.0}, 0.0},
    {"maxwell_power 1.4, brace", ED_LAW_MAXWELL_POWER, 3, {1.5, 1.4, 9.0}, 30.0},
    {"modified", ED_LAW_MODIFIED_BOUC_WEN, 11, {3.0, 2.0, 0.8, 0.5, 0.1, 1.0, 0.4, 0.6, 2.0, 0.7, 0.5}, 0.0},
    {"modified without dashpot", ED_LAW_MODIFIED_BOUC_WEN, 11, {3.0, 2.0, 0.8, 0.5, 0.1, 1.0, 0.4, 0.6, 2.0, 0.0, 0.5}, 0.0},
    {"modified, brace", ED_LAW_MODIFIED_BOUC_WEN, 11, {3.0, 2.0, 0.8, 0.5, 0.1, 1.0, 0.4, 0.6, 2.0, 0.7, 0.5}, 25.0},
    {"modified without dashpot, brace",
     ED_LAW_MODIFIED_BOUC_WEN,
     11,
     {3.0, 2.0, 0.8, 0.5, 0.1, 1.0, 0.4, 0.6, 2.0, 0.0, 0.5},
     25.0},
};

typedef struct {
  ed_damper *damper[LAWS];
  double state[LAWS][SIZE], trial[LAWS][SIZE];
  const double *committed[LAWS];
  double *to[LAWS];
  ed_path path[LAWS], direction[LAWS][2];
  ed_damper_force out[LAWS];
} devices;

static void make(devices *all)
{
  memset(all, 0, sizeof *all);
  for (int i = 0; i < LAWS; i++) {
    char message[256];
    int status;
    all->damper[i] = ed_damper_new(kinds[i].law, kinds[i].n, kinds[i].parameter, kinds[i].brace, 0.0, &status, message, 256);
    CHECK_STATUS(status, ED_OK);
    CHECK(ed_damper_state_size(all->damper[i]) <= SIZE);
    ed_damper_start(all->damper[i], all->state[i]);
    all->committed[i] = all->state[i];
    all->to[i] = all->trial[i];
  }
}

static void discard(devices *all)
{
  for (int i = 0; i < LAWS; i++)
    ed_damper_free(all->damper[i]);
}

static ed_ode_system *system_of(const devices *all, double tolerance)
{
  int status;
  ed_ode_system *system = ed_ode_system_new(LAWS, (const ed_damper *const *)all->damper, tolerance, &status);
  CHECK_STATUS(status, ED_OK);
  return system;
}

static int advance(ed_ode_system *system, devices *all)
{
  return ed_ode_system_step(system, all->committed, all->path, (const ed_path(*)[2])all->direction, all->to, all->out);
}

/* Each on a way of its own: they reverse at different instants of the step. */
static void set_paths(devices *all, double h, double u0, double v0, double u1, double v1)
{
  for (int i = 0; i < LAWS; i++) {
    ed_path_hermite(&all->path[i], h, u0, v0, u1 + 0.01 * i, v1 + 0.05 * i);
    ed_path_hermite_directions(all->direction[i], h);
  }
}

static int same(const devices *a, const devices *b)
{
  return memcmp(a->trial, b->trial, sizeof a->trial) == 0 && memcmp(a->out, b->out, sizeof a->out) == 0;
}

static void check_repeatable(void)
{
  devices all, first;
  make(&all);
  ed_ode_system *system = system_of(&all, 1e-6);
  set_paths(&all, 0.3, 0.0, 2.0, 0.3, -1.0);
  CHECK_STATUS(advance(system, &all), ED_OK);
  first = all;
  set_paths(&all, 1.7, 0.0, -3.0, 2.0, 0.4); /* something else between */
  CHECK_STATUS(advance(system, &all), ED_OK);
  CHECK(!same(&all, &first));
  set_paths(&all, 0.3, 0.0, 2.0, 0.3, -1.0);
  CHECK_STATUS(advance(system, &all), ED_OK);
  CHECK(same(&all, &first));
  CHECK(memcmp(all.state, first.state, sizeof all.state) == 0);
  ed_ode_system_free(system);
  system = system_of(&all, 1e-6);
  CHECK_STATUS(advance(system, &all), ED_OK);
  CHECK(same(&all, &first));
  ed_ode_system_free(system);
  discard(&all);
}

/* A few steps with reversals at different instants: the system against each damper alone with a tolerance 1e4 times smaller. Errors
 * stay below the tolerance times what the steps may add up to, and fall with it. */
static void check_convergence(void)
{
  static const double u[6] = {0.0, 0.8, 0.75, -0.6, -0.1, 1.3}, v[6] = {1.0, 0.5, -2.0, -0.5, 3.0, 0.2};
  double worst[2] = {0.0, 0.0};
  for (int run = 0; run < 2; run++) {
    const double tolerance = run ? 1e-7 : 1e-4, h = 0.4;
    devices all;
    make(&all);
    ed_ode_system *system = system_of(&all, tolerance);
    for (int step = 0; step < 5; step++) {
      set_paths(&all, h, u[step], v[step], u[step + 1], v[step + 1]);
      CHECK_STATUS(advance(system, &all), ED_OK);
      for (int i = 0; i < LAWS; i++) {
        double alone[SIZE], force, slope[2];
        CHECK_STATUS(ed_damper_step(all.damper[i], ED_DAMPER_ODE, 1e-4 * tolerance, all.state[i], h, u[step], v[step],
                                    u[step + 1] + 0.01 * i, v[step + 1] + 0.05 * i, alone, &force, slope),
                     ED_OK);
        CHECK_NEAR(all.out[i].force, force, 30.0 * tolerance * 4.0);
        worst[run] = fmax(worst[run], fabs(all.out[i].force - force));
      }
      memcpy(all.state, all.trial, sizeof all.state);
    }
    ed_ode_system_free(system);
    discard(&all);
  }
  CHECK(worst[1] < 0.05 * worst[0]);
}

/* d force / d (u1, v1) against central differences, on steps with and without reversals inside, new extremes and returns. */
static void check_tangents(void)
{
  static const double way[][5] = {
      {0.02, 0.0, 1.0, 0.03, 2.0}, {0.4, 0.0, 1.0, 0.5, 1.5}, {0.4, 0.0, 3.0, 0.3, -2.0}, {0.4, 0.0, -4.0, 0.1, 3.0},
      {1.0, 0.0, 4.0, 1.5, -3.0}};
  const double d = 1e-4;
  devices all;
  make(&all);
  for (int i = 0; i < LAWS; i++) {
    const ed_damper *damper = all.damper[i];
    double start[SIZE] = {0.0}, from[SIZE], trial[SIZE], force, ignored[2];
    ed_damper_start(damper, start);
    CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_ODE, 1e-9, start, 0.5, 0.0, 0.0, 0.2, 0.8, from, &force, ignored), ED_OK);
    for (int k = 0; k < (int)(sizeof way / sizeof *way); k++) {
      const double *w = way[k], h = w[0], u0 = 0.2, v0 = w[2], u1 = u0 + w[3], v1 = w[4];
      double slope[2], f[4];
      CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_ODE, 1e-9, from, h, u0, v0, u1, v1, trial, &force, slope), ED_OK);
      for (int side = 0; side < 4; side++) {
        const double du = side == 0 ? d : side == 1 ? -d : 0.0, dv = side == 2 ? d : side == 3 ? -d : 0.0;
        ed_damper_step(damper, ED_DAMPER_ODE, 1e-10, from, h, u0, v0, u1 + du, v1 + dv, trial, &f[side], ignored);
      }
      /* The sensitivities have a tolerance 1000 times larger and pass kinks of n = 1 and of the dashpot with alpha > 1. Without
       * dashpot a brace makes the device's own velocity jump where it passes its largest deformation; the sensitivity leaves out
       * that this instant moves: one per cent of the stiffness, in that step alone. */
      const double tolerance = i == LAWS - 1 ? 3e-2 : 3e-3;
      CHECK_NEAR(slope[0], (f[0] - f[1]) / (2.0 * d), tolerance);
      CHECK_NEAR(slope[1], (f[2] - f[3]) / (2.0 * d), tolerance * fmax(h, 0.1));
    }
  }
  discard(&all);
}

/* Laws without viscosity do not care how long a step lasts; viscous ones relax: of the dashpot c |v|^alpha is left, at 1e-8. */
static void check_long_steps(void)
{
  devices all;
  make(&all);
  for (int i = 0; i < LAWS; i++) {
    const ed_damper *damper = all.damper[i];
    const int viscous = i == 7;
    double trial[SIZE], force, slow, slope[2];
    CHECK_STATUS(ed_damper_step(damper, ED_DAMPER_ODE, 1e-7, all.state[i], 1e8, 0.0, 0.0, 1.4, 0.0, trial, &slow, slope), ED_OK);
    CHECK_STATUS(ed_damper_step(all.damper[i + viscous], ED_DAMPER_ODE, 1e-7, all.state[i], 1.0, 0.0, 0.0, 1.4, 0.0, trial, &force,
                                slope),
                 ED_OK);
    if (kinds[i].law == ED_LAW_MAXWELL_POWER)
      CHECK_NEAR(slow, 0.0, 0.01);
    else
      CHECK_NEAR(slow, force, viscous ? 2e-4 : 1e-5);
  }
  discard(&all);
}

/* A history is the sum of its steps. */
static void check_history(void)
{
  enum { N = 25 };
  devices all;
  make(&all);
  double time[N], u[N], v[N], force[N];
  for (int i = 0; i < N; i++) {
    time[i] = 0.1 * i;
    u[i] = sin(3.0 * time[i]) * (0.5 + 0.2 * time[i]);
    v[i] = 3.0 * cos(3.0 * time[i]) * (0.5 + 0.2 * time[i]) + 0.2 * sin(3.0 * time[i]);
  }
  for (int k = 0; k < LAWS; k++) {
    int done;
    CHECK_STATUS(ed_damper_history(all.damper[k], ED_DAMPER_ODE, 1e-8, N, time, u, v, force, &done), ED_OK);
    CHECK_INT(done, N);
    for (int i = 1; i < N; i++) {
      double f, slope[2];
      CHECK_STATUS(ed_damper_step(all.damper[k], ED_DAMPER_ODE, 1e-8, all.state[k], 0.1, u[i - 1], v[i - 1], u[i], v[i],
                                  all.trial[k], &f, slope),
                   ED_OK);
      CHECK_NEAR(force[i], f, 3e-6);
      memcpy(all.state[k], all.trial[k], sizeof all.state[k]);
    }
  }
  discard(&all);
}

static void check_failures(void)
{
  devices all;
  int status;
  make(&all);
  CHECK(ed_ode_system_new(LAWS, (const ed_damper *const *)all.damper, 0.0, &status) == NULL);
  CHECK_STATUS(status, ED_E_ARGUMENT);
  ed_ode_system *system = system_of(&all, 1e-6);
  set_paths(&all, 0.3, 0.0, 2.0, 0.3, -1.0);
  all.state[1][0] = NAN;
  CHECK_STATUS(advance(system, &all), ED_E_NOT_FINITE);
  all.state[1][0] = 0.0;
  CHECK_STATUS(advance(system, &all), ED_OK);
  ed_ode_system_free(system);
  ed_ode_system_free(NULL);
  discard(&all);
}

int main(void)
{
  check_repeatable();
  check_convergence();
  check_tangents();
  check_long_steps();
  check_history();
  check_failures();
  return checks_end("ode_system");
}
