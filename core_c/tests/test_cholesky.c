/* Sparse Cholesky factors: solutions and terms of the inverse on patterns of several kinds, results that do not depend on what is solved
 * beside, and matrices that are refused. */
#include "checks.h"
#include "edcore.h"
#include "numbers.h"
#include "space/cholesky.h"

#include <math.h>
#include <string.h>

enum { N = 150, LAST = 9, CASES = 37 };

/* A dense symmetric matrix, and what of it is not zero. */
typedef struct {
  double dense[N][N], value[N * N];
  int n, start[N + 1], row[N * N], diagonal[N];
} matrix;

static void put(matrix *m, int i, int j, double value)
{
  m->dense[i][j] = m->dense[j][i] = value;
}

/* Diagonally dominant. kind 0: diagonal; 1: a grid; 2: a grid whose last equations meet many others; 3: full. */
static void make(matrix *m, int n, int kind, numbers *source)
{
  const int wide = 8;
  memset(m, 0, sizeof *m);
  m->n = n;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < i; j++) {
      const int grid = (i - j == 1 && i % wide) || i - j == wide, master = i >= n - LAST && (i + j) % 3 == 0;
      if (kind == 3 || (kind && grid) || (kind == 2 && master))
        put(m, i, j, next_number(source, -1.0, 1.0));
    }
  int count = 0;
  for (int i = 0; i < n; i++) {
    double sum = 0.0;
    for (int j = 0; j < n; j++)
      sum += fabs(m->dense[i][j]);
    put(m, i, i, sum + next_number(source, 0.5, 2.0));
  }
  for (int j = 0; j < n; j++) {
    m->start[j] = count;
    for (int i = 0; i < n; i++)
      if (m->dense[i][j] != 0.0) {
        m->diagonal[j] = i == j ? count : m->diagonal[j];
        m->row[count++] = i;
      }
  }
  m->start[n] = count;
}

static const double *values(matrix *m)
{
  for (int j = 0; j < m->n; j++)
    for (int k = m->start[j]; k < m->start[j + 1]; k++)
      m->value[k] = m->dense[m->row[k]][j];
  return m->value;
}

static ed_cholesky *analysed(const matrix *m, int last)
{
  ed_cholesky *c = ed_cholesky_new(m->n, last, m->start, m->row, m->diagonal);
  CHECK(c != NULL);
  return c;
}

static void check_solutions(const matrix *m, ed_cholesky *c, numbers *source)
{
  static double x[CASES * N], b[CASES * N], single[N];
  const int n = m->n;
  memset(b, 0, sizeof b);
  for (int i = 0; i < CASES * n; i++)
    x[i] = next_number(source, -1.0, 1.0);
  for (int s = 0; s < CASES; s++)
    for (int i = 0; i < n; i++)
      for (int j = 0; j < n; j++)
        b[s * n + i] += m->dense[i][j] * x[s * n + j];
  memcpy(single, b + (CASES - 1) * n, (size_t)n * sizeof *single);
  CHECK_STATUS(ed_cholesky_solve(c, b, CASES), ED_OK);
  for (int i = 0; i < CASES * n; i++)
    CHECK_NEAR(b[i], x[i], 1e-12);
  CHECK_STATUS(ed_cholesky_solve(c, single, 1), ED_OK);
  CHECK_SAME(single, b + (CASES - 1) * n, n);
}

/* Against solutions under unit loads; `count` of them from `first` on, the other way round. */
static void check_inverse(ed_cholesky *c, int first, int count)
{
  static double inverse[N * N], x[N];
  int equation[N] = {0};
  for (int i = 0; i < count; i++)
    equation[i] = first + count - 1 - i;
  CHECK_STATUS(ed_cholesky_inverse(c, count, equation, inverse), ED_OK);
  for (int j = 0; j < count; j++) {
    memset(x, 0, sizeof x);
    x[equation[j]] = 1.0;
    CHECK_STATUS(ed_cholesky_solve(c, x, 1), ED_OK);
    for (int i = 0; i < count; i++)
      CHECK_NEAR(inverse[j * count + i], x[equation[i]], 1e-15);
  }
}

static void check_patterns(void)
{
  static const int sizes[] = {1, 2, 3, 5, LAST, 40, N};
  static matrix m;
  numbers source = {3};
  for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
    for (int kind = 0; kind < 4; kind++) {
      const int n = sizes[s], last = n < LAST ? n : LAST;
      make(&m, n, kind, &source);
      for (int with_last = 0; with_last < 2; with_last++) {
        ed_cholesky *c = analysed(&m, with_last ? last : 0);
        double x[N] = {0.0};
        CHECK_STATUS(ed_cholesky_solve(c, x, 1), ED_E_STATE);
        CHECK_STATUS(ed_cholesky_inverse(c, 1, (const int[]){0}, x), ED_E_STATE);
        CHECK_STATUS(ed_cholesky_factor(c, values(&m)), ED_OK);
        CHECK(ed_cholesky_pivot_ratio(c) > 0.1 && ed_cholesky_pivot_ratio(c) <= 1.0);
        check_solutions(&m, c, &source);
        check_inverse(c, n - last, last);
        check_inverse(c, 0, n);
        ed_cholesky_free(c);
      }
    }
}

/* No choice of units makes a matrix singular or saves one, and good factors follow refused ones. */
static void check_refused(void)
{
  static matrix m;
  numbers source = {4};
  for (int kind = 0; kind < 4; kind++) {
    make(&m, N, 2, &source);
    ed_cholesky *c = analysed(&m, LAST);
    double before[N], after[N], x[N] = {0.0};
    for (int i = 0; i < N; i++)
      before[i] = after[i] = i;
    CHECK_STATUS(ed_cholesky_factor(c, values(&m)), ED_OK);
    CHECK_STATUS(ed_cholesky_solve(c, before, 1), ED_OK);
    for (int k = 0; k < m.start[N]; k++)
      m.value[k] *= 1e-9;
    if (kind == 0) /* a degree without stiffness */
      for (int j = 0; j < N; j++)
        for (int k = m.start[j]; k < m.start[j + 1]; k++)
          m.value[k] *= m.row[k] != 70 && j != 70;
    if (kind == 1) /* a grid of springs that nothing holds: only rounding is left of the last pivot */
      for (int j = 0; j < N; j++) {
        double sum = 0.0;
        for (int k = m.start[j]; k < m.start[j + 1]; k++) {
          m.value[k] = -1e-9 * (1.0 + (m.row[k] + j) % 5) / 3.0;
          sum -= m.row[k] == j ? 0.0 : m.value[k];
        }
        m.value[m.diagonal[j]] = sum;
      }
    if (kind == 2) /* indefinite */
      m.value[m.diagonal[31]] *= 0.01;
    if (kind == 3)
      m.value[m.diagonal[31]] = NAN;
    CHECK_STATUS(ed_cholesky_factor(c, m.value), ED_E_SINGULAR);
    CHECK(!(ed_cholesky_pivot_ratio(c) > 0.0));
    CHECK_STATUS(ed_cholesky_solve(c, x, 1), ED_E_STATE);
    CHECK_STATUS(ed_cholesky_factor(c, values(&m)), ED_OK);
    CHECK_STATUS(ed_cholesky_solve(c, after, 1), ED_OK);
    CHECK_SAME(after, before, N);
    ed_cholesky_free(c);
  }
}

int main(void)
{
  check_patterns();
  check_refused();
  ed_cholesky_free(NULL);
  return checks_end("sparse Cholesky factors");
}
