/* Members of a model: beams, trusses, struts, links and springs. */
#include "element/strut.h"
#include "system/model.h"

#include <math.h>
#include <string.h>

/* Appends a member between two nodes, which may be at one place only if `may_be_short`. */
static int member(ed_model *model, const char *name, ed_element_kind kind, int i, int j, int geometry, int may_be_short)
{
  if (ed_model_lacks_node(model, i) || ed_model_lacks_node(model, j))
    return ED_E_ID;
  double between[3];
  if (i == j || (!may_be_short && ed_between(model, i, j, between) <= 0.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s has no length (nodes %s and %s)", name ? name : "", model->nodes[i].name,
                           model->nodes[j].name);
  if (geometry < ED_LINEAR || geometry > ED_COROTATIONAL)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: unknown geometry %d", name ? name : "", geometry);
  ED_MODEL_APPEND(model, members, n_members);
  ed_member *m = &model->members[model->n_members - 1];
  ed_copy_name(m->name, name);
  m->kind = kind;
  m->node[0] = i;
  m->node[1] = j;
  m->geometry = geometry;
  m->damping_factor = 1.0;
  return model->n_members - 1;
}

/* What is wrong with a section of a beam, or NULL. */
static const char *unfit(const ed_model *model, int section)
{
  if (section < 0 || section >= model->n_sections)
    return "there is no section";
  return model->dimension == 3 && model->sections[section].axes != ED_SPACE ? "it bends about two axes, but not section" : NULL;
}

/* Off a right angle to the member, or off the length 1, for rounding. */
static const double ROUNDED = 1e-6;

/* Sets what beams have: releases of their ends, and in space the direction of their web. */
static int set_beam(ed_model *model, int id, const int *release, const double *web)
{
  ed_member *m = &model->members[id];
  for (int i = 0; i < 2 * (model->dimension - 1); i++)
    m->release[i] = release && release[i] != 0;
  if (model->dimension == 2)
    return id;
  double between[3], along = 0.0, size = 0.0;
  const double length = ed_between(model, m->node[0], m->node[1], between);
  for (int i = 0; i < 3; i++) {
    along += web[i] * between[i] / length;
    size += web[i] * web[i];
  }
  if (!(fabs(along) < ROUNDED && fabs(size - 1.0) < ROUNDED)) {
    model->n_members--;
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: its web %g, %g, %g is no direction of length 1 at right angles to it", m->name,
                           web[0], web[1], web[2]);
  }
  memcpy(m->web, web, sizeof m->web);
  return id;
}

int ed_model_beam_column(ed_model *model, const char *name, int i, int j, int points, const int *sections, int geometry,
                         const int *release, const double *web)
{
  if (points < 2 || points > ED_MAX_RULE)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: %d integration points are not in 2..%d", name ? name : "", points,
                  ED_MAX_RULE);
  for (int p = 0; p < points; p++)
    if (unfit(model, sections[p]))
      return ed_model_refuse(model, ED_E_ID, "element %s: %s %d", name ? name : "", unfit(model, sections[p]), sections[p]);
  const int id = member(model, name, ED_FIBRE_BEAM, i, j, geometry, 0);
  if (id < 0)
    return id;
  ed_member *m = &model->members[id];
  m->points = points;
  memcpy(m->section, sections, (size_t)points * sizeof *sections);
  return set_beam(model, id, release, web);
}

int ed_model_elastic_beam(ed_model *model, const char *name, int i, int j, int section, int geometry, const int *release,
                          const double *web)
{
  if (unfit(model, section))
    return ed_model_refuse(model, ED_E_ID, "element %s: %s %d", name ? name : "", unfit(model, section), section);
  const int id = member(model, name, ED_ELASTIC_BEAM, i, j, geometry, 0);
  if (id < 0)
    return id;
  model->members[id].section[0] = section;
  return set_beam(model, id, release, web);
}

int ed_model_breaks(ed_model *model, int element, int n, const double *position)
{
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  ed_member *m = &model->members[element];
  if (m->kind != ED_FIBRE_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is not integrated along its length", m->name);
  if (n < 0 || n >= ED_MAX_POINTS || (n + 1) * (m->points - 1) + 1 > ED_MAX_POINTS)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: %d breaks with %d points a piece are more than %d points", m->name, n,
                  m->points, ED_MAX_POINTS);
  for (int p = 1; p < m->points; p++)
    if (m->section[p] != m->section[0])
      return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: its section is not the same at all points", m->name);
  for (int k = 0; k < n; k++)
    if (!(position[k] > (k ? position[k - 1] : 0.0) && position[k] < 1.0))
      return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: breaks must rise between 0 and 1, not %g", m->name, position[k]);
  m->breaks = n;
  for (int k = 0; k < n; k++)
    m->break_at[k] = position[k];
  return ED_OK;
}

/* Refuses what has no rigid ends. */
static int lacks_ends(ed_model *model, int element)
{
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  const ed_member *m = &model->members[element];
  if (m->kind != ED_FIBRE_BEAM && m->kind != ED_ELASTIC_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is no beam-column and has no rigid ends", m->name);
  return ED_OK;
}

int ed_model_offset_ends(ed_model *model, int element, const double *at_i, const double *at_j)
{
  const int lacks = lacks_ends(model, element);
  if (lacks != ED_OK)
    return lacks;
  ed_member *m = &model->members[element];
  if (model->dimension == 2)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: offset ends are of frames in space", m->name);
  for (int i = 0; i < 3; i++)
    if (!isfinite(at_i[i]) || !isfinite(at_j[i]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: an offset of an end is not a finite number", m->name);
  double nodes[3], faces[3], onwards = 0.0, along = 0.0;
  ed_between(model, m->node[0], m->node[1], nodes);
  ed_member moved = *m;
  memcpy(moved.offset[0], at_i, sizeof moved.offset[0]);
  memcpy(moved.offset[1], at_j, sizeof moved.offset[1]);
  const double length = ed_between_faces(model, &moved, faces);
  for (int i = 0; i < 3; i++) {
    onwards += nodes[i] * faces[i];
    along += m->web[i] * faces[i] / length;
  }
  if (!isnormal(length) || !(onwards > 0.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: its offset ends leave nothing between them from node %s to node %s", m->name,
                           model->nodes[m->node[0]].name, model->nodes[m->node[1]].name);
  if (!(1.0 - along * along >= ROUNDED)) /* at the sine s between, ROUNDED turns the web by ROUNDED / s: at most s */
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: between its offset ends it runs along its web", m->name);
  memcpy(m->offset, moved.offset, sizeof m->offset);
  return ED_OK;
}

int ed_model_rigid_ends(ed_model *model, int element, double start, double end)
{
  const int lacks = lacks_ends(model, element);
  if (lacks != ED_OK)
    return lacks;
  ed_member *m = &model->members[element];
  double between[3];
  const double length = ed_between(model, m->node[0], m->node[1], between);
  if (!(start >= 0.0 && end >= 0.0 && start + end < length))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: rigid ends of %g and %g leave nothing of its length %g", m->name, start,
                  end, length);
  if (model->dimension == 3) {
    double at_i[3], at_j[3];
    for (int i = 0; i < 3; i++) {
      at_i[i] = start * between[i] / length;
      at_j[i] = -end * between[i] / length;
    }
    return ed_model_offset_ends(model, element, at_i, at_j);
  }
  m->rigid[0] = start;
  m->rigid[1] = end;
  return ED_OK;
}

int ed_model_without_flexibility(ed_model *model, int element, int about_y, double at_i, double at_j)
{
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  ed_member *m = &model->members[element];
  if (m->kind != ED_ELASTIC_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is no elastic beam and cannot leave out flexibility", m->name);
  if (about_y && model->dimension == 2)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s bends in a plane, about one axis", m->name);
  double between[3];
  const ed_section *section = &model->sections[m->section[0]];
  const int moment = about_y ? 2 : 1;
  const double stiffness = section->k[ed_sym_place(1 + section->axes, moment, moment)];
  const double most = ed_between(model, m->node[0], m->node[1], between) / (3.0 * stiffness);
  if (!(at_i >= 0.0 && at_i < most && at_j >= 0.0 && at_j < most))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: flexibilities %g and %g to leave out must be from 0 to below %g", m->name,
                           at_i, at_j, most);
  m->without[about_y ? 2 : 0] = at_i;
  m->without[about_y ? 3 : 1] = at_j;
  return ED_OK;
}

int ed_model_truss(ed_model *model, const char *name, int i, int j, int material, double area, int geometry)
{
  if (material < 0 || material >= model->n_materials)
    return ed_model_refuse(model, ED_E_ID, "element %s: there is no material %d", name ? name : "", material);
  if (!(area > 0.0) || !isfinite(area))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: area %g must be positive", name ? name : "", area);
  const int id = member(model, name, ED_TRUSS, i, j, geometry, 0);
  if (id < 0)
    return id;
  model->members[id].material = material;
  model->members[id].area = area;
  return id;
}

int ed_model_strut(ed_model *model, const char *name, int i, int j, int section, int points, int elements, double camber,
                   double buckling_length, double end_stiffness, int material, double area, int geometry)
{
  const char *shown = name ? name : "";
  if (section < 0 || section >= model->n_sections || model->sections[section].elastic || model->sections[section].axes != ED_PLANE)
    return ed_model_refuse(model, ED_E_ID, "strut %s: there is no fibre section %d", shown, section);
  if (points < 3 || points > ED_MAX_RULE)
    return ed_model_refuse(model, ED_E_ARGUMENT, "strut %s: %d integration points are not in 3..%d", shown, points, ED_MAX_RULE);
  if (elements < 2 || elements > ED_STRUT_MAX_ELEMENTS || elements % 2)
    return ed_model_refuse(model, ED_E_ARGUMENT, "strut %s: %d elements are no even number in 2..%d", shown, elements,
                           ED_STRUT_MAX_ELEMENTS);
  if (!(camber > 0.0 && camber <= 0.1))
    return ed_model_refuse(model, ED_E_ARGUMENT, "strut %s: the camber %g is not above 0 and at most 0.1", shown, camber);
  if (!(buckling_length > 0.0 && buckling_length <= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "strut %s: the share %g of its length that buckles is not above 0 and at most 1", shown,
                           buckling_length);
  if (!(end_stiffness >= 0.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "strut %s: the stiffness of its ends must not be negative", shown);
  const int id = ed_model_truss(model, name, i, j, material, area, geometry);
  if (id < 0)
    return id;
  ed_member *m = &model->members[id];
  m->kind = ED_STRUT;
  m->points = points;
  for (int p = 0; p < points; p++)
    m->section[p] = section;
  m->elements = elements;
  m->camber = camber;
  m->buckling_length = buckling_length;
  m->end_stiffness = end_stiffness;
  return id;
}

int ed_model_link(ed_model *model, const char *name, int i, int j, double kx, double ky, double krz, double angle)
{
  if (!(kx >= 0.0 && ky >= 0.0 && krz >= 0.0) || !isfinite(kx + ky + krz + angle))
    return ed_model_refuse(model, ED_E_ARGUMENT, "link %s: stiffnesses must not be negative", name ? name : "");
  if (model->dimension == 3)
    return ed_model_refuse(model, ED_E_ARGUMENT, "link %s: links are of plane frames", name ? name : "");
  const int id = member(model, name, ED_LINK, i, j, ED_LINEAR, 1);
  if (id < 0)
    return id;
  ed_member *m = &model->members[id];
  m->stiffness[0] = kx;
  m->stiffness[1] = ky;
  m->stiffness[2] = krz;
  m->angle = angle;
  return id;
}

int ed_model_spring(ed_model *model, const char *name, int i, int j, const double *coefficient, int law, int n, const double *parameters)
{
  ed_spring spring;
  const char *wrong = ed_spring_set(&spring, law, n, parameters);
  if (wrong)
    return ed_model_refuse(model, ED_E_ARGUMENT, "spring %s: %s", name ? name : "", wrong);
  double largest = 0.0;
  const int degrees = 2 * ed_degrees(model);
  for (int d = 0; d < degrees; d++) {
    if (!isfinite(coefficient[d]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "spring %s: coefficient %d is not a finite number", name ? name : "", d + 1);
    largest = fmax(largest, fabs(coefficient[d]));
  }
  if (largest == 0.0)
    return ed_model_refuse(model, ED_E_ARGUMENT, "spring %s: all its coefficients are 0", name ? name : "");
  ED_MODEL_APPEND(model, springs, n_springs);
  const int id = member(model, name, ED_SPRING, i, j, ED_LINEAR, 1);
  if (id < 0) {
    model->n_springs--;
    return id;
  }
  model->springs[model->n_springs - 1] = spring;
  ed_member *m = &model->members[id];
  m->spring = model->n_springs - 1;
  memcpy(m->coefficient, coefficient, (size_t)degrees * sizeof *coefficient);
  return id;
}

int ed_model_damping_factor(ed_model *model, int element, double factor)
{
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  if (!(factor >= 0.0) || !isfinite(factor))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: the damping factor %g must not be negative", model->members[element].name,
                           factor);
  model->members[element].damping_factor = factor;
  model->uneven_damping |= factor != 1.0;
  return ED_OK;
}
