#include "member.h"

#include "checks.h"
#include "numbers.h"
#include "sections.h"

#include <math.h>
#include <stdlib.h>

static int new_section(ed_model *model, steel_kind steel)
{
  static const double parameters[STEEL_KINDS][6] = {
      {2.1e11, 275e6, 0.0}, {2.1e11, 275e6, 0.02}, {2.1e11, 275e6, 0.01, 20.0, 0.925, 0.15}};
  const int material = steel == CURVED ? ed_model_material(model, ED_MENEGOTTO_PINTO, 6, parameters[steel])
                                       : ed_model_material(model, ED_BILINEAR, 3, parameters[steel]);
  double y[MOST_FIBRES], area[MOST_FIBRES];
  int materials[MOST_FIBRES];
  const int n = i_section_fibres(4, 1, material, material, y, area, materials);
  for (int i = 0; i < n; i++)
    if (steel != PLASTIC && y[i] > 0.2)
      area[i] *= 1.5; /* couples axial force and moment */
  return ed_model_fibre_section(model, n, y, NULL, area, materials, 0.0);
}

member member_new(member_options o)
{
  member m = {.model = ed_model_new(2), .control = {.tolerance = 1e-22, .fast_elastic = 1}};
  const int section = new_section(m.model, o.steel);
  const int i = ed_model_node(m.model, "i", (double[]){1.0, 2.0});
  const int j = ed_model_node(m.model, "j", (double[]){1.0 + 4.0 * cos(0.523598775598299), 2.0 + 4.0 * sin(0.523598775598299)});
  int sections[ED_MAX_RULE], id;
  for (int p = 0; p < ED_MAX_RULE; p++)
    sections[p] = section;
  if (o.kind == ED_FIBRE_BEAM)
    id = ed_model_beam_column(m.model, "m", i, j, o.points ? o.points : 5, sections, o.geometry, (int[]){o.release[0], o.release[1]}, NULL);
  else if (o.kind == ED_ELASTIC_BEAM)
    id = ed_model_elastic_beam(m.model, "m", i, j, section, o.geometry, (int[]){o.release[0], o.release[1]}, NULL);
  else if (o.kind == ED_TRUSS)
    id = ed_model_truss(m.model, "m", i, j, 0, 0.01, o.geometry);
  else
    id = ed_model_link(m.model, "m", i, j, 3e7, 2e7, 1e7, 0.0);
  CHECK_INT(id, 0);
  if (o.rigid[0] + o.rigid[1] > 0.0)
    CHECK_INT(ed_model_rigid_ends(m.model, id, o.rigid[0], o.rigid[1]), ED_OK);
  ed_element_setup(&m.e, m.model, id);
  m.block = calloc((size_t)ed_element_block_size(&m.e), sizeof *m.block);
  m.layers = calloc((size_t)ed_element_layer_size(&m.e) + 1, sizeof *m.layers);
  ed_element_initialise(&m.e, m.block, m.layers);
  return m;
}

void member_free(member *m)
{
  free(m->block);
  free(m->layers);
  ed_model_free(m->model);
}

void member_load(member *m, double wx, double wy, double px, double py)
{
  const ed_member_load uniform = {.position = -1.0, .axial = wx, .transverse = {wy}};
  const ed_member_load point = {.position = 0.3, .axial = px, .transverse = {py}};
  ed_element_clear_loads(&m->e);
  (m->e.rigid ? ed_rigid_add_load : ed_element_add_load)(&m->e, &uniform, 1.0);
  (m->e.rigid ? ed_rigid_add_load : ed_element_add_load)(&m->e, &point, 1.0);
  ed_element_finish_loads(&m->e);
}

int member_update(member *m, const double *displacement)
{
  return ed_element_update(&m->e, displacement, m->layers, m->block, &m->control);
}

void draw_displacement(const member *m, double turn, double size, unsigned long long seed, double *d)
{
  numbers source = {seed};
  const double L = m->e.length + m->e.arm[0] - m->e.arm[1], c = m->e.c, s = m->e.s;
  for (int i = 0; i < 20; i++)
    next_number(&source, 0.0, 1.0); /* near seeds begin alike */
  d[0] = next_number(&source, -1.0, 1.0);
  d[1] = next_number(&source, -1.0, 1.0);
  d[3] = d[0] + L * (c * cos(turn) - s * sin(turn) - c);
  d[4] = d[1] + L * (s * cos(turn) + c * sin(turn) - s);
  const double along = next_number(&source, -0.03, 0.03) * size * L;
  const double across = next_number(&source, -1.0, 1.0) * size * L;
  d[3] += along * c - across * s;
  d[4] += along * s + across * c;
  d[2] = turn + next_number(&source, -1.0, 1.0) * size;
  d[5] = turn + next_number(&source, -1.0, 1.0) * size;
}

double member_plastic_moment(const member *m, int point)
{
  const ed_section *section = m->e.section[point];
  double moment = 0.0;
  for (int i = 0; i < section->n; i++)
    moment += section->area[i] * section->steel[i]->fy * fabs(section->y[i]);
  return moment;
}
