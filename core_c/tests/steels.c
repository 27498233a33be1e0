#include "steels.h"

#include "edcore.h"

#include <math.h>

ed_steel elastic_steel(double E)
{
  return (ed_steel){.law = ED_ELASTIC, .E = E, .fy = HUGE_VAL};
}

ed_steel bilinear_steel(double E, double fy, double b)
{
  return (ed_steel){.law = ED_BILINEAR, .E = E, .fy = fy, .hardening = b, .H = b * E / (1.0 - b)};
}

ed_steel menegotto_pinto_steel(double E, double fy, double b)
{
  ed_steel steel = bilinear_steel(E, fy, b);
  steel.law = ED_MENEGOTTO_PINTO;
  steel.R0 = 20.0;
  steel.cR1 = 0.925;
  steel.cR2 = 0.15;
  return steel;
}

double steel_stress(const ed_steel *steel, const double *state, double strain)
{
  double stress, tangent;
  ed_steel_trial(steel, state, strain, &stress, &tangent);
  return stress;
}

double steel_tangent(const ed_steel *steel, const double *state, double strain)
{
  double stress, tangent;
  ed_steel_trial(steel, state, strain, &stress, &tangent);
  return tangent;
}

void walk(const ed_steel *steel, double *state, double from, double to, int n, double *work, double *dissipated)
{
  double before = from, stress_before = steel_stress(steel, state, from);
  for (int i = 1; i <= n; i++) {
    const double strain = i == n ? to : from + (to - from) * i / n;
    const double stress = steel_stress(steel, state, strain);
    *work += 0.5 * (stress_before + stress) * (strain - before);
    *dissipated += ed_steel_commit(steel, state, strain);
    before = strain;
    stress_before = stress;
  }
}
