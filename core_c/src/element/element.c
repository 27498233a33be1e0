#include "element/element.h"

#include "base/finite.h"
#include "base/symmetric.h"
#include "element/strut.h"

#include <math.h>
#include <string.h>

/* Condensed stiffness of a basic flexibility with moment releases. */
static void stiffness_of(const double *flexibility, const int *release, double *stiffness)
{
  double reduced[6];
  memcpy(reduced, flexibility, sizeof reduced);
  for (int end = 0; end < 2; end++)
    if (release[end])
      ed_sym3_release(reduced, end + 1, flexibility[3]);
  ed_sym3_inverse(reduced, stiffness);
  for (int end = 0; end < 2; end++)
    if (release[end])
      ed_sym3_release(stiffness, end + 1, 0.0);
}

static void setup_link(ed_element *e, const ed_member *m, double dx, double dy)
{
  double c = cos(m->angle), s = sin(m->angle);
  if (e->length > 0.0) {
    c = dx / e->length;
    s = dy / e->length;
  }
  e->c = c;
  e->s = s;
  /* shear acts at mid-length, so that end moments balance it */
  const double h = 0.5 * e->length;
  const double B[3][6] = {{-c, -s, 0, c, s, 0}, {s, -c, -h, -s, c, -h}, {0, 0, -1, 0, 0, 1}};
  for (int i = 0; i < 6; i++)
    for (int j = 0; j < 6; j++)
      for (int k = 0; k < 3; k++)
        e->link[6 * i + j] += m->stiffness[k] * B[k][i] * B[k][j];
}

/* A place of the whole length on the part that bends, 0..1; what is in a rigid end counts where it ends. */
static double place_of(const ed_element *e, double position)
{
  if (!e->rigid)
    return position;
  const double whole = e->length + e->arm[0] - e->arm[1];
  return fmin(fmax((position * whole - e->arm[0]) / e->length, 0.0), 1.0);
}

/* The rule over the whole length, or over each piece of it between breaks, whose common points have the weight of both. */
static void place_points(ed_element *e, const ed_member *m)
{
  ed_gauss_lobatto(m->points, e->x, e->weight);
  e->points = m->points;
  if (m->breaks == 0)
    return;
  double x[ED_MAX_RULE], weight[ED_MAX_RULE];
  memcpy(x, e->x, (size_t)m->points * sizeof *x);
  memcpy(weight, e->weight, (size_t)m->points * sizeof *weight);
  memset(e->weight, 0, sizeof e->weight);
  e->points = (m->breaks + 1) * (m->points - 1) + 1;
  for (int piece = 0; piece <= m->breaks; piece++) {
    const double start = piece ? place_of(e, m->break_at[piece - 1]) : 0.0;
    const double end = piece < m->breaks ? place_of(e, m->break_at[piece]) : 1.0;
    for (int p = 0; p < m->points; p++) {
      const int at = piece * (m->points - 1) + p;
      e->x[at] = p == 0 ? start : p == m->points - 1 ? end : start + (end - start) * x[p];
      e->weight[at] += (end - start) * weight[p];
    }
  }
}

int ed_element_setup(ed_element *e, const ed_model *model, int index)
{
  const ed_member *m = &model->members[index];
  memset(e, 0, sizeof *e);
  e->member = m;
  e->kind = m->kind;
  e->geometry = m->geometry;
  for (int end = 0; end < 2; end++) {
    e->release[end] = m->release[end];
    for (int d = 0; d < 3; d++)
      e->dof[3 * end + d] = 3 * m->node[end] + d;
  }
  const ed_node *i = &model->nodes[m->node[0]], *j = &model->nodes[m->node[1]];
  const double dx = j->x - i->x, dy = j->y - i->y;
  e->length = hypot(dx, dy);
  if (m->kind == ED_LINK) {
    setup_link(e, m, dx, dy);
    return isfinite(e->length) && ed_all_finite(36, e->link);
  }
  if (m->kind == ED_SPRING) {
    e->spring = &model->springs[m->spring];
    e->length = 0.0; /* none to make moments comparable by */
    e->c = 1.0;
    e->stiffness[0] = e->spring->stiffness;
    e->flexibility[0] = 1.0 / e->stiffness[0];
    return isfinite(e->stiffness[0]);
  }
  e->c = dx / e->length;
  e->s = dy / e->length;
  e->rigid = m->rigid[0] > 0.0 || m->rigid[1] > 0.0;
  if (e->rigid) {
    e->arm[0] = m->rigid[0];
    e->arm[1] = -m->rigid[1];
    e->length -= m->rigid[0] + m->rigid[1];
  }
  if (m->kind == ED_TRUSS) {
    e->steel = &model->materials[m->material];
    e->area = m->area;
    e->flexibility[0] = e->length / (e->steel->E * m->area);
    e->stiffness[0] = 1.0 / e->flexibility[0];
    return isfinite(e->length + e->stiffness[0]);
  }
  if (m->kind == ED_STRUT) {
    e->strut = isfinite(e->length) ? ed_strut_new(model, m, e->length) : NULL;
    return e->strut && ed_strut_finite(e->strut);
  }
  if (m->kind == ED_ELASTIC_BEAM) {
    const ed_section *section = &model->sections[m->section[0]];
    const double determinant = section->k11 * section->k22 - section->k12 * section->k12;
    const double f11 = section->k22 / determinant, f12 = -section->k12 / determinant, f22 = section->k11 / determinant;
    const double L = e->length;
    e->section[0] = section;
    e->inverse[0][0] = f11;
    e->inverse[0][1] = f12;
    e->inverse[0][2] = f22;
    const double F[6] = {f11 * L, -f12 * L / 2.0, f12 * L / 2.0, f22 * L / 3.0, -f22 * L / 6.0, f22 * L / 3.0};
    memcpy(e->flexibility, F, sizeof F);
    e->flexibility[3] -= m->without[0];
    e->flexibility[5] -= m->without[1];
  } else {
    place_points(e, m);
    int offset = 0;
    for (int p = 0; p < e->points; p++) {
      const ed_section *section = &model->sections[m->section[m->breaks ? 0 : p]];
      const double x = e->x[p], w = e->weight[p] * e->length;
      const double determinant = section->k11 * section->k22 - section->k12 * section->k12;
      e->section[p] = section;
      e->weight[p] = w;
      e->inverse[p][0] = section->k22 / determinant;
      e->inverse[p][1] = -section->k12 / determinant;
      e->inverse[p][2] = section->k11 / determinant;
      e->layer_offset[p] = offset;
      offset += section->state_size;
      e->flexibility[0] += w * e->inverse[p][0];
      e->flexibility[1] += w * e->inverse[p][1] * (x - 1.0);
      e->flexibility[2] += w * e->inverse[p][1] * x;
      e->flexibility[3] += w * e->inverse[p][2] * (x - 1.0) * (x - 1.0);
      e->flexibility[4] += w * e->inverse[p][2] * (x - 1.0) * x;
      e->flexibility[5] += w * e->inverse[p][2] * x * x;
    }
  }
  stiffness_of(e->flexibility, e->release, e->stiffness);
  return isfinite(e->length) && ed_all_finite(6, e->stiffness);
}

void ed_element_clear(ed_element *e)
{
  ed_strut_free(e->strut);
  e->strut = NULL;
}

int ed_element_block_size(const ed_element *e)
{
  if (e->kind == ED_STRUT)
    return ed_strut_block_size(e->strut);
  const int rigid = e->rigid ? ED_RIGID_SIZE : 0;
  return (e->kind == ED_FIBRE_BEAM ? ED_BLOCK_POINTS + e->points * ED_POINT_SIZE : ED_BLOCK_POINTS) + rigid;
}

int ed_element_record_size(const ed_element *e)
{
  if (e->kind == ED_STRUT)
    return ed_strut_record_size(e->strut);
  int size = 0;
  for (int p = 0; p < e->points; p++)
    size += e->section[p]->record_size;
  return size;
}

void ed_element_place_records(ed_element *e, double *records)
{
  if (e->kind == ED_STRUT)
    ed_strut_place_records(e->strut, records);
  for (int p = 0; p < e->points; p++) {
    e->record[p] = e->section[p]->record_size ? records : NULL;
    records += e->section[p]->record_size;
  }
}

int ed_element_layer_size(const ed_element *e)
{
  if (e->kind == ED_STRUT)
    return ed_strut_layer_size(e->strut);
  if (e->kind == ED_TRUSS)
    return ed_steel_state_size(e->steel);
  if (e->kind == ED_SPRING)
    return ed_spring_state_size(e->spring);
  int size = 0;
  for (int p = 0; p < e->points; p++)
    size += e->section[p]->state_size;
  return size;
}

void ed_element_initialise(const ed_element *e, double *block, double *layers)
{
  if (e->kind == ED_STRUT) {
    ed_strut_initialise(e->strut, block, layers);
    return;
  }
  memset(block, 0, (size_t)ed_element_block_size(e) * sizeof *block);
  if (e->kind == ED_TRUSS)
    ed_steel_initialise(e->steel, layers);
  if (e->kind == ED_SPRING)
    ed_spring_initialise(e->spring, layers);
  for (int p = 0; p < e->points; p++)
    ed_section_initialise(e->section[p], layers + e->layer_offset[p]);
  memcpy(block + ED_BLOCK_K, e->stiffness, sizeof e->stiffness);
  for (int p = 0; p < e->points; p++) {
    double *point = block + ED_BLOCK_POINTS + p * ED_POINT_SIZE;
    point[ED_POINT_K] = e->section[p]->k11;
    point[ED_POINT_K + 1] = e->section[p]->k12;
    point[ED_POINT_K + 2] = e->section[p]->k22;
    point[ED_POINT_ELASTIC] = 1.0;
  }
}

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

int ed_element_update(const ed_element *e, const double *displacement, const double *layers, double *block,
                      ed_element_control *control)
{
  if (e->kind == ED_LINK)
    return ED_OK;
  if (e->kind == ED_SPRING) {
    double u = 0.0;
    for (int i = 0; i < 6; i++)
      u += e->member->coefficient[i] * displacement[i];
    control->updates++;
    block[ED_BLOCK_V] = u;
    control->elastic += ed_spring_trial(e->spring, layers, u, &block[ED_BLOCK_Q], &block[ED_BLOCK_K]);
    return ED_OK;
  }
  ed_kinematics k;
  ed_kinematics_of(e, displacement, &k);
  if (e->kind == ED_FIBRE_BEAM)
    return ed_fibre_beam_update(e, k.v, layers, block, control);
  if (e->kind == ED_STRUT)
    return ed_strut_update(e->strut, k.v[0], layers, block, control);
  control->updates++;
  memcpy(block + ED_BLOCK_V, k.v, sizeof k.v);
  double *q = block + ED_BLOCK_Q;
  if (e->kind == ED_ELASTIC_BEAM) {
    double relative[3];
    for (int i = 0; i < 3; i++)
      relative[i] = k.v[i] - e->free_deformation[i];
    ed_sym3_times(e->stiffness, relative, q);
    return ED_OK;
  }
  double stress, tangent;
  ed_steel_trial(e->steel, layers, k.v[0] / e->length, &stress, &tangent);
  q[0] = stress * e->area;
  block[ED_BLOCK_K] = tangent * e->area / e->length;
  return ED_OK;
}

int ed_element_layers_valid(const ed_element *e, const double *layers)
{
  if (e->kind == ED_TRUSS)
    return ed_steel_state_valid(e->steel, layers);
  if (e->kind == ED_STRUT)
    return ed_strut_layers_valid(e->strut, layers);
  if (e->kind == ED_SPRING)
    return ed_spring_state_valid(e->spring, layers);
  for (int p = 0; p < e->points; p++)
    if (!ed_section_state_valid(e->section[p], layers + e->layer_offset[p]))
      return 0;
  return 1;
}

double ed_element_commit(const ed_element *e, double *block, double *layers)
{
  if (e->kind == ED_TRUSS)
    return e->area * e->length * ed_steel_commit(e->steel, layers, block[ED_BLOCK_V] / e->length);
  if (e->kind == ED_STRUT)
    return ed_strut_commit(e->strut, block, layers);
  double dissipated = 0.0;
  if (e->kind == ED_SPRING) {
    dissipated = ed_spring_commit(e->spring, layers, block[ED_BLOCK_V]);
    if (dissipated != 0.0)
      block[ED_BLOCK_INELASTIC] = 1.0;
  }
  for (int p = 0; p < e->points; p++) {
    double *point = block + ED_BLOCK_POINTS + p * ED_POINT_SIZE;
    if (point[ED_POINT_ELASTIC] != 0.0 && !e->section[p]->curved && !e->section[p]->fatigue)
      continue; /* no layer yields: nothing to remember */
    const double *record = point[ED_POINT_REACH] > 0.0 ? e->record[p] : NULL; /* 0: no trial since the last commit */
    block[ED_BLOCK_INELASTIC] = point[ED_POINT_INELASTIC] = 1.0;
    point[ED_POINT_REACH] = 0.0;
    dissipated += e->weight[p] * ed_section_commit(e->section[p], layers + e->layer_offset[p], point[0], point[1], record);
  }
  return dissipated;
}

double ed_element_stored(const ed_element *e, const double *block, const double *layers)
{
  const double *q = block + ED_BLOCK_Q, *v = block + ED_BLOCK_V;
  if (e->kind == ED_TRUSS)
    return 0.5 * q[0] * q[0] * e->flexibility[0];
  if (e->kind == ED_STRUT)
    return ed_strut_stored(e->strut, block, layers);
  if (e->kind == ED_SPRING)
    return ed_spring_stored(e->spring, layers, v[0]);
  if (e->kind == ED_FIBRE_BEAM) {
    double energy = 0.0;
    for (int p = 0; p < e->points; p++) {
      const double *point = block + ED_BLOCK_POINTS + p * ED_POINT_SIZE;
      double density;
      if (point[ED_POINT_INELASTIC] == 0.0 && e->section[p]->yield_strain > 0.0)
        density = 0.5 * (point[0] * point[ED_POINT_S] + point[1] * point[ED_POINT_S + 1]);
      else
        density = ed_section_stored(e->section[p], layers + e->layer_offset[p], point[0], point[1]);
      energy += e->weight[p] * density;
    }
    return energy;
  }
  /* elastic beam: deformation energy of q, of the loads and of both together, up to the constant of the loads alone */
  double energy = 0.0;
  for (int i = 0; i < 3; i++)
    energy += 0.5 * q[i] * (v[i] + e->free_deformation[i]);
  return energy;
}

double ed_element_plastic_rotation(const ed_element *e, const double *block, int end)
{
  if (e->kind == ED_SPRING)
    return block[ED_BLOCK_V] - e->flexibility[0] * block[ED_BLOCK_Q];
  if (e->kind != ED_FIBRE_BEAM || e->release[end])
    return 0.0; /* a hinge turns freely */
  double elastic[3];
  ed_sym3_times(e->flexibility, block + ED_BLOCK_Q, elastic);
  return block[ED_BLOCK_V + 1 + end] - elastic[1 + end] - e->free_deformation[1 + end];
}
