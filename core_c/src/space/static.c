/* Static cases: loads on nodes and members, displacements, end forces, reactions. */
#include "space/loads.h"
#include "space/space.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const DIRECTION[] = {"ux", "uy", "uz", "rx", "ry", "rz"};

int ed_space_check_loads(ed_space *s, int n_cases, const ed_space_loads *loads)
{
  if (n_cases < 0 || (loads && loads->n_points < 0))
    return ed_space_fail(s, ED_E_ARGUMENT, "a number of cases or point loads is negative");
  const size_t components = 3 * (size_t)s->n_members;
  for (size_t i = 0; loads && loads->uniform && i < (size_t)n_cases * components; i++)
    if (!isfinite(loads->uniform[i]))
      return ed_space_fail(s, ED_E_NOT_FINITE, "case %d, member %s: a uniform load is not a finite number", (int)(i / components),
                           s->member_name[i % components / 3]);
  for (int i = 0; loads && i < loads->n_points; i++) {
    const double position = loads->point_position[i], *force = loads->point_force + 3 * (size_t)i;
    if (loads->point_case[i] < 0 || loads->point_case[i] >= n_cases)
      return ed_space_fail(s, ED_E_ID, "point load %d: there is no case %d; there are %d", i, loads->point_case[i], n_cases);
    if (loads->point_member[i] < 0 || loads->point_member[i] >= s->n_members)
      return ed_space_fail(s, ED_E_ID, "point load %d: there is no member %d; there are %d", i, loads->point_member[i], s->n_members);
    if (!(position >= 0.0 && position <= 1.0))
      return ed_space_fail(s, ED_E_ARGUMENT, "point load %d on member %s: its position is %g of the length; it must be 0 to 1", i,
                           s->member_name[loads->point_member[i]], position);
    if (!isfinite(force[0]) || !isfinite(force[1]) || !isfinite(force[2]))
      return ed_space_fail(s, ED_E_NOT_FINITE, "point load %d on member %s is not a finite number", i, s->member_name[loads->point_member[i]]);
  }
  return ED_OK;
}

static int check_nodal(ed_space *s, int n_cases, const double *nodal)
{
  for (int c = 0; c < n_cases; c++)
    for (int i = 0; i < s->n_nodes; i++)
      for (int d = 0; d < 6; d++) {
        const double force = nodal[((size_t)c * (size_t)s->n_nodes + (size_t)i) * 6 + (size_t)d];
        if (!isfinite(force))
          return ed_space_fail(s, ED_E_NOT_FINITE, "case %d: the load at %s.%s is not a finite number", c, s->node[i].name, DIRECTION[d]);
        if (force != 0.0 && s->node[i].left_out[d])
          return ed_space_fail(s, ED_E_ARGUMENT, "case %d: nothing resists the load at %s.%s", c, s->node[i].name, DIRECTION[d]);
      }
  return ED_OK;
}

/* Forces on the ends of members between fixed nodes. */
static void fixed_end_forces(const ed_space *s, int n_cases, const ed_space_loads *loads, double *end_forces)
{
  const size_t members = (size_t)s->n_members;
  memset(end_forces, 0, (size_t)n_cases * members * 12 * sizeof *end_forces);
  if (!loads)
    return;
  for (size_t i = 0; loads->uniform && i < (size_t)n_cases * members; i++) {
    const double *load = loads->uniform + 3 * i;
    if (load[0] != 0.0 || load[1] != 0.0 || load[2] != 0.0)
      ed_member_add_uniform(&s->member[i % members], load, end_forces + 12 * i);
  }
  for (int i = 0; i < loads->n_points; i++) {
    const int m = loads->point_member[i];
    ed_member_add_point(&s->member[m], loads->point_position[i], loads->point_force + 3 * (size_t)i,
                        end_forces + 12 * ((size_t)loads->point_case[i] * members + (size_t)m));
  }
}

/* Adds what members exert on nodes (n_nodes x 6), times `sign`. */
static void add_end_forces(const ed_space *s, double sign, const double *end_forces, double *nodal)
{
  for (int m = 0; m < s->n_members; m++)
    for (int e = 0; e < 4; e++) {
      const double *own = end_forces + 12 * (size_t)m + 3 * e, turned[3] = {sign * own[0], sign * own[1], sign * own[2]};
      ed_member_add_global(&s->member[m], turned, nodal + 6 * (size_t)s->member[m].node[e / 2] + 3 * (e % 2));
    }
}

void ed_space_member_forces(const ed_space *s, const double *displacements, double *end_forces)
{
  for (int m = 0; m < s->n_members; m++) {
    const ed_space_member *member = &s->member[m];
    ed_member_add_forces(member, displacements + 6 * (size_t)member->node[0], displacements + 6 * (size_t)member->node[1],
                         end_forces + 12 * (size_t)m);
  }
}

/* Reactions of restrained floors: the sum of what is at their nodes, as it acts on the master, at the nodes that restrain it. */
static void gather_floors(const ed_space *s, const double *rest, double *sums, double *reactions)
{
  memset(sums, 0, 3 * (size_t)s->n_floors * sizeof *sums);
  for (int i = 0; i < s->n_nodes; i++) {
    const ed_space_node *node = &s->node[i];
    const double *r = rest + 6 * (size_t)i;
    if (node->floor < 0)
      continue;
    double *sum = sums + 3 * (size_t)node->floor;
    sum[0] += r[0];
    sum[1] += r[1];
    sum[2] += r[5] + node->dx * r[1] - node->dy * r[0];
  }
  for (int f = 0; f < s->n_floors; f++) {
    static const int direction[] = {0, 1, 5};
    const int *support = s->floor[f].support;
    double *sum = sums + 3 * (size_t)f;
    if (support[0] >= 0)
      sum[2] += s->node[support[0]].dy * sum[0];
    if (support[1] >= 0)
      sum[2] -= s->node[support[1]].dx * sum[1];
    for (int k = 0; k < 3; k++)
      if (support[k] >= 0)
        reactions[6 * (size_t)support[k] + (size_t)direction[k]] += sum[k];
  }
}

/* rest: n_nodes x 6, what ends of members ask of nodes less what loads give them; it becomes less what springs give. */
static void find_reactions(const ed_space *s, const double *displacements, double *rest, double *sums, double *reactions)
{
  memset(reactions, 0, 6 * (size_t)s->n_nodes * sizeof *reactions);
  for (int i = 0; i < s->n_nodes; i++)
    for (int d = 0; d < 6; d++) {
      const ed_space_node *node = &s->node[i];
      const size_t at = 6 * (size_t)i + (size_t)d;
      const double spring = -node->spring[d] * displacements[at];
      rest[at] -= spring;
      reactions[at] += spring;
      if (node->fixed[d] && !(node->floor >= 0 && (d < 2 || d == 5)))
        reactions[at] += rest[at];
    }
  gather_floors(s, rest, sums, reactions);
}

/* What is asked of the factors was found, if there are any. */
static int solved(ed_space *s, int status)
{
  return status == ED_OK ? ED_OK : ed_space_fail(s, ED_E_SINGULAR, "the frame's equations could not be solved");
}

int ed_space_static(ed_space *s, int n_cases, const double *nodal, const ed_space_loads *loads, double *displacements,
                    double *end_forces, double *reactions)
{
  int status = ed_space_check_loads(s, n_cases, loads);
  if (status == ED_OK && nodal)
    status = check_nodal(s, n_cases, nodal);
  if (status != ED_OK)
    return status;
  const size_t degrees = 6 * (size_t)s->n_nodes, n = (size_t)s->n, per_case = 12 * (size_t)s->n_members;
  double *right = malloc(((size_t)n_cases * n + 1) * sizeof *right);
  double *forces = malloc((2 * degrees + 3 * (size_t)s->n_floors + 1) * sizeof *forces);
  if (!right || !forces) {
    free(right);
    free(forces);
    return ed_space_fail(s, ED_E_MEMORY, "out of memory");
  }
  double *own = forces + degrees, *sums = forces + 2 * degrees;
  fixed_end_forces(s, n_cases, loads, end_forces);
  for (size_t c = 0; c < (size_t)n_cases; c++) {
    memset(forces, 0, degrees * sizeof *forces);
    if (nodal)
      memcpy(forces, nodal + c * degrees, degrees * sizeof *forces);
    add_end_forces(s, -1.0, end_forces + c * per_case, forces);
    ed_space_reduce(s, forces, right + c * n);
  }
  status = solved(s, ed_cholesky_solve(s->factors, right, n_cases));
  for (size_t c = 0; c < (size_t)n_cases && status == ED_OK; c++) {
    double *u = displacements ? displacements + c * degrees : own;
    ed_space_spread(s, right + c * n, u);
    for (size_t i = 0; i < degrees && status == ED_OK; i++)
      if (!isfinite(u[i]))
        status = ed_space_fail(s, ED_E_NOT_FINITE, "case %d: the displacement at %s.%s is not a finite number", (int)c,
                               s->node[i / 6].name, DIRECTION[i % 6]);
    double *of_case = end_forces + c * per_case;
    ed_space_member_forces(s, u, of_case);
    for (size_t i = 0; i < per_case && status == ED_OK; i++)
      if (!isfinite(of_case[i]))
        status = ed_space_fail(s, ED_E_NOT_FINITE, "case %d, member %s: a force at its end is not a finite number", (int)c,
                               s->member_name[i / 12]);
    if (!reactions)
      continue;
    memset(forces, 0, degrees * sizeof *forces);
    add_end_forces(s, 1.0, of_case, forces);
    for (size_t i = 0; nodal && i < degrees; i++)
      forces[i] -= nodal[c * degrees + i];
    find_reactions(s, u, forces, sums, reactions + c * degrees);
  }
  free(right);
  free(forces);
  return status;
}

/* Refuses numbers that are not finite. */
static int check_solutions(ed_space *s, size_t count, const double *solution)
{
  for (size_t i = 0; i < count; i++)
    if (!isfinite(solution[i]))
      return ed_space_fail(s, ED_E_NOT_FINITE, "a solution is not a finite number");
  return ED_OK;
}

int ed_space_flexibility(ed_space *s, int n, const int *equation, double *flexibility)
{
  if (n < 0)
    return ed_space_fail(s, ED_E_ARGUMENT, "the number of equations is negative");
  for (int i = 0; i < n; i++)
    if (equation[i] < 0 || equation[i] >= s->n)
      return ed_space_fail(s, ED_E_ID, "there is no equation %d; there are %d", equation[i], s->n);
  const int status = solved(s, ed_cholesky_inverse(s->factors, n, equation, flexibility));
  return status == ED_OK ? check_solutions(s, (size_t)n * (size_t)n, flexibility) : status;
}

int ed_space_solve(ed_space *s, int n, double *right_sides)
{
  if (n < 0)
    return ed_space_fail(s, ED_E_ARGUMENT, "the number of right sides is negative");
  const int status = solved(s, ed_cholesky_solve(s->factors, right_sides, n));
  return status == ED_OK ? check_solutions(s, (size_t)n * (size_t)s->n, right_sides) : status;
}

int ed_space_expand(ed_space *s, int n, const double *solution, double *displacements, double *end_forces)
{
  const size_t degrees = 6 * (size_t)s->n_nodes, per_case = 12 * (size_t)s->n_members;
  if (n < 0)
    return ed_space_fail(s, ED_E_ARGUMENT, "the number of solutions is negative");
  for (size_t c = 0; c < (size_t)n; c++) {
    ed_space_spread(s, solution + c * (size_t)s->n, displacements + c * degrees);
    if (!end_forces)
      continue;
    memset(end_forces + c * per_case, 0, per_case * sizeof *end_forces);
    ed_space_member_forces(s, displacements + c * degrees, end_forces + c * per_case);
  }
  return ED_OK;
}
