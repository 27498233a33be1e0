/* Models: materials, sections, nodes, and what all parts of a model share. */
#include "system/model.h"

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

/* Room for one more item; arrays grow by powers of two, so that the present count gives the capacity. */
void *ed_model_grown(void *array, int count, size_t size)
{
  const int full = count >= 8 ? (count & (count - 1)) == 0 : count == 0;
  if (!full)
    return array;
  const size_t capacity = count >= 8 ? 2 * (size_t)count : 8;
  return realloc(array, capacity * size);
}

int ed_model_lacks_node(ed_model *model, int node)
{
  if (node >= 0 && node < model->n_nodes)
    return 0;
  ed_model_refuse(model, ED_E_ID, "there is no node %d", node);
  return 1;
}

int ed_model_lacks_element(ed_model *model, int element)
{
  if (element >= 0 && element < model->n_members)
    return 0;
  ed_model_refuse(model, ED_E_ID, "there is no element %d", element);
  return 1;
}

ed_model *ed_model_new(int dimension)
{
  ed_model *model = dimension == 2 || dimension == 3 ? calloc(1, sizeof(ed_model)) : NULL;
  if (model)
    model->dimension = dimension;
  return model;
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
  ED_MODEL_APPEND(model, materials, n_materials);
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

int ed_model_elastic_section(ed_model *model, const double *stiffness)
{
  static const char *const name[] = {"EA", "EI", "EI about y", "GJ"};
  const int n = model->dimension == 3 ? 4 : 2;
  for (int i = 0; i < n; i++)
    if (!(stiffness[i] > 0.0) || !isfinite(stiffness[i]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "section: %s %g must be positive", name[i], stiffness[i]);
  ED_MODEL_APPEND(model, sections, n_sections);
  ed_section *section = &model->sections[model->n_sections - 1];
  ed_section_elastic(section, model->dimension == 3 ? ED_SPACE : ED_PLANE, stiffness);
  section->torsion = model->dimension == 3 ? stiffness[3] : 0.0;
  return model->n_sections - 1;
}

/* Whether fibres may have these stresses before any load; refuses others. */
static int self_balanced(ed_model *model, int n, const double *y, const double *z, const double *area, const int *material,
                         const double *stress)
{
  double sum[ED_MAX_RESULTANTS] = {0.0}, size[ED_MAX_RESULTANTS] = {0.0};
  for (int i = 0; i < n; i++) {
    const ed_steel *steel = &model->materials[material[i]];
    if (steel->law != ED_BILINEAR || steel->fatigue_strain > 0.0) {
      ed_model_refuse(model, ED_E_ARGUMENT, "section: fibre %d with an initial stress is not of a bilinear law that does not break", i + 1);
      return 0;
    }
    if (!(fabs(stress[i]) * (1.0 + steel->H / steel->E) < steel->fy)) {
      ed_model_refuse(model, ED_E_ARGUMENT, "section: the initial stress %g of fibre %d is not below yield", stress[i], i + 1);
      return 0;
    }
    const double lever[ED_MAX_RESULTANTS] = {1.0, y[i], z ? z[i] : 0.0};
    for (int k = 0; k < ED_MAX_RESULTANTS; k++) {
      sum[k] += area[i] * stress[i] * lever[k];
      size[k] += area[i] * fabs(stress[i] * lever[k]);
    }
  }
  for (int k = 0; k < ED_MAX_RESULTANTS; k++)
    if (fabs(sum[k]) > 1e-12 * size[k]) {
      ed_model_refuse(model, ED_E_ARGUMENT, "section: its initial stresses have the %s %g", k ? "moment" : "force", sum[k]);
      return 0;
    }
  return 1;
}

int ed_model_fibre_section(ed_model *model, int n, const double *y, const double *z, const double *area, const int *material,
                           double torsion)
{
  return ed_model_stressed_section(model, n, y, z, area, material, NULL, torsion);
}

int ed_model_stressed_section(ed_model *model, int n, const double *y, const double *z, const double *area, const int *material,
                              const double *stress, double torsion)
{
  if (n < 1)
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: at least one fibre is needed");
  if (z && model->dimension == 2)
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: fibres of a plane frame have depths alone");
  if (z && !(torsion > 0.0 && isfinite(torsion)))
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: GJ %g must be positive", torsion);
  for (int i = 0; i < n; i++) {
    if (!isfinite(y[i]) || !isfinite(area[i]) || area[i] <= 0.0 || (z && !isfinite(z[i])))
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
  if (stress && !self_balanced(model, n, y, z, area, material, stress))
    return ED_E_ARGUMENT;
  ED_MODEL_APPEND(model, sections, n_sections);
  ed_section *section = &model->sections[model->n_sections - 1];
  if (!ed_section_from_fibres(section, n, y, z, area, material, stress, model->materials)) {
    model->n_sections--;
    return ed_model_refuse(model, ED_E_MEMORY, "out of memory");
  }
  if (!ed_section_bends(section)) {
    model->n_sections--;
    ed_section_free(section);
    return ed_model_refuse(model, ED_E_ARGUMENT, z ? "section: no bending stiffness (all fibres on one line)"
                                                   : "section: no bending stiffness (all fibres at one depth)");
  }
  section->torsion = z ? torsion : 0.0;
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

int ed_model_node(ed_model *model, const char *name, const double *position)
{
  const double z = model->dimension == 3 ? position[2] : 0.0;
  if (!isfinite(position[0]) || !isfinite(position[1]) || !isfinite(z))
    return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: coordinates are not finite numbers", name ? name : "");
  ED_MODEL_APPEND(model, nodes, n_nodes);
  ed_node *node = &model->nodes[model->n_nodes - 1];
  ed_copy_name(node->name, name);
  node->x = position[0];
  node->y = position[1];
  node->z = z;
  for (int d = 0; d < ED_MOST_DEGREES; d++)
    node->master[d] = -1;
  return model->n_nodes - 1;
}

double ed_between(const ed_model *model, int from, int to, double between[3])
{
  const ed_node *i = &model->nodes[from], *j = &model->nodes[to];
  between[0] = j->x - i->x;
  between[1] = j->y - i->y;
  between[2] = j->z - i->z;
  const double in_plan = hypot(between[0], between[1]);
  return model->dimension == 3 ? hypot(in_plan, between[2]) : in_plan;
}

double ed_between_faces(const ed_model *model, const ed_member *member, double between[3])
{
  const double length = ed_between(model, member->node[0], member->node[1], between);
  if (model->dimension == 2)
    return length;
  for (int i = 0; i < 3; i++)
    between[i] += member->offset[1][i] - member->offset[0][i];
  return hypot(hypot(between[0], between[1]), between[2]);
}

enum { TURN = 5 }; /* rz */

static int in_plan(int d)
{
  return d < 2 || d == TURN;
}

/* The master alone can be supported: of a node with a lever it would not be this degree that stands. */
static int refuse_support(ed_model *model, const ed_node *one, int master)
{
  return ed_model_refuse(model, ED_E_ARGUMENT, "node %s of a diaphragm is supported in plan; support its master %s instead", one->name,
                         model->nodes[master].name);
}

int ed_model_fix(ed_model *model, int node, const int *fixed)
{
  if (ed_model_lacks_node(model, node))
    return ED_E_ID;
  ed_node *one = &model->nodes[node];
  for (int d = 0; d < ed_degrees(model); d++)
    if (fixed[d] && one->diaphragm && in_plan(d))
      return refuse_support(model, one, one->master[d]);
  for (int d = 0; d < ed_degrees(model); d++)
    one->fixed[d] |= fixed[d] != 0;
  return ED_OK;
}

int ed_model_tie(ed_model *model, int node, int master, const int *tied)
{
  if (ed_model_lacks_node(model, node) || ed_model_lacks_node(model, master))
    return ED_E_ID;
  if (node == master)
    return ed_model_refuse(model, ED_E_ARGUMENT, "node %s is tied to itself", model->nodes[node].name);
  for (int d = 0; d < ed_degrees(model); d++) {
    const ed_node *ends[2] = {&model->nodes[node], &model->nodes[master]};
    for (int i = 0; i < 2; i++)
      if (tied[d] && in_plan(d) && (ends[i]->diaphragm || ends[i]->is_master))
        return ed_model_refuse(model, ED_E_ARGUMENT, "node %s is of a diaphragm, so its %s cannot be tied", ends[i]->name,
                               ed_degree_name(model, d));
  }
  for (int d = 0; d < ed_degrees(model); d++) {
    if (!tied[d])
      continue;
    /* all that either of them is tied to becomes one group */
    int of_node = node, of_master = master;
    while (model->nodes[of_node].master[d] >= 0)
      of_node = model->nodes[of_node].master[d];
    while (model->nodes[of_master].master[d] >= 0)
      of_master = model->nodes[of_master].master[d];
    if (of_node == of_master)
      continue;
    model->nodes[of_node].master[d] = of_master;
    model->nodes[of_master].is_followed |= in_plan(d);
  }
  return ED_OK;
}

int ed_model_diaphragm(ed_model *model, int master, int n, const int *node)
{
  if (model->dimension != 3)
    return ed_model_refuse(model, ED_E_ARGUMENT, "a plane frame has no diaphragm");
  if (ed_model_lacks_node(model, master))
    return ED_E_ID;
  if (model->n_devices)
    return ed_model_refuse(model, ED_E_STATE, "diaphragms are declared before dampers");
  if (n < 1)
    return ed_model_refuse(model, ED_E_ARGUMENT, "the diaphragm of %s has no node", model->nodes[master].name);
  for (int i = 0; i < n; i++)
    if (ed_model_lacks_node(model, node[i]))
      return ED_E_ID;
  for (int i = -1; i < n; i++) { /* the master too */
    const ed_node *one = &model->nodes[i < 0 ? master : node[i]];
    int tied = one->diaphragm || one->is_followed || (i >= 0 && one->is_master);
    for (int d = 0; d < ED_MOST_DEGREES; d++)
      tied |= in_plan(d) && one->master[d] >= 0;
    if (tied || (i >= 0 && node[i] == master))
      return ed_model_refuse(model, ED_E_ARGUMENT, "node %s cannot be of the diaphragm of %s: it is tied already", one->name,
                             model->nodes[master].name);
    if (i >= 0 && (one->fixed[0] || one->fixed[1] || one->fixed[TURN]))
      return refuse_support(model, one, master);
  }
  model->nodes[master].is_master = 1;
  for (int i = 0; i < n; i++) {
    ed_node *one = &model->nodes[node[i]];
    one->diaphragm = 1;
    one->master[0] = one->master[1] = one->master[TURN] = master;
  }
  return ED_OK;
}

ed_in_plan ed_of_master(const ed_model *model, int degree)
{
  const int d = degree % ed_degrees(model);
  const ed_node *node = &model->nodes[degree / ed_degrees(model)];
  if (!node->diaphragm || !in_plan(d))
    return (ed_in_plan){degree, -1, 0.0};
  const ed_node *master = &model->nodes[node->master[d]];
  const int at = ed_degrees(model) * node->master[d];
  if (d == TURN)
    return (ed_in_plan){at + d, -1, 0.0};
  return (ed_in_plan){at + d, at + TURN, d ? node->x - master->x : master->y - node->y};
}

int ed_put_on_masters(const ed_model *model, int n, int *degree, double *coefficient)
{
  int terms = n;
  for (int i = 0; i < n; i++) {
    const ed_in_plan of = ed_of_master(model, degree[i]);
    degree[i] = of.degree;
    if (of.turn < 0)
      continue;
    degree[terms] = of.turn;
    coefficient[terms++] = of.lever * coefficient[i];
  }
  return terms;
}

int ed_model_mass(ed_model *model, int node, const double *mass)
{
  if (ed_model_lacks_node(model, node))
    return ED_E_ID;
  for (int d = 0; d < ed_degrees(model); d++) {
    if (!(mass[d] >= 0.0) || !isfinite(mass[d]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: masses must not be negative", model->nodes[node].name);
    if (!isfinite(model->nodes[node].mass[d] + mass[d]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: the sum of its masses is not a finite number", model->nodes[node].name);
  }
  for (int d = 0; d < ed_degrees(model); d++)
    model->nodes[node].mass[d] += mass[d];
  return ED_OK;
}
