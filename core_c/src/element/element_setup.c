/* Elements of the members of a model: geometry, points of integration, elastic stiffness. */
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

/* Flexibility 11 12 22 of a section before any strain. */
static void section_flexibility(const ed_section *section, double inverse[3])
{
  const double determinant = section->k11 * section->k22 - section->k12 * section->k12;
  inverse[0] = section->k22 / determinant;
  inverse[1] = -section->k12 / determinant;
  inverse[2] = section->k11 / determinant;
}

/* In closed form; `without`: flexibilities that its ends leave out. */
static void setup_elastic_beam(ed_element *e, const ed_section *section, const double without[2])
{
  double *f = e->inverse[0];
  const double L = e->length;
  e->section[0] = section;
  section_flexibility(section, f);
  const double F[6] = {f[0] * L, -f[1] * L / 2.0, f[1] * L / 2.0, f[2] * L / 3.0, -f[2] * L / 6.0, f[2] * L / 3.0};
  memcpy(e->flexibility, F, sizeof F);
  e->flexibility[3] -= without[0];
  e->flexibility[5] -= without[1];
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
    e->flexibility[0] += w * f[0];
    e->flexibility[1] += w * f[1] * (x - 1.0);
    e->flexibility[2] += w * f[1] * x;
    e->flexibility[3] += w * f[2] * (x - 1.0) * (x - 1.0);
    e->flexibility[4] += w * f[2] * (x - 1.0) * x;
    e->flexibility[5] += w * f[2] * x * x;
  }
}

/* Axis and length of what bends between two nodes. */
static void place_axis(ed_element *e, const ed_member *m, double dx, double dy)
{
  e->c = dx / e->length;
  e->s = dy / e->length;
  e->rigid = m->rigid[0] > 0.0 || m->rigid[1] > 0.0;
  if (e->rigid) {
    e->arm[0] = m->rigid[0];
    e->arm[1] = -m->rigid[1];
    e->length -= m->rigid[0] + m->rigid[1];
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
  if (!isfinite(e->length))
    return ED_E_NOT_FINITE;
  if (e->kind != ED_LINK && e->kind != ED_SPRING) /* which may have no length */
    place_axis(e, m, dx, dy);
  switch (e->kind) {
    case ED_LINK:
      setup_link(e, m, dx, dy);
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
      stiffness_of(e->flexibility, e->release, e->stiffness);
      break;
    case ED_FIBRE_BEAM:
      setup_fibre_beam(e, model, m);
      stiffness_of(e->flexibility, e->release, e->stiffness);
  }
  return ed_all_finite(6, e->stiffness) ? ED_OK : ED_E_NOT_FINITE;
}

void ed_element_clear(ed_element *e)
{
  ed_strut_free(e->strut);
  e->strut = NULL;
}
