/* Loads between the ends of elements: forces in the basic system, and what they deform by themselves. */
#include "element/element.h"

#include <string.h>

void ed_element_clear_loads(ed_element *e)
{
  memset(e->section_load, 0, sizeof e->section_load);
  memset(e->end_load, 0, sizeof e->end_load);
  memset(e->free_deformation, 0, sizeof e->free_deformation);
  e->mean_axial = 0.0;
  memset(e->arm_force, 0, sizeof e->arm_force);
  memset(e->arm_moment, 0, sizeof e->arm_moment);
}

static int is_partial(const ed_member_load *load)
{
  return load->position >= 0.0 && load->end > load->position;
}

/* First moment about x (0..1) of what a partial load has before x, in shares of the length: Macaulay's brackets. */
static double partial_moment(const ed_member_load *load, int axis, double x)
{
  const double part = load->end - load->position, t = x - load->position;
  if (t <= 0.0)
    return 0.0;
  const double slope = (load->transverse_end[axis] - load->transverse[axis]) / part;
  if (t <= part)
    return 0.5 * load->transverse[axis] * t * t + slope * t * t * t / 6.0;
  const double at_end = 0.5 * load->transverse[axis] * part * part + slope * part * part * part / 6.0;
  return at_end + 0.5 * (load->transverse[axis] + load->transverse_end[axis]) * part * (t - part);
}

/* Internal forces at x (0..1) of the simply supported basic system, axially fixed at i: N, and the moment M_z of the load along y (axis 0)
 * or -M_y of that along z (axis 1). */
static void load_forces(const ed_element *e, const ed_member_load *load, int axis, double factor, double x, double *N, double *M)
{
  const double L = e->length, wx = factor * load->axial, wy = factor * load->transverse[axis];
  if (load->position < 0.0) {
    *N = wx * L * (1.0 - x);
    *M = 0.5 * wy * L * L * x * (x - 1.0);
  } else if (is_partial(load)) {
    *N = 0.0;
    *M = -factor * L * L * (partial_moment(load, axis, 1.0) * x - partial_moment(load, axis, x));
  } else {
    const double a = load->position;
    *N = x < a ? wx : 0.0;
    *M = -wy * L * (x < a ? (1.0 - a) * x : a * (1.0 - x));
  }
}

/* Integrals over the length of the moment of a partial load, and of that times x: of polynomials up to the fourth degree. */
static void partial_integrals(const ed_element *e, const ed_member_load *load, int axis, double factor, double *m, double *mx)
{
  const double at[4] = {0.0, load->position, load->end, 1.0};
  double x[4], weight[4];
  ed_gauss_lobatto(4, x, weight);
  *m = *mx = 0.0;
  for (int piece = 0; piece < 3; piece++)
    for (int p = 0; p < 4; p++) {
      const double part = at[piece + 1] - at[piece], place = at[piece] + part * x[p];
      double N, M;
      load_forces(e, load, axis, factor, place, &N, &M);
      *m += part * weight[p] * M;
      *mx += part * weight[p] * M * place;
    }
}

/* Reactions of the load along one axis at both ends. */
static void add_reactions(const ed_element *e, const ed_member_load *load, int axis, double factor, double *reaction)
{
  const double L = e->length, w = factor * load->transverse[axis];
  if (load->position < 0.0) {
    reaction[0] -= 0.5 * w * L;
    reaction[1] -= 0.5 * w * L;
  } else if (is_partial(load)) {
    const double whole = 0.5 * (load->transverse[axis] + load->transverse_end[axis]) * (load->end - load->position);
    const double at_i = partial_moment(load, axis, 1.0);
    reaction[0] -= factor * L * at_i;
    reaction[1] -= factor * L * (whole - at_i);
  } else {
    reaction[0] -= w * (1.0 - load->position);
    reaction[1] -= w * load->position;
  }
}

/* Integrals over the length, in shares of it, of the moment of load_forces and of that times x. */
static void integrals(const ed_element *e, const ed_member_load *load, int axis, double factor, double *m, double *mx)
{
  const double L = e->length, w = factor * load->transverse[axis];
  if (load->position < 0.0) {
    *m = -w * L * L / 12.0;
    *mx = 0.5 * *m;
  } else if (is_partial(load)) {
    partial_integrals(e, load, axis, factor, m, mx);
  } else {
    const double a = load->position;
    *m = -w * L * a * (1.0 - a) / 2.0;
    *mx = -w * L * a * (1.0 - a) * (1.0 + a) / 6.0;
  }
}

/* Of an elastic beam in closed form: int b' f s_load over the length. */
static void add_free_deformation(ed_element *e, const ed_member_load *load, double factor)
{
  const double L = e->length, wx = factor * load->axial, *f = e->inverse[0];
  double n, nx; /* integrals of N and N x */
  if (load->position < 0.0) {
    n = 0.5 * wx * L;
    nx = wx * L / 6.0;
  } else {
    n = is_partial(load) ? 0.0 : wx * load->position;
    nx = 0.5 * wx * load->position * load->position;
  }
  double m[ED_MAX_RESULTANTS] = {n, 0.0, 0.0}, mx[ED_MAX_RESULTANTS] = {nx, 0.0, 0.0};
  for (int a = 0; a < e->axes; a++) {
    integrals(e, load, a, factor, &m[1 + a], &mx[1 + a]);
    if (a == 1) {
      m[2] = -m[2];
      mx[2] = -mx[2];
    }
  }
  double all[ED_MAX_RESULTANTS] = {0}, at_j[ED_MAX_RESULTANTS] = {0}, at_i[ED_MAX_RESULTANTS] = {0}, less[ED_MAX_RESULTANTS];
  for (int i = 0; i <= e->axes; i++)
    less[i] = mx[i] - m[i];
  ed_sym_times(1 + e->axes, f, m, all);
  ed_sym_times(1 + e->axes, f, less, at_i);
  ed_sym_times(1 + e->axes, f, mx, at_j);
  e->free_deformation[0] += L * all[0];
  for (int a = 0; a < e->axes; a++) {
    e->free_deformation[1 + 2 * a] += L * at_i[1 + a];
    e->free_deformation[2 + 2 * a] += L * at_j[1 + a];
  }
}

void ed_element_add_load(ed_element *e, const ed_member_load *load, double factor)
{
  const double L = e->length, wx = factor * load->axial;
  e->mean_axial += load->position < 0.0 ? 0.5 * wx * L : wx * load->position;
  if (load->position < 0.0)
    e->end_load[0] -= wx * L;
  else if (!is_partial(load))
    e->end_load[0] -= wx;
  for (int a = 0; a < e->axes; a++)
    add_reactions(e, load, a, factor, e->end_load + 1 + 2 * a);
  for (int p = 0; p < e->points; p++) {
    double N, M;
    load_forces(e, load, 0, factor, e->x[p], &N, &M);
    e->section_load[p][0] += N;
    e->section_load[p][1] += M;
    if (e->axes == ED_SPACE) {
      load_forces(e, load, 1, factor, e->x[p], &N, &M);
      e->section_load[p][2] -= M;
    }
  }
  if (e->kind == ED_ELASTIC_BEAM)
    add_free_deformation(e, load, factor);
}

void ed_element_finish_loads(ed_element *e)
{
  for (int p = 0; p < e->points; p++) {
    double free[ED_MAX_RESULTANTS] = {0};
    ed_sym_times(1 + e->axes, e->inverse[p], e->section_load[p], free);
    e->free_deformation[0] += e->weight[p] * free[0];
    for (int i = 1; i < ed_basic(e->axes); i++)
      e->free_deformation[i] += ed_share(e->x[p], (i + 1) % 2) * (e->weight[p] * free[(i + 1) / 2]);
  }
}
