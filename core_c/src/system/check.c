/* Structures that cannot stand are refused before the first analysis, by name. */
#include "system/analysis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAMED = 8 }; /* degrees in a message */
/* Smallest |pivot| / |diagonal term| of a structure that stands; of a mechanism only the rounding of a sum is left, 1e-16 a term. */
static const double LEAST_PIVOT = 1e-12;
/* What makes a mechanism's matrix regular: a share of each diagonal term, well above its rounding, and one of the largest term for
 * degrees that have no stiffness at all. */
static const double STIFFENING = 1e-9, STIFFENING_OF_NONE = 1e-18;

static int find(int *parent, int i)
{
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

/* Every node must reach a support through elements or ties. */
static int check_connected(ed_analysis *a)
{
  const ed_model *model = a->model;
  const int n = model->n_nodes;
  int *parent = malloc(((size_t)n + 1) * sizeof *parent);
  if (!parent)
    return ed_fail(a, ED_E_MEMORY, "out of memory");
  for (int i = 0; i <= n; i++) /* n: the ground */
    parent[i] = i;
  for (int m = 0; m < model->n_members; m++)
    parent[find(parent, model->members[m].node[0])] = find(parent, model->members[m].node[1]);
  for (int i = 0; i < n; i++)
    for (int d = 0; d < ed_degrees(model); d++) {
      if (model->nodes[i].fixed[d])
        parent[find(parent, i)] = find(parent, n);
      if (model->nodes[i].master[d] >= 0)
        parent[find(parent, i)] = find(parent, model->nodes[i].master[d]);
    }
  char names[400] = "";
  int lost = 0;
  for (int i = 0; i < n; i++)
    if (find(parent, i) != find(parent, n)) {
      const size_t used = strlen(names);
      if (lost < 12)
        snprintf(names + used, sizeof names - used, "%s%s", lost ? ", " : "", model->nodes[i].name);
      lost++;
    }
  free(parent);
  if (lost == 0)
    return ED_OK;
  return ed_fail(a, ED_E_DISCONNECTED, "%d node%s not connected to any support: %s%s", lost, lost == 1 ? " is" : "s are",
                 names, lost > 12 ? ", ..." : "");
}

/* The degrees that move most in the softest motion, by inverse iteration on a slightly stiffened matrix. */
void ed_name_mechanism(ed_analysis *a, char *buffer, int size)
{
  const int n = a->numbering.n;
  const ed_numbering *numbering = &a->numbering;
  buffer[0] = '\0';
  ed_keep_factors(a);
  a->factors.stamp = -1; /* the factors are of another matrix from here on */
  double largest = 0.0; /* gives degrees without any stiffness some */
  for (int i = 0; i < n; i++)
    largest = fmax(largest, fabs(a->matrix.tangent[a->matrix.diagonal[i]]) /
                                (numbering->rotational[i] ? numbering->length * numbering->length : 1.0));
  if (largest == 0.0) /* none has any */
    largest = 1.0;
  memcpy(a->factors.effective, a->matrix.tangent, (size_t)a->matrix.nnz * sizeof(double));
  ed_add_device_tangent(a, 1.0, a->factors.effective);
  for (int i = 0; i < n; i++) {
    const double scale = numbering->rotational[i] ? numbering->length * numbering->length : 1.0;
    a->factors.effective[a->matrix.diagonal[i]] +=
        STIFFENING * fabs(a->matrix.tangent[a->matrix.diagonal[i]]) + STIFFENING_OF_NONE * largest * scale;
  }
  int repivoted;
  if (ed_solver_factor(a->factors.solver, a->factors.effective, &repivoted) != ED_OK)
    return;
  double *x = a->iteration.work;
  for (int i = 0; i < n; i++)
    x[i] = (1.0 + 0.1 * ((i * 7) % 11)) / (numbering->rotational[i] ? numbering->length : 1.0);
  for (int iteration = 0; iteration < 6; iteration++) {
    if (ed_solver_solve(a->factors.solver, x, 1) != ED_OK)
      return;
    double norm = 0.0;
    for (int i = 0; i < n; i++)
      norm = fmax(norm, fabs(x[i]) * (numbering->rotational[i] ? numbering->length : 1.0));
    for (int i = 0; norm > 0.0 && i < n; i++)
      x[i] /= norm;
  }
  int moving = 0;
  for (int i = 0; i < n; i++) {
    char name[ED_NAME + 8];
    if (fabs(x[i]) * (numbering->rotational[i] ? numbering->length : 1.0) < 0.5)
      continue;
    const size_t used = strlen(buffer);
    if (moving++ < NAMED)
      snprintf(buffer + used, (size_t)size - used, "%s%s", moving > 1 ? ", " : "",
               ed_equation_name(a->model, numbering, i, name, sizeof name));
  }
  const size_t used = strlen(buffer);
  if (moving > NAMED)
    snprintf(buffer + used, (size_t)size - used, " and %d more", moving - NAMED);
}

int ed_check_structure(ed_analysis *a)
{
  int status = check_connected(a);
  if (status != ED_OK)
    return status;
  ed_assemble_tangent(a);
  const double *matrix = a->matrix.tangent;
  if ((status = ed_first_slopes(a)) != ED_OK)
    return status;
  if (ed_installed(a)) {
    memcpy(a->factors.effective, a->matrix.tangent, (size_t)a->matrix.nnz * sizeof(double));
    ed_add_device_tangent(a, 1.0, a->factors.effective);
    matrix = a->factors.effective;
  }
  int repivoted;
  const int factored = ed_solver_factor(a->factors.solver, matrix, &repivoted);
  if (factored == ED_E_MEMORY || (factored == ED_OK && ed_solver_pivot_ratio(a->factors.solver) > LEAST_PIVOT))
    return factored;
  char names[400];
  ed_name_mechanism(a, names, sizeof names);
  return ed_fail(a, ED_E_MECHANISM, "the structure is a mechanism; it moves freely at %s", names);
}
