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
  if (section->plastic) /* all laws are bilinear */
    memcpy(state, section->plastic, (size_t)section->n * sizeof *state);
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

/* The kernels are written for both kinds of sections, with `axes` as a constant: the compiler makes one of each. */
typedef struct {
  lanes N, M_z, M_y, k[ED_MAX_SECTION_TERMS]; /* of k: N N, N M_z, M_z M_z, then with M_y: N, M_z, M_y */
  lanes margin; /* of stress, from yielding or to unloading */
  mask yielded;
} half_sum;

ED_INLINE void strains_at(const ed_section *section, const double *deformation, int i, const int axes, lanes *strain)
{
  *strain = deformation[0] - deformation[1] * ED_LOAD(section->y + i);
  if (axes == ED_SPACE)
    *strain += deformation[2] * ED_LOAD(section->z + i);
}

/* Adds HALF bilinear or elastic layers from index i on. */
ED_INLINE void add_layers(const ed_section *section, const double *plastic, const double *deformation, int i, half_sum *add,
                          const int axes)
{
  const lanes zero = {0};
  lanes strain;
  strains_at(section, deformation, i, axes, &strain);
  const lanes plastic_strain = ED_LOAD(plastic + i), fy = ED_LOAD(section->fy + i), E = ED_LOAD(section->E + i);
  const lanes relative = E * strain - ED_LOAD(section->EH + i) * plastic_strain;
  const mask above = relative > fy, beyond = above | (relative < -fy);
  const lanes excess = ED_SELECT(beyond, relative - ED_SELECT(above, fy, -fy), zero);
  const lanes stress = E * (strain - plastic_strain) - ED_LOAD(section->flow + i) * excess;
  const lanes factor = ED_SELECT(beyond, ED_LOAD(section->hardening + i), zero + 1.0);
  add->N += ED_LOAD(section->A + i) * stress;
  add->M_z -= ED_LOAD(section->Ay + i) * stress;
  add->k[0] += factor * ED_LOAD(section->EA + i);
  add->k[1] -= factor * ED_LOAD(section->EAy + i);
  add->k[2] += factor * ED_LOAD(section->EAyy + i);
  if (axes == ED_SPACE) {
    add->M_y += ED_LOAD(section->Az + i) * stress;
    add->k[3] += factor * ED_LOAD(section->EAz + i);
    add->k[4] -= factor * ED_LOAD(section->EAyz + i);
    add->k[5] += factor * ED_LOAD(section->EAzz + i);
  }
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

ED_INLINE void sum_up(const half_sum *low, const half_sum *high, ed_section_response *response, const int axes)
{
  const double NN = total(&low->k[0], &high->k[0]), Nz = total(&low->k[1], &high->k[1]), zz = total(&low->k[2], &high->k[2]);
  response->force[0] = total(&low->N, &high->N);
  response->force[1] = total(&low->M_z, &high->M_z);
  response->k[0] = NN;
  response->k[1] = Nz;
  if (axes == ED_PLANE) {
    response->k[2] = zz;
    return;
  }
  response->force[2] = total(&low->M_y, &high->M_y);
  response->k[2] = total(&low->k[3], &high->k[3]);
  response->k[3] = zz;
  response->k[4] = total(&low->k[4], &high->k[4]);
  response->k[5] = total(&low->k[5], &high->k[5]);
}

/* Bilinear and elastic layers; `plastic` n_padded plastic strains. */
ED_INLINE void sum_straight(const ed_section *section, const double *plastic, const double *deformation,
                            ed_section_response *response, const int axes)
{
  half_sum low = {0}, high = {0};
  low.margin = high.margin = low.N + NO_LIMIT;
  for (int i = 0; i < section->n_padded; i += ED_LANES) {
    add_layers(section, plastic, deformation, i, &low, axes);
    add_layers(section, plastic, deformation, i + HALF, &high, axes);
  }
  sum_up(&low, &high, response, axes);
  const lanes margin = ED_SELECT(low.margin < high.margin, low.margin, high.margin);
  response->reach = fmin(fmin(margin[0], margin[1]), fmin(margin[2], margin[3])) / section->stiffest;
  const mask any = low.yielded | high.yielded;
  response->elastic = !ED_ANY(any);
}

ED_CLONES static void straight_in_plane(const ed_section *section, const double *plastic, const double *deformation,
                                        ed_section_response *response)
{
  sum_straight(section, plastic, deformation, response, ED_PLANE);
}

ED_CLONES static void straight_in_space(const ed_section *section, const double *plastic, const double *deformation,
                                        ed_section_response *response)
{
  sum_straight(section, plastic, deformation, response, ED_SPACE);
}

enum { CHUNK = 4 * ED_LANES }; /* layers of which strains and stresses are held at once */

ED_INLINE void strains_of(const ed_section *section, int first, int count, const double *deformation, double *strain, const int axes)
{
  for (int i = 0; i < count; i += HALF) {
    lanes at;
    strains_at(section, deformation, first + i, axes, &at);
    ED_STORE(strain + i, at);
  }
}

static int chunk_at(const ed_section *section, int first)
{
  return section->n_padded - first < CHUNK ? section->n_padded - first : CHUNK;
}

ED_INLINE void add_curved(const ed_section *section, const double *stress, const double *tangent, int first, int i, half_sum *add,
                          const int axes)
{
  const lanes area = ED_LOAD(section->curved_area + first + i), y = ED_LOAD(section->y + first + i);
  const lanes force = area * ED_LOAD(stress + i), stiffness = area * ED_LOAD(tangent + i);
  add->N += force;
  add->M_z -= force * y;
  add->k[0] += stiffness;
  add->k[1] -= stiffness * y;
  add->k[2] += stiffness * y * y;
  if (axes == ED_SPACE) {
    const lanes z = ED_LOAD(section->z + first + i);
    add->M_y += force * z;
    add->k[3] += stiffness * z;
    add->k[4] -= stiffness * y * z;
    add->k[5] += stiffness * z * z;
  }
}

/* Layers of Menegotto-Pinto's law. */
ED_INLINE void sum_curved(const ed_section *section, const double *state, const double *deformation, double *record,
                          ed_section_response *response, const int axes)
{
  half_sum low = {0}, high = {0};
  int elastic = 1;
  double reach = NO_LIMIT;
  for (int d = 0; record && d <= axes; d++)
    record[d] = deformation[d];
  for (int first = 0; first < section->n_padded; first += CHUNK) {
    double strain[CHUNK], unrecorded[2][CHUNK], part;
    double *const stress = record ? record + record_layers(axes) + first : unrecorded[0];
    double *const tangent = record ? stress + section->n_padded : unrecorded[1];
    const int count = chunk_at(section, first);
    strains_of(section, first, count, deformation, strain, axes);
    elastic &= ed_menegotto_pinto_trial(&section->menegotto_pinto, state, first, count, strain, stress, tangent, &part);
    reach = fmin(reach, part);
    for (int i = 0; i < count; i += ED_LANES) {
      add_curved(section, stress, tangent, first, i, &low, axes);
      add_curved(section, stress, tangent, first, i + HALF, &high, axes);
    }
  }
  sum_up(&low, &high, response, axes);
  response->elastic = elastic;
  response->reach = reach;
}

ED_CLONES static void curved_in_plane(const ed_section *section, const double *state, const double *deformation, double *record,
                                      ed_section_response *response)
{
  sum_curved(section, state, deformation, record, response, ED_PLANE);
}

ED_CLONES static void curved_in_space(const ed_section *section, const double *state, const double *deformation, double *record,
                                      ed_section_response *response)
{
  sum_curved(section, state, deformation, record, response, ED_SPACE);
}

static void layers_trial(const ed_section *section, const double *state, const double *deformation, double *record,
                         ed_section_response *response)
{
  const int plane = section->axes == ED_PLANE;
  if (section->straight)
    (plane ? straight_in_plane : straight_in_space)(section, state, deformation, response);
  if (!section->curved)
    return;
  ed_section_response curved;
  (plane ? curved_in_plane : curved_in_space)(section, curved_state(section, state), deformation, record, &curved);
  if (!section->straight) {
    *response = curved;
    return;
  }
  for (int i = 0; i <= section->axes; i++)
    response->force[i] += curved.force[i];
  for (int i = 0; i < ed_section_terms(section->axes); i++)
    response->k[i] += curved.k[i];
  response->elastic &= curved.elastic;
  response->reach = fmin(response->reach, curved.reach);
}

static double layer_strain(const ed_section *section, int layer, const double *deformation)
{
  const double strain = deformation[0] - deformation[1] * section->y[layer];
  return section->axes == ED_PLANE ? strain : strain + deformation[2] * section->z[layer];
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
static void remove_broken(const ed_section *section, const double *state, const double *deformation, ed_section_response *response)
{
  response->elastic = 0; /* every strain is followed by a commit */
  for (int i = 0; fatigue_head(section, state)[BROKEN_LAYERS] > 0.0 && i < section->n; i++) {
    if (!ed_fatigue_broken(fatigue_of(section, state, i)))
      continue;
    const double lever[ED_MAX_RESULTANTS] = {1.0, -section->y[i], section->axes == ED_SPACE ? section->z[i] : 0.0};
    double tangent, stress = layer_trial(section, state, i, layer_strain(section, i, deformation), &tangent), *k = response->k;
    stress *= section->area[i];
    tangent *= section->area[i];
    for (int p = 0; p <= section->axes; p++) {
      response->force[p] -= stress * lever[p];
      for (int q = p; q <= section->axes; q++)
        *k++ -= tangent * lever[p] * lever[q];
    }
  }
}

static void elastic_trial(const ed_section *section, const double *deformation, ed_section_response *response)
{
  for (int i = 0; i <= section->axes; i++)
    response->force[i] = section->k[ed_sym_place(1 + section->axes, i, i)] * deformation[i];
  memcpy(response->k, section->k, sizeof response->k);
  response->elastic = 1;
  response->reach = NO_LIMIT;
}

void ed_section_trial(const ed_section *section, const double *state, const double *deformation, double *record,
                      ed_section_response *response)
{
  if (section->elastic) {
    elastic_trial(section, deformation, response);
    return;
  }
  layers_trial(section, state, deformation, record, response);
  if (section->fatigue)
    remove_broken(section, state, deformation, response);
}

/* Stresses of curved layers first to first + count at a deformation, from a record within reach. */
ED_INLINE void recorded_stresses(const ed_section *section, const double *record, int first, int count, const double *deformation,
                                 double *stress, const int axes)
{
  const double *recorded = record + record_layers(axes) + first, *tangent = recorded + section->n_padded;
  double change[ED_MAX_RESULTANTS];
  for (int d = 0; d <= axes; d++)
    change[d] = deformation[d] - record[d];
  strains_of(section, first, count, change, stress, axes);
  for (int i = 0; i < count; i += HALF)
    ED_STORE(stress + i, ED_LOAD(recorded + i) + ED_LOAD(tangent + i) * ED_LOAD(stress + i));
}

/* `area`: of the curved layers. */
ED_INLINE double commit_curved(const ed_section *section, double *state, const double *deformation, const double *record,
                               const double *area, const int axes)
{
  lanes low = {0}, high = {0};
  for (int first = 0; first < section->n_padded; first += CHUNK) {
    double strain[CHUNK], stress[CHUNK], tangent[CHUNK], dissipated[CHUNK], reach;
    const int count = chunk_at(section, first);
    strains_of(section, first, count, deformation, strain, axes);
    if (record)
      recorded_stresses(section, record, first, count, deformation, stress, axes);
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

ED_CLONES static double commit_in_plane(const ed_section *section, double *state, const double *deformation, const double *record,
                                        const double *area)
{
  return commit_curved(section, state, deformation, record, area, ED_PLANE);
}

ED_CLONES static double commit_in_space(const ed_section *section, double *state, const double *deformation, const double *record,
                                        const double *area)
{
  return commit_curved(section, state, deformation, record, area, ED_SPACE);
}

/* Follows the strains of the layers; the return is the energy that those gave up which break here. */
static double follow_fatigue(const ed_section *section, double *state, const double *deformation)
{
  double energy = 0.0, *head = fatigue_head(section, state);
  for (int i = 0; i < section->n; i++) {
    const ed_steel *steel = section->steel[i];
    double *fatigue = fatigue_of(section, state, i), tangent;
    const double strain = layer_strain(section, i, deformation);
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

double ed_section_commit(const ed_section *section, double *state, const double *deformation, const double *record)
{
  const double *area = section->fatigue ? state + section->fatigue : section->area; /* what has broken dissipates nothing */
  double energy = 0.0;
  if (section->curved)
    energy = (section->axes == ED_PLANE ? commit_in_plane : commit_in_space)(
        section, curved_state(section, state), deformation, record, section->fatigue && !section->straight ? area : section->curved_area);
  for (int i = 0; i < section->n && section->straight; i++)
    if (section->steel[i]->law != ED_MENEGOTTO_PINTO)
      energy += area[i] * ed_steel_commit(section->steel[i], state + i, layer_strain(section, i, deformation));
  return section->fatigue ? energy + follow_fatigue(section, state, deformation) : energy;
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

double ed_section_stored(const ed_section *section, const double *state, const double *deformation)
{
  if (section->elastic) {
    double energy = 0.0;
    for (int i = 0; i <= section->axes; i++)
      energy += section->k[ed_sym_place(1 + section->axes, i, i)] * deformation[i] * deformation[i];
    return 0.5 * energy;
  }
  lanes low = {0}, high = {0};
  for (int i = 0; i < section->n_padded && section->straight; i += HALF) {
    lanes strain;
    strains_at(section, deformation, i, section->axes, &strain);
    strain -= ED_LOAD(state + i);
    *(i % ED_LANES ? &high : &low) += ED_LOAD(section->EA + i) * strain * strain;
  }
  double energy = 0.5 * total(&low, &high) - section->locked;
  for (int i = 0; section->fatigue && section->straight && i < section->n; i++)
    if (section->steel[i]->law != ED_MENEGOTTO_PINTO && ed_fatigue_broken(fatigue_of(section, state, i))) {
      const double strain = layer_strain(section, i, deformation) - state[i];
      energy -= 0.5 * section->EA[i] * strain * strain;
    }
  const double *area = section->fatigue ? state + section->fatigue : section->area;
  for (int i = 0; i < section->n && section->curved; i++)
    if (section->steel[i]->law == ED_MENEGOTTO_PINTO)
      energy += area[i] *
                ed_steel_stored(section->steel[i], ed_menegotto_pinto_stress(curved_state(section, state), i));
  return energy;
}

void ed_section_layer(const ed_section *section, const double *state, int layer, const double *deformation, double *stress, double *strain)
{
  double tangent;
  *strain = layer_strain(section, layer, deformation);
  const int broken = section->fatigue && ed_fatigue_broken(fatigue_of(section, state, layer));
  *stress = broken ? 0.0 : layer_trial(section, state, layer, *strain, &tangent);
}
