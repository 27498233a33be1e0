/* Small matrices: LU with row pivoting, and the inverse and release of symmetric 3x3 matrices. */
#include "base/dense.h"
#include "base/symmetric.h"
#include "checks.h"
#include "numbers.h"

#include <math.h>
#include <string.h>

enum { LARGEST = 12 };

static void check_lu(int n, numbers *source)
{
  double a[LARGEST * LARGEST], factors[LARGEST * LARGEST], x[LARGEST], b[LARGEST];
  int pivot[LARGEST];
  for (int i = 0; i < n * n; i++)
    a[i] = next_number(source, -1.0, 1.0);
  for (int i = 0; i < n; i++)
    a[i * n + i] = 0.0; /* without pivoting the first step would divide by zero */
  for (int i = 0; i < n; i++)
    x[i] = next_number(source, -1.0, 1.0);
  for (int i = 0; i < n; i++) {
    b[i] = 0.0;
    for (int j = 0; j < n; j++)
      b[i] += a[i * n + j] * x[j];
  }
  memcpy(factors, a, sizeof factors);
  CHECK_INT(ed_dense_factor(n, factors, pivot), 1);
  ed_dense_solve(n, factors, pivot, b);
  for (int i = 0; i < n; i++)
    CHECK_NEAR(b[i], x[i], 1e-11); /* rounding times a condition below 1e4 */
}

static void check_singular(void)
{
  double rank_one[4] = {1.0, 2.0, 2.0, 4.0}, zero[9] = {0};
  int pivot[3];
  CHECK_INT(ed_dense_factor(2, rank_one, pivot), 0);
  CHECK_INT(ed_dense_factor(3, zero, pivot), 0);
}

static void multiply(const double *a, const double *b, double *product)
{
  for (int j = 0; j < 3; j++) {
    static const int column[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    const double x[3] = {b[column[j][0]], b[column[j][1]], b[column[j][2]]};
    double y[3];
    ed_sym3_times(a, x, y);
    for (int i = 0; i < 3; i++)
      product[3 * i + j] = y[i];
  }
}

static void check_inverse(numbers *source)
{
  double a[6], inverse[6] = {0}, product[9];
  for (int i = 0; i < 6; i++)
    a[i] = next_number(source, -1.0, 1.0);
  a[0] += 4.0; /* diagonally dominant: positive definite */
  a[3] += 4.0;
  a[5] += 4.0;
  const double determinant = ed_sym3_inverse(a, inverse);
  const double expected = a[0] * a[3] * a[5] + 2.0 * a[1] * a[2] * a[4] - a[0] * a[4] * a[4] - a[3] * a[2] * a[2] -
                          a[5] * a[1] * a[1];
  CHECK_NEAR(determinant, expected, 1e-13 * expected);
  multiply(a, inverse, product);
  for (int i = 0; i < 9; i++)
    CHECK_NEAR(product[i], i % 4 == 0 ? 1.0 : 0.0, 1e-14);
}

static void check_release(void)
{
  /* releasing a moment and inverting condenses it: what is left is the inverse of the other rows and columns */
  for (int which = 1; which <= 2; which++) {
    double a[6] = {2.0, 0.3, -0.4, 5.0, 0.7, 4.0}, inverse[6];
    const double kept = which == 1 ? a[5] : a[3], mixed = which == 1 ? a[2] : a[1];
    const double determinant = a[0] * kept - mixed * mixed;
    ed_sym_release(3, a, which, 1.0);
    CHECK(ed_sym3_inverse(a, inverse) > 0.0);
    ed_sym_release(3, inverse, which, 0.0);
    CHECK_NEAR(inverse[0], kept / determinant, 1e-15);
    CHECK_NEAR(inverse[which == 1 ? 5 : 3], 2.0 / determinant, 1e-15);
    CHECK_NEAR(inverse[which == 1 ? 2 : 1], -mixed / determinant, 1e-15);
    CHECK(inverse[which == 1 ? 3 : 5] == 0.0 && inverse[which] == 0.0 && inverse[4] == 0.0);
  }
}

int main(void)
{
  numbers source = {1};
  for (int n = 2; n <= LARGEST; n++)
    check_lu(n, &source);
  check_singular();
  for (int i = 0; i < 200; i++)
    check_inverse(&source);
  const double zero[6] = {0}, rank_two[6] = {1.0, 1.0, 0.0, 1.0, 0.0, 1.0};
  double inverse[6];
  CHECK(ed_sym3_inverse(zero, inverse) == 0.0);
  CHECK(ed_sym3_inverse(rank_two, inverse) == 0.0);
  check_release();
  return checks_end("dense");
}
