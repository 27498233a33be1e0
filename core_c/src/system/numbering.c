#include "system/analysis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Follows ties to the degree that is kept. */
static int root(const ed_model *model, int degree)
{
  const int degrees = ed_degrees(model), d = degree % degrees;
  int node = degree / degrees;
  while (model->nodes[node].master[d] >= 0)
    node = model->nodes[node].master[d];
  return degrees * node + d;
}

/* What the rounding of a centre may leave of a first moment, as a share of the sum of its parts; the mass matrix leaves it out. */
static const double OFF_CENTRE = 1e-9;

/* How displacements go with the masters of diaphragms, and masses with them: a master stands at the centre of mass of its diaphragm, so that
 * the mass matrix stays diagonal. */
static int number_diaphragms(ed_analysis *a)
{
  const ed_model *model = a->model;
  ed_numbering *numbering = &a->numbering;
  int any = 0;
  for (int i = 0; i < model->n_nodes; i++)
    any |= model->nodes[i].diaphragm;
  if (!any)
    return ED_OK;
  numbering->plan = malloc((size_t)numbering->degrees * sizeof *numbering->plan);
  double *about = calloc(3 * (size_t)numbering->n, sizeof *about); /* first moments of m_x and m_y, of equations that turn; and their sizes */
  if (!numbering->plan || !about) {
    free(about);
    return ED_E_MEMORY;
  }
  for (int i = 0; i < numbering->degrees; i++) {
    const ed_in_plan of = numbering->plan[i] = ed_of_master(model, i);
    const int turn = of.turn < 0 ? -1 : numbering->equation[of.turn];
    if (of.degree != i && numbering->equation[of.degree] >= 0) /* named after the master, whichever node comes first */
      numbering->name[numbering->equation[of.degree]] = of.degree;
    const double mass = model->nodes[i / ed_degrees(model)].mass[i % ed_degrees(model)];
    if (turn < 0)
      continue;
    numbering->mass[turn] += mass * of.lever * of.lever;
    about[3 * turn + i % ed_degrees(model)] += mass * of.lever;
    about[3 * turn + 2] += mass * fabs(of.lever);
  }
  int status = ED_OK;
  for (int i = 0; status == ED_OK && i < numbering->n; i++)
    if (fabs(about[3 * i]) + fabs(about[3 * i + 1]) > OFF_CENTRE * about[3 * i + 2])
      status = ed_fail(a, ED_E_ARGUMENT, "the master %s of a diaphragm does not stand at the centre of its masses",
                       model->nodes[numbering->name[i] / ed_degrees(model)].name);
  free(about);
  return status;
}

int ed_number(ed_analysis *a)
{
  const ed_model *model = a->model;
  ed_numbering *numbering = &a->numbering;
  const int of_node = ed_degrees(model), degrees = numbering->degrees = of_node * model->n_nodes;
  numbering->equation = malloc(((size_t)degrees + 1) * sizeof *numbering->equation);
  if (!numbering->equation)
    return ED_E_MEMORY;
  for (int i = 0; i < degrees; i++)
    numbering->equation[i] = 0;
  /* a support at any of the tied degrees supports them all */
  for (int i = 0; i < degrees; i++)
    if (model->nodes[i / of_node].fixed[i % of_node])
      numbering->equation[root(model, i)] = -1;
  int n = 0;
  for (int i = 0; i < degrees; i++)
    if (root(model, i) == i && numbering->equation[i] == 0)
      numbering->equation[i] = n++;
  numbering->support = malloc(((size_t)degrees + 1) * sizeof *numbering->support);
  if (!numbering->support)
    return ED_E_MEMORY;
  for (int i = 0; i < degrees; i++)
    numbering->support[i] = numbering->equation[root(model, i)] < 0 && root(model, i) == i ? numbering->n_supports++ : -1;
  for (int i = 0; i < degrees; i++) {
    numbering->equation[i] = numbering->equation[root(model, i)];
    numbering->support[i] = numbering->support[root(model, i)];
  }
  numbering->n = n;
  if (n == 0)
    return ed_fail(a, ED_E_EMPTY, "the structure has no free degree of freedom");
  numbering->mass = calloc((size_t)n, sizeof *numbering->mass);
  numbering->rotational = calloc((size_t)n, sizeof *numbering->rotational);
  numbering->name = calloc((size_t)n, sizeof *numbering->name);
  if (!numbering->mass || !numbering->rotational || !numbering->name)
    return ED_E_MEMORY;
  for (int axis = 0; axis < model->dimension; axis++)
    if (!(numbering->influence[axis] = calloc((size_t)n, sizeof(double))))
      return ED_E_MEMORY;
  for (int i = degrees - 1; i >= 0; i--) { /* downwards: the first degree gives the name */
    const int equation = numbering->equation[i], d = i % of_node;
    if (equation < 0)
      continue;
    numbering->mass[equation] += model->nodes[i / of_node].mass[d];
    numbering->rotational[equation] = ed_is_rotation(model, d);
    numbering->name[equation] = i;
    if (d < model->dimension)
      numbering->influence[d][equation] = 1.0;
  }
  const int status = number_diaphragms(a);
  if (status != ED_OK)
    return status;
  for (int i = 0; i < n; i++)
    if (!isfinite(numbering->mass[i])) {
      char name[ED_NAME + 8];
      return ed_fail(a, ED_E_NOT_FINITE, "the sum of the masses at %s is not a finite number",
                     ed_equation_name(model, numbering, i, name, sizeof name));
    }
  return ED_OK;
}

int ed_set_length(ed_numbering *numbering, double length)
{
  numbering->length = length;
  numbering->scale = calloc((size_t)numbering->n, sizeof *numbering->scale);
  if (!numbering->scale)
    return ED_E_MEMORY;
  for (int i = 0; i < numbering->n; i++)
    numbering->scale[i] = numbering->rotational[i] ? 1.0 / length : 1.0;
  return ED_OK;
}

void ed_numbering_free(ed_numbering *numbering)
{
  free(numbering->equation);
  free(numbering->support);
  free(numbering->mass);
  free(numbering->influence[0]);
  free(numbering->influence[1]);
  free(numbering->influence[2]);
  free(numbering->plan);
  free(numbering->rotational);
  free(numbering->scale);
  free(numbering->name);
}

const char *ed_equation_name(const ed_model *model, const ed_numbering *numbering, int equation, char *buffer, int size)
{
  if (equation < 0 || equation >= numbering->n)
    snprintf(buffer, (size_t)size, "?");
  else
    snprintf(buffer, (size_t)size, "%s.%s", model->nodes[numbering->name[equation] / ed_degrees(model)].name,
             ed_degree_name(model, numbering->name[equation]));
  return buffer;
}
