/* Loads of a model, by patterns. */
#include "system/model.h"

#include <math.h>
#include <string.h>

int ed_model_pattern(ed_model *model)
{
  return model->n_patterns++;
}

int ed_model_nodal_load(ed_model *model, int pattern, int node, const double *force)
{
  if (pattern < 0 || pattern >= model->n_patterns)
    return ed_model_refuse(model, ED_E_ID, "there is no load pattern %d", pattern);
  if (ed_model_lacks_node(model, node))
    return ED_E_ID;
  for (int d = 0; d < ed_degrees(model); d++)
    if (!isfinite(force[d]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: a load is not a finite number", model->nodes[node].name);
  ED_MODEL_APPEND(model, nodal_loads, n_nodal_loads);
  ed_nodal_load *load = &model->nodal_loads[model->n_nodal_loads - 1];
  load->pattern = pattern;
  load->node = node;
  memcpy(load->force, force, (size_t)ed_degrees(model) * sizeof *force);
  return ED_OK;
}

/* across, across_end: along y, in space along z too */
static int member_load(ed_model *model, int pattern, int element, ed_member_load load, const double *across, const double *across_end)
{
  if (pattern < 0 || pattern >= model->n_patterns)
    return ed_model_refuse(model, ED_E_ID, "there is no load pattern %d", pattern);
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  ed_member *m = &model->members[element];
  if (m->kind != ED_FIBRE_BEAM && m->kind != ED_ELASTIC_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is no beam-column and takes no load", m->name);
  for (int i = 0; i < model->dimension - 1; i++) {
    load.transverse[i] = across[i];
    load.transverse_end[i] = across_end ? across_end[i] : 0.0;
    if (!isfinite(load.axial + load.transverse[i] + load.transverse_end[i]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load is not a finite number", m->name);
  }
  ED_MODEL_APPEND(model, member_loads, n_member_loads);
  load.pattern = pattern;
  load.element = element;
  model->member_loads[model->n_member_loads - 1] = load;
  m->loaded = 1;
  return ED_OK;
}

int ed_model_uniform_load(ed_model *model, int pattern, int element, double axial, const double *transverse)
{
  return member_load(model, pattern, element, (ed_member_load){.position = -1.0, .axial = axial}, transverse, NULL);
}

int ed_model_point_load(ed_model *model, int pattern, int element, double position, double axial, const double *transverse)
{
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  if (!(position >= 0.0 && position <= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load at %g of its length is not on it",
                  model->members[element].name, position);
  return member_load(model, pattern, element, (ed_member_load){.position = position, .axial = axial}, transverse, NULL);
}

int ed_model_partial_load(ed_model *model, int pattern, int element, double start, double end, const double *at_start,
                          const double *at_end)
{
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  if (!(start >= 0.0 && start < end && end <= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load from %g to %g of its length is not on it",
                  model->members[element].name, start, end);
  return member_load(model, pattern, element, (ed_member_load){.position = start, .end = end}, at_start, at_end);
}
