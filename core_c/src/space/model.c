/* What a space frame is made of is checked, copied and freed. */
#include "space/space.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const DIRECTION[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
static const char *const PROPERTY[] = {"E", "G", "A", "A_y", "A_z", "I_t", "I_y", "I_z"};

int ed_space_fail(ed_space *space, int status, const char *format, ...)
{
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(space->message, sizeof space->message, format, arguments);
  va_end(arguments);
  return status;
}

static int set_nodes(ed_space *s, const ed_space_input *in)
{
  for (int i = 0; i < s->n_floors; i++) {
    s->floor[i] = (ed_space_floor){.x = in->masters[2 * i], .y = in->masters[2 * i + 1], .first = -1, .support = {-1, -1, -1}};
    if (!isfinite(s->floor[i].x) || !isfinite(s->floor[i].y))
      return ed_space_fail(s, ED_E_ARGUMENT, "the place of the master of diaphragm %d is not a finite number", i);
  }
  for (int i = 0; i < s->n_nodes; i++) {
    ed_space_node *node = &s->node[i];
    snprintf(node->name, sizeof node->name, "%s", in->node_name[i] ? in->node_name[i] : "");
    node->floor = in->node_floor[i];
    if (node->floor < -1 || node->floor >= s->n_floors)
      return ed_space_fail(s, ED_E_ID, "node %s: there is no diaphragm %d; there are %d", node->name, node->floor, s->n_floors);
    for (int d = 0; d < 3; d++) {
      node->x[d] = in->coordinates[3 * i + d];
      if (!isfinite(node->x[d]))
        return ed_space_fail(s, ED_E_ARGUMENT, "node %s: a coordinate is not a finite number", node->name);
    }
    for (int d = 0; d < 6; d++) {
      node->fixed[d] = in->fixed[6 * i + d] != 0;
      node->spring[d] = in->springs[6 * i + d];
      if (!(node->spring[d] >= 0.0) || !isfinite(node->spring[d]))
        return ed_space_fail(s, ED_E_ARGUMENT, "node %s: the spring of %s has stiffness %g; it must be a finite number of at least 0",
                             node->name, DIRECTION[d], node->spring[d]);
    }
    if (node->floor >= 0) {
      ed_space_floor *floor = &s->floor[node->floor];
      node->dx = node->x[0] - floor->x;
      node->dy = node->x[1] - floor->y;
      floor->first = floor->first < 0 ? i : floor->first;
    }
  }
  for (int i = 0; i < s->n_floors; i++)
    if (s->floor[i].first < 0)
      return ed_space_fail(s, ED_E_ARGUMENT, "diaphragm %d has no node", i);
  return ED_OK;
}

static int check_properties(ed_space *s, int number, const double *property)
{
  for (int i = 0; i < ED_SPACE_PROPERTIES; i++) {
    const int shear_area = i == ED_A_Y || i == ED_A_Z;
    const int counts = !s->member[number].axial_only || i == ED_E || i == ED_A;
    if (counts && (!isfinite(property[i]) || !(shear_area ? property[i] >= 0.0 : property[i] > 0.0)))
      return ed_space_fail(s, ED_E_ARGUMENT, "member %s: %s is %g; it must be a finite number %s", s->member_name[number], PROPERTY[i],
                           property[i], shear_area ? "of at least 0" : "above 0");
  }
  return ED_OK;
}

static int set_properties(ed_space *s, int number, const double *property)
{
  ed_space_member *m = &s->member[number];
  memcpy(m->property, property, sizeof m->property);
  ed_member_stiffness(m);
  const ed_space_stiffness *k = &m->stiffness;
  const double square = m->length * m->length;
  const double all[] = {k->axial, k->torsion, k->y[0], k->y[1], k->y[2], k->z[0], k->z[1], k->z[2], (k->y[0] + k->z[0]) / square};
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    if (!isfinite(all[i]))
      return ed_space_fail(s, ED_E_NOT_FINITE, "member %s: its stiffness is not a finite number", s->member_name[number]);
  return ED_OK;
}

static double dot(const double *a, const double *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static int set_axes(ed_space *s, int number, const double *web)
{
  /* what rounding of the given direction may leave: eight digits, squared in the length */
  const double SKEW = 1e-6;
  ed_space_member *m = &s->member[number];
  const double *start = s->node[m->node[0]].x, *end = s->node[m->node[1]].x;
  double *x = m->axis[0], *y = m->axis[1], *z = m->axis[2];
  for (int d = 0; d < 3; d++)
    x[d] = end[d] - start[d];
  m->length = sqrt(dot(x, x));
  if (!(m->length > 0.0) || !isfinite(m->length))
    return ed_space_fail(s, ED_E_ARGUMENT, "member %s has the length %g", s->member_name[number], m->length);
  for (int d = 0; d < 3; d++)
    x[d] /= m->length;
  const double along = dot(web, x);
  if (!(fabs(along) <= SKEW) || !(fabs(dot(web, web) - 1.0) <= SKEW))
    return ed_space_fail(s, ED_E_ARGUMENT, "member %s: the direction (%g, %g, %g) of its web is not of length 1 and at right angles to it",
                         s->member_name[number], web[0], web[1], web[2]);
  for (int d = 0; d < 3; d++)
    z[d] = web[d] - along * x[d];
  const double size = sqrt(dot(z, z));
  for (int d = 0; d < 3; d++)
    z[d] /= size;
  y[0] = z[1] * x[2] - z[2] * x[1];
  y[1] = z[2] * x[0] - z[0] * x[2];
  y[2] = z[0] * x[1] - z[1] * x[0];
  return ED_OK;
}

static int set_members(ed_space *s, const ed_space_input *in)
{
  double total = 0.0;
  for (int i = 0; i < s->n_members; i++) {
    ed_space_member *m = &s->member[i];
    snprintf(s->member_name[i], sizeof s->member_name[i], "%s", in->member_name[i] ? in->member_name[i] : "");
    m->node[0] = in->start[i];
    m->node[1] = in->end[i];
    m->axial_only = in->axial_only[i] != 0;
    for (int e = 0; e < 2; e++)
      if (m->node[e] < 0 || m->node[e] >= s->n_nodes)
        return ed_space_fail(s, ED_E_ID, "member %s: there is no node %d", s->member_name[i], m->node[e]);
    for (int e = 0; e < 4; e++) {
      m->end[e] = in->ends[4 * i + e];
      if (!(m->end[e] >= 0.0))
        return ed_space_fail(s, ED_E_ARGUMENT, "member %s: a rotational spring has stiffness %g; it must be at least 0",
                             s->member_name[i], m->end[e]);
    }
    int status = set_axes(s, i, in->web + 3 * i);
    if (status == ED_OK)
      status = check_properties(s, i, in->properties + ED_SPACE_PROPERTIES * i);
    if (status == ED_OK)
      status = set_properties(s, i, in->properties + ED_SPACE_PROPERTIES * i);
    if (status != ED_OK)
      return status;
    total += m->length / s->n_members;
  }
  s->length = total;
  return ED_OK;
}

static int make(ed_space *s, const ed_space_input *in)
{
  s->n_nodes = in->n_nodes;
  s->n_floors = in->n_floors;
  s->n_members = in->n_members;
  if (s->n_nodes < 0 || s->n_floors < 0 || s->n_members < 0)
    return ed_space_fail(s, ED_E_ARGUMENT, "a number of nodes, diaphragms or members is negative");
  if (s->n_members == 0)
    return ed_space_fail(s, ED_E_EMPTY, "the frame has no member");
  const size_t members = (size_t)s->n_members;
  s->node = calloc((size_t)s->n_nodes + 1, sizeof *s->node);
  s->floor = calloc((size_t)s->n_floors + 1, sizeof *s->floor);
  s->member = calloc(members, sizeof *s->member);
  s->member_name = calloc(members, sizeof *s->member_name);
  s->stiffness = calloc(members, sizeof *s->stiffness);
  s->saved = calloc(members, ED_SPACE_PROPERTIES * sizeof *s->saved);
  if (!s->node || !s->floor || !s->member || !s->member_name || !s->stiffness || !s->saved)
    return ED_E_MEMORY;
  int status = set_nodes(s, in);
  if (status == ED_OK)
    status = set_members(s, in);
  if (status == ED_OK)
    status = ed_space_check_connected(s);
  if (status == ED_OK)
    status = ed_space_number(s);
  if (status == ED_OK)
    status = ed_space_build_pattern(s);
  return status == ED_OK ? ed_space_factor(s) : status;
}

ed_space *ed_space_new(const ed_space_input *input, int *status, char *message, int size)
{
  ed_space *space = calloc(1, sizeof *space);
  *status = space ? make(space, input) : ED_E_MEMORY;
  if (*status == ED_E_MEMORY && space)
    ed_space_fail(space, ED_E_MEMORY, "out of memory");
  if (size > 0)
    snprintf(message, (size_t)size, "%s", *status == ED_OK ? "" : space ? space->message : "out of memory");
  if (*status == ED_OK)
    return space;
  ed_space_free(space);
  return NULL;
}

void ed_space_free(ed_space *space)
{
  if (!space)
    return;
  void *all[] = {space->node,  space->floor,        space->member,       space->member_name, space->name,      space->column_start,
                 space->row,   space->diagonal,     space->scale,        space->work,        space->stiffness, space->saved,
                 space->place, space->spring_place, space->spring_value, space->matrix};
  ed_cholesky_free(space->factors);
  for (size_t i = 0; i < sizeof all / sizeof *all; i++)
    free(all[i]);
  free(space);
}

const char *ed_space_message(const ed_space *space)
{
  return space->message;
}

int ed_space_change(ed_space *s, int n, const int *member, const double *properties)
{
  if (n < 0 || n > s->n_members)
    return ed_space_fail(s, ED_E_ARGUMENT, "%d members are to change; there are %d", n, s->n_members);
  int status = ED_OK;
  for (int i = 0; i < n && status == ED_OK; i++) {
    if (member[i] < 0 || member[i] >= s->n_members)
      return ed_space_fail(s, ED_E_ID, "there is no member %d; there are %d", member[i], s->n_members);
    status = check_properties(s, member[i], properties + (size_t)ED_SPACE_PROPERTIES * (size_t)i);
  }
  if (status != ED_OK)
    return status;
  int done = 0;
  for (; done < n && status == ED_OK; done++) {
    memcpy(s->saved + (size_t)ED_SPACE_PROPERTIES * (size_t)done, s->member[member[done]].property, sizeof s->member->property);
    status = set_properties(s, member[done], properties + (size_t)ED_SPACE_PROPERTIES * (size_t)done);
  }
  if (status == ED_OK)
    status = ed_space_factor(s);
  if (status == ED_OK)
    return ED_OK;
  char message[ED_SPACE_MESSAGE];
  memcpy(message, s->message, sizeof message);
  while (done-- > 0)
    set_properties(s, member[done], s->saved + (size_t)ED_SPACE_PROPERTIES * (size_t)done);
  ed_space_factor(s);
  memcpy(s->message, message, sizeof message);
  return status;
}
