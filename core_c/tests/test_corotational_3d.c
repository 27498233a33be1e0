/* Members in space under finite rotations: rigid motions leave no force but that of loads inside, which keep their direction; forces are
 * the slope of the potential and the tangent that of the forces, wherever the member has turned. */
#include "checks.h"
#include "element/element.h"
#include "numbers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double EA = 3e9, EI_Z = 2e7, EI_Y = 5e7, GJ = 4e6;

typedef struct {
  ed_model *model;
  ed_element e;
  double *block, layers[1];
} one;

static one one_new(ed_element_kind kind)
{
  one m = {.model = ed_model_new(3)};
  const int i = ed_model_node(m.model, "i", (double[]){1.0, 2.0, -1.0}), j = ed_model_node(m.model, "j", (double[]){2.0, 4.0, 1.0});
  const double web[3] = {2.0 / 3.0, -2.0 / 3.0, 1.0 / 3.0};
  int id;
  if (kind == ED_TRUSS) {
    ed_model_material(m.model, ED_ELASTIC, 1, &EA);
    id = ed_model_truss(m.model, "m", i, j, 0, 1.0, ED_COROTATIONAL);
  } else {
    ed_model_elastic_section(m.model, (double[]){EA, EI_Z, EI_Y, GJ});
    id = ed_model_elastic_beam(m.model, "m", i, j, 0, ED_COROTATIONAL, NULL, web);
  }
  CHECK_INT(id, 0);
  CHECK_STATUS(ed_element_setup(&m.e, m.model, id), ED_OK);
  m.block = calloc((size_t)ed_element_block_size(&m.e), sizeof *m.block);
  ed_element_initialise(&m.e, m.block, m.layers);
  return m;
}

static void one_free(one *m)
{
  free(m->block);
  ed_element_clear(&m->e);
  ed_model_free(m->model);
}

static const ed_member_load UNIFORM = {.position = -1.0, .axial = 4e6, .transverse = {-7e6, 3e6}},
                           POINT = {.position = 0.3, .axial = -9e6, .transverse = {2e6, 8e6}};

static void load(one *m)
{
  ed_element_add_load(&m->e, &UNIFORM, 1.0);
  ed_element_add_load(&m->e, &POINT, 1.0);
  ed_element_finish_loads(&m->e);
}

static void forces_at(one *m, const double *d, double *force)
{
  ed_element_control control = {.tolerance = 1e-22, .fast_elastic = 1};
  CHECK_STATUS(ed_element_update(&m->e, d, m->layers, m->block, &control), ED_OK);
  ed_element_forces(&m->e, d, m->block, force);
}

static double energy_at(one *m, const double *d)
{
  double force[ED_MAX_DEGREES];
  forces_at(m, d, force);
  return ed_element_stored(&m->e, m->block, m->layers);
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

/* Displacements of a rotation by the vector r about the start. */
static void swing(const one *m, const double r[3], double *d)
{
  const double axis[3] = {m->e.length * m->e.axis[0][0], m->e.length * m->e.axis[0][1], m->e.length * m->e.axis[0][2]};
  turn(r, axis, d + 6);
  for (int i = 0; i < 3; i++) {
    d[i] = 0.0;
    d[3 + i] = d[9 + i] = r[i];
  }
}

/* Displacements of a rigid motion by the rotation vector r. */
static void move(const one *m, const double r[3], numbers *source, double *d)
{
  swing(m, r, d);
  for (int i = 0; i < 3; i++) {
    d[i] = next_number(source, -2.0, 2.0);
    d[6 + i] += d[i];
  }
}

/* Work of the loads as the end of a straight member moves and its start stays: at a share x of the length they move by x times that. */
static double work_of_loads(const one *m, const double *moved)
{
  const double x[3] = {0.5 * UNIFORM.axial * m->e.length + POINT.position * POINT.axial,
                       0.5 * UNIFORM.transverse[0] * m->e.length + POINT.position * POINT.transverse[0],
                       0.5 * UNIFORM.transverse[1] * m->e.length + POINT.position * POINT.transverse[1]};
  double work = 0.0;
  for (int k = 0; k < 3; k++)
    for (int i = 0; i < 3; i++)
      work += x[k] * m->e.axis[k][i] * moved[i];
  return work;
}

/* A loaded pendulum: forces at both ends together are the loads, and along a turn about the start they do their work. Differences err by
 * h^2 / 6 of what changes once a radian; the member stays straight, as it is stiff. */
static void check_pendulum(numbers *source)
{
  enum { N = ED_MAX_DEGREES };
  const double h = 1e-4, scale = 3.0 * 9e6;
  one m = one_new(ED_ELASTIC_BEAM);
  load(&m);
  for (int round = 0; round < 40; round++) {
    double r[3], by[3], d[N], force[N], side[2][N], apart[3], work = 0.0;
    for (int i = 0; i < 3; i++) {
      r[i] = next_number(source, -1.7, 1.7);
      by[i] = next_number(source, -1.0, 1.0);
    }
    swing(&m, r, d);
    forces_at(&m, d, force);
    for (int i = 0; i < 3; i++) {
      double whole = 0.0;
      for (int k = 0; k < 3; k++) {
        const double uniform = k ? UNIFORM.transverse[k - 1] : UNIFORM.axial, point = k ? POINT.transverse[k - 1] : POINT.axial;
        whole += (uniform * m.e.length + point) * m.e.axis[k][i];
      }
      CHECK_NEAR(force[i] + force[6 + i], -whole, 1e-13 * EA);
    }
    for (int s = 0; s < 2; s++) {
      const double there[3] = {r[0] + (s ? h : -h) * by[0], r[1] + (s ? h : -h) * by[1], r[2] + (s ? h : -h) * by[2]};
      swing(&m, there, side[s]);
    }
    for (int i = 0; i < N; i++)
      work += force[i] * (side[1][i] - side[0][i]) / (2.0 * h);
    for (int i = 0; i < 3; i++)
      apart[i] = (side[1][6 + i] - side[0][6 + i]) / (2.0 * h);
    CHECK_NEAR(work, -work_of_loads(&m, apart), 1e-7 * scale);
  }
  one_free(&m);
}

static void check_rigid(ed_element_kind kind, numbers *source)
{
  one m = one_new(kind);
  for (int round = 0; round < 40; round++) {
    const double size = 0.15 * round; /* up to 5.85 rad */
    double r[3], d[ED_MAX_DEGREES], force[ED_MAX_DEGREES], norm = 0.0;
    for (int i = 0; i < 3; i++) {
      r[i] = next_number(source, -1.0, 1.0);
      norm += r[i] * r[i];
    }
    for (int i = 0; i < 3; i++)
      r[i] *= (size + 1e-3) / sqrt(norm);
    move(&m, r, source, d);
    forces_at(&m, d, force);
    for (int i = 0; i < ED_MAX_DEGREES; i++)
      CHECK_NEAR(force[i], 0.0, 1e-13 * EA);
  }
  one_free(&m);
}

/* Central differences, in steps that lose half of the digits. */
static void check_slopes(ed_element_kind kind, int loaded, numbers *source)
{
  enum { N = ED_MAX_DEGREES };
  const double h = 1e-5;
  one m = one_new(kind);
  if (loaded)
    load(&m);
  for (int round = 0; round < 30; round++) {
    double r[3], d[N], force[N], tangent[N * N];
    for (int i = 0; i < 3; i++)
      r[i] = next_number(source, -1.5, 1.5);
    move(&m, r, source, d);
    for (int i = 0; i < N; i++)
      d[i] += next_number(source, -0.05, 0.05);
    forces_at(&m, d, force);
    ed_element_tangent(&m.e, d, m.block, tangent);
    const double scale = EA;
    for (int j = 0; j < N; j++) {
      double plus[N], minus[N], there[N];
      memcpy(there, d, sizeof d);
      there[j] = d[j] + h;
      const double up = energy_at(&m, there);
      forces_at(&m, there, plus);
      there[j] = d[j] - h;
      const double down = energy_at(&m, there);
      forces_at(&m, there, minus);
      if (!loaded)
        CHECK_NEAR((up - down) / (2.0 * h), force[j], 1e-6 * scale);
      for (int i = 0; i < N; i++) {
        CHECK_NEAR((plus[i] - minus[i]) / (2.0 * h), tangent[N * i + j], 1e-7 * scale);
        CHECK_NEAR(tangent[N * i + j], tangent[N * j + i], 1e-13 * scale);
      }
    }
  }
  one_free(&m);
}

int main(void)
{
  numbers source = {7};
  check_rigid(ED_ELASTIC_BEAM, &source);
  check_rigid(ED_TRUSS, &source);
  check_pendulum(&source);
  check_slopes(ED_ELASTIC_BEAM, 0, &source);
  check_slopes(ED_ELASTIC_BEAM, 1, &source);
  check_slopes(ED_TRUSS, 0, &source);
  return checks_end("finite rotations in space");
}
