#include "random_calls.h"

#include "checks.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_THINGS = 12, MOST_DEGREES = 6, MOST_NODES = 16 };

/* What the caller knows of a model. */
typedef struct {
  ed_model *model;
  int dimension, degrees; /* of a node */
  int materials, sections, nodes, elements, patterns, dampers;
  int in_plane[MOST_THINGS];      /* sections that bend about one axis */
  double place[MOST_NODES][3], mass[MOST_NODES];
} things;

/* Over the degrees of a node, each with its own share. */
static int *some_degrees(caller *c, const double *share, int *degrees)
{
  for (int d = 0; d < MOST_DEGREES; d++)
    degrees[d] = chance(c, share[d]);
  return degrees;
}

/* A degree of a node, now and then one that there is not. */
static int some_degree(caller *c, const things *m)
{
  return chance(c, c->wild) ? whole(c, -1, m->degrees) : whole(c, 0, m->degrees - 1);
}

static void count(caller *c, int *of, int id)
{
  expect_listed(c, id < 0 ? id : ED_OK);
  CHECK(id < 0 || id == *of);
  *of += id >= 0;
}

static const char *name(caller *c)
{
  static const char *const names[] = {"a", "beam", "", NULL,
                                      "a name that is longer than any name of a node should be, and then it goes on and on"};
  return names[whole(c, 0, 4)];
}

static void add_steels(caller *c, things *m)
{
  for (int i = whole(c, 1, 3); i > 0; i--) {
    const double parameters[6] = {or_absurd(c, 2e11), or_absurd(c, 2.75e8), or_absurd(c, 0.02),
                                  or_absurd(c, 20.0), or_absurd(c, 0.925),  or_absurd(c, 0.15)};
    const int law = chance(c, c->wild) ? whole(c, -1, 3) : whole(c, 0, 2);
    count(c, &m->materials, ed_model_material(m->model, law, law == 0 ? 1 : law == 1 ? 3 : 6, parameters));
    if (chance(c, 0.2))
      expect_listed(c, ed_model_fatigue(m->model, some_id(c, m->materials), or_absurd(c, 0.05), or_absurd(c, 2.0)));
  }
  for (int i = whole(c, 1, 3); i > 0; i--) {
    if (chance(c, 0.4)) {
      const double stiffness[4] = {or_absurd(c, 2e9), or_absurd(c, 4e7), or_absurd(c, 1e7), or_absurd(c, 1e6)};
      m->in_plane[m->sections] = m->dimension == 2;
      count(c, &m->sections, ed_model_elastic_section(m->model, stiffness));
      continue;
    }
    const int n = chance(c, c->wild) ? 0 : whole(c, 2, 20);
    double *y = room(n), *z = room(n), *area = room(n);
    const int in_plane = m->dimension == 2 ? !chance(c, c->wild) : chance(c, 0.3);
    int *material = calloc((size_t)n + 1, sizeof *material);
    for (int k = 0; k < n; k++) {
      y[k] = or_absurd(c, chance(c, 0.3) ? 0.1 : next_number(&c->source, -0.2, 0.2));
      z[k] = or_absurd(c, chance(c, 0.3) ? 0.05 : next_number(&c->source, -0.1, 0.1));
      area[k] = or_absurd(c, 1e-3);
      material[k] = some_id(c, m->materials);
    }
    m->in_plane[m->sections] = in_plane;
    count(c, &m->sections, ed_model_fibre_section(m->model, n, y, in_plane ? NULL : z, area, material, or_absurd(c, 1e6)));
    if (chance(c, 0.2))
      expect_listed(c, ed_model_section_layers(m->model, some_id(c, m->sections)) < 0 ? ED_E_ID : ED_OK);
    free(y), free(z), free(area), free(material);
  }
}

static int ends(caller *c, const things *m, int *j)
{
  const int i = some_id(c, m->nodes);
  *j = chance(c, 0.8) && i >= 0 && i < m->nodes - 1 ? i + 1 : some_id(c, m->nodes);
  return i;
}

/* One that bends about as many axes as are asked for, if there is one. */
static int some_section(caller *c, const things *m, int in_plane)
{
  int id = some_id(c, m->sections);
  for (int i = 0; i < m->sections && !chance(c, c->wild) && id >= 0 && id < m->sections && m->in_plane[id] != in_plane; i++)
    id = (id + 1) % m->sections;
  return id;
}

/* At right angles to what runs between two nodes, and of length 1. */
static void some_web(caller *c, const things *m, int i, int j, double *web)
{
  double along[3] = {0.0, 0.0, 1.0}, length = 0.0, share = 0.0, size = 0.0;
  for (int k = 0; i >= 0 && j >= 0 && i < m->nodes && j < m->nodes && k < 3; k++)
    along[k] = m->place[j][k] - m->place[i][k];
  for (int k = 0; k < 3; k++) {
    web[k] = next_number(&c->source, -1.0, 1.0);
    length += along[k] * along[k];
    share += web[k] * along[k];
  }
  for (int k = 0; k < 3; k++) {
    web[k] -= length > 0.0 ? share / length * along[k] : 0.0;
    size += web[k] * web[k];
  }
  for (int k = 0; k < 3; k++)
    web[k] = or_absurd(c, web[k] / sqrt(size));
}

static void add_spring(caller *c, things *m, int i, int j)
{
  static const double laws[][21] = {
      [ED_SPRING_MULTILINEAR] = {1e-3, 1e4, 1e-2, 2e4, 1e5},
      [ED_SPRING_CONTACT] = {1e8, 1e5},
      [ED_SPRING_DETERIORATING] = {1e7, 0.02, 0.1, 0.3, 1e4, 1.1, 0.2, 1.0, 0.02, 0.1, 0.3, 1e4, 1.1, 0.2, 1.0, 1e3, 1e3, 1e3, 1.0, 1.0, 1.0}};
  static const int counts[] = {5, 2, 21};
  double coefficient[2 * MOST_DEGREES] = {0.0}, parameters[21];
  const int law = chance(c, c->wild) ? whole(c, -1, 3) : whole(c, 0, 2), known = law >= 0 && law < 3 ? law : 0;
  for (int k = 0; k < 21; k++)
    parameters[k] = or_absurd(c, laws[known][k]);
  const int d = whole(c, 0, m->degrees - 1);
  coefficient[d] = or_absurd(c, -1.0);
  coefficient[m->degrees + d] = or_absurd(c, 1.0);
  for (int k = 0; k < 2 * m->degrees && chance(c, 0.5); k++)
    coefficient[k] += or_absurd(c, next_number(&c->source, -1.0, 1.0));
  count(c, &m->elements, ed_model_spring(m->model, name(c), i, j, coefficient, law, chance(c, c->wild) ? 3 : counts[known], parameters));
}

static void add_element(caller *c, things *m, int i, int j, int kind)
{
  int sections[MOST_THINGS], release[4];
  double web[3];
  const int points = chance(c, c->wild) ? whole(c, -1, 12) : whole(c, 3, 5);
  const int geometry = chance(c, c->wild) ? 9 : whole(c, 0, 2);
  for (int k = 0; k < MOST_THINGS; k++)
    sections[k] = k && chance(c, 0.8) ? sections[0] : some_section(c, m, m->dimension == 2 || kind == 3);
  for (int k = 0; k < 4; k++)
    release[k] = chance(c, 0.03);
  some_web(c, m, i, j, web);
  switch (kind) { /* others are fibre beams */
    case 0:
      count(c, &m->elements, ed_model_truss(m->model, name(c), i, j, some_id(c, m->materials), or_absurd(c, 1e-2), geometry));
      break;
    case 1:
      if (m->dimension == 2 || chance(c, c->wild))
        count(c, &m->elements, ed_model_link(m->model, name(c), i, j, or_absurd(c, 1e8), or_absurd(c, 1e8), or_absurd(c, 1e7), or_absurd(c, 0.3)));
      break;
    case 3:
      count(c, &m->elements,
            ed_model_strut(m->model, name(c), i, j, sections[0], points, chance(c, c->wild) ? whole(c, -1, 20) : 2 * whole(c, 1, 4),
                           or_absurd(c, 1e-3), or_absurd(c, chance(c, 0.5) ? 1.0 : 0.5), or_absurd(c, chance(c, 0.5) ? 0.0 : 1e6),
                           some_id(c, m->materials), or_absurd(c, 1e-2), geometry));
      break;
    case 2:
      count(c, &m->elements, ed_model_elastic_beam(m->model, name(c), i, j, sections[0], geometry, release, web));
      break;
    case 4:
      add_spring(c, m, i, j);
      break;
    default:
      count(c, &m->elements, ed_model_beam_column(m->model, name(c), i, j, points, sections, geometry, release, web));
  }
}

static void add_damper(caller *c, things *m)
{
  double parameters[64] = {0.0}, coefficient[MOST_THINGS + 2];
  int law, node[MOST_THINGS + 2], degree[MOST_THINGS + 2];
  const int n = some_law(c, &law, parameters), terms = chance(c, c->wild) ? whole(c, -1, MOST_THINGS + 2) : chance(c, 0.8) ? 2 : whole(c, 1, 12);
  for (int k = 0; k < terms; k++) {
    node[k] = some_id(c, m->nodes);
    degree[k] = chance(c, c->wild) ? whole(c, -1, 6) : k && chance(c, 0.8) ? degree[0] : whole(c, 0, m->degrees - 1);
    coefficient[k] = or_absurd(c, k % 2 ? 1.0 : -1.0);
  }
  count(c, &m->dampers, ed_model_damper(m->model, name(c), law, n, parameters, or_absurd(c, chance(c, 0.6) ? 0.0 : 1e8),
                                        or_absurd(c, chance(c, 0.8) ? 0.0 : 1e-3), or_absurd(c, 1.0),
                                        or_absurd(c, 1.0), terms, node, degree, coefficient));
  if (chance(c, 0.3)) {
    for (int k = 0; k < terms; k++)
      degree[k] = chance(c, 0.8) ? 1 : whole(c, 0, m->degrees - 1);
    count(c, &m->dampers, ed_model_damper_across(m->model, some_id(c, m->dampers), name(c), terms, node, degree, coefficient));
  }
  if (chance(c, 0.1))
    expect_listed(c, ed_model_damper_carries(m->model, some_id(c, m->dampers)));
  if (chance(c, 0.1))
    expect_listed(c, ed_model_damper_weighs(m->model, some_id(c, m->dampers), some_id(c, m->elements), or_absurd(c, 1e5)));
  if (chance(c, 0.3)) {
    int form;
    const int k = some_effect(c, &form, parameters);
    expect_listed(c, ed_model_add_damper_effect(m->model, some_id(c, m->dampers), form, some_placement(c), k, parameters));
  }
}

static void shape_element(caller *c, const things *m)
{
  if (chance(c, 0.3))
    expect_listed(c, ed_model_rigid_ends(m->model, some_id(c, m->elements), or_absurd(c, 0.2), or_absurd(c, 0.3)));
  if (chance(c, 0.3)) {
    double offset[2][3];
    for (int k = 0; k < 6; k++)
      offset[k / 3][k % 3] = or_absurd(c, chance(c, 0.3) ? 0.0 : size_between(c, 1e-3, 1.0) * (chance(c, 0.5) ? 1.0 : -1.0));
    expect_listed(c, ed_model_offset_ends(m->model, some_id(c, m->elements), offset[0], offset[1]));
  }
  if (chance(c, 0.1))
    expect_listed(c, ed_model_without_flexibility(m->model, some_id(c, m->elements), chance(c, 0.5), or_absurd(c, 1e-10), or_absurd(c, 1e-10)));
  if (chance(c, 0.1))
    expect_listed(c, ed_model_damping_factor(m->model, some_id(c, m->elements), or_absurd(c, 2.0)));
  if (chance(c, 0.3)) {
    double position[MOST_THINGS];
    const int n = chance(c, c->wild) ? whole(c, -1, MOST_THINGS) : whole(c, 0, 3);
    for (int k = 0; k < MOST_THINGS; k++)
      position[k] = or_absurd(c, (k + 0.5) / (n > 0 ? n : 1));
    expect_listed(c, ed_model_breaks(m->model, some_id(c, m->elements), n, position));
  }
}

static void add_loads(caller *c, things *m)
{
  for (int i = whole(c, 1, 3); i > 0; i--)
    count(c, &m->patterns, ed_model_pattern(m->model));
  for (int i = whole(c, 1, 6); i > 0; i--) {
    const int pattern = some_id(c, m->patterns);
    double force[MOST_DEGREES], across[4][2];
    for (int d = 0; d < MOST_DEGREES; d++)
      force[d] = or_absurd(c, d == m->dimension - 1 ? -1e5 : d < 2 || chance(c, 0.3) ? 1e4 : 0.0);
    for (int k = 0; k < 4; k++)
      for (int a = 0; a < 2; a++)
        across[k][a] = or_absurd(c, a ? 3e3 : -1e4);
    expect_listed(c, ed_model_nodal_load(m->model, pattern, some_id(c, m->nodes), force));
    if (chance(c, 0.3))
      expect_listed(c, ed_model_uniform_load(m->model, pattern, some_id(c, m->elements), or_absurd(c, 0.0), across[0]));
    if (chance(c, 0.2))
      expect_listed(c, ed_model_point_load(m->model, pattern, some_id(c, m->elements), or_absurd(c, 0.4), or_absurd(c, 0.0), across[1]));
    if (chance(c, 0.2))
      expect_listed(c, ed_model_partial_load(m->model, pattern, some_id(c, m->elements), or_absurd(c, 0.1), or_absurd(c, 0.7), across[2], across[3]));
  }
}

static void add_node(caller *c, things *m, double x, double y, double z)
{
  double *place = m->place[m->nodes];
  place[0] = or_absurd(c, x), place[1] = or_absurd(c, y), place[2] = or_absurd(c, z);
  count(c, &m->nodes, ed_model_node(m->model, name(c), place));
}

static void add_mass(caller *c, things *m, int node, double turning)
{
  double mass[MOST_DEGREES];
  const int at = chance(c, 0.9) ? node : some_id(c, m->nodes);
  const double size = size_between(c, 1e3, 1e4);
  for (int d = 0; d < MOST_DEGREES; d++)
    mass[d] = or_absurd(c, d < m->dimension ? size : turning);
  if (expect_listed(c, ed_model_mass(m->model, at, mass)) == ED_OK)
    m->mass[at] += size;
}

/* Of nodes from `first` on; the master, which is made here, stands at their centre of mass unless the caller is wild. Returns the first
 * that is not in it. */
static int add_diaphragm(caller *c, things *m, int first, int last)
{
  int node[MOST_NODES], n = 0;
  double mass = 0.0, at[3] = {0.0};
  for (int i = first; i <= last; i++) {
    node[n++] = chance(c, 0.1 * c->wild) ? some_id(c, m->nodes) : i;
    for (int k = 0; k < 3; k++)
      at[k] += m->mass[i] * m->place[i][k];
    mass += m->mass[i];
  }
  if (mass <= 0.0)
    mass = 1.0;
  add_node(c, m, at[0] / mass, at[1] / mass, at[2] / mass);
  const int master = m->nodes - 1;
  if (chance(c, 0.95))
    expect_listed(c, ed_model_fix(m->model, master, (int[]){chance(c, 0.1), chance(c, 0.1), 1, 1, 1, chance(c, 0.1)}));
  expect_listed(c, ed_model_diaphragm(m->model, chance(c, c->wild) ? some_id(c, m->nodes) : master, chance(c, c->wild) ? whole(c, -1, n) : n, node));
  if (chance(c, 0.3))
    add_mass(c, m, master, 1e3);
  return last + 1;
}

/* Masses and supports; in space diaphragms too, which come before dampers. */
static void hold(caller *c, things *m)
{
  int degrees[MOST_DEGREES];
  static const double all[] = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}, half[] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, tied[] = {0.7, 0.2, 0.2, 0.1, 0.1, 0.1};
  const int nodes = m->nodes;
  expect_listed(c, ed_model_fix(m->model, some_id(c, 1), some_degrees(c, all, degrees)));
  for (int i = 0; i < nodes; i++)
    add_mass(c, m, i, chance(c, 0.5) ? 0.0 : 1e3);
  if (m->dimension == 3 || chance(c, c->wild))
    for (int i = 1; i < nodes - 1 && m->nodes < MOST_NODES - 1;)
      i = chance(c, 0.6) ? add_diaphragm(c, m, i, whole(c, i + 1, nodes - 1)) : i + 1;
  for (int i = whole(c, 0, 2); i > 0; i--)
    expect_listed(c, ed_model_fix(m->model, some_id(c, m->nodes), some_degrees(c, half, degrees)));
  for (int i = whole(c, 0, 2); i > 0 && chance(c, 0.3); i--)
    expect_listed(c, ed_model_tie(m->model, some_id(c, m->nodes), some_id(c, m->nodes), some_degrees(c, tied, degrees)));
}

static int make_model(caller *c, things *m, int dimension)
{
  *m = (things){.model = ed_model_new(dimension), .dimension = dimension, .degrees = dimension == 3 ? 6 : 3};
  if (!m->model) {
    expect_listed(c, ED_E_MEMORY);
    return 0;
  }
  add_steels(c, m);
  for (int i = whole(c, 2, 7); i > 0; i--) {
    const double away = chance(c, 0.7) ? 0.0 : 4.0 * m->nodes;
    if (dimension == 2)
      add_node(c, m, away, 3.0 * m->nodes, 0.0);
    else
      add_node(c, m, away, chance(c, 0.7) ? 0.0 : 5.0, 3.0 * (chance(c, 0.6) ? m->nodes : m->nodes / 2));
  }
  const int chain = chance(c, 0.7) ? m->nodes - 1 : 0; /* members of a chain of beams, or whatever comes */
  hold(c, m);
  for (int i = 0; i < chain; i++)
    add_element(c, m, i, i + 1, chance(c, 0.2) ? 2 : 9);
  for (int i = chain ? whole(c, 0, 4) : m->nodes + 2; i > 0; i--) {
    int k;
    const int j = ends(c, m, &k);
    add_element(c, m, j, k, whole(c, 0, 9));
    shape_element(c, m);
  }
  for (int i = whole(c, 0, 4); i > 0 && chance(c, 0.6); i--)
    add_damper(c, m);
  add_loads(c, m);
  CHECK(ed_model_message(m->model) != NULL);
  return 1;
}

/* ---- analysis ---- */

typedef struct {
  ed_analysis *analysis;
  int n, channels, kept, steps, state_size;
  double *state;                     /* before the present call */
  double *abscissa, *values, *energy; /* buffers of the run, or NULL */
} run;

static void note_state(run *r)
{
  ed_state_get(r->analysis, r->state);
}

/* After a call that failed, or that only looks. */
#define expect_same_state(r) expect_same_state_at(__LINE__, (r))
static void expect_same_state_at(int line, run *r)
{
  double *now = room(r->state_size);
  ed_state_get(r->analysis, now);
  check_true(__FILE__, line, memcmp(now, r->state, (size_t)r->state_size * sizeof *now) == 0, "the same state");
  free(now);
}

static void free_buffers(run *r)
{
  free(r->abscissa), free(r->values), free(r->energy);
  r->abscissa = r->values = r->energy = NULL;
}

static void add_channel(caller *c, run *r, const things *m)
{
  const int n = chance(c, c->wild) ? whole(c, -1, 0) : whole(c, 1, 3);
  double coefficient[3];
  int kind[3], object[3], component[3];
  for (int i = 0; i < n; i++) {
    coefficient[i] = signed_size(c, 0.1, 10.0);
    kind[i] = chance(c, c->wild) ? whole(c, -1, 26) : whole(c, 0, 25);
    object[i] = some_id(c, kind[i] <= ED_REACTION ? m->nodes : kind[i] >= ED_DAMPER_FORCE && kind[i] < ED_GIVEN_FORCE ? m->dampers : m->elements);
    component[i] = chance(c, 0.6) ? 0 : whole(c, -1, 14);
  }
  const int keep = chance(c, 0.5), root = chance(c, 0.1);
  const int id = root ? ed_channel_root(r->analysis, some_id(c, r->channels), some_id(c, r->channels), keep)
                      : ed_channel(r->analysis, n, coefficient, kind, object, component, keep);
  expect_listed(c, id < 0 ? id : ED_OK);
  if (id >= 0) {
    CHECK_INT(id, r->channels);
    r->channels++;
    r->kept += keep;
    if (chance(c, 0.2))
      expect_listed(c, ed_channel_limit(r->analysis, some_id(c, r->channels), or_absurd(c, size_between(c, 1e-3, 1e6))));
  }
}

static void set_something(caller *c, run *r)
{
  static const double usual[] = {1e-7, 25, 1e-16, 4, 1, 1, 1};
  const int setting = chance(c, c->wild) ? whole(c, -1, 9) : whole(c, 0, 6);
  expect_listed(c, ed_set(r->analysis, setting, or_absurd(c, setting >= 0 && setting < 7 ? usual[setting] : 1.0)));
  if (chance(c, 0.5))
    expect_listed(c, ed_rayleigh(r->analysis, or_absurd(c, 0.1), or_absurd(c, 1e-3), chance(c, c->wild) ? 7 : whole(c, 0, 2)));
  if (chance(c, 0.2)) {
    const int modes = chance(c, c->wild) ? r->n + 1 : whole(c, 0, r->n < 3 ? r->n : 3);
    double *shape = values_between(c, modes * r->n, 0.1, 1.0), *omega = values_between(c, modes, 1.0, 100.0), *ratio = room(modes);
    for (int i = 0; i < modes; i++)
      omega[i] = fabs(omega[i]), ratio[i] = or_absurd(c, 0.05);
    expect_listed(c, ed_modal_damping(r->analysis, modes, shape, omega, ratio));
    free(shape), free(omega), free(ratio);
  }
}

static void begin_run(caller *c, run *r, const things *m)
{
  const int steps = chance(c, c->wild) ? whole(c, -1, 0) : whole(c, 1, 12), kind = whole(c, 0, 3);
  int status;
  note_state(r);
  if (kind == 0)
    status = ed_static_begin(r->analysis, some_id(c, m->patterns), or_absurd(c, 1.0), steps);
  else if (kind == 1)
    status = ed_pushover_begin(r->analysis, some_id(c, m->patterns), some_id(c, m->nodes), chance(c, 0.7) ? 0 : some_degree(c, m), or_absurd(c, 0.05), steps);
  else {
    double *x = values_between(c, steps + 1, 1e-2, 10.0), *y = values_between(c, steps + 1, 1e-2, 10.0), *z = values_between(c, steps + 1, 1e-2, 10.0);
    const double newmark[] = {or_absurd(c, 0.5), or_absurd(c, 0.25)};
    const double alpha[] = {or_absurd(c, 0.0), or_absurd(c, 0.05), or_absurd(c, 0.55), or_absurd(c, 0.275625)};
    const int method = chance(c, c->wild) ? whole(c, -1, 2) : whole(c, 0, 1);
    status = ed_history_begin(r->analysis, steps, or_absurd(c, 0.01), steps > 0 && chance(c, 0.9) ? x : NULL, chance(c, 0.3) ? y : NULL, chance(c, 0.3) ? z : NULL, method, method == ED_GENERALISED_ALPHA ? alpha : newmark);
    free(x), free(y), free(z);
  }
  if (expect_listed(c, status) != ED_OK) {
    expect_same_state(r);
    return;
  }
  for (int i = kind > 1 && chance(c, 0.4) ? whole(c, 1, 4) : 0; i > 0; i--) {
    double *part[3];
    for (int k = 0; k < 3; k++) {
      part[k] = values_between(c, steps + 1, 1e-4, 1e-2);
      part[k][0] = chance(c, 0.1) ? part[k][0] : 0.0;
    }
    expect_listed(c, ed_history_support(r->analysis, some_id(c, m->nodes), some_degree(c, m), part[0], part[1], part[2]));
    for (int k = 0; k < 3; k++)
      free(part[k]);
    note_state(r); /* a support begins with an acceleration */
  }
  for (int i = kind > 1 && chance(c, 0.4) ? whole(c, 1, 3) : 0; i > 0; i--) {
    const int node[] = {some_id(c, m->nodes), some_id(c, m->nodes)}, degree[] = {whole(c, 0, m->degrees - 1), chance(c, 0.5) ? 0 : some_degree(c, m)};
    const double coefficient[] = {or_absurd(c, 1.0), or_absurd(c, -1.0)};
    const int number = ed_history_force(r->analysis, whole(c, 1, 2), node, degree, coefficient);
    expect_listed(c, number < 0 ? number : ED_OK);
    expect_listed(c, ed_history_set_force(r->analysis, whole(c, 0, 1), or_absurd(c, 1e3), or_absurd(c, 1e3)));
    note_state(r); /* accelerations jump with a force */
  }
  r->steps = steps;
  free_buffers(r);
  const int every = whole(c, 1, 3), rows = steps / every + 1;
  r->abscissa = chance(c, 0.7) ? room(rows) : NULL;
  r->values = chance(c, 0.7) ? room(rows * (r->kept + 4)) : NULL; /* of channels that are still to come */
  r->energy = chance(c, 0.7) ? room(rows * ED_N_ENERGY) : NULL;
  ed_run_buffers(r->analysis, every, r->abscissa, r->values, r->energy);
}

static void check_results(caller *c, run *r, int status)
{
  double *of[6];
  for (int k = 0; k < 6; k++)
    of[k] = room(r->channels + 1);
  const int rows = ed_run_rows(r->analysis);
  if (rows > 0) {
    ed_extremes(r->analysis, of[0], of[1], of[2], of[3], of[4]);
    ed_angles(r->analysis, of[5]);
    for (int k = 0; k < 6; k++)
      expect_finite(status, of[k], r->channels);
  }
  if (r->abscissa)
    expect_finite(status, r->abscissa, rows);
  if (r->values)
    expect_finite(status, r->values, rows * r->kept);
  if (r->energy)
    expect_finite(status, r->energy, rows * ED_N_ENERGY);
  ed_statistics s;
  ed_get_statistics(r->analysis, &s);
  const double measure[2] = {s.worst_unbalance, s.energy_error};
  expect_finite(status, measure, 2);
  note_state(r);
  expect_finite(status, r->state, r->state_size);
  if (status == ED_LIMIT) {
    double limit[2] = {NAN, NAN};
    CHECK(ed_run_limit(r->analysis, &limit[0], &limit[1]) >= 0);
    expect_finite(status, limit, 2);
  }
  ed_event event;
  ed_get_event(r->analysis, some_id(c, ed_n_events(r->analysis)), &event);
  for (int k = 0; k < 6; k++)
    free(of[k]);
}

static void advance(caller *c, run *r)
{
  const int steps = chance(c, 0.8) ? 1 : whole(c, -1, 5), before = ed_run_steps_done(r->analysis);
  if (before == 0)
    expect_listed(c, ed_run_advance(r->analysis, 0)); /* the first sample, which counts the energy of what there is */
  note_state(r);
  const int status = expect_listed(c, ed_run_advance(r->analysis, steps)), done = ed_run_steps_done(r->analysis);
  CHECK(done - before <= (steps > 0 ? steps : 0));
  if (status < 0 && done == before)
    expect_same_state(r);
  if (status >= 0)
    check_results(c, r, status);
}

static void look(caller *c, run *r, const things *m)
{
  const int nnz = ed_n_nonzeros(r->analysis);
  int *start = malloc(((size_t)r->n + 1) * sizeof *start), *row = malloc((size_t)nnz * sizeof *row);
  int *equation = malloc((size_t)m->degrees * (size_t)m->nodes * sizeof *equation);
  double *value = room(nnz), *mass = room(r->n);
  note_state(r);
  const int status = expect_listed(c, ed_stiffness(r->analysis, start, row, value));
  expect_finite(status, value, nnz);
  ed_mass(r->analysis, mass);
  expect_finite(ED_OK, mass, r->n);
  ed_equations(r->analysis, equation);
  CHECK(ed_unstable_directions(r->analysis) >= -1);
  expect_same_state(r);
  free(start), free(row), free(equation), free(value), free(mass);
}

/* States that are the analysis' own, of another time, or no state at all. */
static void set_state(caller *c, run *r, const double *kept)
{
  double *given = room(r->state_size);
  memcpy(given, kept, (size_t)r->state_size * sizeof *given);
  if (chance(c, c->wild))
    given[whole(c, 0, r->state_size - 1)] = chance(c, 0.5) ? NAN : INFINITY;
  note_state(r);
  if (expect_listed(c, ed_state_set(r->analysis, given)) != ED_OK)
    expect_same_state(r);
  free(given);
}

static void give_velocity(caller *c, run *r)
{
  double *velocity = values_between(c, r->n, 1e-3, 0.1);
  note_state(r);
  if (expect_listed(c, ed_initial_velocity(r->analysis, velocity)) != ED_OK)
    expect_same_state(r);
  free(velocity);
}

static void call_something(caller *c, run *r, const things *m, const double *kept)
{
  switch (whole(c, 0, 12)) {
    case 0:
      set_something(c, r);
      break;
    case 1:
      add_channel(c, r, m);
      break;
    case 2:
      begin_run(c, r, m);
      break;
    case 3:
      look(c, r, m);
      break;
    case 4:
      expect_listed(c, ed_install_dampers(r->analysis));
      break;
    case 5:
      if (chance(c, 0.5))
        give_velocity(c, r);
      else if (chance(c, 0.5))
        set_state(c, r, kept);
      break;
    case 6:
      note_state(r);
      expect_listed(c, ed_try_and_revert(r->analysis, or_absurd(c, 1.0)));
      expect_same_state(r);
      break;
    case 7:
      if (chance(c, 0.5))
        ed_run_end(r->analysis);
      if (chance(c, 0.2) && ed_run_rows(r->analysis) == 0) {
        ed_clear_channels(r->analysis);
        r->channels = r->kept = 0;
      }
      break;
    default:
      if (ed_run_advance(r->analysis, 0) < 0 && chance(c, 0.8)) { /* none is on, or it has failed */
        ed_run_end(r->analysis);
        begin_run(c, r, m);
      }
      for (int i = whole(c, 1, 6); i > 0; i--)
        advance(c, r);
  }
}

static void call_model(caller *c, int dimension)
{
  things m;
  char message[300] = "";
  int status;
  if (!make_model(c, &m, dimension))
    return;
  run r = {.analysis = ed_analysis_new(m.model, &status, message, sizeof message)};
  expect_listed(c, status);
  CHECK(!r.analysis == (status != ED_OK));
  CHECK(status == ED_OK || strlen(message) > 0);
  if (r.analysis) {
    r.n = ed_n_equations(r.analysis);
    r.state_size = ed_state_size(r.analysis);
    r.state = room(r.state_size);
    double *kept = room(r.state_size);
    ed_state_get(r.analysis, kept);
    expect_finite(ED_OK, kept, r.state_size);
    ed_analysis_ask(r.analysis, &IMPATIENT);
    for (int i = 0; i < 30; i++) {
      call_something(c, &r, &m, kept);
      if (chance(c, 0.05))
        ed_state_get(r.analysis, kept);
    }
    CHECK(ed_analysis_message(r.analysis) != NULL);
    free_buffers(&r);
    free(kept);
    free(r.state);
  }
  ed_analysis_free(r.analysis);
  ed_model_free(m.model);
}

void call_frame(caller *c)
{
  call_model(c, 2);
}

void call_frame_in_space(caller *c)
{
  call_model(c, 3);
}
