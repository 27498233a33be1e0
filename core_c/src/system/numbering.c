#include "system/analysis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Follows ties to the degree that is kept. */
static int root(const ed_model *model, int degree)
{
  const int d = degree % 3;
  int node = degree / 3;
  while (model->nodes[node].master[d] >= 0)
    node = model->nodes[node].master[d];
  return 3 * node + d;
}

int ed_number(ed_analysis *a)
{
  const ed_model *model = a->model;
  ed_numbering *numbering = &a->numbering;
  const int degrees = 3 * model->n_nodes;
  numbering->equation = malloc(((size_t)degrees + 1) * sizeof *numbering->equation);
  if (!numbering->equation)
    return ED_E_MEMORY;
  for (int i = 0; i < degrees; i++)
    numbering->equation[i] = 0;
  /* a support at any of the tied degrees supports them all */
  for (int i = 0; i < degrees; i++)
    if (model->nodes[i / 3].fixed[i % 3])
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
  numbering->influence[0] = calloc((size_t)n, sizeof(double));
  numbering->influence[1] = calloc((size_t)n, sizeof(double));
  if (!numbering->mass || !numbering->rotational || !numbering->name || !numbering->influence[0] || !numbering->influence[1])
    return ED_E_MEMORY;
  for (int i = degrees - 1; i >= 0; i--) { /* downwards: the first degree gives the name */
    const int equation = numbering->equation[i], d = i % 3;
    if (equation < 0)
      continue;
    numbering->mass[equation] += model->nodes[i / 3].mass[d];
    numbering->rotational[equation] = d == 2;
    numbering->name[equation] = i;
    if (d < 2)
      numbering->influence[d][equation] = 1.0;
  }
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
  free(numbering->rotational);
  free(numbering->scale);
  free(numbering->name);
}

const char *ed_equation_name(const ed_model *model, const ed_numbering *numbering, int equation, char *buffer, int size)
{
  static const char *const degree[] = {"ux", "uy", "rz"};
  if (equation < 0 || equation >= numbering->n)
    snprintf(buffer, (size_t)size, "?");
  else
    snprintf(buffer, (size_t)size, "%s.%s", model->nodes[numbering->name[equation] / 3].name, degree[numbering->name[equation] % 3]);
  return buffer;
}
