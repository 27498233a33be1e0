/* Peaks of recursions of the second order against closed forms: an impulse makes y_i = exp(-d i) sin(h (i + 1)) / sin h of the
 * recursion with a1 = -2 exp(-d) cos h, a2 = exp(-2 d). */
#include "checks.h"
#include "edcore.h"

#include <math.h>
#include <stddef.h>

enum { N = 400, M = 11, MOST = 5 };

/* Peaks of a decaying sine: half a turn apart, each exp(-d pi / h) of the one before, with changing signs. The parabola leaves out
 * the third and fourth derivatives, of the order of d h^2 and h^4. */
static void check_decay(void)
{
  static double x[N] = {1.0}, b[M][3], a[M][2], place[M][MOST], value[M][MOST];
  int count[M];
  const double d = 0.004;
  for (int m = 0; m < M; m++) {
    const double h = 2.0 * M_PI / (12.3 + 5.1 * m);
    b[m][0] = 1.0, b[m][1] = b[m][2] = 0.0;
    a[m][0] = -2.0 * exp(-d) * cos(h), a[m][1] = exp(-2.0 * d);
  }
  CHECK_STATUS(ed_recursion_peaks(N, x, M, &b[0][0], &a[0][0], 0.0, MOST, count, &place[0][0], &value[0][0], NULL), ED_OK);
  for (int m = 0; m < M; m++) {
    const double h = 2.0 * M_PI / (12.3 + 5.1 * m), turn = atan2(h, d); /* where h cos = d sin */
    CHECK(count[m] == MOST);
    for (int k = 0; k < MOST; k++) {
      const double at = (turn + k * M_PI) / h, expected = exp(-d * (at - 1.0)) * sin(h * at) / sin(h);
      CHECK_NEAR(place[m][k], at - 1.0, 0.02);
      CHECK_NEAR(value[m][k], expected, (h * h * h * h / 40.0 + 2.0 * d * h * h * h) * fabs(expected));
    }
  }
}

/* A sum of what was put in: y = x. Only maxima from the share on, the largest first, of equal ones the earlier; ends do not count. */
static void check_choice(void)
{
  const double x[12] = {9.0, 0.0, 3.0, 0.0, -5.0, 0.0, 1.0, 0.0, 3.0, 0.0, 0.0, 9.0};
  const double b[3] = {1.0, 0.0, 0.0}, a[2] = {0.0, 0.0};
  double place[4], value[4];
  int count;
  CHECK_STATUS(ed_recursion_peaks(12, x, 1, b, a, 0.2, 4, &count, place, value, NULL), ED_OK); /* of 9, the largest sample */
  CHECK(count == 3);
  CHECK(value[0] == -5.0 && place[0] == 4.0);
  CHECK(value[1] == 3.0 && place[1] == 2.0);
  CHECK(value[2] == 3.0 && place[2] == 8.0);
  CHECK_STATUS(ed_recursion_peaks(12, x, 1, b, a, 0.2, 2, &count, place, value, NULL), ED_OK);
  CHECK(count == 2 && place[1] == 2.0);
  CHECK_STATUS(ed_recursion_peaks(12, x, 1, b, a, 1.0, 4, &count, place, value, NULL), ED_OK);
  CHECK(count == 0);
}

static void check_arguments(void)
{
  const double x[3] = {0.0, 1.0, 0.0}, wrong[3] = {0.0, NAN, 0.0}, b[3] = {1.0, 0.0, 0.0}, a[2] = {0.5, 0.0};
  double place, value;
  int count;
  CHECK_STATUS(ed_recursion_peaks(2, x, 1, b, a, 0.5, 1, &count, &place, &value, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_recursion_peaks(3, x, -1, b, a, 0.5, 1, &count, &place, &value, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_recursion_peaks(3, x, 1, b, a, 1.5, 1, &count, &place, &value, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_recursion_peaks(3, x, 1, b, a, NAN, 1, &count, &place, &value, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_recursion_peaks(3, x, 1, b, a, 0.5, 0, &count, &place, &value, NULL), ED_E_ARGUMENT);
  CHECK_STATUS(ed_recursion_peaks(3, wrong, 1, b, a, 0.5, 1, &count, &place, &value, NULL), ED_E_NOT_FINITE);
  CHECK_STATUS(ed_recursion_peaks(3, x, 0, b, a, 0.5, 1, &count, &place, &value, NULL), ED_OK);
}

int main(void)
{
  check_decay();
  check_choice();
  check_arguments();
  return checks_end("recursion_peaks");
}
