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
