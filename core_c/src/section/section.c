#include "section/section.h"

#include "base/clones.h"
#include "edcore.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double y, area;
  int material;
} fibre;

static int by_depth(const void *left, const void *right)
{
  const fibre *a = left, *b = right;
  if (a->y != b->y)
    return a->y < b->y ? -1 : 1;
  if (a->material != b->material)
    return a->material < b->material ? -1 : 1;
  return (a->area > b->area) - (a->area < b->area); /* so that the sum does not depend on the order given */
}

void ed_section_elastic(ed_section *section, double EA, double EI)
{
  memset(section, 0, sizeof *section);
  section->elastic = 1;
  section->k11 = EA;
  section->k22 = EI;
  section->yield_strain = HUGE_VAL;
}

void ed_section_free(ed_section *section)
{
  free(section->block);
  free(section->steel);
  free(section->state_offset);
}

int ed_section_from_fibres(ed_section *section, int n, const double *y, const double *area, const int *material,
                           const ed_steel *steels)
{
  memset(section, 0, sizeof *section);
  fibre *fibres = malloc((size_t)n * sizeof *fibres);
  if (!fibres)
    return 0;
  for (int i = 0; i < n; i++)
    fibres[i] = (fibre){y[i], area[i], material[i]};
  qsort(fibres, (size_t)n, sizeof *fibres, by_depth);
  int layers = 0;
  for (int i = 0; i < n; i++) {
    if (layers && fibres[layers - 1].y == fibres[i].y && fibres[layers - 1].material == fibres[i].material)
      fibres[layers - 1].area += fibres[i].area;
    else
      fibres[layers++] = fibres[i];
  }
  const int padded = (layers + ED_LANES - 1) / ED_LANES * ED_LANES;
  enum { ARRAYS = 11 };
  section->block = aligned_alloc(64, (size_t)ARRAYS * (size_t)padded * sizeof(double));
  section->steel = malloc((size_t)layers * sizeof *section->steel);
  section->state_offset = malloc((size_t)layers * sizeof *section->state_offset);
  if (!section->block || !section->steel || !section->state_offset) {
    ed_section_free(section);
    free(fibres);
    return 0;
  }
  double **arrays[ARRAYS] = {&section->y,  &section->area,      &section->E,    &section->EH,
                             &section->fy, &section->hardening, &section->flow, &section->Ay,
                             &section->EA, &section->EAy,       &section->EAyy};
  for (int k = 0; k < ARRAYS; k++)
    *arrays[k] = (double *)section->block + (size_t)k * (size_t)padded;
  section->n = layers;
  section->n_padded = padded;
  section->vector = 1;
  section->yield_strain = HUGE_VAL;
  for (int i = 0; i < layers; i++)
    section->vector = section->vector && steels[fibres[i].material].law != ED_MENEGOTTO_PINTO;
  int offset = 0;
  for (int i = 0; i < padded; i++) {
    const ed_steel *steel = i < layers ? &steels[fibres[i].material] : &steels[fibres[0].material];
    const double depth = i < layers ? fibres[i].y : 0.0, a = i < layers ? fibres[i].area : 0.0;
    section->y[i] = depth;
    section->area[i] = a;
    section->E[i] = steel->E;
    section->EH[i] = steel->E + steel->H;
    section->fy[i] = i < layers ? steel->fy : HUGE_VAL;
    section->hardening[i] = steel->hardening;
    section->flow[i] = steel->E / (steel->E + steel->H);
    section->Ay[i] = a * depth;
    section->EA[i] = steel->E * a;
    section->EAy[i] = steel->E * a * depth;
    section->EAyy[i] = steel->E * a * depth * depth;
    if (i >= layers)
      continue;
    section->steel[i] = steel;
    section->state_offset[i] = offset;
    offset += ed_steel_state_size(steel);
    section->depth = fmax(section->depth, fabs(depth));
    section->yield_strain = fmin(section->yield_strain, steel->law == ED_ELASTIC ? HUGE_VAL : steel->fy / steel->E);
    if (steel->law == ED_MENEGOTTO_PINTO)
      section->yield_strain = 0.0; /* its curve is never straight */
  }
  section->state_size = section->vector ? padded : offset;
  /* the same sums as the kernel's, so that an elastic answer equals the initial stiffness bit for bit */
  double *zero = calloc((size_t)section->state_size, sizeof *zero);
  free(fibres);
  if (!zero) {
    ed_section_free(section);
    return 0;
  }
  ed_section_response response;
  ed_section_trial(section, zero, 0.0, 0.0, &response);
  free(zero);
  section->k11 = response.k11;
  section->k12 = response.k12;
  section->k22 = response.k22;
  return 1;
}

/* Half a group of lanes: the widest vector whose comparisons every instruction set with doubles has. */
enum { HALF = ED_LANES / 2 };
typedef double lanes __attribute__((vector_size(HALF * sizeof(double))));
typedef long long mask __attribute__((vector_size(HALF * sizeof(long long))));

#define SELECT(condition, yes, no) ((lanes)(((condition) & (mask)(yes)) | (~(condition) & (mask)(no))))

typedef struct {
  lanes N, M, k11, k12, k22;
  mask yielded;
} half_sum;

/* HALF doubles from anywhere. */
typedef double loose __attribute__((vector_size(HALF * sizeof(double)), aligned(sizeof(double)), may_alias));
#define LOAD(from) (*(const loose *)(const void *)(from))

/* Adds HALF bilinear or elastic layers from index i on. */
static inline __attribute__((always_inline)) void add_layers(const ed_section *section, const double *plastic, double e0,
                                                             double kappa, int i, half_sum *add)
{
  const lanes zero = {0};
  const lanes strain = e0 - kappa * LOAD(section->y + i);
  const lanes plastic_strain = LOAD(plastic + i), fy = LOAD(section->fy + i), E = LOAD(section->E + i);
  const lanes relative = E * strain - LOAD(section->EH + i) * plastic_strain;
  const mask above = relative > fy, beyond = above | (relative < -fy);
  const lanes excess = SELECT(beyond, relative - SELECT(above, fy, -fy), zero);
  const lanes stress = E * (strain - plastic_strain) - LOAD(section->flow + i) * excess;
  const lanes factor = SELECT(beyond, LOAD(section->hardening + i), zero + 1.0);
  add->N += LOAD(section->area + i) * stress;
  add->M -= LOAD(section->Ay + i) * stress;
  add->k11 += factor * LOAD(section->EA + i);
  add->k12 -= factor * LOAD(section->EAy + i);
  add->k22 += factor * LOAD(section->EAyy + i);
  add->yielded |= beyond;
}

static inline __attribute__((always_inline)) double total(const lanes *low, const lanes *high)
{
  const lanes v = *low + *high;
  return (v[0] + v[2]) + (v[1] + v[3]);
}

/* Bilinear and elastic layers; `plastic` n_padded plastic strains. */
ED_CLONES static void trial_vector(const ed_section *section, const double *plastic, double e0, double kappa,
                                   ed_section_response *response)
{
  half_sum low = {0}, high = {0};
  for (int i = 0; i < section->n_padded; i += ED_LANES) {
    add_layers(section, plastic, e0, kappa, i, &low);
    add_layers(section, plastic, e0, kappa, i + HALF, &high);
  }
  const mask any = low.yielded | high.yielded;
  *response = (ed_section_response){
      .N = total(&low.N, &high.N),
      .M = total(&low.M, &high.M),
      .k11 = total(&low.k11, &high.k11),
      .k12 = total(&low.k12, &high.k12),
      .k22 = total(&low.k22, &high.k22),
      .elastic = (any[0] | any[1] | any[2] | any[3]) == 0,
  };
}

static void trial_scalar(const ed_section *section, const double *state, double e0, double kappa,
                         ed_section_response *response)
{
  ed_section_response r = {.elastic = 1};
  for (int i = 0; i < section->n; i++) {
    double stress, tangent;
    const double y = section->y[i], area = section->area[i];
    r.elastic &= ed_steel_trial(section->steel[i], state + section->state_offset[i], e0 - kappa * y, &stress, &tangent);
    r.N += area * stress;
    r.M -= area * y * stress;
    r.k11 += tangent * area;
    r.k12 -= tangent * area * y;
    r.k22 += tangent * area * y * y;
  }
  *response = r;
}

void ed_section_trial(const ed_section *section, const double *state, double e0, double kappa,
                      ed_section_response *response)
{
  if (section->elastic)
    *response = (ed_section_response){section->k11 * e0, section->k22 * kappa, section->k11, 0.0, section->k22, 1};
  else if (section->vector)
    trial_vector(section, state, e0, kappa, response);
  else
    trial_scalar(section, state, e0, kappa, response);
}

static double stored_vector(const ed_section *section, const double *plastic, double e0, double kappa)
{
  lanes low = {0}, high = {0};
  for (int i = 0; i < section->n_padded; i += HALF) {
    const lanes strain = e0 - kappa * LOAD(section->y + i) - LOAD(plastic + i);
    *(i % ED_LANES ? &high : &low) += LOAD(section->EA + i) * strain * strain;
  }
  return 0.5 * total(&low, &high);
}

static double *layer_state(const ed_section *section, double *state, int layer)
{
  return state + (section->vector ? layer : section->state_offset[layer]);
}

double ed_section_commit(const ed_section *section, double *state, double e0, double kappa)
{
  double dissipated = 0.0;
  for (int i = 0; i < section->n; i++)
    dissipated += section->area[i] *
                  ed_steel_commit(section->steel[i], layer_state(section, state, i), e0 - kappa * section->y[i]);
  return dissipated;
}

double ed_section_stored(const ed_section *section, const double *state, double e0, double kappa)
{
  if (section->elastic)
    return 0.5 * (section->k11 * e0 * e0 + section->k22 * kappa * kappa);
  if (section->vector)
    return stored_vector(section, state, e0, kappa);
  double energy = 0.0;
  for (int i = 0; i < section->n; i++) {
    double stress, strain;
    ed_section_layer(section, state, i, e0, kappa, &stress, &strain);
    energy += section->area[i] * ed_steel_stored(section->steel[i], stress);
  }
  return energy;
}

void ed_section_layer(const ed_section *section, const double *state, int layer, double e0, double kappa,
                      double *stress, double *strain)
{
  double tangent;
  *strain = e0 - kappa * section->y[layer];
  ed_steel_trial(section->steel[layer], state + (section->vector ? layer : section->state_offset[layer]), *strain,
                 stress, &tangent);
}
