/* Elements of the members of a model: geometry, points of integration, elastic stiffness. */
#include "element/element.h"

#include "base/finite.h"
#include "base/symmetric.h"
#include "element/strut.h"

#include <math.h>
#include <string.h>

/* Condensed stiffness of the basic flexibility with moment releases. */
static void find_stiffness(ed_element *e)
{
  const int rows = ed_basic(e->axes);
  double reduced[ED_MAX_BASIC_TERMS];
  memcpy(reduced, e->flexibility, sizeof reduced);
  for (int i = 1; i < rows; i++)
    if (e->release[i - 1])
      ed_sym_release(rows, reduced, i, e->flexibility[rows]);
  if (e->axes == ED_PLANE)
    ed_sym3_inverse(reduced, e->stiffness);
  else if (!ed_sym_inverse(rows, reduced, e->stiffness))
    e->stiffness[0] = NAN; /* of numbers that are none */
  for (int i = 1; i < rows; i++)
    if (e->release[i - 1])
      ed_sym_release(rows, e->stiffness, i, 0.0);
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

static void setup_spring(ed_element *e, const ed_spring *spring)
{
  e->spring = spring;
  e->length = 0.0; /* none to make moments comparable by */
  e->c = 1.0;
  e->stiffness[0] = spring->stiffness;
  e->flexibility[0] = 1.0 / e->stiffness[0];
}

static void setup_truss(ed_element *e, const ed_steel *steel, double area)
{
  e->steel = steel;
  e->area = area;
  e->flexibility[0] = e->length / (steel->E * area);
  e->stiffness[0] = 1.0 / e->flexibility[0];
}

/* Flexibility of a section before any strain. */
static void section_flexibility(const ed_section *section, double *inverse)
{
  const double *k = section->k;
  if (section->axes == ED_SPACE) {
    ed_sym3_inverse(k, inverse);
    return;
  }
  const double determinant = k[0] * k[2] - k[1] * k[1];
  inverse[0] = k[2] / determinant;
  inverse[1] = -k[1] / determinant;
  inverse[2] = k[0] / determinant;
}

/* In closed form; `without`: flexibilities that its ends leave out. */
static void setup_elastic_beam(ed_element *e, const ed_section *section, const double without[4])
{
  double *f = e->inverse[0];
  const double L = e->length;
  e->section[0] = section;
  section_flexibility(section, f);
  if (e->axes == ED_PLANE) {
    const double F[6] = {f[0] * L, -f[1] * L / 2.0, f[1] * L / 2.0, f[2] * L / 3.0, -f[2] * L / 6.0, f[2] * L / 3.0};
    memcpy(e->flexibility, F, sizeof F);
  } else { /* three points are exact for products of linear moments */
    double x[3], weight[3];
    ed_gauss_lobatto(3, x, weight);
    for (int p = 0; p < 3; p++)
      ed_add_flexibility(e->flexibility, f, x[p], weight[p] * L, ED_SPACE);
  }
  const int rows = ed_basic(e->axes);
  for (int i = 1; i < rows; i++)
    e->flexibility[ed_sym_place(rows, i, i)] -= without[i - 1];
}

static void setup_fibre_beam(ed_element *e, const ed_model *model, const ed_member *m)
{
  place_points(e, m);
  int offset = 0;
  for (int p = 0; p < e->points; p++) {
    const ed_section *section = &model->sections[m->section[m->breaks ? 0 : p]];
    const double x = e->x[p], w = e->weight[p] * e->length, *f = e->inverse[p];
    e->section[p] = section;
    e->weight[p] = w;
    section_flexibility(section, e->inverse[p]);
    e->layer_offset[p] = offset;
    offset += section->state_size;
    ed_add_flexibility(e->flexibility, f, x, w, e->axes);
  }
}

/* A direction across an axis: from the global axis that is furthest from it. */
static void find_across(const double *axis, double *across)
{
  int least = 0;
  for (int i = 1; i < 3; i++)
    if (fabs(axis[i]) < fabs(axis[least]))
      least = i;
  const double along = axis[least], size = sqrt(1.0 - along * along);
  for (int i = 0; i < 3; i++)
    across[i] = ((i == least) - along * axis[i]) / size;
}

/* Offsets of the ends of what bends, which may stand askew to the line between the nodes: the web turns with it as little as it can. */
static void place_offsets(ed_element *e, const ed_member *m)
{
  double *web = e->axis[2], along[2] = {0.0, 0.0}, tilt = 0.0, size = 0.0;
  for (int i = 0; i < 3; i++)
    for (int end = 0; end < 2; end++) {
      e->rigid |= m->offset[end][i] != 0.0;
      along[end] += m->offset[end][i] * e->axis[0][i];
    }
  if (!e->rigid)
    return;
  memcpy(e->offset, m->offset, sizeof e->offset);
  e->arm[0] = fmax(along[0], 0.0);
  e->arm[1] = fmin(along[1], 0.0);
  for (int i = 0; i < 3; i++)
    tilt += web[i] * e->axis[0][i];
  for (int i = 0; i < 3; i++) {
    web[i] -= tilt * e->axis[0][i];
    size += web[i] * web[i];
  }
  for (int i = 0; i < 3; i++)
    web[i] /= sqrt(size);
}

/* Axis and length of what bends between two nodes; the web of a beam in space gives local z. */
static void place_axis(ed_element *e, const ed_member *m, const double *between)
{
  e->c = between[0] / e->length;
  e->s = between[1] / e->length;
  for (int i = 0; i < 3; i++)
    e->axis[0][i] = between[i] / e->length;
  memcpy(e->axis[2], m->web, sizeof m->web);
  if (e->axes == ED_SPACE)
    place_offsets(e, m);
  if (e->degrees == ED_MAX_DEGREES && e->axes == ED_PLANE) /* a bar in space is the same in all directions across it: any serves */
    find_across(e->axis[0], e->axis[2]);
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    e->axis[1][i] = e->axis[2][j] * e->axis[0][k] - e->axis[2][k] * e->axis[0][j];
  }
  if (m->rigid[0] > 0.0 || m->rigid[1] > 0.0) {
    e->rigid = 1;
    e->arm[0] = m->rigid[0];
    e->arm[1] = -m->rigid[1];
    e->length -= m->rigid[0] + m->rigid[1];
  }
}

int ed_element_setup(ed_element *e, const ed_model *model, int index)
{
  const ed_member *m = &model->members[index];
  const int degrees = ed_degrees(model);
  memset(e, 0, sizeof *e);
  e->member = m;
  e->kind = m->kind;
  e->geometry = m->geometry;
  e->axes = model->dimension == 3 && (m->kind == ED_FIBRE_BEAM || m->kind == ED_ELASTIC_BEAM) ? ED_SPACE : ED_PLANE;
  e->degrees = 2 * degrees;
  memcpy(e->release, m->release, sizeof e->release);
  for (int end = 0; end < 2; end++)
    for (int d = 0; d < degrees; d++)
      e->dof[degrees * end + d] = degrees * m->node[end] + d;
  double between[3];
  e->length = ed_between_faces(model, m, between);
  if (!isfinite(e->length))
    return ED_E_NOT_FINITE;
  if (e->kind != ED_LINK && e->kind != ED_SPRING) /* which may have no length */
    place_axis(e, m, between);
  switch (e->kind) {
    case ED_LINK:
      setup_link(e, m, between[0], between[1]);
      return ed_all_finite(36, e->link) ? ED_OK : ED_E_NOT_FINITE;
    case ED_SPRING:
      setup_spring(e, &model->springs[m->spring]);
      break;
    case ED_TRUSS:
      setup_truss(e, &model->materials[m->material], m->area);
      break;
    case ED_STRUT:
      e->strut = ed_strut_new(model, m, e->length);
      return !e->strut ? ED_E_MEMORY : ed_strut_finite(e->strut) ? ED_OK : ED_E_NOT_FINITE;
    case ED_ELASTIC_BEAM:
      setup_elastic_beam(e, &model->sections[m->section[0]], m->without);
      find_stiffness(e);
      break;
    case ED_FIBRE_BEAM:
      setup_fibre_beam(e, model, m);
      find_stiffness(e);
  }
  if (e->axes == ED_SPACE)
    e->twist_stiffness = e->section[0]->torsion / e->length;
  return ed_all_finite(ed_basic_terms(e->axes), e->stiffness) && isfinite(e->twist_stiffness) ? ED_OK : ED_E_NOT_FINITE;
}

void ed_element_clear(ed_element *e)
{
  ed_strut_free(e->strut);
  e->strut = NULL;
}
