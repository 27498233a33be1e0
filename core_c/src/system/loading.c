#include "system/loading.h"

#include "system/analysis.h"

#include <stdlib.h>
#include <string.h>

int ed_loading_allocate(ed_loading *loading, const ed_model *model, int n)
{
  const size_t patterns = (size_t)model->n_patterns + 1;
  loading->factors = calloc(patterns, sizeof(double));
  loading->factors_committed = calloc(patterns, sizeof(double));
  loading->factors_backup = calloc(patterns, sizeof(double));
  loading->external = calloc((size_t)n, sizeof(double));
  loading->external_committed = calloc((size_t)n, sizeof(double));
  loading->member_committed = calloc((size_t)model->n_members + 1, sizeof *loading->member_committed);
  return loading->factors && loading->factors_committed && loading->factors_backup && loading->external &&
                 loading->external_committed && loading->member_committed
             ? ED_OK
             : ED_E_MEMORY;
}

void ed_loading_free(ed_loading *loading)
{
  free(loading->factors);
  free(loading->factors_committed);
  free(loading->factors_backup);
  free(loading->external);
  free(loading->external_committed);
  free(loading->member_committed);
}

void ed_set_factors(ed_analysis *a)
{
  const ed_model *model = a->model;
  memset(a->loading.external, 0, (size_t)a->numbering.n * sizeof *a->loading.external);
  for (int i = 0; i < model->n_nodal_loads; i++) {
    const ed_nodal_load *load = &model->nodal_loads[i];
    for (int d = 0; d < ed_degrees(model); d++)
      ed_add_at_degree(&a->numbering, ed_degrees(model) * load->node + d, a->loading.factors[load->pattern] * load->force[d],
                       a->loading.external, NULL);
  }
  for (int m = 0; m < model->n_members; m++)
    if (model->members[m].loaded)
      ed_element_clear_loads(&a->members.element[m]);
  for (int i = 0; i < model->n_member_loads; i++) {
    const ed_member_load *load = &model->member_loads[i];
    ed_element *e = &a->members.element[load->element];
    (e->rigid ? ed_rigid_add_load : ed_element_add_load)(e, load, a->loading.factors[load->pattern]);
  }
  for (int m = 0; m < model->n_members; m++)
    if (model->members[m].loaded)
      ed_element_finish_loads(&a->members.element[m]);
}

void ed_remember_loads(ed_analysis *a)
{
  memcpy(a->loading.external_committed, a->loading.external, (size_t)a->numbering.n * sizeof(double));
  for (int m = 0; m < a->model->n_members; m++) {
    ed_member_loads *loads = &a->loading.member_committed[m];
    const size_t points = (size_t)a->members.element[m].points; /* far fewer than there may be */
    memcpy(loads->section_load, a->members.element[m].section_load, points * sizeof *loads->section_load);
    memcpy(loads->end_load, a->members.element[m].end_load, sizeof loads->end_load);
    memcpy(loads->arm_force, a->members.element[m].arm_force, sizeof loads->arm_force);
    memcpy(loads->arm_moment, a->members.element[m].arm_moment, sizeof loads->arm_moment);
    loads->mean_axial = a->members.element[m].mean_axial;
    memcpy(loads->free_deformation, a->members.element[m].free_deformation, sizeof loads->free_deformation);
  }
}
