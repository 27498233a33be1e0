/* Loads of a model, by patterns. */
#include "system/model.h"

#include <math.h>
#include <string.h>

int ed_model_pattern(ed_model *model)
{
  return model->n_patterns++;
}

int ed_model_nodal_load(ed_model *model, int pattern, int node, double fx, double fy, double mz)
{
  if (pattern < 0 || pattern >= model->n_patterns)
    return ed_model_refuse(model, ED_E_ID, "there is no load pattern %d", pattern);
  if (ed_model_lacks_node(model, node))
    return ED_E_ID;
  if (!isfinite(fx + fy + mz))
    return ed_model_refuse(model, ED_E_ARGUMENT, "node %s: a load is not a finite number", model->nodes[node].name);
  ED_MODEL_APPEND(model, nodal_loads, n_nodal_loads);
  model->nodal_loads[model->n_nodal_loads - 1] = (ed_nodal_load){pattern, node, {fx, fy, mz}};
  return ED_OK;
}

static int member_load(ed_model *model, int pattern, int element, ed_member_load load)
{
  if (pattern < 0 || pattern >= model->n_patterns)
    return ed_model_refuse(model, ED_E_ID, "there is no load pattern %d", pattern);
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  ed_member *m = &model->members[element];
  if (m->kind != ED_FIBRE_BEAM && m->kind != ED_ELASTIC_BEAM)
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s is no beam-column and takes no load", m->name);
  if (!isfinite(load.axial + load.transverse + load.transverse_end))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load is not a finite number", m->name);
  ED_MODEL_APPEND(model, member_loads, n_member_loads);
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
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  if (!(position >= 0.0 && position <= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load at %g of its length is not on it",
                  model->members[element].name, position);
  return member_load(model, pattern, element, (ed_member_load){.position = position, .axial = axial, .transverse = transverse});
}

int ed_model_partial_load(ed_model *model, int pattern, int element, double start, double end, double at_start, double at_end)
{
  if (ed_model_lacks_element(model, element))
    return ED_E_ID;
  if (!(start >= 0.0 && start < end && end <= 1.0))
    return ed_model_refuse(model, ED_E_ARGUMENT, "element %s: a load from %g to %g of its length is not on it",
                  model->members[element].name, start, end);
  return member_load(model, pattern, element,
                     (ed_member_load){.position = start, .transverse = at_start, .end = end, .transverse_end = at_end});
}
