/* Steels for tests (Pa), built as the model builds them. */
#ifndef STEELS_H
#define STEELS_H

#include "base/lanes.h"
#include "material/steel.h"

enum { LARGEST_STEEL_STATE = ED_LANE_WIDTH * ED_MENEGOTTO_PINTO_STATE };

ed_steel elastic_steel(double E);
ed_steel bilinear_steel(double E, double fy, double b);
ed_steel menegotto_pinto_steel(double E, double fy, double b); /* R0 20, cR1 0.925, cR2 0.15 */

double steel_stress(const ed_steel *steel, const double *state, double strain);
double steel_tangent(const ed_steel *steel, const double *state, double strain);
/* Commits n equal steps from `from` to `to`; adds the work (trapezoids of the stress) and what was dissipated, a unit
 * volume. */
void walk(const ed_steel *steel, double *state, double from, double to, int n, double *work, double *dissipated);

#endif
