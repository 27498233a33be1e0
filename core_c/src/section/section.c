/* Stresses of the layers of a section, what a commit keeps of them, and fatigue that breaks them. */
#include "section/section.h"

#include "base/clones.h"
#include "base/lanes.h"
#include "edcore.h"
#include "material/fatigue.h"
#include "section/layout.h"

#include <math.h>
#include <string.h>

static const double NO_LIMIT = 1e300; /* of a strain */

/* The part of a state that curved layers keep. */
static double *curved_state(const ed_section *section, const double *state)
{
  return (double *)state + (section->straight ? section->n_padded : 0);
}

void ed_section_initialise(const ed_section *section, double *state)
{
  memset(state, 0, (size_t)section->state_size * sizeof *state);
  if (section->curved)
    ed_menegotto_pinto_initialise(&section->menegotto_pinto, curved_state(section, state));
  if (section->fatigue)
    memcpy(state + section->fatigue, section->area, (size_t)section->n_padded * sizeof *state);
}

/* Of the fatigue of a section, behind the intact areas of the layers. */
static double *fatigue_head(const ed_section *section, const double *state)
{
  return (double *)state + section->fatigue + section->n_padded;
}

static double *fatigue_of(const ed_section *section, const double *state, int layer)
{
  return fatigue_head(section, state) + FATIGUE_HEAD + layer * ED_FATIGUE_STATE;
}

static int fatigue_valid(const ed_section *section, const double *state)
{
  for (int i = 0; i < section->n; i++)
    if (!ed_fatigue_state_valid(fatigue_of(section, state, i)))
      return 0;
  return 1;
}

int ed_section_state_valid(const ed_section *section, const double *state)
{
  return (!section->curved || ed_menegotto_pinto_valid(section->n_padded, curved_state(section, state))) &&
         (!section->fatigue || fatigue_valid(section, state));
}

typedef ed_lanes lanes;
typedef ed_mask mask;

enum { HALF = ED_LANE_WIDTH };
_Static_assert(ED_LANES == 2 * HALF, "two vectors a group");

typedef struct {
  lanes N, M, k11, k12, k22;
  lanes margin; /* of stress, from yielding or to unloading */
  mask yielded;
} half_sum;

/* Adds HALF bilinear or elastic layers from index i on. */
ED_INLINE void add_layers(const ed_section *section, const double *plastic, double e0, double kappa, int i, half_sum *add)
{
  const lanes zero = {0};
  const lanes strain = e0 - kappa * ED_LOAD(section->y + i);
  const lanes plastic_strain = ED_LOAD(plastic + i), fy = ED_LOAD(section->fy + i), E = ED_LOAD(section->E + i);
  const lanes relative = E * strain - ED_LOAD(section->EH + i) * plastic_strain;
  const mask above = relative > fy, beyond = above | (relative < -fy);
  const lanes excess = ED_SELECT(beyond, relative - ED_SELECT(above, fy, -fy), zero);
  const lanes stress = E * (strain - plastic_strain) - ED_LOAD(section->flow + i) * excess;
  const lanes factor = ED_SELECT(beyond, ED_LOAD(section->hardening + i), zero + 1.0);
  add->N += ED_LOAD(section->A + i) * stress;
  add->M -= ED_LOAD(section->Ay + i) * stress;
  add->k11 += factor * ED_LOAD(section->EA + i);
  add->k12 -= factor * ED_LOAD(section->EAy + i);
  add->k22 += factor * ED_LOAD(section->EAyy + i);
  add->yielded |= beyond;
  lanes margin;
  ed_lanes_size(&relative, &margin);
  margin -= fy;
  ed_lanes_size(&margin, &margin);
  add->margin = ED_SELECT(margin < add->margin, margin, add->margin);
}

ED_INLINE double total(const lanes *low, const lanes *high)
{
  const lanes v = *low + *high;
  return (v[0] + v[2]) + (v[1] + v[3]);
}

ED_INLINE void sum_up(const half_sum *low, const half_sum *high, ed_section_response *response)
{
  *response = (ed_section_response){
      .N = total(&low->N, &high->N),
      .M = total(&low->M, &high->M),
      .k11 = total(&low->k11, &high->k11),
      .k12 = total(&low->k12, &high->k12),
      .k22 = total(&low->k22, &high->k22),
  };
}

/* Bilinear and elastic layers; `plastic` n_padded plastic strains. */
ED_CLONES static void straight_trial(const ed_section *section, const double *plastic, double e0, double kappa,
                                     ed_section_response *response)
{
  half_sum low = {0}, high = {0};
  low.margin = high.margin = low.N + NO_LIMIT;
  for (int i = 0; i < section->n_padded; i += ED_LANES) {
    add_layers(section, plastic, e0, kappa, i, &low);
    add_layers(section, plastic, e0, kappa, i + HALF, &high);
  }
  sum_up(&low, &high, response);
  const lanes margin = ED_SELECT(low.margin < high.margin, low.margin, high.margin);
  response->reach = fmin(fmin(margin[0], margin[1]), fmin(margin[2], margin[3])) / section->stiffest;
  const mask any = low.yielded | high.yielded;
  response->elastic = !ED_ANY(any);
}

enum { CHUNK = 4 * ED_LANES }; /* layers of which strains and stresses are held at once */

ED_INLINE void strains_of(const ed_section *section, int first, int count, double e0, double kappa, double *strain)
{
  for (int i = 0; i < count; i += HALF)
    ED_STORE(strain + i, e0 - kappa * ED_LOAD(section->y + first + i));
}

static int chunk_at(const ed_section *section, int first)
{
  return section->n_padded - first < CHUNK ? section->n_padded - first : CHUNK;
}

ED_INLINE void add_curved(const ed_section *section, const double *stress, const double *tangent, int first, int i, half_sum *add)
{
  const lanes area = ED_LOAD(section->curved_area + first + i), y = ED_LOAD(section->y + first + i);
  const lanes force = area * ED_LOAD(stress + i), stiffness = area * ED_LOAD(tangent + i);
  add->N += force;
  add->M -= force * y;
  add->k11 += stiffness;
  add->k12 -= stiffness * y;
  add->k22 += stiffness * y * y;
}

/* Layers of Menegotto-Pinto's law. */
ED_CLONES static void curved_trial(const ed_section *section, const double *state, double e0, double kappa, double *record,
                                   ed_section_response *response)
{
  half_sum low = {0}, high = {0};
  int elastic = 1;
  double reach = NO_LIMIT;
  if (record) {
    record[RECORD_E0] = e0;
    record[RECORD_KAPPA] = kappa;
  }
  for (int first = 0; first < section->n_padded; first += CHUNK) {
    double strain[CHUNK], unrecorded[2][CHUNK], part;
    double *const stress = record ? record + RECORD_LAYERS + first : unrecorded[0];
    double *const tangent = record ? stress + section->n_padded : unrecorded[1];
    const int count = chunk_at(section, first);
    strains_of(section, first, count, e0, kappa, strain);
    elastic &= ed_menegotto_pinto_trial(&section->menegotto_pinto, state, first, count, strain, stress, tangent, &part);
    reach = fmin(reach, part);
    for (int i = 0; i < count; i += ED_LANES) {
      add_curved(section, stress, tangent, first, i, &low);
      add_curved(section, stress, tangent, first, i + HALF, &high);
    }
  }
  sum_up(&low, &high, response);
  response->elastic = elastic;
  response->reach = reach;
}

static void layers_trial(const ed_section *section, const double *state, double e0, double kappa, double *record,
                         ed_section_response *response)
{
  if (section->straight)
    straight_trial(section, state, e0, kappa, response);
  if (!section->curved)
    return;
  ed_section_response curved;
  curved_trial(section, curved_state(section, state), e0, kappa, record, &curved);
  if (!section->straight) {
    *response = curved;
    return;
  }
  response->N += curved.N;
  response->M += curved.M;
  response->k11 += curved.k11;
  response->k12 += curved.k12;
  response->k22 += curved.k22;
  response->elastic &= curved.elastic;
  response->reach = fmin(response->reach, curved.reach);
}

/* Stress and tangent of a layer as if it had not broken. */
static double layer_trial(const ed_section *section, const double *state, int layer, double strain, double *tangent)
{
  double stress;
  if (section->steel[layer]->law != ED_MENEGOTTO_PINTO) {
    ed_steel_trial(section->steel[layer], state + layer, strain, &stress, tangent);
    return stress;
  }
  const int first = layer / HALF * HALF;
  double strains[HALF], stresses[HALF], tangents[HALF], reach;
  for (int i = 0; i < HALF; i++)
    strains[i] = strain;
  ed_menegotto_pinto_trial(&section->menegotto_pinto, curved_state(section, state), first, HALF, strains, stresses, tangents, &reach);
  *tangent = tangents[layer - first];
  return stresses[layer - first];
}

/* What layers that have broken took part with. */
static void remove_broken(const ed_section *section, const double *state, double e0, double kappa, ed_section_response *response)
{
  response->elastic = 0; /* every strain is followed by a commit */
  for (int i = 0; fatigue_head(section, state)[BROKEN_LAYERS] > 0.0 && i < section->n; i++) {
    if (!ed_fatigue_broken(fatigue_of(section, state, i)))
      continue;
    const double y = section->y[i];
    double tangent, stress = layer_trial(section, state, i, e0 - kappa * y, &tangent);
    stress *= section->area[i];
    tangent *= section->area[i];
    response->N -= stress;
    response->M += stress * y;
    response->k11 -= tangent;
    response->k12 += tangent * y;
    response->k22 -= tangent * y * y;
  }
}

void ed_section_trial(const ed_section *section, const double *state, double e0, double kappa, double *record,
                      ed_section_response *response)
{
  if (section->elastic) {
    *response = (ed_section_response){section->k11 * e0, section->k22 * kappa, section->k11, 0.0, section->k22, 1, NO_LIMIT};
    return;
  }
  layers_trial(section, state, e0, kappa, record, response);
  if (section->fatigue)
    remove_broken(section, state, e0, kappa, response);
}

/* Stresses of curved layers first to first + count at (e0, kappa), from a record within reach. */
ED_INLINE void recorded_stresses(const ed_section *section, const double *record, int first, int count, double e0, double kappa,
                                 double *stress)
{
  const double *recorded = record + RECORD_LAYERS + first, *tangent = recorded + section->n_padded;
  strains_of(section, first, count, e0 - record[RECORD_E0], kappa - record[RECORD_KAPPA], stress);
  for (int i = 0; i < count; i += HALF)
    ED_STORE(stress + i, ED_LOAD(recorded + i) + ED_LOAD(tangent + i) * ED_LOAD(stress + i));
}

/* `area`: of the curved layers. */
ED_CLONES static double curved_commit(const ed_section *section, double *state, double e0, double kappa, const double *record,
                                      const double *area)
{
  lanes low = {0}, high = {0};
  for (int first = 0; first < section->n_padded; first += CHUNK) {
    double strain[CHUNK], stress[CHUNK], tangent[CHUNK], dissipated[CHUNK], reach;
    const int count = chunk_at(section, first);
    strains_of(section, first, count, e0, kappa, strain);
    if (record)
      recorded_stresses(section, record, first, count, e0, kappa, stress);
    else
      ed_menegotto_pinto_trial(&section->menegotto_pinto, state, first, count, strain, stress, tangent, &reach);
    ed_menegotto_pinto_commit(&section->menegotto_pinto, state, first, count, strain, stress, dissipated);
    for (int i = 0; i < count; i += ED_LANES) {
      low += ED_LOAD(area + first + i) * ED_LOAD(dissipated + i);
      high += ED_LOAD(area + first + i + HALF) * ED_LOAD(dissipated + i + HALF);
    }
  }
  return total(&low, &high);
}

/* Follows the strains of the layers; the return is the energy that those gave up which break here. */
static double follow_fatigue(const ed_section *section, double *state, double e0, double kappa)
{
  double energy = 0.0, *head = fatigue_head(section, state);
  for (int i = 0; i < section->n; i++) {
    const ed_steel *steel = section->steel[i];
    double *fatigue = fatigue_of(section, state, i), tangent;
    const double strain = e0 - kappa * section->y[i];
    if (steel->fatigue_strain == 0.0 || ed_fatigue_broken(fatigue))
      continue;
    const double damage = ed_fatigue_follow(steel, fatigue, strain);
    head[DAMAGE] = fmin(fmax(head[DAMAGE], damage), 1.0);
    if (damage < 1.0)
      continue;
    const double stress = layer_trial(section, state, i, strain, &tangent);
    if (!(stress > 0.0))
      continue;
    ed_fatigue_break(fatigue);
    head[BROKEN_LAYERS] += 1.0;
    state[section->fatigue + i] = 0.0;
    energy += section->area[i] * ed_steel_stored(steel, stress);
  }
  return energy;
}

double ed_section_commit(const ed_section *section, double *state, double e0, double kappa, const double *record)
{
  const double *area = section->fatigue ? state + section->fatigue : section->area; /* what has broken dissipates nothing */
  double energy = 0.0;
  if (section->curved)
    energy = curved_commit(section, curved_state(section, state), e0, kappa, record,
                           section->fatigue && !section->straight ? area : section->curved_area);
  for (int i = 0; i < section->n && section->straight; i++)
    if (section->steel[i]->law != ED_MENEGOTTO_PINTO)
      energy += area[i] * ed_steel_commit(section->steel[i], state + i, e0 - kappa * section->y[i]);
  return section->fatigue ? energy + follow_fatigue(section, state, e0, kappa) : energy;
}

double ed_section_damage(const ed_section *section, const double *state)
{
  return section->fatigue ? fatigue_head(section, state)[DAMAGE] : 0.0;
}

double ed_section_broken_share(const ed_section *section, const double *state)
{
  double broken = 0.0, all = 0.0;
  for (int i = 0; i < section->n && section->fatigue; i++) {
    all += section->area[i];
    broken += section->area[i] - state[section->fatigue + i];
  }
  return all > 0.0 ? broken / all : 0.0;
}

double ed_section_stored(const ed_section *section, const double *state, double e0, double kappa)
{
  if (section->elastic)
    return 0.5 * (section->k11 * e0 * e0 + section->k22 * kappa * kappa);
  lanes low = {0}, high = {0};
  for (int i = 0; i < section->n_padded && section->straight; i += HALF) {
    const lanes strain = e0 - kappa * ED_LOAD(section->y + i) - ED_LOAD(state + i);
    *(i % ED_LANES ? &high : &low) += ED_LOAD(section->EA + i) * strain * strain;
  }
  double energy = 0.5 * total(&low, &high);
  for (int i = 0; section->fatigue && section->straight && i < section->n; i++)
    if (section->steel[i]->law != ED_MENEGOTTO_PINTO && ed_fatigue_broken(fatigue_of(section, state, i))) {
      const double strain = e0 - kappa * section->y[i] - state[i];
      energy -= 0.5 * section->EA[i] * strain * strain;
    }
  const double *area = section->fatigue ? state + section->fatigue : section->area;
  for (int i = 0; i < section->n && section->curved; i++)
    if (section->steel[i]->law == ED_MENEGOTTO_PINTO)
      energy += area[i] *
                ed_steel_stored(section->steel[i], ed_menegotto_pinto_stress(curved_state(section, state), i));
  return energy;
}

void ed_section_layer(const ed_section *section, const double *state, int layer, double e0, double kappa,
                      double *stress, double *strain)
{
  double tangent;
  *strain = e0 - kappa * section->y[layer];
  const int broken = section->fatigue && ed_fatigue_broken(fatigue_of(section, state, layer));
  *stress = broken ? 0.0 : layer_trial(section, state, layer, *strain, &tangent);
}
