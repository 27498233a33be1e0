/* Space frames: closed forms of one member, a storey on four columns, new sections, combination, critical loads, and what is refused. */
#include "checks.h"
#include "edcore.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 8, MEMBERS = 4 };

static const double E = 2.1e11, G = 8.1e10, H = 3.0;

/* Four columns below a diaphragm; arrays that a test may spoil before it makes the frame. */
typedef struct {
  ed_space_input input;
  const char *node_name[NODES], *member_name[MEMBERS];
  double coordinates[3 * NODES], masters[2], springs[6 * NODES], web[3 * MEMBERS];
  double properties[ED_SPACE_PROPERTIES * MEMBERS], ends[4 * MEMBERS];
  int node_floor[NODES], fixed[6 * NODES], start[MEMBERS], end[MEMBERS], axial_only[MEMBERS];
} frame;

static void make(frame *f)
{
  static const char *const nodes[] = {"A0", "B0", "C0", "D0", "A1", "B1", "C1", "D1"}, *const members[] = {"A", "B", "C", "D"};
  const double property[ED_SPACE_PROPERTIES] = {E, G, 1e-2, 0.0, 0.0, 1e-12, 2e-4, 1e-4};
  memset(f, 0, sizeof *f);
  f->masters[0] = 2.0;
  f->masters[1] = 1.0;
  for (int i = 0; i < NODES; i++) {
    const int top = i >= MEMBERS;
    f->node_name[i] = nodes[i];
    f->coordinates[3 * i] = i % 2 ? 4.0 : 0.0;
    f->coordinates[3 * i + 1] = i / 2 % 2 ? 2.0 : 0.0;
    f->coordinates[3 * i + 2] = top ? H : 0.0;
    f->node_floor[i] = top ? 0 : -1;
    for (int d = 0; d < 6; d++)
      f->fixed[6 * i + d] = !top || (d >= 2 && d < 5);
  }
  for (int m = 0; m < MEMBERS; m++) {
    f->member_name[m] = members[m];
    f->start[m] = m;
    f->end[m] = m + MEMBERS;
    f->web[3 * m] = 1.0;
    memcpy(f->properties + ED_SPACE_PROPERTIES * m, property, sizeof property);
    for (int e = 0; e < 4; e++)
      f->ends[4 * m + e] = INFINITY;
  }
  f->input = (ed_space_input){NODES, 1, MEMBERS, f->node_name, f->member_name, f->coordinates, f->node_floor, f->masters, f->fixed,
                              f->springs, f->start, f->end, f->web, f->properties, f->ends, f->axial_only};
}

static ed_space *made(const frame *f)
{
  int status;
  char message[256];
  ed_space *space = ed_space_new(&f->input, &status, message, sizeof message);
  CHECK_STATUS(status, ED_OK);
  CHECK(space != NULL);
  CHECK_INT((long)strlen(message), 0);
  return space;
}

static void check_refused(const frame *f, int expected, const char *part)
{
  int status;
  char message[256];
  ed_space *space = ed_space_new(&f->input, &status, message, sizeof message);
  CHECK(space == NULL);
  CHECK_STATUS(status, expected);
  CHECK_CONTAINS(message, part);
  ed_space_free(space);
}

/* 12 EI / H^3 a column each way; a force off the centre turns the floor: F e / sum of k r^2. */
static void check_storey(void)
{
  frame f;
  make(&f);
  ed_space *space = made(&f);
  CHECK_INT(ed_space_n_equations(space), 3);
  CHECK_INT(ed_space_n_nonzeros(space), 9);
  int equation[6 * NODES + 3];
  ed_space_equations(space, equation);
  CHECK_INT(equation[6 * MEMBERS], -1); /* follows the master */
  CHECK_INT(equation[6 * NODES + 2], 2);
  double nodal[6 * NODES] = {0.0}, u[6 * NODES], forces[12 * MEMBERS], reactions[6 * NODES];
  nodal[6 * MEMBERS] = 1e4; /* at A1, 1 m before the centre */
  CHECK_STATUS(ed_space_static(space, 1, nodal, NULL, u, forces, reactions), ED_OK);
  const double kx = 12.0 * E * 2e-4 / pow(H, 3), ky = 12.0 * E * 1e-4 / pow(H, 3), turn = 1e4 * 1.0 / (4.0 * kx * 1.0 + 4.0 * ky * 4.0);
  CHECK_NEAR(u[6 * MEMBERS + 5], turn, 1e-9 * turn); /* what is left is torsion of the columns, 1e-9 */
  CHECK_NEAR(u[6 * MEMBERS], 1e4 / (4.0 * kx) + turn, 1e-12);
  double sum = 0.0, moment = 0.0;
  for (int i = 0; i < NODES; i++) {
    sum += reactions[6 * i];
    moment += reactions[6 * i + 5] + f.coordinates[3 * i] * reactions[6 * i + 1] - f.coordinates[3 * i + 1] * reactions[6 * i];
  }
  CHECK_NEAR(sum, -1e4, 1e-8);
  CHECK_NEAR(moment, 0.0, 1e-8); /* the force acts along the axis y = 0 */
  const double stations[] = {0.0, 0.5, 1.0};
  double internal[MEMBERS * 3 * 6];
  CHECK_STATUS(ed_space_internal(space, 1, forces, NULL, 3, stations, internal), ED_OK);
  CHECK_NEAR(internal[4], -forces[4], 1e-9);
  CHECK_NEAR(internal[6 + 4], 0.0, 1e-8); /* guided at both ends */
  CHECK_NEAR(internal[12 + 4], forces[10], 1e-9);
  CHECK_STATUS(ed_space_static(space, 0, NULL, NULL, NULL, forces, NULL), ED_OK);
  ed_space_free(space);
}

/* Terms of the inverse are what single loads give; only equations that are there are taken. */
static void check_flexibility(void)
{
  frame f;
  make(&f);
  ed_space *space = made(&f);
  const int all[] = {2, 0, 1}, beyond[] = {0, 3};
  double flexibility[9], unit[9] = {0.0};
  CHECK_STATUS(ed_space_flexibility(space, 3, all, flexibility), ED_OK);
  for (int i = 0; i < 3; i++)
    unit[3 * i + all[i]] = 1.0;
  CHECK_STATUS(ed_space_solve(space, 3, unit), ED_OK);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      CHECK_NEAR(flexibility[3 * i + j], unit[3 * i + all[j]], 1e-20);
  CHECK_STATUS(ed_space_flexibility(space, 2, beyond, flexibility), ED_E_ID);
  CHECK_CONTAINS(ed_space_message(space), "there is no equation 3; there are 3");
  CHECK_STATUS(ed_space_flexibility(space, -1, all, flexibility), ED_E_ARGUMENT);
  ed_space_free(space);
}

static void check_loads(void)
{
  frame f;
  make(&f);
  ed_space *space = made(&f);
  const int at_case[] = {0}, member[] = {2};
  const double position[] = {0.25}, force[] = {0.0, 8.0, 0.0};
  double uniform[3 * MEMBERS] = {0.0, 6.0, 0.0}, u[6 * NODES], forces[12 * MEMBERS], reactions[6 * NODES], sum = 0.0;
  ed_space_loads loads = {uniform, 1, at_case, member, position, force};
  CHECK_STATUS(ed_space_static(space, 1, NULL, &loads, u, forces, reactions), ED_OK);
  for (int i = 0; i < NODES; i++)
    sum += reactions[6 * i + 1];
  CHECK_NEAR(sum, -(6.0 * H + 8.0), 1e-12);
  const int none[] = {4};
  loads.point_member = none;
  CHECK_STATUS(ed_space_static(space, 1, NULL, &loads, u, forces, reactions), ED_E_ID);
  CHECK_CONTAINS(ed_space_message(space), "there is no member 4");
  loads.point_member = member;
  uniform[4] = NAN;
  CHECK_STATUS(ed_space_static(space, 1, NULL, &loads, u, forces, reactions), ED_E_NOT_FINITE);
  CHECK_CONTAINS(ed_space_message(space), "member B");
  CHECK_STATUS(ed_space_static(space, -1, NULL, NULL, u, forces, reactions), ED_E_ARGUMENT);
  ed_space_free(space);
}

/* Twice the stiffness, half the displacement; refused properties leave it so. */
static void check_change(void)
{
  frame f;
  make(&f);
  ed_space *space = made(&f);
  double nodal[6 * NODES] = {0.0}, u[6 * NODES], forces[12 * MEMBERS], properties[ED_SPACE_PROPERTIES * MEMBERS];
  const int all[] = {0, 1, 2, 3}, beyond[] = {0, 4};
  nodal[6 * MEMBERS + 1] = 1e4;
  CHECK_STATUS(ed_space_static(space, 1, nodal, NULL, u, forces, NULL), ED_OK);
  const double before = u[6 * MEMBERS + 1];
  memcpy(properties, f.properties, sizeof properties);
  for (int m = 0; m < MEMBERS; m++)
    properties[ED_SPACE_PROPERTIES * m] *= 2.0;
  CHECK_STATUS(ed_space_change(space, MEMBERS, all, properties), ED_OK);
  CHECK_STATUS(ed_space_static(space, 1, nodal, NULL, u, forces, NULL), ED_OK);
  CHECK_NEAR(u[6 * MEMBERS + 1], 0.5 * before, 1e-9 * before); /* torsion keeps its G */
  const double after = u[6 * MEMBERS + 1];
  CHECK_STATUS(ed_space_change(space, 2, beyond, properties), ED_E_ID);
  CHECK_STATUS(ed_space_change(space, 5, all, properties), ED_E_ARGUMENT);
  properties[0] = 1e300;
  properties[6] = 1e300;
  CHECK_STATUS(ed_space_change(space, 1, all, properties), ED_E_NOT_FINITE);
  CHECK_STATUS(ed_space_static(space, 1, nodal, NULL, u, forces, NULL), ED_OK);
  CHECK_SAME(&u[6 * MEMBERS + 1], &after, 1);
  ed_space_free(space);
}

/* Guided columns, one member each, by pi^2 EI / H^2 in the weaker plane: polynomials of the sixth degree for the slope. */
static void check_critical(void)
{
  frame f;
  make(&f);
  ed_space *space = made(&f);
  const double pressed[MEMBERS] = {-1.0, -1.0, -1.0, -1.0}, pulled[MEMBERS] = {1.0, 1.0, 1.0, 0.0}, odd[MEMBERS] = {NAN};
  double factor;
  CHECK_STATUS(ed_space_critical(space, pressed, &factor), ED_OK);
  CHECK_NEAR(factor * H * H / (E * 1e-4), M_PI * M_PI, 1e-7);
  CHECK_STATUS(ed_space_critical(space, pulled, &factor), ED_OK);
  CHECK(isinf(factor));
  CHECK_STATUS(ed_space_critical(space, odd, &factor), ED_E_NOT_FINITE);
  ed_space_free(space);
}

/* Of columns that sway without bows 1.2 N / H each; symmetric, bows and all. */
static void check_geometric(void)
{
  enum { SHAPES = 3 };
  frame f;
  make(&f);
  ed_space *space = made(&f);
  const double axial[MEMBERS] = {-1.0, -2.0, 0.0, -4.0}, odd[MEMBERS] = {NAN};
  const int length = ed_space_shape_length(space, axial), equations = ed_space_n_equations(space);
  CHECK((length - equations) % 3 == 0 && length > equations); /* of three members */
  int *equation = malloc((6 * (size_t)f.input.n_nodes + 3) * sizeof *equation);
  double *shape = calloc(SHAPES * (size_t)length, sizeof *shape), *image = malloc(SHAPES * (size_t)length * sizeof *image);
  ed_space_equations(space, equation);
  const int sway = equation[6 * f.input.n_nodes];
  shape[sway] = 1.0;
  for (int i = length; i < SHAPES * length; i++)
    shape[i] = sin(1.0 + 3.0 * i);
  CHECK_STATUS(ed_space_geometric(space, axial, SHAPES, shape, image), ED_OK);
  CHECK_NEAR(image[sway], 1.2 * 7.0 / H, 1e-12);
  double one = 0.0, other = 0.0;
  for (int i = 0; i < length; i++) {
    one += shape[length + i] * image[2 * length + i];
    other += shape[2 * length + i] * image[length + i];
  }
  CHECK_NEAR(one, other, 1e-12);
  CHECK_STATUS(ed_space_geometric(space, axial, -1, shape, image), ED_E_ARGUMENT);
  CHECK_STATUS(ed_space_geometric(space, odd, 1, shape, image), ED_E_NOT_FINITE);
  free(equation), free(shape), free(image);
  ed_space_free(space);
}

static void check_combine(void)
{
  const double values[] = {3.0, 1.0, -2.0, 4.0, 2.0, 2.0}, rho[] = {1.0, 0.5, 0.5, 1.0}, skew[] = {1.0, 0.5, 0.4, 1.0};
  double result[3];
  CHECK_STATUS(ed_combine(3, 2, values, rho, result), ED_OK);
  CHECK_NEAR(result[0], sqrt(9.0 + 16.0 + 12.0), 1e-14);
  CHECK_NEAR(result[1], sqrt(1.0 + 4.0 + 2.0), 1e-14);
  CHECK_NEAR(result[2], sqrt(4.0 + 4.0 - 4.0), 1e-14);
  CHECK_STATUS(ed_combine(3, 2, values, skew, result), ED_E_ARGUMENT);
  CHECK_STATUS(ed_combine(3, 0, values, rho, result), ED_E_ARGUMENT);
  /* one mode: what is combined is the magnitude of the linear moment */
  const double forces[] = {-1.0, 2.0, 0.0, 0.0, -6.0, 8.0, 1.0, -2.0, 0.0, 0.0, -2.0, 4.0}, one[] = {1.0}, stations[] = {0.0, 0.5, 0.75, 1.0};
  double at[4 * 6];
  CHECK_STATUS(ed_combine_stations(1, 1, forces, one, 4, stations, at), ED_OK);
  for (int s = 0; s < 4; s++) {
    CHECK_NEAR(at[6 * s], 1.0, 1e-15);
    CHECK_NEAR(at[6 * s + 4], fabs(6.0 - 8.0 * stations[s]), 1e-7); /* the root of what cancels at 0.75 */
    CHECK_NEAR(at[6 * s + 5], fabs(-8.0 + 12.0 * stations[s]), 1e-7);
  }
  CHECK_STATUS(ed_combine_stations(1, 1, forces, one, 4, forces, at), ED_E_ARGUMENT);
}

static void check_refusals(void)
{
  frame f;
  make(&f);
  for (int e = 0; e < 4 * MEMBERS; e++)
    f.ends[e] = 0.0;
  check_refused(&f, ED_E_MECHANISM, "of the diaphragm of A1");
  make(&f);
  f.properties[ED_SPACE_PROPERTIES + 2] = -1.0;
  check_refused(&f, ED_E_ARGUMENT, "member B: A is -1");
  make(&f);
  f.end[3] = 99;
  check_refused(&f, ED_E_ID, "member D: there is no node 99");
  make(&f);
  f.node_floor[5] = 1;
  check_refused(&f, ED_E_ID, "node B1: there is no diaphragm 1");
  make(&f);
  f.masters[1] = INFINITY;
  check_refused(&f, ED_E_ARGUMENT, "master of diaphragm 0");
  make(&f);
  f.springs[7] = -1.0;
  check_refused(&f, ED_E_ARGUMENT, "node B0: the spring of uy");
  make(&f);
  memset(f.fixed, 0, sizeof f.fixed);
  check_refused(&f, ED_E_DISCONNECTED, "8 nodes are not connected to any support: A0");
  make(&f);
  f.input.n_members = 0;
  check_refused(&f, ED_E_EMPTY, "no member");
  make(&f);
  f.fixed[6 * 5] = 1;
  check_refused(&f, ED_E_ARGUMENT, "node B1 of a diaphragm is restrained in ux away from its master");
  make(&f);
  f.fixed[6 * 5] = f.fixed[6 * 5 + 1] = f.fixed[6 * 5 + 5] = 1;
  check_refused(&f, ED_E_EMPTY, "no free degree");
  char small[8];
  int status;
  make(&f);
  f.web[0] = 0.5;
  CHECK(ed_space_new(&f.input, &status, small, sizeof small) == NULL);
  CHECK_STATUS(status, ED_E_ARGUMENT);
  CHECK(strlen(small) < sizeof small);
  ed_space_free(NULL);
}

int main(void)
{
  check_storey();
  check_flexibility();
  check_loads();
  check_change();
  check_critical();
  check_geometric();
  check_combine();
  check_refusals();
  return checks_end("space frames");
}
