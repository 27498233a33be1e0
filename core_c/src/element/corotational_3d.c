/* Exact kinematics of members in space: finite rotations of the nodes, a chord that moves with them, small deformations from it.
 *
 * The rotations of a node are the components of its rotation vector, so that R = exp(r) (Argyris 1982; Ibrahimbegovic 1997). The chord's
 * frame has its x along the chord (Battini & Pacoste 2002), and turns about it so that y and z are together as near as can be to those of
 * both ends: its y is along what y + z x chord of the ends has across the chord. Of y alone it would depend on how the web stands. From it
 * the ends turn by log(E' R E_0), of which the components about z and y are rotations of the basic system, and the difference about x the
 * twist. With basic forces q the forces are the gradient of sum q_k v_k, and the geometric tangent is its second derivative, which is
 * symmetric: rotation vectors are coordinates. Both come from arithmetic on values with their derivatives, by the displacements that
 * count: u_j - u_i, r_i, r_j. */
#include "element/element.h"

#include "base/lanes.h"

#include <math.h>
#include <string.h>

enum { VARIABLES = 9, PAIRS = VARIABLES * (VARIABLES + 1) / 2, STRAINS = ED_MAX_BASIC + 1 };

/* A value with its derivatives up to an order. */
typedef struct {
  double value, first[VARIABLES], second[PAIRS];
} jet;

ED_INLINE void set(jet *a, double value, const int order)
{
  a->value = value;
  if (order > 0)
    memset(a->first, 0, sizeof a->first);
  if (order > 1)
    memset(a->second, 0, sizeof a->second);
}

/* a += factor b */
ED_INLINE void add(jet *a, double factor, const jet *b, const int order)
{
  a->value += factor * b->value;
  for (int i = 0; order > 0 && i < VARIABLES; i++)
    a->first[i] += factor * b->first[i];
  for (int i = 0; order > 1 && i < PAIRS; i++)
    a->second[i] += factor * b->second[i];
}

/* a += factor b c */
static inline void add_product(jet *a, double factor, const jet *b, const jet *c, const int order)
{
  const double x = factor * b->value, y = factor * c->value;
  a->value += x * c->value;
  for (int i = 0; order > 0 && i < VARIABLES; i++)
    a->first[i] += x * c->first[i] + y * b->first[i];
  for (int i = 0, at = 0; order > 1 && i < VARIABLES; i++)
    for (int j = i; j < VARIABLES; j++, at++)
      a->second[at] += x * c->second[at] + y * b->second[at] + factor * (b->first[i] * c->first[j] + b->first[j] * c->first[i]);
}

/* a = f(b), with f, f', f'' there */
ED_INLINE void compose(jet *a, const double f[3], const jet *b, const int order)
{
  a->value = f[0];
  for (int i = 0; order > 0 && i < VARIABLES; i++)
    a->first[i] = f[1] * b->first[i];
  for (int i = 0, at = 0; order > 1 && i < VARIABLES; i++)
    for (int j = i; j < VARIABLES; j++, at++)
      a->second[at] = f[1] * b->second[at] + f[2] * b->first[i] * b->first[j];
}

ED_INLINE void dot(jet *a, const jet *b, const jet *c, const int order)
{
  set(a, 0.0, order);
  for (int i = 0; i < 3; i++)
    add_product(a, 1.0, &b[i], &c[i], order);
}

ED_INLINE void cross(jet *a, const jet *b, const jet *c, const int order)
{
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    set(&a[i], 0.0, order);
    add_product(&a[i], 1.0, &b[j], &c[k], order);
    add_product(&a[i], -1.0, &b[k], &c[j], order);
  }
}

/* a / |a| in its place; the return is |a|. */
static inline double make_unit(jet *a, const int order)
{
  jet square, by;
  dot(&square, a, a, order);
  const double size = sqrt(square.value), f = 1.0 / size;
  compose(&by, (double[3]){f, -0.5 * f / square.value, 0.75 * f / (square.value * square.value)}, &square, order);
  for (int i = 0; i < 3; i++) {
    const jet before = a[i];
    set(&a[i], 0.0, order);
    add_product(&a[i], 1.0, &by, &before, order);
  }
  return size;
}

/* Squares of angles, and 1 - cos, below which series are used: what they leave out is below rounding, and so is what closed forms lose. */
static const double SMALL_SQUARE = 0.25, SMALL_VERSINE = 0.02;

/* sum of c_k s^k for k < 7, and its first two derivatives */
static void series(const double *c, double s, double f[3])
{
  f[0] = f[1] = f[2] = 0.0;
  for (int k = 6; k >= 0; k--) {
    f[2] = f[2] * s + 2.0 * f[1];
    f[1] = f[1] * s + f[0];
    f[0] = f[0] * s + c[k];
  }
}

void ed_rotation_factors(double s, double a[3], double b[3])
{
  static const double A[7] = {1.0, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800, 1.0 / 6227020800.0};
  static const double B[7] = {1.0 / 2, -1.0 / 24, 1.0 / 720, -1.0 / 40320, 1.0 / 3628800, -1.0 / 479001600, 1.0 / 87178291200.0};
  if (s < SMALL_SQUARE) {
    series(A, s, a);
    series(B, s, b);
    return;
  }
  const double t = sqrt(s), c = cos(t), half = sin(0.5 * t);
  a[0] = sin(t) / t;
  b[0] = 2.0 * half * half / s;
  a[1] = 0.5 * (c - a[0]) / s;
  b[1] = (0.5 * a[0] - b[0]) / s;
  a[2] = (-0.25 * a[0] - 1.5 * a[1]) / s;
  b[2] = (0.5 * a[1] - 2.0 * b[1]) / s;
}

/* t / sin t as a function of y = 1 - cos t */
static void log_factor(double y, double f[3])
{
  static const double C[7] = {1.0, 1.0 / 3, 2.0 / 15, 2.0 / 35, 8.0 / 315, 8.0 / 693, 16.0 / 3003};
  if (y < SMALL_VERSINE) {
    series(C, y, f);
    return;
  }
  const double c = 1.0 - y, square = y * (2.0 - y);
  f[0] = acos(fmax(c, -1.0)) / sqrt(square);
  f[1] = (1.0 - c * f[0]) / square;
  f[2] = (f[0] - 3.0 * c * f[1]) / square;
}

/* Local axes of an end as its node has turned: R e = e + a r x e + b (r (r e) - s e). */
static inline void turn_axes(const ed_element *e, const jet *r, jet axis[3][3], const int order)
{
  double f[3], g[3];
  jet s, a, b, less;
  dot(&s, r, r, order);
  ed_rotation_factors(s.value, f, g);
  compose(&a, f, &s, order);
  compose(&b, g, &s, order);
  set(&less, 0.0, order);
  add_product(&less, 1.0, &b, &s, order);
  for (int k = 0; k < 3; k++) {
    const double *fixed = e->axis[k];
    jet along, b_along;
    set(&along, 0.0, order);
    for (int i = 0; i < 3; i++)
      add(&along, fixed[i], &r[i], order);
    set(&b_along, 0.0, order);
    add_product(&b_along, 1.0, &b, &along, order);
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3, l = (i + 2) % 3;
      jet turned;
      set(&turned, 0.0, order);
      add(&turned, fixed[l], &r[j], order);
      add(&turned, -fixed[j], &r[l], order);
      set(&axis[k][i], fixed[i], order);
      add_product(&axis[k][i], 1.0, &a, &turned, order);
      add_product(&axis[k][i], 1.0, &b_along, &r[i], order);
      add(&axis[k][i], -fixed[i], &less, order);
    }
  }
}

/* Rotation vector, about x, y, z of the chord's frame, from it to the axes of an end. */
static inline void turn_from_chord(jet chord[3][3], jet axis[3][3], jet turn[3], const int order)
{
  jet versine, part, factor; /* 1 - cos */
  double f[3];
  set(&versine, 1.5, order);
  for (int k = 0; k < 3; k++) {
    dot(&part, chord[k], axis[k], order);
    add(&versine, -0.5, &part, order);
  }
  log_factor(fmax(versine.value, 0.0), f);
  compose(&factor, f, &versine, order);
  for (int k = 0; k < 3; k++) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    jet sine;
    set(&sine, 0.0, order);
    dot(&part, chord[j], axis[i], order);
    add(&sine, 0.5, &part, order);
    dot(&part, chord[i], axis[j], order);
    add(&sine, -0.5, &part, order);
    set(&turn[k], 0.0, order);
    add_product(&turn[k], 1.0, &factor, &sine, order);
  }
}

/* Basic deformations and the twist, with their derivatives; the return is the length of the chord. */
ED_INLINE double deform(const ed_element *e, const double *d, jet strain[STRAINS], const int order)
{
  jet variable[VARIABLES], axis[2][3][3], chord[3][3], turn[2][3];
  for (int i = 0; i < VARIABLES; i++) {
    set(&variable[i], i < 3 ? d[6 + i] - d[i] : i < 6 ? d[i] : d[3 + i], order);
    if (order > 0)
      variable[i].first[i] = 1.0;
  }
  /* l - L = ((l + L)(l - L)) / (l + L), without cancellation */
  jet more; /* l^2 - L^2 */
  dot(&more, variable, variable, order);
  for (int i = 0; i < 3; i++)
    add(&more, 2.0 * e->length * e->axis[0][i], &variable[i], order);
  const double L = e->length, l = sqrt(fmax(L * L + more.value, 0.0));
  compose(&strain[0], (double[3]){more.value / (l + L), 0.5 / l, -0.25 / (l * l * l)}, &more, order);
  for (int i = 0; i < 3; i++) {
    set(&chord[0][i], L * e->axis[0][i], order);
    add(&chord[0][i], 1.0, &variable[i], order);
  }
  make_unit(chord[0], order);
  jet mean[3], z[3], across[3];
  for (int end = 0; end < 2; end++)
    turn_axes(e, variable + 3 + 3 * end, axis[end], order);
  for (int i = 0; i < 3; i++) {
    mean[i] = axis[0][1][i];
    add(&mean[i], 1.0, &axis[1][1][i], order);
    z[i] = axis[0][2][i];
    add(&z[i], 1.0, &axis[1][2][i], order);
  }
  cross(across, z, chord[0], order);
  for (int i = 0; i < 3; i++)
    add(&mean[i], 1.0, &across[i], order);
  cross(chord[2], chord[0], mean, order);
  make_unit(chord[2], order);
  cross(chord[1], chord[2], chord[0], order);
  for (int end = 0; end < 2; end++) {
    turn_from_chord(chord, axis[end], turn[end], order);
    strain[1 + end] = turn[end][2];
    strain[3 + end] = turn[end][1];
  }
  strain[5] = turn[1][0];
  add(&strain[5], -1.0, &turn[0][0], order);
  return l;
}

static int is_bar(const ed_element *e)
{
  return e->axes == ED_PLANE;
}

/* Chord of a bar: its length, direction, and elongation. */
static double bar_chord(const ed_element *e, const double *d, double direction[3], double *elongation)
{
  double more = 0.0;
  for (int i = 0; i < 3; i++) {
    const double apart = d[6 + i] - d[i];
    direction[i] = e->length * e->axis[0][i] + apart;
    more += apart * (2.0 * e->length * e->axis[0][i] + apart);
  }
  const double l = sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
  for (int i = 0; i < 3; i++)
    direction[i] /= l;
  *elongation = more / (l + e->length);
  return l;
}

void ed_corotational_kinematics_3d(const ed_element *e, const double *d, ed_kinematics *k)
{
  if (is_bar(e)) {
    double direction[3];
    k->l = bar_chord(e, d, direction, &k->v[0]);
    return;
  }
  jet strain[STRAINS];
  k->l = deform(e, d, strain, 0);
  for (int i = 0; i < ED_MAX_BASIC; i++)
    k->v[i] = strain[i].value;
  k->twist = strain[5].value;
}

/* Of force k along the chord, about its axes, or of the twist; along the chord with the mean of axial loads inside (geometry.c). */
static double force_of(const ed_element *e, const double *q, int k, double strain)
{
  return k == ED_MAX_BASIC ? e->twist_stiffness * strain : k == 0 ? q[0] + e->mean_axial : q[k];
}

/* What acts along the variables, on the degrees of both ends: u_j - u_i, r_i, r_j. */
static void on_degrees(const double *along, double *force)
{
  for (int i = 0; i < 3; i++) {
    force[6 + i] += along[i];
    force[i] -= along[i];
    force[3 + i] += along[3 + i];
    force[9 + i] += along[6 + i];
  }
}

void ed_corotational_forces_3d(const ed_element *e, const double *d, const double *block, double *force)
{
  const double *q = block + ed_block_q(e->axes);
  double along[VARIABLES] = {0};
  if (is_bar(e)) {
    double elongation;
    bar_chord(e, d, along, &elongation);
    for (int i = 0; i < 3; i++)
      along[i] *= q[0];
  } else {
    jet strain[STRAINS];
    deform(e, d, strain, 1);
    for (int k = 0; k < STRAINS; k++) {
      const double of = force_of(e, q, k, strain[k].value);
      for (int i = 0; i < VARIABLES; i++)
        along[i] += of * strain[k].first[i];
    }
  }
  on_degrees(along, force);
}

/* Tangent over the variables, its upper triangle. */
static void tangent_along(const ed_element *e, const double *d, const double *block, double *tangent)
{
  const double *q = block + ed_block_q(e->axes), *K = block + ed_block_k(e->axes);
  memset(tangent, 0, PAIRS * sizeof *tangent);
  if (is_bar(e)) {
    double direction[3], elongation;
    const double l = bar_chord(e, d, direction, &elongation), across = q[0] / l;
    for (int i = 0; i < 3; i++)
      for (int j = i; j < 3; j++)
        tangent[ed_sym_place(VARIABLES, i, j)] = (K[0] - across) * direction[i] * direction[j] + (i == j ? across : 0.0);
    return;
  }
  jet strain[STRAINS];
  deform(e, d, strain, 2);
  for (int k = 0; k < STRAINS; k++) {
    const double of = force_of(e, q, k, strain[k].value);
    double slope[VARIABLES] = {0}; /* of this force by the variables */
    for (int m = 0; m < ED_MAX_BASIC && k < ED_MAX_BASIC; m++)
      for (int i = 0; i < VARIABLES; i++)
        slope[i] += K[k < m ? ed_sym_place(ED_MAX_BASIC, k, m) : ed_sym_place(ED_MAX_BASIC, m, k)] * strain[m].first[i];
    for (int i = 0; k == ED_MAX_BASIC && i < VARIABLES; i++)
      slope[i] = e->twist_stiffness * strain[k].first[i];
    for (int i = 0, at = 0; i < VARIABLES; i++)
      for (int j = i; j < VARIABLES; j++, at++)
        tangent[at] += strain[k].first[i] * slope[j] + of * strain[k].second[at];
  }
}

void ed_corotational_tangent_3d(const ed_element *e, const double *d, const double *block, double *t)
{
  double along[PAIRS], columns[VARIABLES][ED_MAX_DEGREES] = {{0}};
  tangent_along(e, d, block, along);
  for (int j = 0; j < VARIABLES; j++) {
    double column[VARIABLES];
    for (int i = 0; i < VARIABLES; i++)
      column[i] = along[i < j ? ed_sym_place(VARIABLES, i, j) : ed_sym_place(VARIABLES, j, i)];
    on_degrees(column, columns[j]);
  }
  for (int i = 0; i < ED_MAX_DEGREES; i++) { /* the same along the other side */
    double row[VARIABLES], all[ED_MAX_DEGREES] = {0};
    for (int j = 0; j < VARIABLES; j++)
      row[j] = columns[j][i];
    on_degrees(row, all);
    for (int j = 0; j < ED_MAX_DEGREES; j++)
      t[ED_MAX_DEGREES * j + i] += all[j];
  }
}
