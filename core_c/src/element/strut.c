/* Half of the brace lies along local x from its end at x = -length/2 to its middle at x = 0, where symmetry holds x and the rotation.
 * Outside of the part that buckles, if any, a bar stays on the chord. The outermost node is driven to x = -(length + elongation)/2; the
 * rest is in equilibrium with it. What is solved is the least potential near the committed shape: where the tangent is not positive
 * definite the brace snaps through, and the iteration goes downhill to the next stable shape. */
#include "element/strut.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

struct ed_strut {
  int parts;                     /* the bar, if there is one, then the beams */
  int unknowns;
  int driven;                    /* number of the driven degree: behind the unknowns */
  int end_rotation;              /* unknown, or -1: fixed */
  int middle;                    /* unknown: deflection of the middle */
  double end_stiffness;          /* rotational, of each end */
  double camber;
  double stiffness;              /* of the brace before any load */
  double nudge[ED_STRUT_MAX_UNKNOWNS]; /* a hundredth of the camber */
  double scale[ED_STRUT_MAX_UNKNOWNS]; /* makes moments forces */
  ed_element part[ED_STRUT_MAX_PARTS];
  int degree[ED_STRUT_MAX_PARTS][6]; /* unknown or driven; -1: held */
};

/* Share of its stiffness that a broken brace keeps, so that what it alone held up is no singular matrix. */
static const double REMAINS = 1e-6;

static const double FAR = 1e12;



enum { SIZE = ED_STRUT_MAX_UNKNOWNS + 1, MAX_ITERATIONS = 60, MAX_SEARCH = 8 };

/* In the block behind its head: elongation, force and stored energy of the last commit; whether the trial snapped through, and whether the
 * brace has broken; the shapes of the last commit and of the trial; the parts' blocks. */
enum {
  ELONGATION = ED_BLOCK_POINTS,
  FORCE,
  STORED,
  SNAPPED,
  BROKEN,    /* sum over the sections of the shares of their areas that had broken at the last commit */
  BREAKING,  /* some broke there */
  FRACTURED, /* a section has broken through */
  COMMITTED
};

static double *shape_of(const ed_strut *s, double *block)
{
  return block + COMMITTED + s->unknowns;
}

static int parts_at(const ed_strut *s)
{
  return COMMITTED + 2 * s->unknowns;
}

/* The part's displacements at the trial's shape. */
static void gather(const ed_strut *s, int p, const double *shape, double driven, double *d)
{
  for (int i = 0; i < 6; i++) {
    const int degree = s->degree[p][i];
    d[i] = degree < 0 ? 0.0 : (degree == s->driven ? driven : shape[degree]);
  }
}

ed_strut *ed_strut_new(const ed_model *model, const ed_member *member, double length)
{
  ed_strut *s = calloc(1, sizeof *s);
  if (!s)
    return NULL;
  const int beams = member->elements / 2, bar = member->buckling_length < 1.0;
  const double buckling = member->buckling_length * length;
  const int fixed = isinf(member->end_stiffness);
  ed_node nodes[ED_STRUT_MAX_PARTS + 1] = {{.x = 0.0}};
  ed_member members[ED_STRUT_MAX_PARTS] = {{.kind = ED_FIBRE_BEAM}};
  int numbers[ED_STRUT_MAX_PARTS + 1][3];
  s->parts = beams + bar;
  s->camber = member->camber * buckling;
  s->end_stiffness = fixed ? 0.0 : member->end_stiffness;
  s->end_rotation = -1;
  for (int i = 0; i <= s->parts; i++) {
    const int at = i - bar; /* of the nodes of the beams, from the end */
    const double share = (double)(at < 0 ? 0 : at) / beams;
    nodes[i].x = at < 0 ? -0.5 * length : -0.5 * buckling * (1.0 - share);
    /* the first mode: half a wave between pins, from chord to crest of a whole wave between fixed ends */
    nodes[i].y = s->camber * (fixed ? 0.5 - 0.5 * cos(M_PI * share) : sin(0.5 * M_PI * share));
    const int outermost = i == 0, end = at == 0, middle = i == s->parts;
    numbers[i][0] = outermost ? -2 : (middle ? -1 : s->unknowns++);
    numbers[i][1] = at <= 0 ? -1 : s->unknowns++;
    numbers[i][2] = middle || at < 0 || (end && fixed) ? -1 : s->unknowns++;
    if (numbers[i][1] >= 0)
      s->nudge[numbers[i][1]] = 0.01 * nodes[i].y;
    if (end)
      s->end_rotation = numbers[i][2];
    if (middle)
      s->middle = numbers[i][1];
    if (numbers[i][2] >= 0)
      s->scale[numbers[i][2]] = 2.0 * beams / buckling;
  }
  for (int i = 0; i < s->unknowns; i++)
    if (s->scale[i] == 0.0)
      s->scale[i] = 1.0;
  s->driven = s->unknowns;
  for (int p = 0; p < s->parts; p++) {
    members[p] = *member;
    members[p].node[0] = p;
    members[p].node[1] = p + 1;
    members[p].geometry = ED_COROTATIONAL;
    members[p].kind = p < bar ? ED_TRUSS : ED_FIBRE_BEAM;
    for (int end = 0; end < 2; end++)
      for (int d = 0; d < 3; d++) {
        const int number = numbers[p + end][d];
        s->degree[p][3 * end + d] = number == -2 ? s->driven : number;
      }
    if (p < bar)
      s->degree[p][2] = s->degree[p][5] = -1; /* a bar turns no node */
  }
  const ed_model inside = {.materials = model->materials, .sections = model->sections, .nodes = nodes, .members = members};
  int block = parts_at(s), layers = 0;
  for (int p = 0; p < s->parts; p++) {
    ed_element *e = &s->part[p];
    if (!ed_element_setup(e, &inside, p))
      s->driven = -1;
    e->member = member;
    e->state = block;
    e->layers = layers;
    block += ed_element_block_size(e);
    layers += ed_element_layer_size(e);
  }
  return s;
}

void ed_strut_free(ed_strut *s)
{
  free(s);
}

int ed_strut_finite(const ed_strut *s)
{
  return s->driven >= 0;
}

int ed_strut_block_size(const ed_strut *s)
{
  const ed_element *last = &s->part[s->parts - 1];
  return last->state + ed_element_block_size(last);
}

int ed_strut_layer_size(const ed_strut *s)
{
  const ed_element *last = &s->part[s->parts - 1];
  return last->layers + ed_element_layer_size(last);
}

int ed_strut_record_size(const ed_strut *s)
{
  int size = 0;
  for (int p = 0; p < s->parts; p++)
    size += ed_element_record_size(&s->part[p]);
  return size;
}

void ed_strut_place_records(ed_strut *s, double *records)
{
  for (int p = 0; p < s->parts; p++) {
    ed_element_place_records(&s->part[p], records);
    records += ed_element_record_size(&s->part[p]);
  }
}

int ed_strut_layers_valid(const ed_strut *s, const double *layers)
{
  for (int p = 0; p < s->parts; p++)
    if (!ed_element_layers_valid(&s->part[p], layers + s->part[p].layers))
      return 0;
  return 1;
}

/* Forces at the unknowns and at the driven degree, of the shape in the block. Returns a status. */
static int evaluate(const ed_strut *s, double driven, const double *layers, double *block, ed_element_control *control, double *force)
{
  const double *shape = shape_of(s, block);
  memset(force, 0, (size_t)(s->unknowns + 1) * sizeof *force);
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    double d[6], f[6];
    gather(s, p, shape, driven, d);
    const int status = ed_element_update(e, d, layers + e->layers, block + e->state, control);
    if (status != ED_OK)
      return status;
    ed_element_forces(e, d, block + e->state, f);
    for (int i = 0; i < 6; i++)
      if (s->degree[p][i] >= 0)
        force[s->degree[p][i]] += f[i];
    block[ED_BLOCK_REFERENCE] = fmax(block[ED_BLOCK_REFERENCE], fabs(block[e->state + ED_BLOCK_Q]));
  }
  if (s->end_rotation >= 0)
    force[s->end_rotation] += s->end_stiffness * shape[s->end_rotation];
  return ED_OK;
}

static void assemble(const ed_strut *s, double driven, double *block, double K[SIZE][SIZE])
{
  const double *shape = shape_of(s, block);
  for (int i = 0; i <= s->unknowns; i++)
    memset(K[i], 0, (size_t)(s->unknowns + 1) * sizeof **K);
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    double d[6], t[36];
    gather(s, p, shape, driven, d);
    ed_element_tangent(e, d, block + e->state, t);
    for (int i = 0; i < 6; i++)
      for (int j = 0; j < 6; j++)
        if (s->degree[p][i] >= 0 && s->degree[p][j] >= 0)
          K[s->degree[p][i]][s->degree[p][j]] += t[6 * i + j];
  }
  if (s->end_rotation >= 0)
    K[s->end_rotation][s->end_rotation] += s->end_stiffness;
}

/* K + shift diag(rigid) = L D L' of the unknowns into F; 0 where it is not positive definite. */
static int factor(int n, double K[SIZE][SIZE], double shift, const double *rigid, double F[SIZE][SIZE])
{
  for (int j = 0; j < n; j++) {
    double pivot = K[j][j] + shift * rigid[j];
    for (int k = 0; k < j; k++)
      pivot -= F[j][k] * F[j][k] * F[k][k];
    if (!(pivot > 4.0 * DBL_EPSILON * rigid[j]))
      return 0;
    F[j][j] = pivot;
    for (int i = j + 1; i < n; i++) {
      double sum = K[i][j];
      for (int k = 0; k < j; k++)
        sum -= F[i][k] * F[j][k] * F[k][k];
      F[i][j] = sum / pivot;
    }
  }
  return 1;
}

static void solve(int n, double F[SIZE][SIZE], double *x)
{
  for (int i = 0; i < n; i++)
    for (int k = 0; k < i; k++)
      x[i] -= F[i][k] * x[k];
  for (int i = n - 1; i >= 0; i--) {
    x[i] /= F[i][i];
    for (int k = i + 1; k < n; k++)
      x[i] -= F[k][i] * x[k];
  }
}

static double dot(int n, const double *a, const double *b)
{
  double sum = 0.0;
  for (int i = 0; i < n; i++)
    sum += a[i] * b[i];
  return sum;
}

/* Stiffness of the driven degree with the rest in equilibrium, by elongation of the whole brace. */
static double condense(const ed_strut *s, double K[SIZE][SIZE], double F[SIZE][SIZE])
{
  double x[SIZE];
  memcpy(x, K[s->driven], (size_t)s->unknowns * sizeof *x);
  solve(s->unknowns, F, x);
  return 0.5 * (K[s->driven][s->driven] - dot(s->unknowns, K[s->driven], x));
}

/* The diagonal of the unloaded brace, which makes shifts comparable. */
static void rigid_diagonal(const ed_strut *s, double *rigid)
{
  memset(rigid, 0, (size_t)(s->unknowns + 1) * sizeof *rigid);
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    const double across = e->kind == ED_TRUSS ? 0.0 : (e->stiffness[3] + 2.0 * e->stiffness[4] + e->stiffness[5]) / (e->length * e->length);
    const double all[6] = {e->stiffness[0], across, e->stiffness[3], e->stiffness[0], across, e->stiffness[5]};
    for (int i = 0; i < 6; i++)
      if (s->degree[p][i] >= 0)
        rigid[s->degree[p][i]] += all[i];
  }
}

void ed_strut_initialise(ed_strut *s, double *block, double *layers)
{
  double K[SIZE][SIZE], F[SIZE][SIZE] = {{0}}, rigid[SIZE];
  memset(block, 0, (size_t)ed_strut_block_size(s) * sizeof *block);
  for (int p = 0; p < s->parts; p++)
    ed_element_initialise(&s->part[p], block + s->part[p].state, layers + s->part[p].layers);
  rigid_diagonal(s, rigid);
  assemble(s, 0.0, block, K);
  if (factor(s->unknowns, K, 0.0, rigid, F))
    block[ED_BLOCK_K] = s->stiffness = condense(s, K, F);
}

/* One equilibrium at an elongation, from the shape in the block. */
static int equilibrate(const ed_strut *s, double elongation, const double *layers, double *block, ed_element_control *control)
{
  const int n = s->unknowns;
  const double driven = -0.5 * elongation, tolerance = sqrt(control->tolerance);
  double K[SIZE][SIZE], F[SIZE][SIZE] = {{0}}, rigid[SIZE], force[SIZE], step[SIZE], *shape = shape_of(s, block), shift = 0.0;
  rigid_diagonal(s, rigid);
  int status = evaluate(s, driven, layers, block, control, force);
  block[SNAPPED] = 0.0;
  for (int iteration = 0; status == ED_OK; iteration++) {
    double unbalance = 0.0;
    for (int i = 0; i < n; i++) {
      const double value = fabs(force[i]) * s->scale[i];
      if (!(value <= unbalance))
        unbalance = value;
    }
    if (!isfinite(unbalance))
      return ED_E_NOT_FINITE;
    assemble(s, driven, block, K);
    const int stable = factor(n, K, 0.0, rigid, F);
    const int balanced = unbalance <= tolerance * block[ED_BLOCK_REFERENCE];
    if (balanced && stable) {
      block[ED_BLOCK_Q] = -force[s->driven];
      block[ED_BLOCK_K] = condense(s, K, F);
      if (control->no_softening)
        block[ED_BLOCK_K] = fmax(block[ED_BLOCK_K], 0.0);
      return ED_OK;
    }
    if (iteration == MAX_ITERATIONS)
      return ED_E_ELEMENT;
    control->iterations++;
    shift = stable ? 0.0 : fmax(0.25 * shift, 1e-6);
    if (!stable) {
      block[SNAPPED] = 1.0;
      while (!factor(n, K, shift, rigid, F))
        if (!((shift *= 2.0) < FAR)) /* what no shift makes definite is no number */
          return ED_E_NOT_FINITE;
    }
    for (int i = 0; i < n; i++)
      step[i] = balanced ? s->nudge[i] : -force[i]; /* out of a balance that is not stable */
    if (!balanced)
      solve(n, F, step);
    /* no beam turns by more than a few degrees in an iteration: tangents do not reach further */
    double turn = 0.0;
    for (int i = 0; i < n; i++)
      turn = fmax(turn, fabs(step[i]) * (s->scale[i] == 1.0 ? 1.0 / s->part[s->parts - 1].length : 1.0));
    double taken = turn > 0.1 ? 0.1 / turn : 1.0;
    const double start = balanced ? 0.0 : -taken * dot(n, step, force);
    for (int i = 0; i < n; i++) {
      step[i] *= taken;
      shape[i] += step[i];
    }
    taken = 1.0;
    status = evaluate(s, driven, layers, block, control, force);
    /* slope of the potential along the step, at its start -start: shorten a step that passes the least of it */
    double low = 0.0, at_low = -start, high = 1.0;
    for (int search = 0; status == ED_OK && !balanced && search < MAX_SEARCH; search++) {
      const double slope = dot(n, step, force);
      if (slope <= 0.8 * start && (taken == 1.0 || slope >= -0.8 * start))
        break;
      double next;
      if (slope > 0.0) {
        high = taken;
        next = low + (high - low) * at_low / (at_low - slope);
      } else {
        low = taken;
        at_low = slope;
        next = 0.5 * (low + high);
      }
      next = fmin(fmax(next, low + 0.1 * (high - low)), high - 0.1 * (high - low));
      for (int i = 0; i < n; i++)
        shape[i] += (next - taken) * step[i];
      taken = next;
      status = evaluate(s, driven, layers, block, control, force);
    }
  }
  return status;
}

int ed_strut_update(const ed_strut *s, double elongation, const double *layers, double *block, ed_element_control *control)
{
  control->updates++;
  block[ED_BLOCK_V] = elongation;
  if (block[FRACTURED] != 0.0) {
    block[ED_BLOCK_K] = REMAINS * s->stiffness;
    block[ED_BLOCK_Q] = block[ED_BLOCK_K] * elongation;
    return ED_OK;
  }
  memcpy(shape_of(s, block), block + COMMITTED, (size_t)s->unknowns * sizeof *block);
  return equilibrate(s, elongation, layers, block, control);
}

/* The sum of a quantity over the sections. */
static double summed(const ed_strut *s, const double *layers, double (*of)(const ed_section *, const double *))
{
  double sum = 0.0;
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    for (int i = 0; i < e->points; i++)
      sum += of(e->section[i], layers + e->layers + e->layer_offset[i]);
  }
  return sum;
}

/* The largest of a quantity over the sections. */
static double largest(const ed_strut *s, const double *layers, double (*of)(const ed_section *, const double *))
{
  double most = 0.0;
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    for (int i = 0; i < e->points; i++)
      most = fmax(most, of(e->section[i], layers + e->layers + e->layer_offset[i]));
  }
  return most;
}

double ed_strut_damage(const ed_strut *s, const double *layers)
{
  return largest(s, layers, ed_section_damage);
}

double ed_strut_broken_share(const ed_strut *s, const double *layers)
{
  return largest(s, layers, ed_section_broken_share);
}

double ed_strut_commit(const ed_strut *s, double *block, double *layers)
{
  double dissipated = 0.0;
  const int fractured = block[FRACTURED] != 0.0;
  for (int p = 0; !fractured && p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    dissipated += 2.0 * ed_element_commit(e, block + e->state, layers + e->layers);
    if (block[e->state + ED_BLOCK_INELASTIC] != 0.0)
      block[ED_BLOCK_INELASTIC] = 1.0;
  }
  const double work = 0.5 * (block[FORCE] + block[ED_BLOCK_Q]) * (block[ED_BLOCK_V] - block[ELONGATION]);
  double stored = ed_strut_stored(s, block, layers);
  /* What statics has no place for turns into vibrations of the brace, and these into heat: a snap, and after fibres have broken the work
   * of a force that was no longer there. */
  const double left = work - (stored - block[STORED]);
  if (block[BREAKING] != 0.0)
    dissipated = left;
  else if (block[SNAPPED] != 0.0)
    dissipated = fmax(dissipated, left);
  const double broken = summed(s, layers, ed_section_broken_share);
  block[BREAKING] = broken > block[BROKEN];
  block[BROKEN] = broken;
  if (!fractured && ed_strut_broken_share(s, layers) > 1.0 - 1e-9) { /* what it had stored goes as in a snap */
    block[FRACTURED] = 1.0;
    dissipated += stored;
    stored = ed_strut_stored(s, block, layers);
    dissipated -= stored;
  }
  block[ELONGATION] = block[ED_BLOCK_V];
  block[FORCE] = block[ED_BLOCK_Q];
  block[STORED] = stored;
  memcpy(block + COMMITTED, shape_of(s, block), (size_t)s->unknowns * sizeof *block);
  return dissipated;
}

double ed_strut_stored(const ed_strut *s, const double *block, const double *layers)
{
  double energy = 0.0;
  if (block[FRACTURED] != 0.0)
    return 0.5 * REMAINS * s->stiffness * block[ED_BLOCK_V] * block[ED_BLOCK_V];
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    energy += 2.0 * ed_element_stored(e, block + e->state, layers + e->layers);
  }
  if (s->end_rotation >= 0) {
    const double turned = shape_of(s, (double *)block)[s->end_rotation];
    energy += s->end_stiffness * turned * turned;
  }
  return energy;
}

double ed_strut_deflection(const ed_strut *s, const double *block)
{
  return s->camber + shape_of(s, (double *)block)[s->middle];
}
