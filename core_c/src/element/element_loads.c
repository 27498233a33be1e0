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
static double partial_moment(const ed_member_load *load, double x)
{
  const double part = load->end - load->position, t = x - load->position;
  if (t <= 0.0)
    return 0.0;
  const double slope = (load->transverse_end - load->transverse) / part;
  if (t <= part)
    return 0.5 * load->transverse * t * t + slope * t * t * t / 6.0;
  const double at_end = 0.5 * load->transverse * part * part + slope * part * part * part / 6.0;
  return at_end + 0.5 * (load->transverse + load->transverse_end) * part * (t - part);
}

/* Internal forces at x (0..1) of the simply supported basic system, axially fixed at i. */
static void load_forces(const ed_element *e, const ed_member_load *load, double factor, double x, double *N, double *M)
{
  const double L = e->length, wx = factor * load->axial, wy = factor * load->transverse;
  if (load->position < 0.0) {
    *N = wx * L * (1.0 - x);
    *M = 0.5 * wy * L * L * x * (x - 1.0);
  } else if (is_partial(load)) {
    *N = 0.0;
    *M = -factor * L * L * (partial_moment(load, 1.0) * x - partial_moment(load, x));
  } else {
    const double a = load->position;
    *N = x < a ? wx : 0.0;
    *M = -wy * L * (x < a ? (1.0 - a) * x : a * (1.0 - x));
  }
}

/* Integrals over the length of the moment of a partial load, and of that times x: of polynomials up to the fourth degree. */
static void partial_integrals(const ed_element *e, const ed_member_load *load, double factor, double *m, double *mx)
{
  const double at[4] = {0.0, load->position, load->end, 1.0};
  double x[4], weight[4];
  ed_gauss_lobatto(4, x, weight);
  *m = *mx = 0.0;
  for (int piece = 0; piece < 3; piece++)
    for (int p = 0; p < 4; p++) {
      const double part = at[piece + 1] - at[piece], place = at[piece] + part * x[p];
      double N, M;
      load_forces(e, load, factor, place, &N, &M);
      *m += part * weight[p] * M;
      *mx += part * weight[p] * M * place;
    }
}

void ed_element_add_load(ed_element *e, const ed_member_load *load, double factor)
{
  const double L = e->length, wx = factor * load->axial, wy = factor * load->transverse;
  const int partial = is_partial(load);
  e->mean_axial += load->position < 0.0 ? 0.5 * wx * L : wx * load->position;
  if (load->position < 0.0) {
    e->end_load[0] -= wx * L;
    e->end_load[1] -= 0.5 * wy * L;
    e->end_load[2] -= 0.5 * wy * L;
  } else if (partial) {
    const double whole = 0.5 * (load->transverse + load->transverse_end) * (load->end - load->position);
    const double at_i = partial_moment(load, 1.0);
    e->end_load[1] -= factor * L * at_i;
    e->end_load[2] -= factor * L * (whole - at_i);
  } else {
    e->end_load[0] -= wx;
    e->end_load[1] -= wy * (1.0 - load->position);
    e->end_load[2] -= wy * load->position;
  }
  for (int p = 0; p < e->points; p++) {
    double N, M;
    load_forces(e, load, factor, e->x[p], &N, &M);
    e->section_load[p][0] += N;
    e->section_load[p][1] += M;
  }
  if (e->kind != ED_ELASTIC_BEAM)
    return;
  /* closed form: int b' f s_load over the length */
  const double *f = e->inverse[0];
  double n, m, mx; /* integrals of N, M and M x */
  if (load->position < 0.0) {
    n = 0.5 * wx * L;
    m = -wy * L * L / 12.0;
    mx = 0.5 * m;
  } else if (partial) {
    n = 0.0;
    partial_integrals(e, load, factor, &m, &mx);
  } else {
    const double a = load->position;
    n = wx * a;
    m = -wy * L * a * (1.0 - a) / 2.0;
    mx = -wy * L * a * (1.0 - a) * (1.0 + a) / 6.0;
  }
  double nx; /* integral of N x */
  nx = load->position < 0.0 ? wx * L / 6.0 : 0.5 * wx * load->position * load->position;
  e->free_deformation[0] += L * (f[0] * n + f[1] * m);
  e->free_deformation[1] += L * (f[1] * (nx - n) + f[2] * (mx - m));
  e->free_deformation[2] += L * (f[1] * nx + f[2] * mx);
}

void ed_element_finish_loads(ed_element *e)
{
  for (int p = 0; p < e->points; p++) {
    const double *f = e->inverse[p], *s = e->section_load[p];
    const double e0 = e->weight[p] * (f[0] * s[0] + f[1] * s[1]);
    const double kappa = e->weight[p] * (f[1] * s[0] + f[2] * s[1]);
    e->free_deformation[0] += e0;
    e->free_deformation[1] += (e->x[p] - 1.0) * kappa;
    e->free_deformation[2] += e->x[p] * kappa;
  }
}
