/* The equilibrium of the half brace at an elongation. The outermost node is driven to x = -(length + elongation)/2; the rest is in
 * equilibrium with it. What is solved is the least potential near the committed shape: where the tangent is not positive definite the
 * brace snaps through, and the iteration goes downhill to the next stable shape. */
#include "element/strut_parts.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Where the search for a shift begins, over the unloaded diagonal: it doubles from there. */
static const double LEAST_SHIFT = 1e-6;
/* Of the shift that makes a tangent definite, over the unloaded diagonal: what needs more is no number. */
static const double LARGEST_SHIFT = 1e12;

enum { SIZE = ED_STRUT_MAX_UNKNOWNS + 1, MAX_ITERATIONS = 60, MAX_SEARCH = 8 };

/* The part's displacements at the trial's shape. */
static void gather(const ed_strut *s, int p, const double *shape, double driven, double *d)
{
  for (int i = 0; i < 6; i++) {
    const int degree = s->degree[p][i];
    d[i] = degree < 0 ? 0.0 : (degree == s->driven ? driven : shape[degree]);
  }
}

/* Forces at the unknowns and at the driven degree, of the shape in the block. Returns a status. */
static int evaluate(const ed_strut *s, double driven, const double *layers, double *block, ed_element_control *control, double *force)
{
  const double *shape = ed_strut_shape(s, block);
  memset(force, 0, (size_t)(s->unknowns + 1) * sizeof *force);
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    double d[6], f[6];
    gather(s, p, shape, driven, d);
    const int status = ed_element_update(e, d, layers + e->layers, block + e->state, control);
    if (status != ED_OK)
      return status;
    ed_element_forces(e, d, block + e->state, f);
    for (int i = 0; i < 6; i++)
      if (s->degree[p][i] >= 0)
        force[s->degree[p][i]] += f[i];
    block[ED_BLOCK_REFERENCE] = fmax(block[ED_BLOCK_REFERENCE], fabs(block[e->state + ED_BLOCK_Q]));
  }
  if (s->end_rotation >= 0)
    force[s->end_rotation] += s->end_stiffness * shape[s->end_rotation];
  return ED_OK;
}

static void assemble(const ed_strut *s, double driven, double *block, double K[SIZE][SIZE])
{
  const double *shape = ed_strut_shape(s, block);
  for (int i = 0; i <= s->unknowns; i++)
    memset(K[i], 0, (size_t)(s->unknowns + 1) * sizeof **K);
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    double d[6], t[36];
    gather(s, p, shape, driven, d);
    ed_element_tangent(e, d, block + e->state, t);
    for (int i = 0; i < 6; i++)
      for (int j = 0; j < 6; j++)
        if (s->degree[p][i] >= 0 && s->degree[p][j] >= 0)
          K[s->degree[p][i]][s->degree[p][j]] += t[6 * i + j];
  }
  if (s->end_rotation >= 0)
    K[s->end_rotation][s->end_rotation] += s->end_stiffness;
}

/* K + shift diag(rigid) = L D L' of the unknowns into F; 0 where it is not positive definite. */
static int factor(int n, double K[SIZE][SIZE], double shift, const double *rigid, double F[SIZE][SIZE])
{
  for (int j = 0; j < n; j++) {
    double pivot = K[j][j] + shift * rigid[j];
    for (int k = 0; k < j; k++)
      pivot -= F[j][k] * F[j][k] * F[k][k];
    if (!(pivot > 4.0 * DBL_EPSILON * rigid[j]))
      return 0;
    F[j][j] = pivot;
    for (int i = j + 1; i < n; i++) {
      double sum = K[i][j];
      for (int k = 0; k < j; k++)
        sum -= F[i][k] * F[j][k] * F[k][k];
      F[i][j] = sum / pivot;
    }
  }
  return 1;
}

static void solve(int n, double F[SIZE][SIZE], double *x)
{
  for (int i = 0; i < n; i++)
    for (int k = 0; k < i; k++)
      x[i] -= F[i][k] * x[k];
  for (int i = n - 1; i >= 0; i--) {
    x[i] /= F[i][i];
    for (int k = i + 1; k < n; k++)
      x[i] -= F[k][i] * x[k];
  }
}

static double dot(int n, const double *a, const double *b)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

/* Stiffness of the driven degree with the rest in equilibrium, by elongation of the whole brace. */
static double condense(const ed_strut *s, double K[SIZE][SIZE], double F[SIZE][SIZE])
{
  double x[SIZE];
  memcpy(x, K[s->driven], (size_t)s->unknowns * sizeof *x);
  solve(s->unknowns, F, x);
  return 0.5 * (K[s->driven][s->driven] - dot(s->unknowns, K[s->driven], x));
}

/* The diagonal of the unloaded brace, which makes shifts comparable. */
static void rigid_diagonal(const ed_strut *s, double *rigid)
{
  memset(rigid, 0, (size_t)(s->unknowns + 1) * sizeof *rigid);
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    const double across = e->kind == ED_TRUSS ? 0.0 : (e->stiffness[3] + 2.0 * e->stiffness[4] + e->stiffness[5]) / (e->length * e->length);
    const double all[6] = {e->stiffness[0], across, e->stiffness[3], e->stiffness[0], across, e->stiffness[5]};
    for (int i = 0; i < 6; i++)
      if (s->degree[p][i] >= 0)
        rigid[s->degree[p][i]] += all[i];
  }
}

double ed_strut_initial_stiffness(const ed_strut *s, double *block)
{
  double K[SIZE][SIZE], F[SIZE][SIZE] = {{0}}, rigid[SIZE];
  rigid_diagonal(s, rigid);
  assemble(s, 0.0, block, K);
  return factor(s->unknowns, K, 0.0, rigid, F) ? condense(s, K, F) : 0.0;
}

/* The largest force out of balance, moments by their scale; not finite if one is. */
static double unbalance_of(const ed_strut *s, const double *force)
{
  double unbalance = 0.0;
  for (int i = 0; i < s->unknowns; i++) {
    const double value = fabs(force[i]) * s->scale[i];
    if (!(value <= unbalance))
      unbalance = value;
  }
  return unbalance;
}

/* By how much a step has to be shortened: no beam turns by more than a few degrees in an iteration, as tangents do not reach further. */
static double share_within_reach(const ed_strut *s, const double *step)
{
  const double length = s->part[s->parts - 1].length;
  double turn = 0.0;
  for (int i = 0; i < s->unknowns; i++)
    turn = fmax(turn, fabs(step[i]) * (s->scale[i] == 1.0 ? 1.0 / length : 1.0));
  return turn > 0.1 ? 0.1 / turn : 1.0;
}

/* Shortens a step that passes the least of the potential, whose slope along the step is -start at its beginning. Returns a status. */
static int shorten(const ed_strut *s, double start, const double *step, double driven, const double *layers, double *block,
                   ed_element_control *control, double *force)
{
  double taken = 1.0, low = 0.0, at_low = -start, high = 1.0, *shape = ed_strut_shape(s, block);
  int status = ED_OK;
  for (int search = 0; status == ED_OK && search < MAX_SEARCH; search++) {
    const double slope = dot(s->unknowns, step, force);
    if (slope <= 0.8 * start && (taken == 1.0 || slope >= -0.8 * start))
      break;
    double next;
    if (slope > 0.0) {
      high = taken;
      next = low + (high - low) * at_low / (at_low - slope);
    } else {
      low = taken;
      at_low = slope;
      next = 0.5 * (low + high);
    }
    next = fmin(fmax(next, low + 0.1 * (high - low)), high - 0.1 * (high - low));
    for (int i = 0; i < s->unknowns; i++)
      shape[i] += (next - taken) * step[i];
    taken = next;
    status = evaluate(s, driven, layers, block, control, force);
  }
  return status;
}

int ed_strut_equilibrate(const ed_strut *s, double elongation, const double *layers, double *block, ed_element_control *control)
{
  const int n = s->unknowns;
  const double driven = -0.5 * elongation, tolerance = sqrt(control->tolerance);
  double K[SIZE][SIZE], F[SIZE][SIZE] = {{0}}, rigid[SIZE], force[SIZE], step[SIZE], *shape = ed_strut_shape(s, block), shift = 0.0;
  rigid_diagonal(s, rigid);
  int status = evaluate(s, driven, layers, block, control, force);
  block[SNAPPED] = 0.0;
  for (int iteration = 0; status == ED_OK; iteration++) {
    const double unbalance = unbalance_of(s, force);
    if (!isfinite(unbalance))
      return ED_E_NOT_FINITE;
    assemble(s, driven, block, K);
    const int stable = factor(n, K, 0.0, rigid, F);
    const int balanced = unbalance <= tolerance * block[ED_BLOCK_REFERENCE];
    if (balanced && stable) {
      block[ED_BLOCK_Q] = -force[s->driven];
      block[ED_BLOCK_K] = condense(s, K, F);
      if (control->no_softening)
        block[ED_BLOCK_K] = fmax(block[ED_BLOCK_K], 0.0);
      return ED_OK;
    }
    if (iteration == MAX_ITERATIONS)
      return ED_E_ELEMENT;
    control->iterations++;
    shift = stable ? 0.0 : fmax(0.25 * shift, LEAST_SHIFT);
    if (!stable) {
      block[SNAPPED] = 1.0;
      while (!factor(n, K, shift, rigid, F))
        if (!((shift *= 2.0) < LARGEST_SHIFT))
          return ED_E_NOT_FINITE;
    }
    for (int i = 0; i < n; i++)
      step[i] = balanced ? s->nudge[i] : -force[i]; /* out of a balance that is not stable */
    if (!balanced)
      solve(n, F, step);
    const double share = share_within_reach(s, step), start = -share * dot(n, step, force);
    for (int i = 0; i < n; i++) {
      step[i] *= share;
      shape[i] += step[i];
    }
    status = evaluate(s, driven, layers, block, control, force);
    if (status == ED_OK && !balanced)
      status = shorten(s, start, step, driven, layers, block, control, force);
  }
  return status;
}
