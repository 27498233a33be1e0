/* Running extremes along cubics whose turns are known, and against the largest of many samples. */
#include "checks.h"
#include "damper/running_extremes.h"
#include "numbers.h"

#include <math.h>

/* u = 3 s - 2.25 s^2 + 0.5 s^3 - 0.5 turns at 1 (u = 0.75) and at 2 (u = 0.5). */
static const ed_path path = {2.0, {-0.5, 3.0, -2.25, 0.5}};

static void check_peak_inside(void)
{
  ed_extremes_piece piece[ED_EXTREMES_PIECES];
  const ed_running start = {0.25, -0.75};
  CHECK_INT(ed_extremes_pieces(start, &path, piece), 3);
  CHECK(piece[0].from == 0.0 && piece[0].growing == 0 && piece[0].largest_at < 0.0);
  CHECK_NEAR(ed_path_u(&path, piece[1].from), 0.25, 1e-15);
  CHECK(piece[0].to == piece[1].from && piece[1].growing == 1);
  CHECK_NEAR(piece[1].to, 1.0, 1e-15);
  CHECK(piece[2].growing == 0 && piece[2].to == 2.0);
  CHECK_NEAR(piece[2].start.largest, 0.75, 1e-15);
  CHECK_NEAR(piece[2].largest_at, 1.0, 1e-15);
  CHECK(piece[2].start.smallest == -0.75 && piece[2].smallest_at < 0.0);
  CHECK_NEAR(ed_extremes_along(start, &path).largest, 0.75, 1e-15);
  double at[ED_EXTREMES_BREAKS];
  CHECK_INT(ed_extremes_breaks(start, &path, at), 2);
  CHECK(at[0] == piece[1].from && at[1] == piece[2].from);
}

/* Nothing new: one piece. A first value outside (a jump): it counts. */
static void check_ends(void)
{
  ed_extremes_piece piece[ED_EXTREMES_PIECES];
  CHECK_INT(ed_extremes_pieces((ed_running){1.0, -1.0}, &path, piece), 1);
  CHECK(piece[0].from == 0.0 && piece[0].to == 2.0 && piece[0].growing == 0);
  CHECK_INT(ed_extremes_pieces((ed_running){1.0, 0.0}, &path, piece), 1);
  CHECK(piece[0].start.smallest == -0.5 && piece[0].smallest_at == 0.0);
  CHECK_NEAR(ed_extremes_mean(ed_extremes_along((ed_running){1.0, 0.0}, &path)), 0.75, 1e-15);
}

static void check_against_samples(void)
{
  numbers source = {7};
  for (int i = 0; i < 2000; i++) {
    ed_path random = {next_number(&source, 0.1, 2.0), {0}}, velocity;
    for (int k = 0; k < 4; k++)
      random.c[k] = next_number(&source, -1.0, 1.0);
    ed_path_of_velocity(&random, &velocity);
    const ed_running start = {next_number(&source, 0.0, 1.0), next_number(&source, -1.0, 0.0)};
    const ed_path *const of[2] = {&random, &velocity};
    for (int j = 0; j < 2; j++) {
      ed_running sampled = start;
      enum { N = 1000 };
      for (int k = 0; k <= N; k++)
        sampled = ed_extremes_with(sampled, ed_path_u(of[j], random.h * k / N));
      const ed_running exact = ed_extremes_along(start, of[j]);
      /* a peak between two samples is missed by at most half the curvature times the square of half their distance */
      const double missed = 0.5 * (6.0 + 6.0 * random.h) * random.h * random.h / (4.0 * N * N) + 1e-14;
      CHECK(exact.largest >= sampled.largest - 1e-14 && exact.largest <= sampled.largest + missed);
      CHECK(exact.smallest <= sampled.smallest + 1e-14 && exact.smallest >= sampled.smallest - missed);
    }
  }
}

int main(void)
{
  check_peak_inside();
  check_ends();
  check_against_samples();
  return checks_end("running extremes");
}
