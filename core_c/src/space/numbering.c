/* Degrees get their equations; what hangs in the air is refused by name. */
#include "space/space.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAMED = 12 }; /* nodes in a message */

static const char *const DIRECTION[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
static const int OF_FLOOR[] = {0, 1, -1, -1, -1, 2}; /* which of Ux, Uy, Rz of the master a degree follows */

static int find(int *parent, int i)
{
  while (parent[i] != i)
    i = parent[i] = parent[parent[i]];
  return i;
}

int ed_space_check_connected(ed_space *s)
{
  const int ground = s->n_nodes;
  int *parent = malloc(((size_t)ground + 1) * sizeof *parent);
  if (!parent)
    return ED_E_MEMORY;
  for (int i = 0; i <= ground; i++)
    parent[i] = i;
  for (int m = 0; m < s->n_members; m++)
    parent[find(parent, s->member[m].node[0])] = find(parent, s->member[m].node[1]);
  for (int i = 0; i < ground; i++) {
    if (s->node[i].floor >= 0)
      parent[find(parent, i)] = find(parent, s->floor[s->node[i].floor].first);
    for (int d = 0; d < 6; d++)
      if (s->node[i].fixed[d] || s->node[i].spring[d] > 0.0)
        parent[find(parent, i)] = find(parent, ground);
  }
  char names[NAMED * (ED_SPACE_NAME + 2)] = "";
  int lost = 0;
  for (int i = 0; i < ground; i++)
    if (find(parent, i) != find(parent, ground) && lost++ < NAMED) {
      const size_t used = strlen(names);
      snprintf(names + used, sizeof names - used, "%s%s", lost > 1 ? ", " : "", s->node[i].name);
    }
  free(parent);
  if (lost == 0)
    return ED_OK;
  return ed_space_fail(s, ED_E_DISCONNECTED, "%d node%s not connected to any support: %s%s", lost, lost == 1 ? " is" : "s are", names,
                       lost > NAMED ? ", ..." : "");
}

/* Marks in `left_out` rotations that neither members nor springs resist, and uz of nodes of floors where no member ends. */
static void find_idle(ed_space *s)
{
  for (int i = 0; i < s->n_nodes; i++) {
    ed_space_node *node = &s->node[i];
    for (int d = 0; d < 6; d++)
      node->left_out[d] = d >= 3 || (d == 2 && node->floor >= 0);
  }
  for (int m = 0; m < s->n_members; m++) {
    double matrix[144];
    ed_member_matrix(&s->member[m], &s->member[m].stiffness, matrix);
    for (int e = 0; e < 2; e++) {
      ed_space_node *node = &s->node[s->member[m].node[e]];
      node->left_out[2] = 0;
      for (int d = 3; d < 6; d++)
        if (matrix[13 * (6 * e + d)] > 0.0)
          node->left_out[d] = 0;
    }
  }
  for (int i = 0; i < s->n_nodes; i++)
    for (int d = 0; d < 6; d++)
      if (s->node[i].spring[d] > 0.0 || s->node[i].fixed[d] || (s->node[i].floor >= 0 && OF_FLOOR[d] >= 0))
        s->node[i].left_out[d] = 0;
}

/* Which supports at nodes of a floor restrain its master. */
static int restrain_floors(ed_space *s)
{
  static const int order[] = {5, 0, 1}; /* rz first: it decides for the others */
  for (int pass = 0; pass < 3; pass++)
    for (int i = 0; i < s->n_nodes; i++) {
      const ed_space_node *node = &s->node[i];
      const int d = order[pass];
      if (node->floor < 0 || !node->fixed[d])
        continue;
      ed_space_floor *floor = &s->floor[node->floor];
      if (d < 2 && floor->support[2] < 0 && (d == 0 ? node->dy : node->dx) != 0.0)
        return ed_space_fail(s, ED_E_ARGUMENT,
                             "node %s of a diaphragm is restrained in %s away from its master; restrain its rz as well, put the master on its "
                             "line, or use a spring",
                             node->name, DIRECTION[d]);
      int *support = &floor->support[OF_FLOOR[d]];
      *support = *support < 0 ? i : *support;
    }
  return ED_OK;
}

int ed_space_number(ed_space *s)
{
  s->name = malloc((6 * (size_t)s->n_nodes + 3 * (size_t)s->n_floors + 1) * sizeof *s->name);
  if (!s->name)
    return ED_E_MEMORY;
  find_idle(s);
  const int status = restrain_floors(s);
  if (status != ED_OK)
    return status;
  int n = 0;
  for (int i = 0; i < s->n_nodes; i++) {
    ed_space_node *node = &s->node[i];
    for (int d = 0; d < 6; d++) {
      const int follows = node->floor >= 0 && OF_FLOOR[d] >= 0;
      node->equation[d] = -1;
      if (follows || node->fixed[d] || node->left_out[d])
        continue;
      s->name[n] = 6 * i + d;
      node->equation[d] = n++;
    }
  }
  for (int f = 0; f < s->n_floors; f++)
    for (int k = 0; k < 3; k++) {
      s->floor[f].equation[k] = -1;
      if (s->floor[f].support[k] >= 0)
        continue;
      s->name[n] = 6 * s->n_nodes + 3 * f + k;
      s->floor[f].equation[k] = n++;
    }
  for (int i = 0; i < s->n_nodes; i++)
    for (int d = 0; s->node[i].floor >= 0 && d < 6; d++)
      if (OF_FLOOR[d] >= 0)
        s->node[i].equation[d] = s->floor[s->node[i].floor].equation[OF_FLOOR[d]];
  s->n = n;
  return n ? ED_OK : ed_space_fail(s, ED_E_EMPTY, "the frame has no free degree of freedom");
}

const char *ed_space_degree_name(const ed_space *s, int equation, char *buffer, int size)
{
  static const int direction[] = {0, 1, 5};
  const int degree = s->name[equation], of_masters = degree - 6 * s->n_nodes;
  if (of_masters < 0)
    snprintf(buffer, (size_t)size, "%s.%s", s->node[degree / 6].name, DIRECTION[degree % 6]);
  else
    snprintf(buffer, (size_t)size, "%s of the diaphragm of %s", DIRECTION[direction[of_masters % 3]], s->node[s->floor[of_masters / 3].first].name);
  return buffer;
}

int ed_space_n_equations(const ed_space *space)
{
  return space->n;
}

void ed_space_equations(const ed_space *s, int *equation)
{
  for (int i = 0; i < s->n_nodes; i++)
    for (int d = 0; d < 6; d++)
      equation[6 * i + d] = s->node[i].floor >= 0 && OF_FLOOR[d] >= 0 ? -1 : s->node[i].equation[d];
  for (int f = 0; f < s->n_floors; f++)
    memcpy(equation + 6 * s->n_nodes + 3 * f, s->floor[f].equation, sizeof s->floor[f].equation);
}
