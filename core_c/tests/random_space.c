#include "random_calls.h"

#include "checks.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_NODES = 14, MOST_MEMBERS = 20, MOST_CASES = 3 };

/* What a space frame is made of, and the object. */
typedef struct {
  ed_space_input input;
  const char *node_name[MOST_NODES], *member_name[MOST_MEMBERS];
  double coordinates[3 * MOST_NODES], masters[2 * MOST_NODES], springs[6 * MOST_NODES], web[3 * MOST_MEMBERS];
  double properties[ED_SPACE_PROPERTIES * MOST_MEMBERS], ends[4 * MOST_MEMBERS];
  int node_floor[MOST_NODES], fixed[6 * MOST_NODES], start[MOST_MEMBERS], end[MOST_MEMBERS], axial_only[MOST_MEMBERS];
  int nodes, members, equations;
  ed_space *space;
} building;

static const char *name(caller *c)
{
  static const char *const names[] = {"a", "beam", "", NULL,
                                      "a name that is longer than any name of a node should be, and then it goes on and on"};
  return names[whole(c, 0, 4)];
}

static void some_properties(caller *c, double *p)
{
  const double usual[ED_SPACE_PROPERTIES] = {2.1e11, 8.1e10, 1e-2, 4e-3, 4e-3, 1e-6, 2e-4, 1e-4};
  for (int i = 0; i < ED_SPACE_PROPERTIES; i++)
    p[i] = or_absurd(c, usual[i] * size_between(c, 0.3, 3.0));
  if (chance(c, 0.3))
    p[3] = p[4] = 0.0;
}

static void add_member(caller *c, building *b, int start, int end)
{
  const int m = b->members++;
  double x[3];
  b->member_name[m] = name(c);
  b->start[m] = chance(c, 0.2 * c->wild) ? some_id(c, b->nodes) : start;
  b->end[m] = chance(c, 0.2 * c->wild) ? some_id(c, b->nodes) : end;
  for (int d = 0; d < 3; d++)
    x[d] = b->coordinates[3 * end + d] - b->coordinates[3 * start + d];
  /* across the member, in a horizontal plane or along x */
  const double plan = hypot(x[0], x[1]);
  b->web[3 * m] = plan > 0.0 ? -x[1] / plan : 1.0;
  b->web[3 * m + 1] = plan > 0.0 ? x[0] / plan : 0.0;
  b->web[3 * m + 2] = or_absurd(c, 0.0);
  some_properties(c, b->properties + ED_SPACE_PROPERTIES * m);
  for (int e = 0; e < 4; e++)
    b->ends[4 * m + e] = chance(c, 0.7) ? INFINITY : or_absurd(c, chance(c, 0.5) ? 0.0 : 1e7);
  b->axial_only[m] = chance(c, 0.1);
}

/* One or two storeys of four columns and their beams, or what is left of them. */
static void describe(caller *c, building *b)
{
  const int storeys = whole(c, 1, 2), diaphragms = chance(c, 0.7) ? storeys : 0;
  *b = (building){.nodes = 4 * (storeys + 1)};
  for (int i = 0; i < b->nodes; i++) {
    b->node_name[i] = name(c);
    b->coordinates[3 * i] = or_absurd(c, i % 2 ? 5.0 : 0.0);
    b->coordinates[3 * i + 1] = or_absurd(c, i / 2 % 2 ? 4.0 : 0.0);
    b->coordinates[3 * i + 2] = or_absurd(c, 3.0 * (i / 4));
    b->node_floor[i] = chance(c, 0.2 * c->wild) ? some_id(c, diaphragms) : diaphragms ? i / 4 - 1 : -1;
    for (int d = 0; d < 6; d++) {
      b->fixed[6 * i + d] = i < 4 ? !chance(c, 0.1 * c->wild) : chance(c, 0.1 * c->wild);
      b->springs[6 * i + d] = chance(c, 0.1) ? or_absurd(c, 1e7) : 0.0;
    }
  }
  for (int f = 0; f < diaphragms; f++)
    for (int d = 0; d < 2; d++)
      b->masters[2 * f + d] = or_absurd(c, 2.0);
  for (int i = 4; i < b->nodes; i++) {
    if (!chance(c, 0.1 * c->wild))
      add_member(c, b, i - 4, i);
    if (i % 2)
      add_member(c, b, i - 1, i);
    if (i / 2 % 2 && !chance(c, 0.2))
      add_member(c, b, i - 2, i);
  }
  b->input = (ed_space_input){b->nodes, diaphragms, b->members, b->node_name, b->member_name, b->coordinates, b->node_floor, b->masters,
                              b->fixed, b->springs, b->start, b->end, b->web, b->properties, b->ends, b->axial_only};
  if (chance(c, 0.2 * c->wild))
    b->input.n_members = -whole(c, 0, 1);
}

static int make_space(caller *c, building *b)
{
  int status = 99;
  char message[300] = "";
  describe(c, b);
  b->space = ed_space_new(&b->input, &status, message, chance(c, 0.1) ? 1 : (int)sizeof message);
  expect_listed(c, status);
  CHECK((status == ED_OK) == (b->space != NULL));
  b->equations = b->space ? ed_space_n_equations(b->space) : 0;
  return b->space != NULL;
}

static void call_static(caller *c, building *b)
{
  const int cases = chance(c, 0.1 * c->wild) ? -whole(c, 0, 1) : whole(c, 1, MOST_CASES), points = chance(c, 0.5) ? whole(c, 1, 4) : 0;
  const int count = cases > 0 ? cases : 0, stations = whole(c, 0, 4);
  double *nodal = values_between(c, 6 * b->nodes * count, 1.0, 1e5), *uniform = values_between(c, 3 * b->members * count, 1.0, 1e4);
  double *u = room(6 * b->nodes * count), *forces = room(12 * b->members * count + 1), *reactions = room(6 * b->nodes * count);
  double *internal = room(6 * b->members * count * stations), at[4], position[4], force[12];
  int point_case[4], member[4];
  for (int i = 0; i < 4; i++) {
    at[i] = or_absurd(c, 0.3 * i);
    position[i] = or_absurd(c, 0.25 * i);
    point_case[i] = some_id(c, count);
    member[i] = some_id(c, b->members);
    for (int d = 0; d < 3; d++)
      force[3 * i + d] = signed_size(c, 1.0, 1e5);
  }
  const ed_space_loads loads = {chance(c, 0.8) && count ? uniform : NULL, points, point_case, member, position, force};
  const ed_space_loads *given = chance(c, 0.8) ? &loads : NULL;
  const int status = expect_listed(c, ed_space_static(b->space, cases, chance(c, 0.8) && count ? nodal : NULL, given,
                                                      chance(c, 0.8) && count ? u : NULL, forces, chance(c, 0.8) && count ? reactions : NULL));
  expect_finite(status, forces, 12 * b->members * count);
  if (status == ED_OK) {
    const int found = expect_listed(c, ed_space_internal(b->space, cases, forces, given, stations, at, internal));
    expect_finite(found, internal, 6 * b->members * count * stations);
  }
  free(nodal), free(uniform), free(u), free(forces), free(reactions), free(internal);
}

static void call_modes(caller *c, building *b)
{
  const int n = whole(c, 1, 4);
  double *x = values_between(c, n * b->equations, 1e-3, 1.0), *u = room(6 * b->nodes * n), *forces = room(12 * b->members * n);
  double *result = room(12 * b->members), *stations = room(6 * b->members * 3), at[3] = {0.0, or_absurd(c, 0.5), 1.0}, rho[16];
  for (int i = 0; i < n; i++)
    for (int j = 0; j <= i; j++)
      rho[i * n + j] = rho[j * n + i] = i == j ? 1.0 : or_absurd(c, 0.2);
  const int solved = expect_listed(c, ed_space_solve(b->space, n, x));
  expect_finite(solved, x, n * b->equations);
  if (solved == ED_OK) {
    expect_listed(c, ed_space_expand(b->space, n, x, u, forces));
    const int combined = expect_listed(c, ed_combine(12 * b->members, n, forces, rho, result));
    expect_finite(combined, result, 12 * b->members);
    const int spread = expect_listed(c, ed_combine_stations(b->members, n, forces, rho, 3, at, stations));
    expect_finite(spread, stations, 18 * b->members);
  }
  free(x), free(u), free(forces), free(result), free(stations);
}

static void call_flexibility(caller *c, building *b)
{
  const int n = chance(c, 0.1 * c->wild) ? -1 : whole(c, 0, 5);
  int equation[5];
  double flexibility[25];
  for (int i = 0; i < n; i++)
    equation[i] = some_id(c, b->equations);
  const int status = expect_listed(c, ed_space_flexibility(b->space, n, equation, flexibility));
  expect_finite(status, flexibility, n > 0 ? n * n : 0);
}

static void call_critical(caller *c, building *b)
{
  double *axial = values_between(c, b->members, 1e2, 1e6), factor = NAN;
  const int status = expect_listed(c, ed_space_critical(b->space, axial, &factor));
  CHECK(status < 0 || factor > 0.0);
  const int length = ed_space_shape_length(b->space, axial);
  double *shape = values_between(c, length, 1e-3, 1.0), *image = room(length);
  const int multiplied = expect_listed(c, ed_space_geometric(b->space, axial, 1, shape, image));
  expect_finite(multiplied, image, length);
  free(axial), free(shape), free(image);
}

static void call_change(caller *c, building *b)
{
  int number[MOST_MEMBERS];
  double properties[ED_SPACE_PROPERTIES * MOST_MEMBERS];
  const int n = chance(c, 0.1 * c->wild) ? -1 : whole(c, 0, b->members);
  for (int i = 0; i < n; i++) {
    number[i] = some_id(c, b->members);
    some_properties(c, properties + ED_SPACE_PROPERTIES * i);
  }
  expect_listed(c, ed_space_change(b->space, n, number, properties));
}

void call_space(caller *c)
{
  building b;
  if (!make_space(c, &b))
    return;
  for (int i = whole(c, 1, 6); i > 0; i--) {
    void (*const calls[])(caller *, building *) = {call_static,   call_static,      call_modes,
                                                       call_critical, call_flexibility, call_change};
    calls[whole(c, 0, 5)](c, &b);
    CHECK(ed_space_message(b.space) != NULL);
  }
  ed_space_free(b.space);
}
