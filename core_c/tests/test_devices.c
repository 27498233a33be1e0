/* Dampers in a frame: equivalent links, tries that leave nothing behind, halved steps, saved states, refusals. */
#include "checks.h"
#include "edcore.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 150 };
static const double DT = 0.02, STIFF = 4e6;
static const frame_options FRAME = {.bays = 1, .storeys = 2, .points = 5, .geometry = ED_P_DELTA};
static const double MGMM[] = {515e3, 15.1e3, 107e3, 21e3, 0.374, 3741e3, 3613e3, 7.966e-3, 902e3, 190e3, 13.468e-3, 0.0};
static const double BOUC_WEN[] = {40e3, 5e-3, 0.05, 1.0, 0.5, 0.5, 1.0};

/* Between the floors of a storey. */
static int damper(ed_model *model, int storey, int law, int n, const double *parameters, double brace)
{
  const int node[] = {frame_node(FRAME, 0, storey), frame_node(FRAME, 0, storey - 1)}, degree[] = {0, 0};
  const double coefficient[] = {1.0, -1.0};
  return ed_model_damper(model, "damper", law, n, parameters, brace, 0.0, 1.0, 1.0, 2, node, degree, coefficient);
}

/* The second damper by SUNDIALS, or as the first by its exact step: only dampers that all have one are balanced with the condensed frame. */
static ed_model *damped_frame(int exact, double brace)
{
  ed_model *model = frame_model(FRAME);
  CHECK_INT(damper(model, 1, ED_LAW_MGMM, 12, MGMM, brace), 0);
  if (exact)
    CHECK_INT(damper(model, 2, ED_LAW_MGMM, 12, MGMM, brace), 1);
  else
    CHECK_INT(damper(model, 2, ED_LAW_BOUC_WEN, 7, BOUC_WEN, brace), 1);
  return model;
}

static ed_analysis *under_gravity(const ed_model *model)
{
  ed_analysis *a = frame_analysis(model);
  CHECK_STATUS(ed_static_begin(a, GRAVITY, 1.0, 2), ED_OK);
  CHECK_STATUS(run_to_end(a, 2), ED_OK);
  CHECK_STATUS(ed_install_dampers(a), ED_OK);
  return a;
}

static double *state_of(const ed_analysis *a)
{
  double *state = malloc((size_t)ed_state_size(a) * sizeof *state);
  ed_state_get(a, state);
  return state;
}

/* A spring as a damper is a spring as a link. */
static void check_link(void)
{
  static const double spring[] = {STIFF, 0.0};
  double ground[N + 1], moved[2];
  ground_motion(N, DT, 6.0, ground);
  for (int as_link = 0; as_link < 2; as_link++) {
    ed_model *model = frame_model(FRAME);
    if (as_link) {
      const int top = frame_node(FRAME, 0, 1), base = ed_model_node(model, "base", (double[]){0.0, 3.5});
      ed_model_fix(model, base, (int[]){1, 1, 1});
      CHECK(ed_model_link(model, "spring", base, top, STIFF, 0.0, 0.0, 0.0) >= 0);
    } else
      damper(model, 1, ED_LAW_KELVIN_VOIGT, 2, spring, 0.0);
    ed_analysis *a = frame_analysis(model);
    CHECK_STATUS(ed_install_dampers(a), ED_OK); /* both from the unloaded frame */
    CHECK_STATUS(ed_set(a, ED_TOLERANCE, 1e-10), ED_OK);
    const int channel = add_channel(a, ED_DISPLACEMENT, frame_node(FRAME, 0, 2), 0);
    CHECK_STATUS(ed_history_begin(a, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
    CHECK_STATUS(run_to_end(a, N), ED_OK);
    double most[2], when[2], least[2], since[2], last[2];
    ed_extremes(a, most, when, least, since, last);
    moved[as_link] = last[channel];
    ed_run_end(a);
    ed_analysis_free(a);
    ed_model_free(model);
  }
  CHECK_NEAR(moved[0], moved[1], 1e-8 * fabs(moved[1])); /* equilibrium to 1e-10 of the forces */
}

/* Energy error of the frame without dampers under the same motion: fibres that yield within steps of 0.02 s. */
static double bare_energy_error(const double *ground)
{
  ed_statistics statistics;
  ed_model *model = frame_model(FRAME);
  ed_analysis *a = under_gravity(model);
  CHECK_STATUS(ed_history_begin(a, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_STATUS(run_to_end(a, N), ED_OK);
  ed_run_end(a);
  ed_get_statistics(a, &statistics);
  ed_analysis_free(a);
  ed_model_free(model);
  return statistics.energy_error;
}

/* Tries that are given up, and the same run in one analysis or taken up from a saved state. */
static void check_tries(int exact, double brace)
{
  double ground[N + 1];
  ground_motion(N, DT, 6.0, ground);
  ed_model *model = damped_frame(exact, brace);
  ed_analysis *straight = under_gravity(model), *hesitant = under_gravity(model);
  CHECK_STATUS(ed_history_begin(straight, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_STATUS(ed_history_begin(hesitant, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  for (int i = 0; i < N; i++) {
    CHECK_STATUS(ed_run_advance(straight, 1), ED_OK);
    CHECK_STATUS(ed_try_and_revert(hesitant, i % 2 ? 1.0 : 0.25), ED_OK);
    CHECK_STATUS(ed_run_advance(hesitant, 1), ED_OK);
  }
  double *one = state_of(straight), *other = state_of(hesitant);
  CHECK_SAME(other, one, ed_state_size(straight));
  ed_statistics statistics;
  ed_run_end(straight);
  ed_get_statistics(straight, &statistics);
  CHECK_NEAR(statistics.energy_error, 0.0, 2.0 * bare_energy_error(ground)); /* dampers add nothing of their own */
  free(one);
  free(other);
  ed_analysis_free(straight);
  ed_analysis_free(hesitant);
  ed_model_free(model);
}

/* Statistics of a history to a tight tolerance, and what it ends with: displacement of the roof, forces of the dampers. */
static ed_statistics tight_history(const ed_model *model, int dampers, int reuse, double end[3])
{
  double ground[N + 1], most[3], when[3], least[3], since[3];
  ground_motion(N, DT, 6.0, ground);
  ed_statistics before, after;
  ed_analysis *a = under_gravity(model);
  CHECK_STATUS(ed_set(a, ED_TOLERANCE, 1e-11), ED_OK);
  CHECK_STATUS(ed_set(a, ED_REUSE_FACTORS, reuse), ED_OK);
  add_channel(a, ED_DISPLACEMENT, frame_node(FRAME, 0, 2), 0);
  for (int i = 0; i < dampers; i++)
    add_channel(a, ED_DAMPER_FORCE, i, 0);
  ed_get_statistics(a, &before);
  CHECK_STATUS(ed_history_begin(a, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_STATUS(run_to_end(a, N), ED_OK);
  ed_extremes(a, most, when, least, since, end);
  ed_get_statistics(a, &after);
  CHECK_INT(after.fallbacks, 0);
  after.iterations -= before.iterations;
  after.refactorisations -= before.refactorisations;
  ed_analysis_free(a);
  return after;
}

/* With kept factors the dampers are balanced with the condensed frame, with new ones in each iteration they are part of its matrix:
 * the answer is the same. Slopes of |v|^0.374 that change ask neither for iterations of the frame nor for factors: it takes no more
 * than bare, where it yields more, and an evaluation of the predictor is no longer needed. */
static void check_condensed(double brace)
{
  ed_model *model = damped_frame(1, brace), *plain = frame_model(FRAME);
  double kept[3], anew[3], undamped[3];
  const ed_statistics few = tight_history(model, 2, 1, kept), many = tight_history(model, 2, 0, anew);
  const ed_statistics bare = tight_history(plain, 0, 1, undamped);
  for (int i = 0; i < 3; i++)
    CHECK_NEAR(kept[i], anew[i], 1e-8 * fabs(anew[i])); /* each is in balance to 1e-11 of the forces, and that over N steps */
  CHECK(few.iterations <= bare.iterations);
  CHECK(few.refactorisations <= bare.refactorisations);
  CHECK(many.refactorisations > N);
  ed_model_free(model);
  ed_model_free(plain);
}

/* A state that is saved and set again goes on as if nothing had been. */
static void check_saved(void)
{
  double ground[N + 1];
  ground_motion(N, DT, 6.0, ground);
  ed_model *model = damped_frame(0, 30e6);
  ed_analysis *a = under_gravity(model), *b = under_gravity(model);
  CHECK_STATUS(ed_set(a, ED_REUSE_FACTORS, 0), ED_OK); /* factors of an earlier step are no part of the state */
  CHECK_STATUS(ed_set(b, ED_REUSE_FACTORS, 0), ED_OK);
  CHECK_STATUS(ed_history_begin(a, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  CHECK_STATUS(run_to_end(a, N), ED_OK);
  ed_run_end(a);
  double *saved = state_of(a);
  CHECK_STATUS(ed_state_set(b, saved), ED_OK);
  double *set = state_of(b);
  CHECK_SAME(set, saved, ed_state_size(a));
  for (int i = 0; i < 2; i++) {
    ed_analysis *each = i ? b : a;
    CHECK_STATUS(ed_history_begin(each, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
    CHECK_STATUS(run_to_end(each, N), ED_OK);
    ed_run_end(each);
    ed_state_get(each, i ? set : saved);
  }
  CHECK_SAME(set, saved, ed_state_size(a));
  free(saved);
  free(set);
  ed_analysis_free(a);
  ed_analysis_free(b);
  ed_model_free(model);
}

/* A mass on a spring, with a damper beside it; pattern 0: 1 N on the mass. */
enum { MASS_NODE = 1 };
static ed_model *oscillator(double mass, double k, int law, int n, const double *parameters)
{
  ed_model *model = ed_model_new(2);
  const int base = ed_model_node(model, "base", (double[]){0.0, 0.0}), top = ed_model_node(model, "top", (double[]){1.0, 0.0}), degree = 0;
  const double one = 1.0;
  ed_model_fix(model, base, (int[]){1, 1, 1});
  ed_model_fix(model, top, (int[]){0, 1, 1});
  ed_model_mass(model, top, (double[]){mass, 0.0, 0.0});
  ed_model_link(model, "spring", base, top, k, 0.0, 0.0, 0.0);
  ed_model_pattern(model);
  ed_model_nodal_load(model, 0, top, (double[]){1.0, 0.0, 0.0});
  CHECK_INT(ed_model_damper(model, "damper", law, n, parameters, 0.0, 0.0, 1.0, 1.0, 1, &top, &degree, &one), 0);
  return model;
}

/* Free vibration from an initial velocity by HHT, whose first step takes its share of the dashpot's force at the start: against the
 * recursion m a1 + (1 - af)(c v1 + k u1) + af (c v0 + k u0) = 0 (Hilber, Hughes & Taylor 1977) written out. */
static void check_hht(void)
{
  enum { STEPS = 60 };
  const double m = 1e4, k = 1e6, kelvin[] = {1e6, 3e4}, dt = 0.02, start = 0.3, af = 0.2, am = 0.0;
  const double parameters[] = {am, af, 0.5 + af, 0.25 * (1.0 + af) * (1.0 + af)}, g = parameters[2], b = parameters[3];
  const double still[STEPS + 1] = {0.0}, all = k + kelvin[0], c = kelvin[1];
  double u = 0.0, v = start, acceleration = -c * v / m;
  for (int i = 0; i < STEPS; i++) {
    const double u_known = u + dt * v + dt * dt * (0.5 - b) * acceleration, v_known = v + dt * (1.0 - g) * acceleration;
    const double next = -((1.0 - af) * (all * u_known + c * v_known) + af * (all * u + c * v)) /
                        (m + (1.0 - af) * (all * b * dt * dt + c * g * dt));
    u = u_known + b * dt * dt * next;
    v = v_known + g * dt * next;
    acceleration = next;
  }
  ed_model *model = oscillator(m, k, ED_LAW_KELVIN_VOIGT, 2, kelvin);
  ed_analysis *a = frame_analysis(model);
  CHECK_STATUS(ed_install_dampers(a), ED_OK);
  CHECK_STATUS(ed_set(a, ED_TOLERANCE, 1e-12), ED_OK);
  CHECK_STATUS(ed_initial_velocity(a, &start), ED_OK);
  const int channel = add_channel(a, ED_DISPLACEMENT, MASS_NODE, 0);
  CHECK_STATUS(ed_history_begin(a, STEPS, dt, still, NULL, NULL, ED_GENERALISED_ALPHA, parameters), ED_OK);
  CHECK_STATUS(run_to_end(a, STEPS), ED_OK);
  double most, when, least, since, last;
  ed_extremes(a, &most, &when, &least, &since, &last);
  CHECK_INT(channel, 0);
  /* of the undamped amplitude; the dashpot's first force is that after 1e-6 of a step, which stretches the spring by as much */
  CHECK_NEAR(last, u, 1e-8 * start * sqrt(m / all));
  ed_analysis_free(a);
  ed_model_free(model);
}

/* A load after a history that ended in motion: static steps start from rest, the dampers relax. */
static void check_static_after(void)
{
  static const double kelvin[] = {1e6, 3e4}, zener[] = {1e6, 2e6, 1e5};
  const double k = 1e6, load = 2e3;
  double ground[N + 1];
  ground_motion(N, DT, 6.0, ground);
  for (int law = ED_LAW_KELVIN_VOIGT; law <= ED_LAW_ZENER; law++) {
    ed_model *model = oscillator(1e4, k, law, law == ED_LAW_ZENER ? 3 : 2, law == ED_LAW_ZENER ? zener : kelvin);
    ed_analysis *a = frame_analysis(model);
    CHECK_STATUS(ed_install_dampers(a), ED_OK);
    add_channel(a, ED_DISPLACEMENT, MASS_NODE, 0);
    add_channel(a, ED_VELOCITY, MASS_NODE, 0);
    CHECK_STATUS(ed_history_begin(a, N, DT, ground, NULL, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
    CHECK_STATUS(run_to_end(a, N), ED_OK);
    ed_run_end(a);
    CHECK_STATUS(ed_static_begin(a, 0, load, 2), ED_OK);
    CHECK_STATUS(run_to_end(a, 2), ED_OK);
    double most[2], when[2], least[2], since[2], last[2];
    ed_extremes(a, most, when, least, since, last);
    CHECK(fabs(last[1]) > 1e-3); /* as the history left it */
    CHECK_NEAR(last[0], load / (k + 1e6), 1e-6 * load / k);
    ed_analysis_free(a);
    ed_model_free(model);
  }
}

/* A mass that only dampers hold: without one that acts from the beginning it is a mechanism, with it the static load finds its long-term
 * stiffness alone (Zener: k0), and what is installed later carries nothing of it; also in one system of SUNDIALS. */
static void check_carrying(void)
{
  static const double zener[] = {1e6, 2e6, 1e5}, soft[] = {40e3, 5e-3, 0.05, 1.0, 0.5, 0.5, 1.0};
  const double load = 2e3, one = 1.0;
  const int degree = 0;
  for (int carries = 0; carries < 3; carries++) { /* 2: a Bouc-Wen damper carries too */
    ed_model *model = ed_model_new(2);
    const int top = ed_model_node(model, "top", (double[]){0.0, 0.0});
    ed_model_fix(model, top, (int[]){0, 1, 1});
    ed_model_mass(model, top, (double[]){1e4, 0.0, 0.0});
    ed_model_pattern(model);
    ed_model_nodal_load(model, 0, top, (double[]){1.0, 0.0, 0.0});
    CHECK_INT(ed_model_damper(model, "bearing", ED_LAW_ZENER, 3, zener, 0.0, 0.0, 1.0, 1.0, 1, &top, &degree, &one), 0);
    CHECK_INT(ed_model_damper(model, "later", ED_LAW_BOUC_WEN, 7, soft, 0.0, 0.0, 1.0, 1.0, 1, &top, &degree, &one), 1);
    CHECK_INT(ed_model_damper(model, "other", ED_LAW_BOUC_WEN, 7, soft, 0.0, 0.0, 1.0, 1.0, 1, &top, &degree, &one), 2);
    if (carries)
      CHECK_STATUS(ed_model_damper_carries(model, 0), ED_OK);
    if (carries == 2)
      CHECK_STATUS(ed_model_damper_carries(model, 2), ED_OK);
    CHECK_STATUS(ed_model_damper_carries(model, 3), ED_E_ID);
    CHECK_STATUS(ed_model_damper_weighs(model, 3, 0, 1.0), ED_E_ID);
    CHECK_STATUS(ed_model_damper_weighs(model, 0, 0, 1.0), ED_E_ID); /* no element is there */
    if (!carries) {
      char message[512] = "";
      int status = ED_OK;
      CHECK(ed_analysis_new(model, &status, message, sizeof message) == NULL);
      CHECK_STATUS(status, ED_E_MECHANISM);
      CHECK_CONTAINS(message, "top.ux");
      ed_model_free(model);
      continue;
    }
    ed_analysis *a = frame_analysis(model);
    CHECK_INT(ed_unstable_directions(a), 0);
    add_channel(a, ED_DISPLACEMENT, top, 0);
    add_channel(a, ED_DAMPER_FORCE, 0, 0);
    add_channel(a, ED_DAMPER_FORCE, 1, 0);
    add_channel(a, ED_DAMPER_FORCE, 2, 0);
    double most[4], when[4], least[4], since[4], last[4];
    CHECK_STATUS(ed_static_begin(a, 0, load, 2), ED_OK);
    CHECK_STATUS(run_to_end(a, 2), ED_OK);
    ed_run_end(a);
    ed_extremes(a, most, when, least, since, last);
    CHECK_NEAR(last[1] + last[3], load, 1e-6 * load);
    CHECK_NEAR(last[1], zener[0] * last[0], 1e-6 * load);
    CHECK(last[2] == 0.0);
    CHECK(carries == 2 ? last[3] > 0.5 * load : last[3] == 0.0);
    CHECK_STATUS(ed_install_dampers(a), ED_OK);
    const double before = last[0];
    CHECK_STATUS(ed_static_begin(a, 0, 2.0 * load, 2), ED_OK);
    CHECK_STATUS(run_to_end(a, 2), ED_OK);
    ed_extremes(a, most, when, least, since, last);
    CHECK_NEAR(last[1] + last[2] + last[3], 2.0 * load, 1e-6 * load);
    CHECK_NEAR(last[1], zener[0] * last[0], 1e-6 * load);
    CHECK(last[2] > 0.0 && last[2] < 8e6 * (last[0] - before)); /* Fy / Y of what has moved since */
    ed_analysis_free(a);
    ed_model_free(model);
  }
}

/* A dashpot whose force is proportional to what presses on a spring while the ground lifts both: at every step its law times N / weight. */
static void check_pressed(void)
{
  enum { STEPS = 400 };
  static const double dashpot[] = {50.0}, contact[] = {1e4, HUGE_VAL}, up[] = {0.0, -1.0, 0.0, 0.0, 1.0, 0.0}, dt = 0.01;
  static const double weight = 9.0, mass = 2.0, one = 1.0;
  const int degree = 0;
  double still[STEPS + 1] = {0.0}, lift[STEPS + 1];
  for (int i = 0; i <= STEPS; i++) /* slowly, beside the 11 Hz of the mass on the spring */
    lift[i] = i < STEPS / 2 ? 3.0 * i / (STEPS / 2) : 3.0;
  ed_model *model = ed_model_new(2);
  const int base = ed_model_node(model, "base", (double[]){0.0, 0.0}), top = ed_model_node(model, "top", (double[]){0.0, 0.0});
  ed_model_fix(model, base, (int[]){1, 1, 1});
  ed_model_fix(model, top, (int[]){0, 0, 1});
  ed_model_mass(model, top, (double[]){mass, mass, 0.0});
  const int spring = ed_model_spring(model, "bearing", base, top, up, ED_SPRING_CONTACT, 2, contact);
  const double pull[] = {-1.0, 0.0, 0.0, 1.0, 0.0, 0.0}, soft[] = {1.0};
  ed_model_spring(model, "soft", base, top, pull, ED_SPRING_MULTILINEAR, 1, soft); /* holds it along the dashpot */
  ed_model_pattern(model);
  ed_model_nodal_load(model, 0, top, (double[]){0.0, -weight, 0.0});
  CHECK_INT(ed_model_damper(model, "dashpot", ED_LAW_VISCOUS, 1, dashpot, 0.0, 0.0, 1.0, 1.0, 1, &top, &degree, &one), 0);
  CHECK_STATUS(ed_model_damper_weighs(model, 0, spring, 0.0), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_damper_weighs(model, 0, spring, weight), ED_OK);
  ed_analysis *a = frame_analysis(model);
  CHECK_STATUS(ed_static_begin(a, 0, 1.0, 1), ED_OK);
  CHECK_STATUS(run_to_end(a, 1), ED_OK);
  ed_run_end(a);
  CHECK_STATUS(ed_install_dampers(a), ED_OK);
  const int equations = ed_n_equations(a);
  double velocity[8] = {0.0};
  int number[6];
  ed_equations(a, number);
  CHECK(equations <= 8);
  velocity[number[3]] = 0.4;
  CHECK_STATUS(ed_initial_velocity(a, velocity), ED_OK);
  add_channel(a, ED_DAMPER_FORCE, 0, 0);
  add_channel(a, ED_VELOCITY, top, 0);
  add_channel(a, ED_AXIAL_FORCE, spring, 0);
  CHECK_STATUS(ed_history_begin(a, STEPS, dt, still, lift, NULL, ED_NEWMARK, AVERAGE_ACCELERATION), ED_OK);
  double most[3], when[3], least[3], since[3], last[3];
  for (int i = 0; i < STEPS; i++) {
    CHECK_STATUS(ed_run_advance(a, 1), ED_OK);
    ed_extremes(a, most, when, least, since, last);
    CHECK_NEAR(last[0], dashpot[0] * last[1] * fmax(-last[2], 0.0) / weight, 1e-6);
  }
  CHECK(most[0] > 10.0 && least[2] < -1.2 * weight);
  ed_analysis_free(a);
  ed_model_free(model);
}

static void check_refusals(void)
{
  ed_model *model = frame_model(FRAME);
  const int node[] = {1, 99}, degree[] = {0, 0};
  const double coefficient[] = {1.0, -1.0}, negative[] = {-1.0, 0.0}, spring[] = {1.0, 0.0};
  CHECK_STATUS(damper(model, 1, ED_LAW_KELVIN_VOIGT, 2, negative, 0.0), ED_E_ARGUMENT);
  CHECK_CONTAINS(ed_model_message(model), "damper damper: k = -1 is not allowed");
  CHECK_STATUS(damper(model, 1, ED_LAW_KELVIN_VOIGT, 2, spring, -5.0), ED_E_ARGUMENT);
  CHECK_CONTAINS(ed_model_message(model), "brace");
  CHECK_STATUS(damper(model, 1, 77, 2, spring, 0.0), ED_E_ID);
  CHECK_STATUS(damper(model, 1, ED_LAW_KELVIN_VOIGT, 5, negative, 0.0), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_damper(model, "x", ED_LAW_KELVIN_VOIGT, 2, spring, 0.0, 0.0, 1.0, 1.0, 2, node, degree, coefficient), ED_E_ID);
  CHECK_STATUS(ed_model_damper(model, "x", ED_LAW_KELVIN_VOIGT, 2, spring, 0.0, 0.0, 0.0, 1.0, 1, node, degree, coefficient), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_damper(model, "x", ED_LAW_KELVIN_VOIGT, 2, spring, 0.0, 0.0, 1.0, 1.0, 13, node, degree, coefficient), ED_E_ARGUMENT);
  CHECK_INT(damper(model, 1, ED_LAW_KELVIN_VOIGT, 2, spring, 0.0), 0); /* what was refused left nothing behind */
  ed_analysis *a = frame_analysis(model);
  const int kind[] = {ED_DAMPER_FORCE}, object[] = {1}, component[] = {0};
  CHECK_STATUS(ed_channel(a, 1, coefficient, kind, object, component, 0), ED_E_ID);
  CHECK_STATUS(ed_static_begin(a, GRAVITY, 1.0, 1), ED_OK);
  CHECK_STATUS(ed_install_dampers(a), ED_E_STATE);
  ed_analysis_free(a);
  ed_model_free(model);
}

/* Sizes of a damper that overflow its stiffness are refused, also where it lies between supports and nothing moves it. */
static void check_endless_stiffness(void)
{
  const frame_options small = {.bays = 1, .storeys = 1, .points = 4};
  ed_model *model = frame_model(small);
  const double parameters[] = {2e5, 3e3}, one = 1.0;
  const int foot = frame_node(small, 0, 0), along_x = 0;
  const int damper = ed_model_damper(model, "endless", ED_LAW_KELVIN_VOIGT, 2, parameters, 0.0, 0.0, 1e300, 1e30, 1, &foot, &along_x, &one);
  int status = ED_OK;
  char message[300] = "";
  CHECK_STATUS(ed_model_damper_carries(model, damper), ED_OK);
  CHECK(!ed_analysis_new(model, &status, message, sizeof message));
  CHECK_STATUS(status, ED_E_NOT_FINITE);
  CHECK_CONTAINS(message, "endless");
  ed_model_free(model);
}

int main(void)
{
  check_endless_stiffness();
  check_link();
  for (int exact = 0; exact < 2; exact++) {
    check_tries(exact, 0.0);
    check_tries(exact, 30e6);
  }
  check_condensed(0.0);
  check_condensed(30e6);
  check_saved();
  check_hht();
  check_static_after();
  check_carrying();
  check_pressed();
  check_refusals();
  return checks_end("dampers in a frame");
}
