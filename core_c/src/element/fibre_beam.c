/* State determination of the force-based beam-column (Spacone, Ciampi & Filippou 1996; Neuenhofer & Filippou 1997).
 *
 * Given the basic deformations v, find section deformations e_p and basic forces q with
 *     s_p(e_p) = b_p q + sl_p        (equilibrium in every section, sl: element load)
 *     sum_p w_p b_p' e_p = v         (compatibility)
 * Newton on both at once, with e_p condensed out. After the first step compatibility holds exactly, and the iteration is
 * then Newton on the convex potential of the sections under linear constraints, so a line search on its slope makes it
 * converge from anywhere for laws without softening.
 *
 * Written for members that bend in one plane and for those in space, with `axes` as a constant: the compiler makes one of each. In space
 * b = [1 0 0 0 0; 0 x-1 x 0 0; 0 0 0 x-1 x] for N, M_z, M_y.
 */
#include "element/element.h"

#include <math.h>
#include <string.h>

enum { MAX_ITERATIONS = 200, MAX_SEARCH = 40 };

/* A fully plastic section has no stiffness; for the direction of the next step (never for forces) it keeps this share of
 * the elastic one. */
static const double RESIDUAL_STIFFNESS = 1e-8;

/* s = b q + sl */
ED_INLINE void section_forces(const double *q, const double *load, double x, double *s, const int axes)
{
  s[0] = q[0] + load[0];
  for (int a = 0; a < axes; a++)
    s[1 + a] = ed_share(x, 0) * q[1 + 2 * a] + ed_share(x, 1) * q[2 + 2 * a] + load[1 + a];
}

ED_INLINE void section_flexibility(const ed_element *e, int p, const double *point, double *f, const int axes)
{
  if (point[ed_point_elastic(axes)] != 0.0) {
    memcpy(f, e->inverse[p], (size_t)ed_section_terms(axes) * sizeof *f);
    return;
  }
  double k[ED_MAX_SECTION_TERMS];
  for (int i = 0; i < ed_section_terms(axes); i++)
    k[i] = point[ed_point_k(axes) + i] + RESIDUAL_STIFFNESS * e->section[p]->k[i];
  if (axes == ED_SPACE) { /* not by cofactors: they lose the stiffness that is left where a single layer is elastic */
    if (!ed_sym_inverse(1 + axes, k, f))
      f[0] = NAN;
    return;
  }
  const double r = 1.0 / (k[0] * k[2] - k[1] * k[1]);
  f[0] = k[2] * r;
  f[1] = -k[1] * r;
  f[2] = k[0] * r;
}

ED_INLINE int invert_flexibility(const ed_element *e, const double *F, double *K, const int axes)
{
  const int rows = ed_basic(axes);
  double reduced[ED_MAX_BASIC_TERMS];
  memcpy(reduced, F, (size_t)ed_basic_terms(axes) * sizeof *reduced);
  for (int i = 1; i < rows; i++)
    if (e->release[i - 1])
      ed_sym_release(rows, reduced, i, F[rows]);
  if (!(axes == ED_PLANE ? ed_sym3_inverse(reduced, K) > 0.0 : ed_sym_inverse(rows, reduced, K)))
    return 0;
  for (int i = 1; i < rows; i++)
    if (e->release[i - 1])
      ed_sym_release(rows, K, i, 0.0);
  return 1;
}

/* Largest strain of a layer, or more. */
ED_INLINE double strain_bound(const ed_section *section, const double *deformation, const int axes)
{
  const double bound = fabs(deformation[0]) + section->depth * fabs(deformation[1]);
  return axes == ED_PLANE ? bound : bound + section->width * fabs(deformation[2]);
}

/* A point in a section that does not yield. */
ED_INLINE void set_elastic(const ed_section *section, double *point, const int axes)
{
  memcpy(point + ed_point_k(axes), section->k, (size_t)ed_section_terms(axes) * sizeof *point);
  point[ed_point_elastic(axes)] = 1.0;
  point[ed_point_reach(axes)] = 0.0;
}

/* Moves a section by `change`; the return is 1 where its forces follow the tangent that far, so that its layers need not be asked. */
ED_INLINE int respond(const ed_element *e, int p, const double *layers, double *point, const double *change, int fast, const int axes)
{
  const ed_section *section = e->section[p];
  double *s = point + ed_point_s(axes), *k = point + ed_point_k(axes), *reach = point + ed_point_reach(axes);
  for (int i = 0; i <= axes; i++)
    point[i] += change[i];
  const double strain = strain_bound(section, change, axes);
  if (fast && strain <= *reach) {
    double forces[ED_MAX_RESULTANTS];
    ed_sym_times(1 + axes, k, change, forces);
    for (int i = 0; i <= axes; i++)
      s[i] += forces[i];
    *reach -= strain;
    return 1;
  }
  /* a section that never yielded and provably does not yield now needs no layers */
  if (fast && point[ed_point_inelastic(axes)] == 0.0 && strain_bound(section, point, axes) < section->yield_strain) {
    ed_sym_times(1 + axes, section->k, point, s);
    set_elastic(section, point, axes);
    return 0;
  }
  ed_section_response r;
  ed_section_trial(section, layers + e->layer_offset[p], point, e->record[p], &r);
  memcpy(s, r.force, (size_t)(1 + axes) * sizeof *s);
  memcpy(k, r.k, (size_t)ed_section_terms(axes) * sizeof *k);
  point[ed_point_elastic(axes)] = r.elastic;
  *reach = r.reach;
  return 0;
}

/* Slope of the potential of the sections along a step that keeps compatibility; q drops out but for rounding. */
ED_INLINE double slope_at(const ed_element *e, const double *points, const double *q, double (*step)[ED_MAX_RESULTANTS], const int axes)
{
  double slope = 0.0;
  for (int p = 0; p < e->points; p++) {
    const double *point = points + p * ed_point_size(axes);
    double s[ED_MAX_RESULTANTS], work = 0.0;
    section_forces(q, e->section_load[p], e->x[p], s, axes);
    for (int i = 0; i <= axes; i++) {
      const double left = (s[i] - point[ed_point_s(axes) + i]) * step[p][i];
      work = i ? work + left : left;
    }
    slope -= e->weight[p] * work;
  }
  return slope;
}

/* A member that never yielded and does not yield now is linear: closed form. Returns 0 when it does not apply. */
ED_INLINE int elastic_shortcut(const ed_element *e, const double *v, double *block, const int axes)
{
  const int rows = ed_basic(axes);
  double relative[ED_MAX_BASIC], q[ED_MAX_BASIC];
  for (int i = 0; i < rows; i++)
    relative[i] = v[i] - e->free_deformation[i];
  ed_sym_times(rows, e->stiffness, relative, q);
  double deformation[ED_MAX_POINTS][ED_MAX_RESULTANTS], force[ED_MAX_POINTS][ED_MAX_RESULTANTS];
  for (int p = 0; p < e->points; p++) {
    section_forces(q, e->section_load[p], e->x[p], force[p], axes);
    ed_sym_times(1 + axes, e->inverse[p], force[p], deformation[p]);
    if (!(strain_bound(e->section[p], deformation[p], axes) < e->section[p]->yield_strain))
      return 0;
  }
  memcpy(block + ED_BLOCK_V, v, (size_t)rows * sizeof *v);
  memcpy(block + ed_block_q(axes), q, (size_t)rows * sizeof *q);
  memcpy(block + ed_block_k(axes), e->stiffness, (size_t)ed_basic_terms(axes) * sizeof(double));
  for (int p = 0; p < e->points; p++) {
    double *point = block + ed_point_at(axes, p);
    memcpy(point, deformation[p], (size_t)(1 + axes) * sizeof *point);
    memcpy(point + ed_point_s(axes), force[p], (size_t)(1 + axes) * sizeof *point);
    set_elastic(e->section[p], point, axes);
  }
  return 1;
}

/* sum over i, j of f_ij a_i a_j */
ED_INLINE double form(const double *f, const double *a, const int axes)
{
  double sum = 0.0;
  for (int i = 0; i <= axes; i++)
    for (int j = i; j <= axes; j++) {
      const double part = i == j ? f[ed_sym_place(1 + axes, i, j)] : 2.0 * f[ed_sym_place(1 + axes, i, j)];
      sum = i + j ? sum + part * a[i] * a[j] : part * a[i] * a[j];
    }
  return sum;
}

ED_INLINE int update(const ed_element *e, const double *v, const double *layers, double *block, ed_element_control *control,
                     const int axes)
{
  const int rows = ed_basic(axes), size = ed_point_size(axes);
  control->updates++;
  if (control->fast_elastic && block[ed_block_inelastic(axes)] == 0.0 && elastic_shortcut(e, v, block, axes)) {
    control->elastic++;
    return ED_OK;
  }
  double *q = block + ed_block_q(axes), *K = block + ed_block_k(axes), *points = block + ed_block_points(axes);
  double *reference = block + ed_block_reference(axes);
  double f[ED_MAX_POINTS][ED_MAX_SECTION_TERMS], unbalance[ED_MAX_POINTS][ED_MAX_RESULTANTS], step[ED_MAX_POINTS][ED_MAX_RESULTANTS];
  memcpy(block + ED_BLOCK_V, v, (size_t)rows * sizeof *v);
  int linear = 1; /* K is that of the sections as they are */

  for (int iteration = 0;; iteration++) {
    double F[ED_MAX_BASIC_TERMS] = {0};
    double gap[ED_MAX_BASIC];     /* of compatibility at present: rounding, after the first iteration */
    double missing[ED_MAX_BASIC]; /* after the sections have followed their unbalance */
    double correction[ED_MAX_BASIC] = {0};
    double energy = 0.0, level = 0.0;
    int elastic = 1;
    for (int i = 0; i < rows; i++)
      gap[i] = v[i];
    for (int p = 0; p < e->points; p++)
      elastic &= points[p * size + ed_point_elastic(axes)] != 0.0;
    for (int p = 0; p < e->points; p++) {
      double *point = points + p * size;
      const double x = e->x[p], w = e->weight[p];
      double s[ED_MAX_RESULTANTS], change[ED_MAX_RESULTANTS];
      section_forces(q, e->section_load[p], x, s, axes);
      section_flexibility(e, p, point, f[p], axes);
      for (int i = 0; i <= axes; i++)
        unbalance[p][i] = s[i] - point[ed_point_s(axes) + i];
      ed_sym_times(1 + axes, f[p], unbalance[p], change);
      gap[0] -= w * point[0];
      correction[0] += w * change[0];
      for (int i = 1; i < rows; i++) {
        const int moment = (i + 1) / 2, end = (i + 1) % 2;
        gap[i] -= ed_share(x, end) * w * point[moment];
        correction[i] += ed_share(x, end) * w * change[moment];
      }
      if (!linear && !elastic)
        ed_add_flexibility(F, f[p], x, w, axes);
      /* measured with the elastic flexibility: the softened one would magnify rounding */
      energy += w * form(e->inverse[p], unbalance[p], axes);
      level += w * form(e->inverse[p], s, axes);
    }
    double gap_force[ED_MAX_BASIC];
    ed_sym_times(rows, e->stiffness, gap, gap_force);
    for (int i = 0; i < rows; i++) {
      missing[i] = gap[i] - correction[i];
      energy += gap[i] * gap_force[i];
    }
    if (!isfinite(energy))
      return ED_E_NOT_FINITE;
    if (level < *reference)
      level = *reference;
    if (!linear) {
      if (elastic)
        memcpy(K, e->stiffness, (size_t)ed_basic_terms(axes) * sizeof *K);
      else if (!invert_flexibility(e, F, K, axes))
        return ED_E_ELEMENT;
    }
    if (iteration > 0 && energy <= control->tolerance * level) {
      *reference = level;
      return ED_OK;
    }
    if (iteration == MAX_ITERATIONS)
      return ED_E_ELEMENT;
    control->iterations++;

    double dq[ED_MAX_BASIC], slope = 0.0;
    linear = 1;
    ed_sym_times(rows, K, missing, dq);
    for (int i = 0; i < rows; i++)
      q[i] += dq[i];
    for (int p = 0; p < e->points; p++) {
      double *point = points + p * size, left[ED_MAX_RESULTANTS], work = 0.0;
      const double x = e->x[p];
      left[0] = unbalance[p][0] + dq[0];
      for (int a = 0; a < axes; a++)
        left[1 + a] = unbalance[p][1 + a] + ed_share(x, 0) * dq[1 + 2 * a] + ed_share(x, 1) * dq[2 + 2 * a];
      ed_sym_times(1 + axes, f[p], left, step[p]);
      for (int i = 0; i <= axes; i++)
        work = i ? work + unbalance[p][i] * step[p][i] : unbalance[p][i] * step[p][i];
      slope -= e->weight[p] * work;
      linear &= respond(e, p, layers, point, step[p], control->fast_elastic, axes);
    }
    if (iteration == 0)
      continue;
    /* slope of the potential along the step: negative at its start, rising; near zero where to stop */
    double taken = 1.0, low = 0.0, at_low = slope, high = 1.0, at_high = 0.0;
    for (int search = 0; search < MAX_SEARCH && slope < 0.0; search++) {
      const double end = slope_at(e, points, q, step, axes);
      if (fabs(end) <= 0.5 * -slope || (taken == 1.0 && end <= 0.0))
        break;
      if (end > 0.0) {
        high = taken;
        at_high = end;
      } else {
        low = taken;
        at_low = end;
      }
      const double width = high - low, secant = low + width * at_low / (at_low - at_high);
      const double next = fmin(fmax(secant, low + 0.1 * width), high - 0.1 * width);
      for (int p = 0; p < e->points; p++) {
        double change[ED_MAX_RESULTANTS];
        for (int i = 0; i <= axes; i++)
          change[i] = (next - taken) * step[p][i];
        linear &= respond(e, p, layers, points + p * size, change, control->fast_elastic, axes);
      }
      taken = next;
    }
  }
}

int ed_fibre_beam_update(const ed_element *e, const double *v, const double *layers, double *block,
                         ed_element_control *control)
{
  return e->axes == ED_PLANE ? update(e, v, layers, block, control, ED_PLANE) : update(e, v, layers, block, control, ED_SPACE);
}
