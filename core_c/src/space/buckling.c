/* Buckling: K phi = -lambda K_G phi. Shapes are over the equations and, behind them, the amplitudes of the bows of all members with an axial
 * force; over these K is 1. The lowest factor is found by Lanczos' method on K^-1 (-K_G), symmetric in the product with K (Ericsson & Ruhe
 * 1980). Its largest eigenvalue is 1 / lambda. That none was passed over is proved by the pivots of K + lambda K_G just below lambda: all
 * positive (Sylvester's law of inertia). */
#include "space/bow.h"
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

/* What the axial forces act through. */
typedef struct {
  int count; /* of members with a force */
  ed_space_bowed *bowed;
  double *moved, *force; /* of the nodes, 6 each */
} pressed_frame;

static int length(const ed_space *s, int bowed)
{
  return s->n + 2 * ED_BOWS * bowed;
}

static void multiply_geometric(const ed_space *s, const pressed_frame *f, const double *x, double *y)
{
  memset(f->force, 0, 6 * (size_t)s->n_nodes * sizeof *f->force);
  memset(y, 0, (size_t)length(s, f->count) * sizeof *y);
  ed_space_spread(s, x, f->moved);
  for (int i = 0; i < f->count; i++) {
    const ed_space_member *m = &s->member[f->bowed[i].member];
    const int start = 6 * m->node[0], end = 6 * m->node[1], bows = length(s, i);
    double force[12] = {0.0};
    ed_member_add_geometric(m, &f->bowed[i], f->moved + start, f->moved + end, x + bows, force, y + bows);
    for (int part = 0; part < 4; part++)
      ed_member_add_global(m, force + 3 * part, f->force + (part < 2 ? start : end) + 3 * (part % 2));
  }
  ed_space_reduce(s, f->force, y);
  for (int i = 0; i < length(s, f->count); i++)
    y[i] = -y[i];
}

int ed_space_shape_length(const ed_space *s, const double *axial)
{
  int count = 0;
  for (int m = 0; m < s->n_members; m++)
    count += axial[m] != 0.0;
  return length(s, count);
}

static int press(ed_space *s, const double *axial, pressed_frame *f)
{
  const size_t nodal = 6 * (size_t)s->n_nodes;
  *f = (pressed_frame){0};
  for (int m = 0; m < s->n_members; m++)
    if (!isfinite(axial[m]))
      return ed_space_fail(s, ED_E_NOT_FINITE, "member %s: its axial force is not a finite number", s->member_name[m]);
  f->bowed = calloc((unsigned)s->n_members, sizeof *f->bowed);
  f->moved = malloc(2 * nodal * sizeof *f->moved);
  if (!f->bowed || !f->moved)
    return ed_space_fail(s, ED_E_MEMORY, "out of memory");
  f->force = f->moved + nodal;
  for (int m = 0; m < s->n_members; m++)
    if (axial[m] != 0.0) {
      f->bowed[f->count].member = m;
      ed_member_bow(&s->member[m], axial[m], &f->bowed[f->count++]);
    }
  return ED_OK;
}

static void release(pressed_frame *f)
{
  free(f->bowed);
  free(f->moved);
}

int ed_space_geometric(ed_space *s, const double *axial, int n, const double *shape, double *image)
{
  if (n < 0)
    return ed_space_fail(s, ED_E_ARGUMENT, "the number of shapes is negative");
  pressed_frame f;
  int status = press(s, axial, &f);
  const size_t each = (size_t)length(s, f.count);
  for (int i = 0; status == ED_OK && i < n; i++) {
    double *of = image + (size_t)i * each, sum = 0.0;
    multiply_geometric(s, &f, shape + (size_t)i * each, of);
    for (size_t j = 0; j < each; j++)
      sum += fabs(of[j]);
    if (!isfinite(sum))
      status = ed_space_fail(s, ED_E_NOT_FINITE, "the geometric stiffness of the frame is not a finite number");
  }
  release(&f);
  return status;
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
    l->next[i] = number * (i < s->n ? sqrt(s->matrix[s->diagonal[i]]) : 1.0); /* no unit counts more */
  }
  memcpy(l->image, l->next, (size_t)l->n * sizeof *l->image);
  ed_cholesky_solve(s->factors, l->next, 1);
  return sqrt(dot(l->n, l->next, l->image));
}

/* 1: all pivots of K + lambda K_G are positive, those of the bows first. The factors of K are lost. */
static int stable(ed_space *s, const pressed_frame *f, double lambda)
{
  for (int i = 0; i < f->count; i++)
    if (!ed_member_pressed(&s->member[f->bowed[i].member], &f->bowed[i], lambda, &s->stiffness[f->bowed[i].member]))
      return 0;
  ed_space_assemble(s, 1, s->matrix);
  return ed_cholesky_factor(s->factors, s->matrix) == ED_OK;
}

static int not_found(ed_space *s, const lanczos *l, double below)
{
  return ed_space_fail(s, ED_E_NOT_CONVERGED, "the critical load factor was not found in %d steps; it is below %g", l->steps, below);
}

static int iterate(ed_space *s, const pressed_frame *f, lanczos *l, int most, double *factor)
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
    multiply_geometric(s, f, q, l->image);
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
        const int none = bound(l) == 0.0 || stable(s, f, 1.0 / (NONE * bound(l))), status = ed_space_factor(s);
        return status != ED_OK || none ? status : not_found(s, l, *factor);
      }
      if (theta > 0.0 && (ended || theta - refuted > SETTLED * bound(l))) {
        proofs++;
        refuted = theta;
        const int proved = stable(s, f, (1.0 - PROVED) / theta), status = ed_space_factor(s);
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
  pressed_frame f;
  int status = press(s, axial, &f), pressed = 0;
  *factor = HUGE_VAL;
  for (int m = 0; m < s->n_members; m++)
    pressed |= axial[m] < 0.0;
  if (status == ED_OK && pressed) {
    const int n = length(s, f.count), most = n < STEPS ? n : STEPS;
    const size_t basis = (size_t)most * (size_t)n;
    double *room = malloc((2 * basis + 2 * (size_t)n + 2 * (size_t)most) * sizeof *room);
    lanczos l = {.n = n, .q = room};
    if (room) {
      l.p = room + basis;
      l.next = l.p + basis;
      l.image = l.next + n;
      l.alpha = l.image + n;
      l.beta = l.alpha + most;
      status = iterate(s, &f, &l, most, factor);
    } else
      status = ed_space_fail(s, ED_E_MEMORY, "out of memory");
    free(room);
  }
  release(&f);
  if (status != ED_OK)
    *factor = HUGE_VAL;
  return status;
}
