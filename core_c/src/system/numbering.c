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
  const int degrees = 3 * model->n_nodes;
  a->equation = malloc(((size_t)degrees + 1) * sizeof *a->equation);
  if (!a->equation)
    return ED_E_MEMORY;
  for (int i = 0; i < degrees; i++)
    a->equation[i] = 0;
  /* a support at any of the tied degrees holds them all */
  for (int i = 0; i < degrees; i++)
    if (model->nodes[i / 3].fixed[i % 3])
      a->equation[root(model, i)] = -1;
  int n = 0;
  for (int i = 0; i < degrees; i++)
    if (root(model, i) == i && a->equation[i] == 0)
      a->equation[i] = n++;
  a->support = malloc(((size_t)degrees + 1) * sizeof *a->support);
  if (!a->support)
    return ED_E_MEMORY;
  for (int i = 0; i < degrees; i++)
    a->support[i] = a->equation[root(model, i)] < 0 && root(model, i) == i ? a->n_supports++ : -1;
  for (int i = 0; i < degrees; i++) {
    a->equation[i] = a->equation[root(model, i)];
    a->support[i] = a->support[root(model, i)];
  }
  a->n = n;
  if (n == 0)
    return ed_fail(a, ED_E_EMPTY, "the structure has no free degree of freedom");
  a->mass = calloc((size_t)n, sizeof *a->mass);
  a->rotational = calloc((size_t)n, sizeof *a->rotational);
  a->name = calloc((size_t)n, sizeof *a->name);
  a->influence[0] = calloc((size_t)n, sizeof(double));
  a->influence[1] = calloc((size_t)n, sizeof(double));
  if (!a->mass || !a->rotational || !a->name || !a->influence[0] || !a->influence[1])
    return ED_E_MEMORY;
  for (int i = degrees - 1; i >= 0; i--) { /* downwards: the first degree gives the name */
    const int equation = a->equation[i], d = i % 3;
    if (equation < 0)
      continue;
    a->mass[equation] += model->nodes[i / 3].mass[d];
    a->rotational[equation] = d == 2;
    a->name[equation] = i;
    if (d < 2)
      a->influence[d][equation] = 1.0;
  }
  for (int i = 0; i < n; i++)
    if (!isfinite(a->mass[i])) {
      char name[ED_NAME + 8];
      return ed_fail(a, ED_E_NOT_FINITE, "the sum of the masses at %s is not a finite number", ed_equation_name(a, i, name, sizeof name));
    }
  return ED_OK;
}

const char *ed_equation_name(const ed_analysis *a, int equation, char *buffer, int size)
{
  static const char *const degree[] = {"ux", "uy", "rz"};
  if (equation < 0 || equation >= a->n)
    snprintf(buffer, (size_t)size, "?");
  else
    snprintf(buffer, (size_t)size, "%s.%s", a->model->nodes[a->name[equation] / 3].name, degree[a->name[equation] % 3]);
  return buffer;
}
