/* Elements in the state: their blocks, trials, commits and energies, by kind. */
#include "element/element.h"

#include "base/symmetric.h"
#include "element/strut.h"

#include <math.h>
#include <string.h>

int ed_element_block_size(const ed_element *e)
{
  if (e->kind == ED_STRUT)
    return ed_strut_block_size(e->strut);
  const int rigid = e->rigid ? 2 * ed_rigid_moments(e) : 0;
  return ed_point_at(e->axes, e->kind == ED_FIBRE_BEAM ? e->points : 0) + rigid;
}

int ed_element_record_size(const ed_element *e)
{
  if (e->kind == ED_STRUT)
    return ed_strut_record_size(e->strut);
  int size = 0;
  for (int p = 0; p < e->points; p++)
    size += e->section[p]->record_size;
  return size;
}

void ed_element_place_records(ed_element *e, double *records)
{
  if (e->kind == ED_STRUT)
    ed_strut_place_records(e->strut, records);
  for (int p = 0; p < e->points; p++) {
    e->record[p] = e->section[p]->record_size ? records : NULL;
    records += e->section[p]->record_size;
  }
}

int ed_element_layer_size(const ed_element *e)
{
  if (e->kind == ED_STRUT)
    return ed_strut_layer_size(e->strut);
  if (e->kind == ED_TRUSS)
    return ed_steel_state_size(e->steel);
  if (e->kind == ED_SPRING)
    return ed_spring_state_size(e->spring);
  int size = 0;
  for (int p = 0; p < e->points; p++)
    size += e->section[p]->state_size;
  return size;
}

void ed_element_initialise(const ed_element *e, double *block, double *layers)
{
  if (e->kind == ED_STRUT) {
    ed_strut_initialise(e->strut, block, layers);
    return;
  }
  memset(block, 0, (size_t)ed_element_block_size(e) * sizeof *block);
  if (e->kind == ED_TRUSS)
    ed_steel_initialise(e->steel, layers);
  if (e->kind == ED_SPRING)
    ed_spring_initialise(e->spring, layers);
  for (int p = 0; p < e->points; p++)
    ed_section_initialise(e->section[p], layers + e->layer_offset[p]);
  memcpy(block + ed_block_k(e->axes), e->stiffness, (size_t)ed_basic_terms(e->axes) * sizeof *block);
  for (int p = 0; p < e->points; p++) {
    double *point = block + ed_point_at(e->axes, p);
    memcpy(point + ed_point_k(e->axes), e->section[p]->k, (size_t)ed_section_terms(e->axes) * sizeof *point);
    point[ed_point_elastic(e->axes)] = 1.0;
  }
}

static void update_elastic_beam(const ed_element *e, const double *v, double *block)
{
  const int rows = ed_basic(e->axes);
  double relative[ED_MAX_BASIC];
  memcpy(block + ED_BLOCK_V, v, (size_t)rows * sizeof *block);
  for (int i = 0; i < rows; i++)
    relative[i] = v[i] - e->free_deformation[i];
  ed_sym_times(rows, e->stiffness, relative, block + ed_block_q(e->axes));
}

static void update_truss(const ed_element *e, const double *v, const double *layers, double *block)
{
  double stress, tangent;
  memcpy(block + ED_BLOCK_V, v, (size_t)ed_basic(ED_PLANE) * sizeof *block);
  ed_steel_trial(e->steel, layers, v[0] / e->length, &stress, &tangent);
  block[ED_BLOCK_Q] = stress * e->area;
  block[ED_BLOCK_K] = tangent * e->area / e->length;
}

static int update_spring(const ed_element *e, const double *displacement, const double *layers, double *block)
{
  double u = 0.0;
  for (int i = 0; i < e->degrees; i++)
    u += e->member->coefficient[i] * displacement[i];
  block[ED_BLOCK_V] = u;
  return ed_spring_trial(e->spring, layers, u, &block[ED_BLOCK_Q], &block[ED_BLOCK_K]);
}

int ed_element_update(const ed_element *e, const double *displacement, const double *layers, double *block,
                      ed_element_control *control)
{
  ed_kinematics k;
  if (e->kind == ED_SPRING) {
    control->updates++;
    control->elastic += update_spring(e, displacement, layers, block);
    return ED_OK;
  }
  if (e->kind == ED_LINK)
    return ED_OK;
  ed_kinematics_of(e, displacement, &k);
  if (e->axes == ED_SPACE)
    block[ed_block_twist(ED_SPACE)] = k.twist;
  if (e->kind == ED_FIBRE_BEAM)
    return ed_fibre_beam_update(e, k.v, layers, block, control);
  if (e->kind == ED_STRUT)
    return ed_strut_update(e->strut, k.v[0], layers, block, control);
  control->updates++;
  if (e->kind == ED_ELASTIC_BEAM)
    update_elastic_beam(e, k.v, block);
  else
    update_truss(e, k.v, layers, block);
  return ED_OK;
}

int ed_element_layers_valid(const ed_element *e, const double *layers)
{
  if (e->kind == ED_TRUSS)
    return ed_steel_state_valid(e->steel, layers);
  if (e->kind == ED_STRUT)
    return ed_strut_layers_valid(e->strut, layers);
  if (e->kind == ED_SPRING)
    return ed_spring_state_valid(e->spring, layers);
  for (int p = 0; p < e->points; p++)
    if (!ed_section_state_valid(e->section[p], layers + e->layer_offset[p]))
      return 0;
  return 1;
}

ED_INLINE double commit_points(const ed_element *e, double *block, double *layers, const int axes)
{
  double dissipated = 0.0;
  for (int p = 0; p < e->points; p++) {
    double *point = block + ed_point_at(axes, p), *reach = point + ed_point_reach(axes);
    if (point[ed_point_elastic(axes)] != 0.0 && !e->section[p]->curved && !e->section[p]->fatigue)
      continue; /* no layer yields: nothing to remember */
    const double *record = *reach > 0.0 ? e->record[p] : NULL; /* 0: no trial since the last commit */
    block[ed_block_inelastic(axes)] = point[ed_point_inelastic(axes)] = 1.0;
    *reach = 0.0;
    dissipated += e->weight[p] * ed_section_commit(e->section[p], layers + e->layer_offset[p], point, record);
  }
  return dissipated;
}

double ed_element_commit(const ed_element *e, double *block, double *layers)
{
  if (e->kind == ED_FIBRE_BEAM)
    return e->axes == ED_PLANE ? commit_points(e, block, layers, ED_PLANE) : commit_points(e, block, layers, ED_SPACE);
  if (e->kind == ED_TRUSS)
    return e->area * e->length * ed_steel_commit(e->steel, layers, block[ED_BLOCK_V] / e->length);
  if (e->kind == ED_STRUT)
    return ed_strut_commit(e->strut, block, layers);
  if (e->kind != ED_SPRING)
    return 0.0;
  const double dissipated = ed_spring_commit(e->spring, layers, block[ED_BLOCK_V]);
  if (dissipated != 0.0)
    block[ED_BLOCK_INELASTIC] = 1.0;
  return dissipated;
}

static double fibres_stored(const ed_element *e, const double *block, const double *layers)
{
  double energy = 0.0;
  for (int p = 0; p < e->points; p++) {
    const double *point = block + ed_point_at(e->axes, p), *force = point + ed_point_s(e->axes);
    double density;
    if (point[ed_point_inelastic(e->axes)] == 0.0 && e->section[p]->yield_strain > 0.0) {
      density = point[0] * force[0] + point[1] * force[1];
      if (e->axes == ED_SPACE)
        density += point[2] * force[2];
      density *= 0.5;
    } else
      density = ed_section_stored(e->section[p], layers + e->layer_offset[p], point);
    energy += e->weight[p] * density;
  }
  return energy;
}

double ed_element_stored(const ed_element *e, const double *block, const double *layers)
{
  const double *q = block + ed_block_q(e->axes), *v = block + ED_BLOCK_V;
  if (e->kind == ED_TRUSS)
    return 0.5 * q[0] * q[0] * e->flexibility[0];
  if (e->kind == ED_STRUT)
    return ed_strut_stored(e->strut, block, layers);
  if (e->kind == ED_SPRING)
    return ed_spring_stored(e->spring, layers, v[0]);
  double energy = 0.0;
  if (e->axes == ED_SPACE) {
    const double twist = block[ed_block_twist(ED_SPACE)];
    energy = 0.5 * e->twist_stiffness * twist * twist;
  }
  if (e->kind == ED_FIBRE_BEAM)
    return energy + fibres_stored(e, block, layers);
  /* elastic beam: deformation energy of q, of the loads and of both together, up to the constant of the loads alone */
  for (int i = 0; i < ed_basic(e->axes); i++)
    energy += 0.5 * q[i] * (v[i] + e->free_deformation[i]);
  return energy;
}

double ed_element_plastic_rotation(const ed_element *e, const double *block, int which)
{
  if (e->kind == ED_SPRING)
    return block[ED_BLOCK_V] - e->flexibility[0] * block[ED_BLOCK_Q];
  if (e->kind != ED_FIBRE_BEAM || e->release[which])
    return 0.0; /* a hinge turns freely */
  double elastic[ED_MAX_BASIC];
  ed_sym_times(ed_basic(e->axes), e->flexibility, block + ed_block_q(e->axes), elastic);
  return block[ED_BLOCK_V + 1 + which] - elastic[1 + which] - e->free_deformation[1 + which];
}
