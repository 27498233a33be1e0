#include "system/members.h"

#include "system/analysis.h"

#include <stdlib.h>
#include <string.h>

int ed_members_allocate(ed_analysis *a)
{
  const ed_model *model = a->model;
  const size_t degrees = (size_t)a->numbering.degrees;
  ed_members *members = &a->members;
  members->element = calloc((size_t)model->n_members + 1, sizeof *members->element);
  members->displacement = calloc(degrees, sizeof(double));
  members->resisting = calloc(degrees, sizeof(double));
  members->force = calloc(2 * (size_t)ed_degrees(model) * (size_t)model->n_members + 1, sizeof(double));
  if (!members->element || !members->displacement || !members->resisting || !members->force)
    return ED_E_MEMORY;
  for (int m = 0; m < model->n_members; m++) {
    const int status = ed_element_setup(&members->element[m], model, m);
    if (status == ED_E_NOT_FINITE)
      return ed_fail(a, ED_E_NOT_FINITE, "element %s: its length or stiffness is not a finite number", model->members[m].name);
    if (status != ED_OK)
      return status;
    members->n_struts += members->element[m].kind == ED_STRUT;
  }
  return ED_OK;
}

void ed_members_free(ed_members *members, int n)
{
  for (int m = 0; members->element && m < n; m++)
    ed_element_clear(&members->element[m]);
  free(members->element);
  free(members->displacement);
  free(members->resisting);
  free(members->force);
}

/* Forces of one element at its present state, added to those at the degrees. */
static void add_forces(ed_analysis *a, int m, const double *d)
{
  const ed_element *e = &a->members.element[m];
  double *force = ed_member_force(&a->members, m);
  ed_element_forces(e, d, a->trial.elements + e->state, force);
  for (int i = 0; i < e->degrees; i++)
    a->members.resisting[e->dof[i]] += force[i];
}

static void clear_forces(ed_analysis *a)
{
  for (int i = 0; i < a->numbering.degrees; i++)
    a->members.displacement[i] = ed_displacement(&a->numbering, &a->trial, i);
  memset(a->members.resisting, 0, (size_t)a->numbering.degrees * sizeof *a->members.resisting);
}

static void sum_forces(ed_analysis *a)
{
  ed_add_device_forces(a);
  memset(a->trial.resisting, 0, (size_t)a->numbering.n * sizeof *a->trial.resisting);
  memset(a->trial.support_force, 0, (size_t)a->numbering.n_supports * sizeof *a->trial.support_force);
  for (int i = 0; i < a->numbering.degrees; i++)
    ed_add_at_degree(&a->numbering, i, a->members.resisting[i], a->trial.resisting, a->trial.support_force);
  a->matrix.stamp++;
}

static int update_members(ed_analysis *a)
{
  clear_forces(a);
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->members.element[m];
    if (ed_watch_step(&a->watch))
      return ED_E_STOPPED;
    double d[ED_MAX_DEGREES];
    ed_gather(&a->members, m, d);
    const int status = ed_element_update(e, d, a->storage.layers + e->layers, a->trial.elements + e->state, &a->members.control);
    if (status != ED_OK) {
      a->members.failed = m;
      return status;
    }
    add_forces(a, m, d);
  }
  return ED_OK;
}

int ed_update_members(ed_analysis *a)
{
  const int status = update_members(a);
  if (status == ED_OK)
    sum_forces(a);
  return status;
}

int ed_update_elements(ed_analysis *a)
{
  int status = update_members(a);
  if (status == ED_OK)
    status = ed_update_devices(a, 0);
  if (status == ED_OK)
    sum_forces(a);
  return status;
}

void ed_collect_forces(ed_analysis *a)
{
  clear_forces(a);
  for (int m = 0; m < a->model->n_members; m++) {
    double d[ED_MAX_DEGREES];
    ed_gather(&a->members, m, d);
    add_forces(a, m, d);
  }
  sum_forces(a);
}
