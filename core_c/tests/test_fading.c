/* What fades against closed forms: constant input makes a geometric series, a turning decay a spiral. */
#include "checks.h"
#include "edcore.h"

#include <math.h>

enum { N = 2000 };

static void check_series(void)
{
  static double decay[N - 1], made[N - 1], q[N];
  for (int i = 0; i < N - 1; i++) {
    decay[i] = 0.99;
    made[i] = 0.01 * 3.0;
  }
  CHECK_STATUS(ed_fading(N, decay, made, 5.0, q), ED_OK);
  for (int i = 0; i < N; i++) /* rounding of some i operations on numbers of about 5 */
    CHECK_NEAR(q[i], 3.0 + 2.0 * pow(0.99, i), 1e-12);
  for (int i = 0; i < N - 1; i++)
    decay[i] = made[i] = 0.0;
  CHECK_STATUS(ed_fading(N, decay, made, 5.0, q), ED_OK);
  CHECK(q[0] == 5.0 && q[1] == 0.0 && q[N - 1] == 0.0);
}

static void check_spiral(void)
{
  static double decay[2 * (N - 1)], made[2 * (N - 1)], q[2 * N];
  const double size = 0.999, turn = 0.03, before[2] = {2.0, -1.0};
  for (int i = 0; i < N - 1; i++) {
    decay[2 * i] = size * cos(turn);
    decay[2 * i + 1] = size * sin(turn);
  }
  CHECK_STATUS(ed_fading_complex(N, decay, made, before, q), ED_OK);
  for (int i = 0; i < N; i++) {
    const double c = pow(size, i) * cos(turn * i), s = pow(size, i) * sin(turn * i);
    CHECK_NEAR(q[2 * i], 2.0 * c + s, 1e-12);
    CHECK_NEAR(q[2 * i + 1], 2.0 * s - c, 1e-12);
  }
  for (int i = 0; i < N - 1; i++) /* fed so that it rests where it began: made = (1 - decay) before */
    made[2 * i] = 2.0 * (1.0 - decay[2 * i]) - decay[2 * i + 1], made[2 * i + 1] = decay[2 * i] - 1.0 - 2.0 * decay[2 * i + 1];
  CHECK_STATUS(ed_fading_complex(N, decay, made, before, q), ED_OK);
  CHECK_NEAR(q[2 * N - 2], 2.0, 1e-12);
  CHECK_NEAR(q[2 * N - 1], -1.0, 1e-12);
}

static void check_ends(void)
{
  const double decay[3] = {0.5, 0.5, 0.5}, made[3] = {0.0, NAN, 0.0}, before[2] = {1.0, 0.0};
  double q[4];
  CHECK_STATUS(ed_fading(0, decay, made, 1.0, q), ED_E_ARGUMENT);
  CHECK_STATUS(ed_fading_complex(0, decay, made, before, q), ED_E_ARGUMENT);
  CHECK_STATUS(ed_fading(1, decay, made, 7.0, q), ED_OK);
  CHECK(q[0] == 7.0);
  CHECK_STATUS(ed_fading(4, decay, made, 1.0, q), ED_E_NOT_FINITE);
  CHECK(q[1] == 0.5 && isnan(q[2]) && isnan(q[3]));
}

int main(void)
{
  check_series();
  check_spiral();
  check_ends();
  return checks_end("fading");
}
