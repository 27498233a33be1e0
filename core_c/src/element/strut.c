/* Half of the brace lies along local x from its end at x = -length/2 to its middle at x = 0, where symmetry holds x and the rotation.
 * Outside of the part that buckles, if any, a bar stays on the chord. */
#include "element/strut_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Share of its stiffness that a broken brace keeps, so that what it alone supported is no singular matrix. */
static const double REMAINS = 1e-6;

/* Of the nodes from the outermost to the middle. */
typedef struct {
  ed_node node[ED_STRUT_MAX_PARTS + 1];
  int number[ED_STRUT_MAX_PARTS + 1][3]; /* unknown, FIXED or DRIVEN */
} half_nodes;

enum { FIXED = -1, DRIVEN = -2 };

/* Places the nodes of half the brace on its camber, and numbers their degrees. */
static void place_nodes(ed_strut *s, const ed_member *member, double length, int bar, half_nodes *nodes)
{
  const int beams = s->parts - bar, fixed = isinf(member->end_stiffness);
  const double buckling = member->buckling_length * length;
  s->camber = member->camber * buckling;
  s->end_stiffness = fixed ? 0.0 : member->end_stiffness;
  s->end_rotation = FIXED;
  for (int i = 0; i <= s->parts; i++) {
    const int at = i - bar; /* of the nodes of the beams, from the end */
    const double share = (double)(at < 0 ? 0 : at) / beams;
    ed_node *node = &nodes->node[i];
    int *number = nodes->number[i];
    node->x = at < 0 ? -0.5 * length : -0.5 * buckling * (1.0 - share);
    /* the first mode: half a wave between pins, from chord to crest of a whole wave between fixed ends */
    node->y = s->camber * (fixed ? 0.5 - 0.5 * cos(M_PI * share) : sin(0.5 * M_PI * share));
    const int outermost = i == 0, end = at == 0, middle = i == s->parts;
    number[0] = outermost ? DRIVEN : (middle ? FIXED : s->unknowns++);
    number[1] = at <= 0 ? FIXED : s->unknowns++;
    number[2] = middle || at < 0 || (end && fixed) ? FIXED : s->unknowns++;
    if (number[0] >= 0)
      s->scale[number[0]] = 1.0;
    if (number[1] >= 0) {
      s->scale[number[1]] = 1.0;
      s->nudge[number[1]] = 0.01 * node->y;
    }
    if (number[2] >= 0)
      s->scale[number[2]] = 2.0 * beams / buckling;
    if (end)
      s->end_rotation = number[2];
    if (middle)
      s->middle = number[1];
  }
  s->driven = s->unknowns;
}

/* Sets up the parts between the nodes, and where each keeps its state and its layers. */
static void make_parts(ed_strut *s, const ed_model *model, const ed_member *member, int bar, const half_nodes *nodes)
{
  ed_member members[ED_STRUT_MAX_PARTS] = {{.kind = ED_FIBRE_BEAM}};
  for (int p = 0; p < s->parts; p++) {
    members[p] = *member;
    members[p].node[0] = p;
    members[p].node[1] = p + 1;
    members[p].geometry = ED_COROTATIONAL;
    members[p].kind = p < bar ? ED_TRUSS : ED_FIBRE_BEAM;
    for (int i = 0; i < 6; i++) {
      const int number = nodes->number[p + i / 3][i % 3];
      s->degree[p][i] = number == DRIVEN ? s->driven : number;
    }
    if (p < bar)
      s->degree[p][2] = s->degree[p][5] = FIXED; /* a bar turns no node */
  }
  const ed_model inside = {
      .dimension = 2, .materials = model->materials, .sections = model->sections, .nodes = (ed_node *)nodes->node, .members = members};
  int block = ed_strut_parts_at(s), layers = 0;
  s->finite = 1;
  for (int p = 0; p < s->parts; p++) {
    ed_element *e = &s->part[p];
    s->finite &= ed_element_setup(e, &inside, p) == ED_OK;
    e->member = member;
    e->state = block;
    e->layers = layers;
    block += ed_element_block_size(e);
    layers += ed_element_layer_size(e);
  }
}

ed_strut *ed_strut_new(const ed_model *model, const ed_member *member, double length)
{
  ed_strut *s = calloc(1, sizeof *s);
  if (!s)
    return NULL;
  const int bar = member->buckling_length < 1.0;
  half_nodes nodes = {.node = {{.x = 0.0}}};
  s->parts = member->elements / 2 + bar;
  place_nodes(s, member, length, bar, &nodes);
  make_parts(s, model, member, bar, &nodes);
  return s;
}

void ed_strut_free(ed_strut *s)
{
  free(s);
}

int ed_strut_finite(const ed_strut *s)
{
  return s->finite;
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

void ed_strut_initialise(ed_strut *s, double *block, double *layers)
{
  memset(block, 0, (size_t)ed_strut_block_size(s) * sizeof *block);
  for (int p = 0; p < s->parts; p++)
    ed_element_initialise(&s->part[p], block + s->part[p].state, layers + s->part[p].layers);
  block[ED_BLOCK_K] = s->stiffness = ed_strut_initial_stiffness(s, block);
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
  memcpy(ed_strut_shape(s, block), block + COMMITTED, (size_t)s->unknowns * sizeof *block);
  return ed_strut_equilibrate(s, elongation, layers, block, control);
}

/* The largest of a quantity over the sections; `sum`: their sum. */
static double largest(const ed_strut *s, const double *layers, double (*of)(const ed_section *, const double *), double *sum)
{
  double most = 0.0;
  *sum = 0.0;
  for (int p = 0; p < s->parts; p++) {
    const ed_element *e = &s->part[p];
    for (int i = 0; i < e->points; i++) {
      const double value = of(e->section[i], layers + e->layers + e->layer_offset[i]);
      most = fmax(most, value);
      *sum += value;
    }
  }
  return most;
}

double ed_strut_damage(const ed_strut *s, const double *layers)
{
  double sum;
  return largest(s, layers, ed_section_damage, &sum);
}

double ed_strut_broken_share(const ed_strut *s, const double *layers)
{
  double sum;
  return largest(s, layers, ed_section_broken_share, &sum);
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
  double broken;
  const double most_broken = largest(s, layers, ed_section_broken_share, &broken);
  block[BREAKING] = broken > block[BROKEN];
  block[BROKEN] = broken;
  if (!fractured && most_broken > 1.0 - 1e-9) { /* what it had stored goes as in a snap */
    block[FRACTURED] = 1.0;
    dissipated += stored;
    stored = ed_strut_stored(s, block, layers);
    dissipated -= stored;
  }
  block[ELONGATION] = block[ED_BLOCK_V];
  block[FORCE] = block[ED_BLOCK_Q];
  block[STORED] = stored;
  memcpy(block + COMMITTED, ed_strut_shape(s, block), (size_t)s->unknowns * sizeof *block);
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
    const double turned = ed_strut_shape(s, (double *)block)[s->end_rotation];
    energy += s->end_stiffness * turned * turned;
  }
  return energy;
}

double ed_strut_deflection(const ed_strut *s, const double *block)
{
  return s->camber + ed_strut_shape(s, (double *)block)[s->middle];
}
