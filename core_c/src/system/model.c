#include "system/model.h"

#include "element/strut.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int ed_model_refuse(ed_model *model, int status, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(model->message, sizeof model->message, format, arguments);
  va_end(arguments);
  return status;
}

/* Room for one more item; arrays grow by powers of two, so that the present count tells the capacity. */
void *ed_model_grown(void *array, int count, size_t size)
{
  const int full = count >= 8 ? (count & (count - 1)) == 0 : count == 0;
  if (!full)
    return array;
  const size_t capacity = count >= 8 ? 2 * (size_t)count : 8;
  return realloc(array, capacity * size);
}

#define APPEND(model, array, count)                                               \
  do {                                                                               \
    void *room = ed_model_grown((model)->array, (model)->count, sizeof *(model)->array); \
    if (!room)                                                                       \
      return ed_model_refuse(model, ED_E_MEMORY, "out of memory");                   \
    (model)->array = room;                                                           \
    memset(&(model)->array[(model)->count], 0, sizeof *(model)->array);              \
    (model)->count++;                                                                \
  } while (0)

ed_model *ed_model_new(void)
{
  return calloc(1, sizeof(ed_model));
}

void ed_model_free(ed_model *model)
{
  if (!model)
    return;
  for (int i = 0; i < model->n_sections; i++)
    ed_section_free(&model->sections[i]);
  free(model->materials);
  free(model->sections);
  free(model->springs);
  free(model->nodes);
  free(model->members);
  free(model->nodal_loads);
  free(model->member_loads);
  for (int i = 0; i < model->n_devices; i++)
    ed_damper_clear(&model->devices[i].damper);
  free(model->devices);
  free(model);
}

const char *ed_model_message(const ed_model *model)
{
  return model->message;
}

int ed_model_material(ed_model *model, int law, int n, const double *p)
{
  static const int expected[] = {1, 3, 6};
  if (law < ED_ELASTIC || law > ED_MENEGOTTO_PINTO || n != expected[law])
    return ed_model_refuse(model, ED_E_ARGUMENT, "material: unknown law %d or wrong number of parameters %d", law, n);
  for (int i = 0; i < n; i++)
    if (!isfinite(p[i]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "material: parameter %d is not a finite number", i + 1);
  if (p[0] <= 0.0 || (n > 1 && p[1] <= 0.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "material: E and fy must be positive");
  if (n > 1 && !isfinite(p[1] / p[0]))
    return ed_model_refuse(model, ED_E_ARGUMENT, "material: fy %g over E %g is not a finite strain", p[1], p[0]);
  if (n > 2 && (p[2] < 0.0 || p[2] >= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "material: hardening ratio %g is not in [0, 1)", p[2]);
  if (law == ED_MENEGOTTO_PINTO && (p[3] <= 0.0 || p[4] < 0.0 || p[4] >= 1.0 || p[5] <= 0.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "material: R0 > 0, 0 <= cR1 < 1 and cR2 > 0 are needed");
  if (model->n_sections)
    return ed_model_refuse(model, ED_E_STATE, "material: declare all materials before the first section");
  APPEND(model, materials, n_materials);
  ed_steel *steel = &model->materials[model->n_materials - 1];
  steel->law = law;
  steel->E = p[0];
  steel->fy = n > 1 ? p[1] : HUGE_VAL;
  steel->hardening = n > 2 ? p[2] : 0.0;
  steel->H = steel->hardening * steel->E / (1.0 - steel->hardening);
  if (law == ED_MENEGOTTO_PINTO) {
    steel->R0 = p[3];
    steel->cR1 = p[4];
    steel->cR2 = p[5];
  }
  return model->n_materials - 1;
}

int ed_model_fatigue(ed_model *model, int material, double strain, double exponent)
{
  if (material < 0 || material >= model->n_materials)
    return ed_model_refuse(model, ED_E_ID, "there is no material %d", material);
  if (!(strain > 0.0 && exponent > 0.0) || !isfinite(strain + exponent))
    return ed_model_refuse(model, ED_E_ARGUMENT, "material: fatigue strain %g and exponent %g must be positive", strain, exponent);
  if (model->n_sections)
    return ed_model_refuse(model, ED_E_STATE, "material: declare fatigue before the first section");
  model->materials[material].fatigue_strain = strain;
  model->materials[material].fatigue_exponent = exponent;
  return ED_OK;
}

int ed_model_elastic_section(ed_model *model, double EA, double EI)
{
  if (!(EA > 0.0 && EI > 0.0 && isfinite(EA) && isfinite(EI)))
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: EA %g and EI %g must be positive", EA, EI);
  APPEND(model, sections, n_sections);
  ed_section_elastic(&model->sections[model->n_sections - 1], EA, EI);
  return model->n_sections - 1;
}

int ed_model_fibre_section(ed_model *model, int n, const double *y, const double *area, const int *material)
{
  if (n < 1)
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: at least one fibre is needed");
  for (int i = 0; i < n; i++) {
    if (!isfinite(y[i]) || !isfinite(area[i]) || area[i] <= 0.0)
      return ed_model_refuse(model, ED_E_ARGUMENT, "section: fibre %d has depth %g and area %g", i + 1, y[i], area[i]);
    if (material[i] < 0 || material[i] >= model->n_materials)
      return ed_model_refuse(model, ED_E_ID, "section: fibre %d has no material %d", i + 1, material[i]);
  }
  int laws[ED_MENEGOTTO_PINTO + 1] = {0}, breaks = 0;
  for (int i = 0; i < n; i++) {
    laws[model->materials[material[i]].law] = 1;
    breaks |= model->materials[material[i]].fatigue_strain > 0.0;
  }
  if (breaks && laws[ED_MENEGOTTO_PINTO] && (laws[ED_ELASTIC] || laws[ED_BILINEAR]))
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: fibres that break take one kind of law");
  APPEND(model, sections, n_sections);
  ed_section *section = &model->sections[model->n_sections - 1];
  if (!ed_section_from_fibres(section, n, y, area, material, model->materials)) {
    model->n_sections--;
    return ed_model_refuse(model, ED_E_MEMORY, "out of memory");
  }
  if (!(section->k11 * section->k22 - section->k12 * section->k12 > 1e-12 * section->k11 * section->k22)) {
    model->n_sections--;
    ed_section_free(section);
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: no bending stiffness (all fibres at one depth)");
  }
  return model->n_sections - 1;
}

int ed_model_section_layers(const ed_model *model, int section)
{
  return section >= 0 && section < model->n_sections ? model->sections[section].n : ED_E_ID;
}

void ed_copy_name(char *to, const char *name)
{
  snprintf(to, ED_NAME, "%s", name ? name : "");
}

int ed_model_node(ed_model *model, const char *name, double x, double y)
{
  if (!isfinite(x) || !isfinite(y))
    return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: coordinates are not finite numbers", name ? name : "");
  APPEND(model, nodes, n_nodes);
  ed_node *node = &model->nodes[model->n_nodes - 1];
  ed_copy_name(node->name, name);
  node->x = x;
  node->y = y;
  for (int d = 0; d < 3; d++)
    node->master[d] = -1;
  return model->n_nodes - 1;
}

static int bad_node(ed_model *model, int node)
{
  if (node >= 0 && node < model->n_nodes)
    return 0;
  ed_model_refuse(model, ED_E_ID, "there is no node %d", node);
  return 1;
}

int ed_model_fix(ed_model *model, int node, int ux, int uy, int rz)
{
  if (bad_node(model, node))
    return ED_E_ID;
  const int fixed[3] = {ux, uy, rz};
  for (int d = 0; d < 3; d++)
    model->nodes[node].fixed[d] |= fixed[d] != 0;
  return ED_OK;
}

int ed_model_tie(ed_model *model, int node, int master, int ux, int uy, int rz)
{
  if (bad_node(model, node) || bad_node(model, master))
    return ED_E_ID;
  const int tied[3] = {ux, uy, rz};
  if (node == master)
    return ed_model_refuse(model, ED_E_ARGUMENT, "node %s is tied to itself", model->nodes[node].name);
  for (int d = 0; d < 3; d++) {
    if (!tied[d])
      continue;
    /* all that either of them is tied to becomes one group */
    int of_node = node, of_master = master;
    while (model->nodes[of_node].master[d] >= 0)
      of_node = model->nodes[of_node].master[d];
    while (model->nodes[of_master].master[d] >= 0)
      of_master = model->nodes[of_master].master[d];
    if (of_node != of_master)
      model->nodes[of_node].master[d] = of_master;
  }
  return ED_OK;
}

int ed_model_mass(ed_model *model, int node, double mx, double my, double mrz)
{
  if (bad_node(model, node))
    return ED_E_ID;
  if (!(mx >= 0.0 && my >= 0.0 && mrz >= 0.0) || !isfinite(mx + my + mrz))
    return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: masses must not be negative", model->nodes[node].name);
  const double mass[3] = {mx, my, mrz};
  for (int d = 0; d < 3; d++)
    if (!isfinite(model->nodes[node].mass[d] + mass[d]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: the sum of its masses is not a finite number", model->nodes[node].name);
  for (int d = 0; d < 3; d++)
    model->nodes[node].mass[d] += mass[d];
  return ED_OK;
}

/* Appends a member between two nodes, which may be at one place only if `may_be_short`. */
static int member(ed_model *model, const char *name, ed_element_kind kind, int i, int j, int geometry, int may_be_short)
{
  if (bad_node(model, i) || bad_node(model, j))
    return ED_E_ID;
  const ed_node *a = &model->nodes[i], *b = &model->nodes[j];
  if (i == j || (!may_be_short && hypot(b->x - a->x, b->y - a->y) <= 0.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s has no length (nodes %s and %s)", name ? name : "", a->name, b->name);
  if (geometry < ED_LINEAR || geometry > ED_COROTATIONAL)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: unknown geometry %d", name ? name : "", geometry);
  APPEND(model, members, n_members);
  ed_member *m = &model->members[model->n_members - 1];
  ed_copy_name(m->name, name);
  m->kind = kind;
  m->node[0] = i;
  m->node[1] = j;
  m->geometry = geometry;
  m->damping_factor = 1.0;
  return model->n_members - 1;
}

int ed_model_beam_column(ed_model *model, const char *name, int i, int j, int points, const int *sections, int geometry,
                         int release_i, int release_j)
{
  if (points < 2 || points > ED_MAX_RULE)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: %d integration points are not in 2..%d", name ? name : "", points,
                  ED_MAX_RULE);
  for (int p = 0; p < points; p++)
    if (sections[p] < 0 || sections[p] >= model->n_sections)
      return ed_model_refuse(model, ED_E_ID, "element %s: there is no section %d", name ? name : "", sections[p]);
  const int id = member(model, name, ED_FIBRE_BEAM, i, j, geometry, 0);
  if (id < 0)
    return id;
  ed_member *m = &model->members[id];
  m->points = points;
  memcpy(m->section, sections, (size_t)points * sizeof *sections);
  m->release[0] = release_i != 0;
  m->release[1] = release_j != 0;
  return id;
}

int ed_model_elastic_beam(ed_model *model, const char *name, int i, int j, int section, int geometry, int release_i,
                          int release_j)
{
  if (section < 0 || section >= model->n_sections)
    return ed_model_refuse(model, ED_E_ID, "element %s: there is no section %d", name ? name : "", section);
  const int id = member(model, name, ED_ELASTIC_BEAM, i, j, geometry, 0);
  if (id < 0)
    return id;
  ed_member *m = &model->members[id];
  m->section[0] = section;
  m->release[0] = release_i != 0;
  m->release[1] = release_j != 0;
  return id;
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
  if (section < 0 || section >= model->n_sections || model->sections[section].elastic)
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
  for (int d = 0; d < 6; d++) {
    if (!isfinite(coefficient[d]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "spring %s: coefficient %d is not a finite number", name ? name : "", d + 1);
    largest = fmax(largest, fabs(coefficient[d]));
  }
  if (largest == 0.0)
    return ed_model_refuse(model, ED_E_ARGUMENT, "spring %s: all its coefficients are 0", name ? name : "");
  APPEND(model, springs, n_springs);
  const int id = member(model, name, ED_SPRING, i, j, ED_LINEAR, 1);
  if (id < 0) {
    model->n_springs--;
    return id;
  }
  model->springs[model->n_springs - 1] = spring;
  ed_member *m = &model->members[id];
  m->spring = model->n_springs - 1;
  memcpy(m->coefficient, coefficient, sizeof m->coefficient);
  return id;
}

static int bad_element(ed_model *model, int element)
{
  if (element >= 0 && element < model->n_members)
    return 0;
  ed_model_refuse(model, ED_E_ID, "there is no element %d", element);
  return 1;
}

int ed_model_without_flexibility(ed_model *model, int element, double at_i, double at_j)
{
  if (bad_element(model, element))
    return ED_E_ID;
  ed_member *m = &model->members[element];
  if (m->kind != ED_ELASTIC_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is no elastic beam and cannot leave out flexibility", m->name);
  const ed_node *i = &model->nodes[m->node[0]], *j = &model->nodes[m->node[1]];
  const double most = hypot(j->x - i->x, j->y - i->y) / (3.0 * model->sections[m->section[0]].k22);
  if (!(at_i >= 0.0 && at_i < most && at_j >= 0.0 && at_j < most))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: flexibilities %g and %g to leave out must be from 0 to below %g", m->name,
                           at_i, at_j, most);
  m->without[0] = at_i;
  m->without[1] = at_j;
  return ED_OK;
}

int ed_model_damping_factor(ed_model *model, int element, double factor)
{
  if (bad_element(model, element))
    return ED_E_ID;
  if (!(factor >= 0.0) || !isfinite(factor))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: the damping factor %g must not be negative", model->members[element].name,
                           factor);
  model->members[element].damping_factor = factor;
  model->uneven_damping |= factor != 1.0;
  return ED_OK;
}

int ed_model_pattern(ed_model *model)
{
  return model->n_patterns++;
}

int ed_model_nodal_load(ed_model *model, int pattern, int node, double fx, double fy, double mz)
{
  if (pattern < 0 || pattern >= model->n_patterns)
    return ed_model_refuse(model, ED_E_ID, "there is no load pattern %d", pattern);
  if (bad_node(model, node))
    return ED_E_ID;
  if (!isfinite(fx + fy + mz))
    return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: a load is not a finite number", model->nodes[node].name);
  APPEND(model, nodal_loads, n_nodal_loads);
  model->nodal_loads[model->n_nodal_loads - 1] = (ed_nodal_load){pattern, node, {fx, fy, mz}};
  return ED_OK;
}

int ed_model_breaks(ed_model *model, int element, int n, const double *position)
{
  if (element < 0 || element >= model->n_members)
    return ed_model_refuse(model, ED_E_ID, "there is no element %d", element);
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

int ed_model_rigid_ends(ed_model *model, int element, double start, double end)
{
  if (element < 0 || element >= model->n_members)
    return ed_model_refuse(model, ED_E_ID, "there is no element %d", element);
  ed_member *m = &model->members[element];
  if (m->kind != ED_FIBRE_BEAM && m->kind != ED_ELASTIC_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is no beam-column and has no rigid ends", m->name);
  const ed_node *i = &model->nodes[m->node[0]], *j = &model->nodes[m->node[1]];
  const double length = hypot(j->x - i->x, j->y - i->y);
  if (!(start >= 0.0 && end >= 0.0 && start + end < length))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: rigid ends of %g and %g leave nothing of its length %g", m->name, start,
                  end, length);
  m->rigid[0] = start;
  m->rigid[1] = end;
  return ED_OK;
}

static int member_load(ed_model *model, int pattern, int element, ed_member_load load)
{
  if (pattern < 0 || pattern >= model->n_patterns)
    return ed_model_refuse(model, ED_E_ID, "there is no load pattern %d", pattern);
  if (bad_element(model, element))
    return ED_E_ID;
  ed_member *m = &model->members[element];
  if (m->kind != ED_FIBRE_BEAM && m->kind != ED_ELASTIC_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is no beam-column and takes no load", m->name);
  if (!isfinite(load.axial + load.transverse + load.transverse_end))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load is not a finite number", m->name);
  APPEND(model, member_loads, n_member_loads);
  load.pattern = pattern;
  load.element = element;
  model->member_loads[model->n_member_loads - 1] = load;
  m->loaded = 1;
  return ED_OK;
}

int ed_model_uniform_load(ed_model *model, int pattern, int element, double axial, double transverse)
{
  return member_load(model, pattern, element, (ed_member_load){.position = -1.0, .axial = axial, .transverse = transverse});
}

int ed_model_point_load(ed_model *model, int pattern, int element, double position, double axial, double transverse)
{
  if (bad_element(model, element))
    return ED_E_ID;
  if (!(position >= 0.0 && position <= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load at %g of its length is not on it",
                  model->members[element].name, position);
  return member_load(model, pattern, element, (ed_member_load){.position = position, .axial = axial, .transverse = transverse});
}

int ed_model_partial_load(ed_model *model, int pattern, int element, double start, double end, double at_start, double at_end)
{
  if (element < 0 || element >= model->n_members)
    return ed_model_refuse(model, ED_E_ID, "there is no element %d", element);
  if (!(start >= 0.0 && start < end && end <= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load from %g to %g of its length is not on it",
                  model->members[element].name, start, end);
  return member_load(model, pattern, element,
                     (ed_member_load){.position = start, .transverse = at_start, .end = end, .transverse_end = at_end});
}
