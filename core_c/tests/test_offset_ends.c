/* Members in space whose ends stand beside their nodes: the member between the ends with arms by hand, the plane member with rigid ends, rigid
 * motions, potentials and tangents by differences, refusals. */
#include "checks.h"
#include "element/element.h"
#include "numbers.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = ED_MAX_DEGREES };
static const double EA = 3e9, EI_Z = 2e7, EI_Y = 5e7, GJ = 4e6;
static const double AT_I[3] = {0.1, -0.1, 0.3}, AT_J[3] = {-0.3, 0.1, -0.2};
static const ed_element_kind KINDS[] = {ED_ELASTIC_BEAM, ED_FIBRE_BEAM};

typedef struct {
  ed_model *model;
  ed_element e;
  double *block, *layers;
} one;

static int add_member(ed_model *model, ed_element_kind kind, int geometry, int section, const double *web)
{
  const int sections[] = {section, section, section, section, section};
  return kind == ED_ELASTIC_BEAM ? ed_model_elastic_beam(model, "m", 0, 1, section, geometry, NULL, web)
                                 : ed_model_beam_column(model, "m", 0, 1, 5, sections, geometry, NULL, web);
}

static one set_up(ed_model *model)
{
  one m = {.model = model};
  CHECK_STATUS(ed_element_setup(&m.e, m.model, 0), ED_OK);
  m.block = calloc((size_t)ed_element_block_size(&m.e), sizeof *m.block);
  m.layers = calloc((size_t)ed_element_layer_size(&m.e) + 1, sizeof *m.layers);
  ed_element_initialise(&m.e, m.block, m.layers);
  return m;
}

/* Between i and j, its web at right angles to that; offsets NULL: none. */
static one one_new(ed_element_kind kind, int geometry, const double *i, const double *j, const double *at_i, const double *at_j)
{
  ed_model *model = ed_model_new(3);
  ed_model_node(model, "i", i);
  ed_model_node(model, "j", j);
  ed_model_elastic_section(model, (double[]){EA, EI_Z, EI_Y, GJ});
  const double x = j[0] - i[0], y = j[1] - i[1], flat = hypot(x, y), web[3] = {-y / flat, x / flat, 0.0};
  CHECK_INT(add_member(model, kind, geometry, 0, web), 0);
  if (at_i)
    CHECK_STATUS(ed_model_offset_ends(model, 0, at_i, at_j), ED_OK);
  return set_up(model);
}

static void one_free(one *m)
{
  free(m->block);
  free(m->layers);
  ed_element_clear(&m->e);
  ed_model_free(m->model);
}

static void forces_at(one *m, const double *d, double *force)
{
  ed_element_control control = {.tolerance = 1e-24, .fast_elastic = 1};
  CHECK_STATUS(ed_element_update(&m->e, d, m->layers, m->block, &control), ED_OK);
  ed_element_forces(&m->e, d, m->block, force);
}

static void draw(numbers *source, double size, double *d)
{
  for (int i = 0; i < N; i++)
    d[i] = next_number(source, -size, size);
}

static const double I[3] = {1.0, 2.0, -1.0}, J[3] = {2.0, 4.0, 1.0};

/* The stiffness between the ends, moved to the nodes by u + t x r. */
static void check_stiffness(ed_element_kind kind)
{
  double from[3], to[3], t[N * N], inner[N * N], B[N][N] = {{0.0}}, d[N] = {0.0}, force[N];
  for (int k = 0; k < 3; k++) {
    from[k] = I[k] + AT_I[k];
    to[k] = J[k] + AT_J[k];
  }
  one m = one_new(kind, ED_LINEAR, I, J, AT_I, AT_J);
  ed_model *between = ed_model_new(3);
  ed_model_node(between, "i", from);
  ed_model_node(between, "j", to);
  ed_model_elastic_section(between, (double[]){EA, EI_Z, EI_Y, GJ});
  CHECK_INT(add_member(between, kind, ED_LINEAR, 0, m.e.axis[2]), 0); /* the web at right angles to it */
  one w = set_up(between);
  CHECK_NEAR(m.e.length, w.e.length, 1e-15);
  forces_at(&m, d, force);
  forces_at(&w, d, force);
  ed_element_tangent(&m.e, d, m.block, t);
  ed_element_tangent(&w.e, d, w.block, inner);
  for (int i = 0; i < N; i++)
    B[i][i] = 1.0;
  for (int end = 0; end < 2; end++) {
    const double *r = end ? AT_J : AT_I;
    const double by[3][3] = {{0.0, r[2], -r[1]}, {-r[2], 0.0, r[0]}, {r[1], -r[0], 0.0}};
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        B[6 * end + i][6 * end + 3 + j] = by[i][j];
  }
  for (int i = 0; i < N; i++)
    for (int j = 0; j < N; j++) {
      double sum = 0.0;
      for (int k = 0; k < N; k++)
        for (int l = 0; l < N; l++)
          sum += B[k][i] * inner[N * k + l] * B[l][j];
      CHECK_NEAR(t[N * i + j], sum, 1e-14 * EA);
    }
  one_free(&m);
  one_free(&w);
}

/* What bends has no load along it: the tangent leaves out how the couple of such loads changes with its length. */
static void put_loads(one *m)
{
  const ed_member_load loads[] = {{.position = -1.0, .transverse = {-7e3, 2e3}},
                                  {.position = 0.99, .axial = 2e4, .transverse = {-3e4, 1e4}},
                                  {.position = 0.4, .transverse = {-2e4, 1e4}},
                                  {.position = 0.01, .end = 0.98, .transverse = {-1e4, 5e3}, .transverse_end = {3e4, -2e4}}};
  for (int i = 0; i < 4; i++)
    ed_rigid_add_load(&m->e, &loads[i], 1.0);
  ed_element_finish_loads(&m->e);
}

/* The member of a plane frame, x and y there, as x and z here: its local y is the web, and it turns against the y axis. */
static void check_plane(ed_element_kind kind, int geometry, numbers *source)
{
  const double c = 0.8, s = 0.6, L = 4.0, A = 0.3, B = 0.5;
  ed_model *flat = ed_model_new(2);
  ed_model_node(flat, "i", (double[]){0.0, 0.0});
  ed_model_node(flat, "j", (double[]){c * L, s * L});
  ed_model_elastic_section(flat, (double[]){EA, EI_Y});
  CHECK_INT(add_member(flat, kind, geometry, 0, NULL), 0);
  CHECK_STATUS(ed_model_rigid_ends(flat, 0, A, B), ED_OK);
  ed_model *space = ed_model_new(3);
  ed_model_node(space, "i", (double[]){0.0, 0.0, 0.0});
  ed_model_node(space, "j", (double[]){c * L, 0.0, s * L});
  ed_model_elastic_section(space, (double[]){EA, EI_Z, EI_Y, GJ});
  CHECK_INT(add_member(space, kind, geometry, 0, (double[]){-s, 0.0, c}), 0);
  CHECK_STATUS(ed_model_rigid_ends(space, 0, A, B), ED_OK);
  one p = set_up(flat), m = set_up(space);
  static const ed_member_load loads[] = {{.position = -1.0, .axial = 3e3, .transverse = {-7e3}},
                                         {.position = 0.03, .axial = 2e4, .transverse = {-3e4}},
                                         {.position = 0.95, .axial = 1e4, .transverse = {-2e4}},
                                         {.position = 0.01, .end = 0.98, .transverse = {-1e4}, .transverse_end = {3e4}}};
  for (int i = 0; i < 4; i++) {
    ed_member_load turned = loads[i];
    for (int k = 0; k < 2; k++) {
      turned.transverse[k] = k ? loads[i].transverse[0] : 0.0;
      turned.transverse_end[k] = k ? loads[i].transverse_end[0] : 0.0;
    }
    ed_rigid_add_load(&p.e, &loads[i], 1.0);
    ed_rigid_add_load(&m.e, &turned, 1.0);
  }
  ed_element_finish_loads(&p.e);
  ed_element_finish_loads(&m.e);
  static const int at[6] = {0, 2, 4, 6, 8, 10};
  for (int round = 0; round < 20; round++) {
    double d[6], of_plane[6], all[N] = {0.0}, force[N], t[36], in_space[N * N];
    for (int i = 0; i < 6; i++) {
      const double sign = i % 3 == 2 ? -1.0 : 1.0;
      d[i] = next_number(source, -1.0, 1.0) * (geometry == ED_COROTATIONAL ? 0.3 : 0.01);
      all[at[i]] = sign * d[i];
    }
    forces_at(&p, d, of_plane);
    forces_at(&m, all, force);
    ed_element_tangent(&p.e, d, p.block, t);
    ed_element_tangent(&m.e, all, m.block, in_space);
    for (int i = 0; i < 6; i++) {
      const double sign = i % 3 == 2 ? -1.0 : 1.0;
      CHECK_NEAR(sign * force[at[i]], of_plane[i], 1e-14 * EA);
      for (int j = 0; j < 6; j++)
        CHECK_NEAR(sign * (j % 3 == 2 ? -1.0 : 1.0) * in_space[N * at[i] + at[j]], t[6 * i + j], 1e-13 * EA);
    }
  }
  one_free(&p);
  one_free(&m);
}

/* exp(r) x - x, Rodrigues */
static void turn(const double r[3], const double x[3], double moved[3])
{
  const double t = sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]), a = sin(t) / t, b = (1.0 - cos(t)) / (t * t);
  const double along = r[0] * x[0] + r[1] * x[1] + r[2] * x[2];
  for (int i = 0; i < 3; i++) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    moved[i] = a * (r[j] * x[k] - r[k] * x[j]) + b * (r[i] * along - t * t * x[i]);
  }
}

static void move(double size, numbers *source, double *d)
{
  double r[3], moved[3];
  for (int i = 0; i < 3; i++)
    r[i] = size * next_number(source, -1.0, 1.0);
  turn(r, (double[]){J[0] - I[0], J[1] - I[1], J[2] - I[2]}, moved);
  for (int i = 0; i < 3; i++) {
    d[i] = next_number(source, -2.0, 2.0);
    d[6 + i] = d[i] + moved[i];
    d[3 + i] = d[9 + i] = r[i];
  }
}

static void check_rigid_motion(ed_element_kind kind, numbers *source)
{
  one m = one_new(kind, ED_COROTATIONAL, I, J, AT_I, AT_J);
  for (int round = 0; round < 30; round++) {
    double d[N], force[N];
    move(0.1 * round + 1e-3, source, d);
    forces_at(&m, d, force);
    for (int i = 0; i < N; i++)
      CHECK_NEAR(force[i], 0.0, 1e-13 * EA);
  }
  one_free(&m);
}

/* Forces are the slope of the potential without loads, the tangent that of the forces with them, by central differences. */
static void check_slopes(ed_element_kind kind, int loaded, numbers *source)
{
  const double h = 1e-5;
  one m = one_new(kind, ED_COROTATIONAL, I, J, AT_I, AT_J);
  if (loaded)
    put_loads(&m);
  for (int round = 0; round < 20; round++) {
    double d[N], off[N], force[N], tangent[N * N];
    move(1.5, source, d);
    draw(source, 0.05, off);
    for (int i = 0; i < N; i++)
      d[i] += off[i];
    forces_at(&m, d, force);
    ed_element_tangent(&m.e, d, m.block, tangent);
    for (int j = 0; j < N; j++) {
      double plus[N], minus[N], there[N];
      memcpy(there, d, sizeof d);
      there[j] = d[j] + h;
      forces_at(&m, there, plus);
      const double up = ed_element_stored(&m.e, m.block, m.layers);
      there[j] = d[j] - h;
      forces_at(&m, there, minus);
      const double down = ed_element_stored(&m.e, m.block, m.layers);
      if (!loaded)
        CHECK_NEAR((up - down) / (2.0 * h), force[j], 1e-6 * EA);
      for (int i = 0; i < N; i++) {
        CHECK_NEAR((plus[i] - minus[i]) / (2.0 * h), tangent[N * i + j], 1e-7 * EA);
        CHECK_NEAR(tangent[N * i + j], tangent[N * j + i], 1e-12 * EA);
      }
    }
  }
  one_free(&m);
}

/* Where nothing has turned P-Delta leaves nothing out of the tangent; a stretch gives the axial force. The same arms to the second order are
 * those of finite rotations: both tangents are one there, but for shear forces over the drift, which P-Delta does not have. */
static void check_p_delta(ed_element_kind kind)
{
  const double h = 1e-6, straight[2][3] = {{0.1, -0.25, 0.2}, {0.1, -0.25, 0.2}};
  one m = one_new(kind, ED_P_DELTA, I, J, straight[0], straight[1]), exact = one_new(kind, ED_COROTATIONAL, I, J, straight[0], straight[1]);
  double d[N] = {0.0}, force[N], tangent[N * N], of_exact[N * N];
  for (int i = 0; i < 3; i++)
    d[6 + i] = 1e-3 * m.e.axis[0][i];
  forces_at(&m, d, force);
  ed_element_tangent(&m.e, d, m.block, tangent);
  for (int j = 0; j < N; j++) {
    double plus[N], minus[N], there[N];
    memcpy(there, d, sizeof d);
    there[j] = d[j] + h;
    forces_at(&m, there, plus);
    there[j] = d[j] - h;
    forces_at(&m, there, minus);
    for (int i = 0; i < N; i++)
      CHECK_NEAR((plus[i] - minus[i]) / (2.0 * h), tangent[N * i + j], 1e-9 * EA);
  }
  forces_at(&exact, d, force);
  ed_element_tangent(&exact.e, d, exact.block, of_exact);
  const double N_axial = 1e-3 * EA / m.e.length;
  for (int i = 0; i < N * N; i++) /* the stretch changes lengths and levers by 1e-3 / 3 */
    CHECK_NEAR(tangent[i], of_exact[i], 1e-3 * N_axial + 1e-3 * EI_Y);
  one_free(&m);
  one_free(&exact);
}

static void check_refused(void)
{
  ed_model *model = ed_model_new(3);
  ed_model_node(model, "i", I);
  ed_model_node(model, "j", (double[]){1.0, 2.0, 2.0});
  ed_model_elastic_section(model, (double[]){EA, EI_Z, EI_Y, GJ});
  const double none[3] = {0.0, 0.0, 0.0}, web[3] = {1.0, 0.0, 0.0};
  CHECK_INT(ed_model_elastic_beam(model, "m", 0, 1, 0, ED_LINEAR, NULL, web), 0);
  const double wrong[][3] = {{NAN, 0.0, 0.0}, {0.0, HUGE_VAL, 0.0}, {0.0, 0.0, 3.0}, {0.0, 0.0, 3.5}, {0.0, 0.0, 1e300}, {1e5, 0.0, 0.0}};
  for (int i = 0; i < 6; i++) {
    CHECK_STATUS(ed_model_offset_ends(model, 0, wrong[i], none), ED_E_ARGUMENT);
    CHECK_CONTAINS(ed_model_message(model), "m");
  }
  CHECK_STATUS(ed_model_offset_ends(model, 1, none, none), ED_E_ID);
  CHECK_STATUS(ed_model_rigid_ends(model, 0, 2.0, 1.0), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_rigid_ends(model, 0, -0.1, 0.1), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_without_flexibility(model, 0, 1, 1.0, 0.0), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_offset_ends(model, 0, none, none), ED_OK);
  ed_model_free(model);
  model = ed_model_new(3); /* whose length is a number, but not one that can be divided by */
  ed_model_node(model, "i", none);
  ed_model_node(model, "j", (double[]){0.0, 0.0, 1e-308});
  ed_model_elastic_section(model, (double[]){EA, EI_Z, EI_Y, GJ});
  CHECK_INT(ed_model_elastic_beam(model, "short", 0, 1, 0, ED_LINEAR, NULL, web), 0);
  CHECK_STATUS(ed_model_offset_ends(model, 0, none, (double[]){0.0, 0.0, -0.9e-308}), ED_E_ARGUMENT);
  ed_model_free(model);
  model = ed_model_new(2);
  ed_model_node(model, "i", I);
  ed_model_node(model, "j", J);
  ed_model_elastic_section(model, (double[]){EA, EI_Y});
  CHECK_INT(ed_model_elastic_beam(model, "flat", 0, 1, 0, ED_LINEAR, NULL, NULL), 0);
  CHECK_STATUS(ed_model_offset_ends(model, 0, none, none), ED_E_ARGUMENT);
  CHECK_STATUS(ed_model_without_flexibility(model, 0, 1, 1e-9, 0.0), ED_E_ARGUMENT);
  ed_model_free(model);
}

/* Springs about y with what the beam leaves out are the plain beam, and do not touch bending about z. */
static void check_without(void)
{
  one plain = one_new(ED_ELASTIC_BEAM, ED_LINEAR, I, J, NULL, NULL), m = one_new(ED_ELASTIC_BEAM, ED_LINEAR, I, J, NULL, NULL);
  const double less[2] = {0.1 * m.e.length / EI_Y, 0.2 * m.e.length / EI_Y};
  CHECK_STATUS(ed_model_without_flexibility(m.model, 0, 1, less[0], less[1]), ED_OK);
  CHECK_STATUS(ed_element_setup(&m.e, m.model, 0), ED_OK);
  for (int i = 0; i < ED_MAX_BASIC; i++)
    for (int j = i; j < ED_MAX_BASIC; j++) {
      const int at = ed_sym_place(ED_MAX_BASIC, i, j);
      CHECK_NEAR(m.e.flexibility[at] + (i == j && i > 2 ? less[i - 3] : 0.0), plain.e.flexibility[at], 1e-22);
    }
  one_free(&plain);
  one_free(&m);
}

int main(void)
{
  numbers source = {11};
  for (int k = 0; k < 2; k++) {
    check_stiffness(KINDS[k]);
    for (int geometry = ED_LINEAR; geometry <= ED_COROTATIONAL; geometry++)
      check_plane(KINDS[k], geometry, &source);
    check_rigid_motion(KINDS[k], &source);
    for (int loaded = 0; loaded < 2; loaded++)
      check_slopes(KINDS[k], loaded, &source);
    check_p_delta(KINDS[k]);
  }
  check_refused();
  check_without();
  return checks_end("offset ends");
}
