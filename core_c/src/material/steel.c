#include "material/steel.h"

#include "base/lanes.h"
#include "edcore.h"
#include "material/menegotto_pinto.h"

#include <math.h>
#include <string.h>

/* One fibre of a law that takes whole vectors: all lanes are that fibre. */
typedef struct {
  ed_menegotto_pinto law;
  double block[ED_MENEGOTTO_PINTO_ARRAYS * ED_LANE_WIDTH];
} alone;

static void set_alone(alone *fibre, const ed_steel *steel)
{
  ed_menegotto_pinto_place(&fibre->law, ED_LANE_WIDTH, fibre->block);
  for (int i = 0; i < ED_LANE_WIDTH; i++)
    ed_menegotto_pinto_set(&fibre->law, i, steel);
}

static void repeat(double *lanes, double value)
{
  for (int i = 0; i < ED_LANE_WIDTH; i++)
    lanes[i] = value;
}

int ed_steel_state_size(const ed_steel *steel)
{
  return steel->law == ED_MENEGOTTO_PINTO ? ED_LANE_WIDTH * ED_MENEGOTTO_PINTO_STATE : ED_BILINEAR_STATE;
}

void ed_steel_initialise(const ed_steel *steel, double *state)
{
  if (steel->law != ED_MENEGOTTO_PINTO) {
    memset(state, 0, ED_BILINEAR_STATE * sizeof *state);
    return;
  }
  alone fibre;
  set_alone(&fibre, steel);
  ed_menegotto_pinto_initialise(&fibre.law, state);
}

int ed_steel_state_valid(const ed_steel *steel, const double *state)
{
  return steel->law != ED_MENEGOTTO_PINTO || ed_menegotto_pinto_valid(ED_LANE_WIDTH, state);
}

/* Closest-point return for linear kinematic hardening (Simo & Hughes 1998, box 1.5 with K = 0). */
static int bilinear_return(const ed_steel *steel, double plastic, double strain, double *stress, double *flow)
{
  const double relative = steel->E * strain - (steel->E + steel->H) * plastic; /* stress less back stress */
  if (fabs(relative) <= steel->fy) {
    *stress = steel->E * (strain - plastic);
    *flow = 0.0;
    return 1;
  }
  *flow = (relative - copysign(steel->fy, relative)) / (steel->E + steel->H);
  *stress = steel->E * (strain - plastic - *flow);
  return 0;
}

int ed_steel_trial(const ed_steel *steel, const double *state, double strain, double *stress, double *tangent)
{
  if (steel->law == ED_MENEGOTTO_PINTO) {
    alone fibre;
    double strains[ED_LANE_WIDTH], stresses[ED_LANE_WIDTH], tangents[ED_LANE_WIDTH], reach;
    set_alone(&fibre, steel);
    repeat(strains, strain);
    const int elastic = ed_menegotto_pinto_trial(&fibre.law, state, 0, ED_LANE_WIDTH, strains, stresses, tangents, &reach);
    *stress = stresses[0];
    *tangent = tangents[0];
    return elastic;
  }
  double flow;
  const int elastic = bilinear_return(steel, state[0], strain, stress, &flow);
  *tangent = elastic ? steel->E : steel->hardening * steel->E;
  return elastic;
}

double ed_steel_commit(const ed_steel *steel, double *state, double strain)
{
  if (steel->law == ED_MENEGOTTO_PINTO) {
    alone fibre;
    double strains[ED_LANE_WIDTH], stresses[ED_LANE_WIDTH], tangents[ED_LANE_WIDTH], dissipated[ED_LANE_WIDTH], reach;
    set_alone(&fibre, steel);
    repeat(strains, strain);
    ed_menegotto_pinto_trial(&fibre.law, state, 0, ED_LANE_WIDTH, strains, stresses, tangents, &reach);
    ed_menegotto_pinto_commit(&fibre.law, state, 0, ED_LANE_WIDTH, strains, stresses, dissipated);
    return dissipated[0];
  }
  double stress, flow;
  if (bilinear_return(steel, state[0], strain, &stress, &flow))
    return 0.0;
  /* plastic work of the straight path from yield to the end of the step: mean stress times flow; with the back stress
   * counted as dissipated, since kinematic hardening gives it back only by further flow */
  const double at_yield = stress - steel->H * flow;
  state[0] += flow;
  return 0.5 * (at_yield + stress) * flow;
}

double ed_steel_stored(const ed_steel *steel, double stress)
{
  return 0.5 * stress * stress / steel->E;
}
