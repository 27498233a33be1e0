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

/* Forces of one element at its present state, added to those at its degrees. */
ED_INLINE void add_forces(ed_analysis *a, int m, const double *d, const int degrees)
{
  const ed_element *e = &a->members.element[m];
  double *force = a->members.force + degrees * m, *resisting = a->members.resisting;
  ed_element_forces(e, d, a->trial.elements + e->state, force);
  for (int i = 0; i < degrees; i++)
    resisting[e->dof[i]] += force[i];
}

static void clear_forces(ed_analysis *a)
{
  const ed_numbering *numbering = &a->numbering;
  double *displacement = a->members.displacement;
  if (numbering->plan)
    for (int i = 0; i < numbering->degrees; i++)
      displacement[i] = ed_displacement(numbering, &a->trial, i);
  else
    for (int i = 0; i < numbering->degrees; i++)
      displacement[i] = *ed_at_equation(numbering, a->trial.u, a->trial.support_u, i);
  memset(a->members.resisting, 0, (size_t)a->numbering.degrees * sizeof *a->members.resisting);
}

static void sum_forces(ed_analysis *a)
{
  ed_add_device_forces(a);
  memset(a->trial.resisting, 0, (size_t)a->numbering.n * sizeof *a->trial.resisting);
  memset(a->trial.support_force, 0, (size_t)a->numbering.n_supports * sizeof *a->trial.support_force);
  const ed_numbering *numbering = &a->numbering;
  const double *resisting = a->members.resisting;
  if (numbering->plan)
    for (int i = 0; i < numbering->degrees; i++)
      ed_add_at_degree(numbering, i, resisting[i], a->trial.resisting, a->trial.support_force);
  else
    for (int i = 0; i < numbering->degrees; i++)
      *ed_at_equation(numbering, a->trial.resisting, a->trial.support_force, i) += resisting[i];
  a->matrix.stamp++;
}

/* The loops over members are written for both dimensions, with the degrees of a member as a constant. */
ED_INLINE int update_all(ed_analysis *a, const int degrees)
{
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->members.element[m];
    if (ed_watch_step(&a->watch))
      return ED_E_STOPPED;
    double d[ED_MAX_DEGREES];
    ed_gather_some(&a->members, m, d, degrees);
    const int status = ed_element_update(e, d, a->storage.layers + e->layers, a->trial.elements + e->state, &a->members.control);
    if (status != ED_OK) {
      a->members.failed = m;
      return status;
    }
    add_forces(a, m, d, degrees);
  }
  return ED_OK;
}

static int update_members(ed_analysis *a)
{
  clear_forces(a);
  return a->model->dimension == 2 ? update_all(a, 6) : update_all(a, ED_MAX_DEGREES);
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

ED_INLINE void collect_all(ed_analysis *a, const int degrees)
{
  for (int m = 0; m < a->model->n_members; m++) {
    double d[ED_MAX_DEGREES];
    ed_gather_some(&a->members, m, d, degrees);
    add_forces(a, m, d, degrees);
  }
}

void ed_collect_forces(ed_analysis *a)
{
  clear_forces(a);
  if (a->model->dimension == 2)
    collect_all(a, 6);
  else
    collect_all(a, ED_MAX_DEGREES);
  sum_forces(a);
}
