/* Models of plane frames: materials, sections, nodes, and what all parts of a model share. */
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

int ed_model_elastic_section(ed_model *model, double EA, double EI)
{
  if (!(EA > 0.0 && EI > 0.0 && isfinite(EA) && isfinite(EI)))
    return ed_model_refuse(model, ED_E_ARGUMENT, "section: EA %g and EI %g must be positive", EA, EI);
  ED_MODEL_APPEND(model, sections, n_sections);
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
  ED_MODEL_APPEND(model, sections, n_sections);
  ed_section *section = &model->sections[model->n_sections - 1];
  if (!ed_section_from_fibres(section, n, y, area, material, model->materials)) {
    model->n_sections--;
    return ed_model_refuse(model, ED_E_MEMORY, "out of memory");
  }
  /* relative, it is variance / (mean square) of the depths: fibres must spread over a millionth of their distance from the axis */
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
  ED_MODEL_APPEND(model, nodes, n_nodes);
  ed_node *node = &model->nodes[model->n_nodes - 1];
  ed_copy_name(node->name, name);
  node->x = x;
  node->y = y;
  for (int d = 0; d < 3; d++)
    node->master[d] = -1;
  return model->n_nodes - 1;
}

int ed_model_fix(ed_model *model, int node, int ux, int uy, int rz)
{
  if (ed_model_lacks_node(model, node))
    return ED_E_ID;
  const int fixed[3] = {ux, uy, rz};
  for (int d = 0; d < 3; d++)
    model->nodes[node].fixed[d] |= fixed[d] != 0;
  return ED_OK;
}

int ed_model_tie(ed_model *model, int node, int master, int ux, int uy, int rz)
{
  if (ed_model_lacks_node(model, node) || ed_model_lacks_node(model, master))
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
  if (ed_model_lacks_node(model, node))
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
