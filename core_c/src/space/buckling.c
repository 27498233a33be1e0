/* The lowest critical load factor: K phi = -lambda K_G phi by Lanczos' method on K^-1 (-K_G), symmetric in the product with K (Ericsson &
 * Ruhe 1980). Its largest eigenvalue is 1 / lambda. That none was passed over is proved by the pivots of K + lambda K_G just below
 * lambda: all positive (Sylvester's law of inertia). */
#include "space/space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STEPS = 300, PROOFS = 8 };
/* Change of the eigenvalue in a step, relative, from which on it is looked at. A proof holds down to PROVED below the factor: there the
 * smallest pivot is still far from rounding, and no engineer minds a factor passed over so close to the other. Below NONE of the
 * largest eigenvalue of either sign there is only rounding. */
static const double SETTLED = 1e-12, PROVED = 1e-4, NONE = 1e-8;
/* Of a vector before it was made orthogonal to the basis: what is left is rounding, and the basis holds all that can be reached. */
static const double EXHAUSTED = 1e-13;

typedef struct {
  int n, steps;
  double *q, *p;           /* steps x n: basis, and K times it */
  double *alpha, *beta;    /* the tridiagonal matrix: beta[j] between j and j + 1 */
  double *next, *image;    /* n each */
} lanczos;

static double dot(int n, const double *a, const double *b)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

static void multiply_geometric(const ed_space *s, const double *x, double *y)
{
  for (int j = 0; j < s->n; j++) { /* symmetric: a column is a row */
    double sum = 0.0;
    for (int k = s->column_start[j]; k < s->column_start[j + 1]; k++)
      sum -= s->geometric[k] * x[s->row[k]];
    y[j] = sum;
  }
}

/* How many eigenvalues of the tridiagonal matrix lie above x (Sturm). */
static int above(const lanczos *l, double x)
{
  double pivot = 1.0;
  int count = 0;
  for (int j = 0; j < l->steps; j++) {
    const double coupling = j ? l->beta[j - 1] * l->beta[j - 1] : 0.0;
    pivot = l->alpha[j] - x - (coupling > 0.0 ? coupling / pivot : 0.0);
    if (pivot == 0.0)
      pivot = -1e-300; /* an eigenvalue on x itself counts as below it, and the next quotient stays finite */
    count += pivot > 0.0;
  }
  return count;
}

static double bound(const lanczos *l)
{
  double largest = 0.0;
  for (int j = 0; j < l->steps; j++)
    largest = fmax(largest, fabs(l->alpha[j]) + (j ? l->beta[j - 1] : 0.0) + (j + 1 < l->steps ? l->beta[j] : 0.0));
  return largest;
}

static double largest_eigenvalue(const lanczos *l)
{
  double high = bound(l), low = -high;
  for (int i = 0; i < 200 && high - low > 0.0; i++) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high)
      break;
    if (above(l, middle) > 0)
      low = middle;
    else
      high = middle;
  }
  return 0.5 * (low + high);
}

/* Removes from `next` (and `image`, K times it) what lies in the basis, twice: once leaves rounding of what was large. */
static void make_orthogonal(lanczos *l)
{
  for (int pass = 0; pass < 2; pass++)
    for (int j = 0; j < l->steps; j++) {
      const double *q = l->q + (size_t)j * (size_t)l->n, *p = l->p + (size_t)j * (size_t)l->n;
      const double share = dot(l->n, p, l->next);
      for (int i = 0; i < l->n; i++) {
        l->next[i] -= share * q[i];
        l->image[i] -= share * p[i];
      }
    }
}

/* Appends next / size to the basis. */
static void append(lanczos *l, double size)
{
  double *q = l->q + (size_t)l->steps * (size_t)l->n, *p = l->p + (size_t)l->steps * (size_t)l->n;
  for (int i = 0; i < l->n; i++) {
    q[i] = l->next[i] / size;
    p[i] = l->image[i] / size;
  }
  l->steps++;
}

/* A start that leaves out no mode, the same on every machine. */
static double begin(ed_space *s, lanczos *l)
{
  unsigned long long state = 1;
  for (int i = 0; i < l->n; i++) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const double number = (double)(state >> 11) / 9007199254740992.0 - 0.5;
    l->next[i] = number * sqrt(s->matrix[s->diagonal[i]]); /* no unit counts more */
  }
  memcpy(l->image, l->next, (size_t)l->n * sizeof *l->image);
  ed_cholesky_solve(s->factors, l->next, 1);
  return sqrt(dot(l->n, l->next, l->image));
}

/* 1: all pivots of K + lambda K_G are positive. The factors of K are lost. */
static int stable(ed_space *s, double lambda)
{
  for (int k = 0; k < s->nnz; k++)
    s->matrix[k] += lambda * s->geometric[k];
  return ed_cholesky_factor(s->factors, s->matrix) == ED_OK;
}

static int not_found(ed_space *s, const lanczos *l, double below)
{
  return ed_space_fail(s, ED_E_NOT_CONVERGED, "the critical load factor was not found in %d steps; it is below %g", l->steps, below);
}

static int iterate(ed_space *s, lanczos *l, int most, double *factor)
{
  double before = 0.0, refuted = -HUGE_VAL;
  int proofs = 0;
  *factor = HUGE_VAL;
  const double size = begin(s, l);
  if (!(size > 0.0) || !isfinite(size))
    return ed_space_fail(s, ED_E_NOT_FINITE, "the stiffness of the frame gives no finite solution");
  append(l, size);
  for (;;) {
    const int j = l->steps - 1;
    const double *q = l->q + (size_t)j * (size_t)l->n;
    multiply_geometric(s, q, l->image);
    memcpy(l->next, l->image, (size_t)l->n * sizeof *l->next);
    ed_cholesky_solve(s->factors, l->next, 1);
    l->alpha[j] = dot(l->n, q, l->image);
    const double whole = sqrt(fmax(dot(l->n, l->next, l->image), 0.0));
    make_orthogonal(l);
    const double rest = sqrt(fmax(dot(l->n, l->next, l->image), 0.0)), theta = largest_eigenvalue(l);
    const int ended = l->steps == most || rest <= EXHAUSTED * whole;
    if (!isfinite(theta) || !isfinite(rest))
      return ed_space_fail(s, ED_E_NOT_FINITE, "the critical load factor is not a finite number");
    if (ended || (j > 0 && fabs(theta - before) <= SETTLED * bound(l))) {
      if (ended && theta <= NONE * bound(l)) { /* nothing but rounding: no axial force bends anything out */
        const int none = bound(l) == 0.0 || stable(s, 1.0 / (NONE * bound(l))), status = ed_space_factor(s);
        return status != ED_OK || none ? status : not_found(s, l, *factor);
      }
      if (theta > 0.0 && (ended || theta - refuted > SETTLED * bound(l))) {
        proofs++;
        refuted = theta;
        const int proved = stable(s, (1.0 - PROVED) / theta), status = ed_space_factor(s);
        *factor = 1.0 / theta;
        if (status != ED_OK || proved)
          return status;
      }
      if (ended || proofs == PROOFS)
        return not_found(s, l, *factor);
    }
    before = theta;
    l->beta[j] = rest;
    append(l, rest);
  }
}

int ed_space_critical(ed_space *s, const double *axial, double *factor)
{
  int pressed = 0;
  *factor = HUGE_VAL;
  for (int m = 0; m < s->n_members; m++) {
    if (!isfinite(axial[m]))
      return ed_space_fail(s, ED_E_NOT_FINITE, "member %s: its axial force is not a finite number", s->member_name[m]);
    pressed |= axial[m] < 0.0;
    s->stiffness[m] = ed_member_geometric(&s->member[m], axial[m]);
  }
  if (!pressed)
    return ED_OK;
  ed_space_assemble(s, 0, s->geometric);
  const int most = s->n < STEPS ? s->n : STEPS;
  const size_t basis = (size_t)most * (size_t)s->n;
  double *room = malloc((2 * basis + 2 * (size_t)s->n + 2 * (size_t)most) * sizeof *room);
  if (!room)
    return ed_space_fail(s, ED_E_MEMORY, "out of memory");
  lanczos l = {.n = s->n, .q = room, .p = room + basis, .next = room + 2 * basis};
  l.image = l.next + s->n;
  l.alpha = l.image + s->n;
  l.beta = l.alpha + most;
  const int status = iterate(s, &l, most, factor);
  free(room);
  if (status != ED_OK)
    *factor = HUGE_VAL;
  return status;
}
