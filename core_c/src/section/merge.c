/* Sections from fibres, which are merged into layers. */
#include "edcore.h"
#include "material/fatigue.h"
#include "section/layout.h"
#include "section/section.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double y, z, area, stress;
  int material;
} fibre;

static int by_place(const void *left, const void *right)
{
  const fibre *a = left, *b = right;
  if (a->y != b->y)
    return a->y < b->y ? -1 : 1;
  if (a->z != b->z)
    return a->z < b->z ? -1 : 1;
  if (a->material != b->material)
    return a->material < b->material ? -1 : 1;
  if (a->stress != b->stress)
    return a->stress < b->stress ? -1 : 1;
  return (a->area > b->area) - (a->area < b->area); /* so that the sum does not depend on the order given */
}

void ed_section_elastic(ed_section *section, int axes, const double *stiffness)
{
  memset(section, 0, sizeof *section);
  section->axes = axes;
  section->elastic = 1;
  for (int i = 0; i <= axes; i++)
    section->k[ed_sym_place(1 + axes, i, i)] = stiffness[i];
  section->yield_strain = HUGE_VAL;
}

int ed_section_bends(const ed_section *section)
{
  const double *k = section->k;
  /* relative, it is variance / (mean square) of the depths: fibres must spread over a millionth of their distance from the axis */
  if (section->axes == ED_PLANE)
    return k[0] * k[2] - k[1] * k[1] > 1e-12 * k[0] * k[2];
  double inverse[ED_MAX_SECTION_TERMS];
  return k[0] * k[3] - k[1] * k[1] > 1e-12 * k[0] * k[3] && k[0] * k[5] - k[2] * k[2] > 1e-12 * k[0] * k[5] &&
         ed_sym3_inverse(k, inverse) > 1e-12 * k[0] * k[3] * k[5];
}

void ed_section_free(ed_section *section)
{
  free(section->block);
  free(section->steel);
  free(section->plastic);
}

/* Sorts fibres, and merges those of one place and law; returns how many are left. */
static int merged(fibre *fibres, int n)
{
  int layers = 0;
  qsort(fibres, (size_t)n, sizeof *fibres, by_place);
  for (int i = 0; i < n; i++) {
    const fibre *last = layers ? &fibres[layers - 1] : NULL;
    if (last && last->y == fibres[i].y && last->z == fibres[i].z && last->material == fibres[i].material &&
        last->stress == fibres[i].stress)
      fibres[layers - 1].area += fibres[i].area;
    else
      fibres[layers++] = fibres[i];
  }
  return layers;
}

/* Makes room for the arrays of the layers; returns 0 when memory ran out. */
static int make_arrays(ed_section *section, int layers)
{
  double **arrays[] = {&section->y,    &section->area, &section->E,  &section->EH,  &section->fy,   &section->hardening,
                       &section->flow, &section->A,    &section->Ay, &section->EA,  &section->EAy,  &section->EAyy,
                       &section->curved_area, &section->z, &section->Az, &section->EAz, &section->EAyz, &section->EAzz};
  enum { ALL = sizeof arrays / sizeof *arrays, OF_SPACE = 5 };
  const int count = section->axes == ED_SPACE ? ALL : ALL - OF_SPACE;
  const int padded = (layers + ED_LANES - 1) / ED_LANES * ED_LANES;
  section->n = layers;
  section->n_padded = padded;
  section->block = aligned_alloc(64, (size_t)(count + ED_MENEGOTTO_PINTO_ARRAYS) * (size_t)padded * sizeof(double));
  section->steel = malloc((size_t)layers * sizeof *section->steel);
  if (!section->block || !section->steel)
    return 0;
  for (int k = 0; k < count; k++)
    *arrays[k] = (double *)section->block + (size_t)k * (size_t)padded;
  ed_menegotto_pinto_place(&section->menegotto_pinto, padded, (double *)section->block + (size_t)count * (size_t)padded);
  section->menegotto_pinto.plain_turns = section->axes == ED_PLANE;
  return 1;
}

/* Sets a layer; padding has no area, and no limit of its stress. `some_curved`: a curved law of the section, NULL without. */
static void set_layer(ed_section *section, int i, const fibre *fibre, const ed_steel *steel, const ed_steel *some_curved)
{
  const double depth = fibre->y, z = fibre->z, area = fibre->area;
  const int curved = steel->law == ED_MENEGOTTO_PINTO;
  const double straight_area = curved ? 0.0 : area;
  section->y[i] = depth;
  section->area[i] = area;
  section->E[i] = steel->E;
  section->EH[i] = steel->E + steel->H;
  section->fy[i] = i < section->n && !curved ? steel->fy : HUGE_VAL;
  section->hardening[i] = steel->hardening;
  section->flow[i] = steel->E / (steel->E + steel->H);
  section->A[i] = straight_area;
  section->Ay[i] = straight_area * depth;
  section->EA[i] = steel->E * straight_area;
  section->EAy[i] = steel->E * straight_area * depth;
  section->EAyy[i] = steel->E * straight_area * depth * depth;
  section->curved_area[i] = curved ? area : 0.0;
  if (section->axes == ED_SPACE) {
    section->z[i] = z;
    section->Az[i] = straight_area * z;
    section->EAz[i] = steel->E * straight_area * z;
    section->EAyz[i] = steel->E * straight_area * depth * z;
    section->EAzz[i] = steel->E * straight_area * z * z;
  }
  if (some_curved)
    ed_menegotto_pinto_set(&section->menegotto_pinto, i, curved ? steel : some_curved);
}

/* What a section keeps of its layers: where the parts of a state begin, and how long state and record are. */
static void lay_out_state(ed_section *section, int may_break)
{
  const int padded = section->n_padded;
  section->record_size = section->curved ? record_layers(section->axes) + 2 * padded : 0;
  section->state_size = (section->straight ? padded : 0) + (section->curved ? padded * ED_MENEGOTTO_PINTO_STATE : 0);
  if (may_break) {
    section->fatigue = section->state_size;
    section->state_size += padded + FATIGUE_HEAD + section->n * ED_FATIGUE_STATE;
  }
}

/* By the same sums as the kernels', so that an elastic answer equals it bit for bit; returns 0 when memory ran out. */
static int find_initial_stiffness(ed_section *section)
{
  double *state = malloc((size_t)section->state_size * sizeof *state);
  if (!state)
    return 0;
  ed_section_response response;
  ed_section_initialise(section, state);
  ed_section_trial(section, state, (double[ED_MAX_RESULTANTS]){0.0}, NULL, &response);
  free(state);
  memcpy(section->k, response.k, (size_t)ed_section_terms(section->axes) * sizeof *section->k);
  return 1;
}

/* Keeps the plastic strains that leave the stresses of the layers; returns 0 when memory ran out. */
static int lock_stresses(ed_section *section, const fibre *fibres)
{
  int any = 0;
  for (int i = 0; i < section->n; i++)
    any |= fibres[i].stress != 0.0;
  if (!any)
    return 1;
  section->plastic = malloc((size_t)section->n * sizeof *section->plastic);
  if (!section->plastic)
    return 0;
  for (int i = 0; i < section->n; i++) {
    section->plastic[i] = -fibres[i].stress / section->steel[i]->E;
    section->locked += section->area[i] * ed_steel_stored(section->steel[i], fibres[i].stress);
  }
  return 1;
}

static int set_layers(ed_section *section, const fibre *fibres, int layers, const ed_steel *steels)
{
  if (!make_arrays(section, layers))
    return 0;
  const ed_steel *some_curved = NULL;
  int may_break = 0;
  section->yield_strain = HUGE_VAL;
  for (int i = 0; i < layers; i++) {
    const ed_steel *steel = &steels[fibres[i].material];
    section->steel[i] = steel;
    section->depth = fmax(section->depth, fabs(fibres[i].y));
    section->width = fmax(section->width, fabs(fibres[i].z));
    section->stiffest = fmax(section->stiffest, steel->E);
    may_break |= steel->fatigue_strain > 0.0;
    if (steel->law == ED_MENEGOTTO_PINTO)
      some_curved = steel;
    else
      section->straight = 1;
    if (steel->law != ED_ELASTIC) /* the plastic strain that leaves a stress has a back stress, too */
      section->yield_strain = fmin(section->yield_strain, (steel->fy - fabs(fibres[i].stress) * (1.0 + steel->H / steel->E)) / steel->E);
  }
  section->curved = some_curved != NULL;
  if (some_curved || may_break) /* its curve is never straight; strains of what may break are followed from the first on */
    section->yield_strain = 0.0;
  for (int i = 0; i < section->n_padded; i++)
    if (i < layers)
      set_layer(section, i, &fibres[i], section->steel[i], some_curved);
    else
      set_layer(section, i, &(fibre){0}, section->steel[0], some_curved);
  lay_out_state(section, may_break);
  return find_initial_stiffness(section) && lock_stresses(section, fibres);
}

int ed_section_from_fibres(ed_section *section, int n, const double *y, const double *z, const double *area, const int *material,
                           const double *stress, const ed_steel *steels)
{
  memset(section, 0, sizeof *section);
  section->axes = z ? ED_SPACE : ED_PLANE;
  fibre *fibres = malloc((size_t)n * sizeof *fibres);
  if (!fibres)
    return 0;
  for (int i = 0; i < n; i++)
    fibres[i] = (fibre){y[i], z ? z[i] : 0.0, area[i], stress ? stress[i] : 0.0, material[i]};
  const int made = set_layers(section, fibres, merged(fibres, n), steels);
  if (!made)
    ed_section_free(section);
  free(fibres);
  return made;
}
