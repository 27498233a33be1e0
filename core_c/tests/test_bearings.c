/* Bearings in two directions: in one direction the law of the plane, alike in all directions, slopes, a circle, in a model. */
#include "checks.h"
#include "damper/law.h"
#include "edcore.h"
#include "frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LAWS = 8, STEPS = 400 };
static const struct {
  int id, n;
  double parameter[7];
} LAW[LAWS] = {{ED_LAW_LEAD_RUBBER, 3, {100e3, 1e6, 5e-3}},
               {ED_LAW_ELASTIC_PLASTIC, 3, {30e6, 150e3, 0.05}},
               {ED_LAW_FRICTION, 3, {0.06, 1e6, 50e6}},
               {ED_LAW_FRICTION_PENDULUM, 6, {1e6, 2.2, 0.02, 0.06, 30.0, 0.5e-3}},
               {ED_LAW_BOUC_WEN, 7, {100e3, 8e-3, 0.1, 1.0, 0.5, 0.5, 1.0}},
               {ED_LAW_BOUC_WEN, 7, {100e3, 8e-3, 0.1, 1.0, 0.3, 0.7, 2.0}},
               {ED_LAW_BOUC_WEN, 7, {100e3, 8e-3, 0.1, 1.2, -0.2, 0.9, 1.5}},
               {ED_LAW_BOUC_WEN, 7, {100e3, 2e-3, 0.1, 1.0, 0.5, 0.5, 7.0}}};
static const double H = 0.01;

static double noise(unsigned *seed)
{
  *seed = *seed * 1664525u + 1013904223u;
  return (double)(*seed >> 8) / (1 << 23) - 1.0;
}

static ed_damper prepared(int law)
{
  char message[ED_DAMPER_MESSAGE];
  ed_damper damper;
  CHECK_STATUS(ed_damper_prepare(&damper, LAW[law].id, LAW[law].n, LAW[law].parameter, 0.0, 0.0, message), ED_OK);
  return damper;
}

typedef struct {
  double u[2], v[2], q[2];
} bearing;

static ed_pair_force go(const ed_damper *damper, bearing *at, const double u[2], const double v[2])
{
  ed_path path[2], direction[2];
  ed_pair_force out;
  double trial[2] = {0};
  const double *committed[2] = {&at->q[0], &at->q[1]};
  for (int c = 0; c < 2; c++)
    ed_path_hermite(&path[c], H, at->u[c], at->v[c], u[c], v[c]);
  ed_path_hermite_directions(direction, H);
  CHECK_STATUS(damper->law->step_pair(damper, committed, path, direction, (double *const[]){&trial[0], &trial[1]}, &out), ED_OK);
  *at = (bearing){{u[0], u[1]}, {v[0], v[1]}, {trial[0], trial[1]}};
  return out;
}

/* Any motion in one direction has the force of the plane's law along it, and none across. */
static void check_one_direction(int law)
{
  ed_damper damper = prepared(law);
  for (int degrees = 0; degrees <= 90; degrees += 30) {
    const double e[2] = {cos(degrees * M_PI / 180.0), sin(degrees * M_PI / 180.0)};
    double state = 0.0, u0 = 0.0, v0 = 0.0, largest = 0.0, off = 0.0;
    unsigned seed = 7;
    bearing at = {0};
    for (int i = 0; i < STEPS; i++) {
      const double size = i % 3 == 0 ? 1e-3 : 0.05, u = u0 + size * noise(&seed), v = 5.0 * size / H * 0.1 * noise(&seed);
      ed_path path, direction[2];
      ed_damper_force plane = {0};
      double trial;
      ed_path_hermite(&path, H, u0, v0, u, v);
      ed_path_hermite_directions(direction, H);
      CHECK_STATUS(damper.law->step(&damper, &state, &path, direction, &trial, &plane), ED_OK);
      const ed_pair_force pair = go(&damper, &at, (double[]){u * e[0], u * e[1]}, (double[]){v * e[0], v * e[1]});
      for (int c = 0; c < 2; c++)
        off = fmax(off, fabs(pair.force[c] - plane.force * e[c]));
      largest = fmax(largest, fabs(plane.force));
      state = trial;
      u0 = u;
      v0 = v;
    }
    CHECK_NEAR(off, 0.0, 1e-11 * largest); /* where a path turns is found to rounding alone */
  }
  ed_damper_clear(&damper);
}

/* A turned motion has the turned forces; slopes are those of differences. */
static void check_all_directions(int law)
{
  ed_damper damper = prepared(law);
  const double c = cos(0.7), s = sin(0.7);
  bearing at = {0}, turned = {0};
  unsigned seed = 3;
  double off = 0.0, slope_off = 0.0, largest = 0.0, stiff = 0.0;
  for (int i = 0; i < STEPS; i++) {
    const double size = i % 4 == 0 ? 1e-4 : 5e-3, u[2] = {at.u[0] + size * noise(&seed), at.u[1] + size * noise(&seed)};
    const double v[2] = {size / H * noise(&seed), size / H * noise(&seed)};
    const bearing before = at;
    const ed_pair_force one = go(&damper, &at, u, v);
    const ed_pair_force other =
      go(&damper, &turned, (double[]){c * u[0] - s * u[1], s * u[0] + c * u[1]}, (double[]){c * v[0] - s * v[1], s * v[0] + c * v[1]});
    off = fmax(off, hypot(other.force[0] - c * one.force[0] + s * one.force[1], other.force[1] - s * one.force[0] - c * one.force[1]));
    largest = fmax(largest, hypot(one.force[0], one.force[1]));
    int turns = 0; /* slopes leave out how the place of least speed moves with the unknowns */
    ed_path path[2];
    for (int k = 0; k < 2; k++)
      ed_path_hermite(&path[k], H, before.u[k], before.v[k], u[k], v[k]);
    for (int j = 0; j <= 1000; j++) {
      const double t = H * j / 1000;
      double power = 0.0;
      for (int k = 0; k < 2; k++)
        power += ed_path_v(&path[k], t) * (2.0 * path[k].c[2] + 6.0 * path[k].c[3] * t);
      turns |= power < 0.0 ? 1 : power > 0.0 && turns ? 2 : 0; /* 1: it slows down, 3: and then speeds up */
    }
    for (int k = 0; turns < 2 && k < 4; k++) {
      double force[2][2];
      const double width = k % 2 ? 1e-7 / H : 1e-8;
      for (int side = 0; side < 2; side++) {
        double to_u[2] = {u[0], u[1]}, to_v[2] = {v[0], v[1]};
        *(k % 2 ? &to_v[k / 2] : &to_u[k / 2]) += side ? width : -width;
        bearing trial = before;
        const ed_pair_force there = go(&damper, &trial, to_u, to_v);
        memcpy(force[side], there.force, sizeof there.force);
      }
      for (int d = 0; d < 2; d++) {
        const double unit = k % 2 ? 1.0 / H : 1.0; /* slopes to velocities as those to deformations */
        slope_off = fmax(slope_off, unit * fabs((force[1][d] - force[0][d]) / (2.0 * width) - one.slope[d][k / 2][k % 2]));
        stiff = fmax(stiff, unit * fabs(one.slope[d][k / 2][k % 2]));
      }
    }
  }
  CHECK_NEAR(off, 0.0, 1e-10 * largest);
  CHECK_NEAR(slope_off, 0.0, 2e-5 * stiff); /* differences of 1e-8 m of forces that bend over 1e-4 m */
  ed_damper_clear(&damper);
}

/* On a circle of radius r friction lags behind the velocity by the angle asin(limit / (k r)), as q' = k (u' - n (n . u')) turns as fast as
 * the motion does. */
static void check_circle(void)
{
  const double r = 0.1, omega = 2.0, k = 50e6, limit = 60e3;
  ed_damper damper = prepared(2);
  bearing at = {{r, 0.0}, {0.0, r * omega}, {0}};
  ed_pair_force out = {0};
  double angle = 0.0, work = 0.0, last[2] = {0.0, limit};
  for (int i = 0; i < 1000; i++) {
    const double before[2] = {at.u[0], at.u[1]};
    angle += omega * H;
    out = go(&damper, &at, (double[]){r * cos(angle), r * sin(angle)}, (double[]){-r * omega * sin(angle), r * omega * cos(angle)});
    for (int c = 0; c < 2; c++) {
      work += 0.5 * (last[c] + out.force[c]) * (at.u[c] - before[c]);
      last[c] = out.force[c];
    }
  }
  const double along = -sin(angle) * out.force[0] + cos(angle) * out.force[1], inward = -(cos(angle) * out.force[0] + sin(angle) * out.force[1]);
  CHECK_NEAR(hypot(along, inward), limit, 1e-12 * limit);
  CHECK_NEAR(atan2(-inward, along), asin(limit / (k * r)), omega * H / 32.0); /* half of the last chord */
  CHECK_NEAR(work, limit * r * angle, 5e-4 * limit * r * angle);
  ed_damper_clear(&damper);
}

/* A mass on a bearing in space, turned in plan: the response turns with it, and energy balances. */
static void check_model(void)
{
  enum { N = 600 };
  static double ground[3][N + 1];
  unsigned seed = 11;
  double last[2][4];
  for (int i = 0; i <= N; i++)
    for (int c = 0; c < 2; c++)
      ground[c][i] = 2.0 * sin((c ? 0.031 : 0.043) * i + c) + 0.5 * noise(&seed);
  for (int turned = 0; turned < 2; turned++) {
    const double c = turned ? cos(0.5) : 1.0, s = turned ? sin(0.5) : 0.0;
    static double moved[2][N + 1];
    for (int i = 0; i <= N; i++) {
      moved[0][i] = c * ground[0][i] - s * ground[1][i];
      moved[1][i] = s * ground[0][i] + c * ground[1][i];
    }
    ed_model *model = ed_model_new(3);
    const int base = ed_model_node(model, "base", (double[]){0.0, 0.0, 0.0}), top = ed_model_node(model, "top", (double[]){0.0, 0.0, 3.0});
    const double stiffness[] = {1e9, 1e7, 1e7, 1e7}, mass[] = {5e4, 5e4, 0.0, 0.0, 0.0, 0.0};
    const int section = ed_model_elastic_section(model, stiffness);
    CHECK(ed_model_elastic_beam(model, "column", base, top, section, ED_LINEAR, NULL, (double[]){1.0, 0.0, 0.0}) >= 0);
    ed_model_fix(model, base, (int[]){0, 0, 1, 1, 1, 1});
    ed_model_mass(model, base, mass);
    ed_model_mass(model, top, mass);
    const int x = 0, y = 1;
    const double one = 1.0;
    const int number = ed_model_damper(model, "x", LAW[3].id, LAW[3].n, LAW[3].parameter, 0.0, 0.0, 1.0, 1.0, 1, &base, &x, &one);
    CHECK_INT(number, 0);
    CHECK_INT(ed_model_damper_across(model, number, "y", 1, &base, &y, &one), 1);
    CHECK_STATUS(ed_model_damper_carries(model, number), ED_OK);
    CHECK(ed_model_damper_across(model, 1, "z", 1, &base, &y, &one) < 0);
    CHECK_CONTAINS(ed_model_message(model), "damper y acts in two directions already");
    const int gap = ed_model_damper(model, "gap", ED_LAW_GAP, 4, (double[]){1e6, 10.0, 0.0, 0.0}, 0.0, 0.0, 1.0, 1.0, 1, &base, &x, &one);
    CHECK(ed_model_damper_across(model, gap, "y", 1, &base, &y, &one) < 0);
    CHECK_CONTAINS(ed_model_message(model), "the law gap acts in one direction alone");
    int status = ED_OK;
    char message[256] = "";
    ed_analysis *a = ed_analysis_new(model, &status, message, sizeof message);
    CHECK_STATUS(status, ED_OK);
    ed_set(a, ED_TOLERANCE, 1e-11);
    int channel[4];
    for (int i = 0; i < 4; i++)
      channel[i] = i < 2 ? add_channel(a, ED_DISPLACEMENT, top, i) : add_channel(a, ED_DAMPER_FORCE, i - 2, 0);
    CHECK_STATUS(ed_history_begin(a, N, 0.01, moved[0], moved[1], NULL, ED_NEWMARK, (double[]){0.5, 0.25}), ED_OK);
    CHECK_STATUS(ed_run_advance(a, N), ED_OK);
    ed_statistics statistics;
    ed_get_statistics(a, &statistics);
    CHECK(statistics.energy_error < 1e-9);
    CHECK(statistics.iterations < 6 * N);
    double most[4], when[4], least[4], since[4], end[4];
    ed_extremes(a, most, when, least, since, end);
    for (int i = 0; i < 4; i += 2) {
      last[turned][i] = c * end[channel[i]] + s * end[channel[i + 1]];
      last[turned][i + 1] = -s * end[channel[i]] + c * end[channel[i + 1]];
    }
    ed_run_end(a);
    ed_analysis_free(a);
    ed_model_free(model);
  }
  for (int i = 0; i < 4; i++)
    CHECK_NEAR(last[1][i], last[0][i], 1e-8 * hypot(last[0][i], last[0][i ^ 1]));
}

int main(void)
{
  for (int law = 0; law < LAWS; law++) {
    check_one_direction(law);
    check_all_directions(law);
  }
  check_circle();
  check_model();
  return checks_end("bearings");
}
