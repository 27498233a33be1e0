/* Names, order and bounds of the parameters of all laws: made by tools/law_parameters.py from
 * edesign/damper/laws.py, where they are changed. */
#ifndef ED_LAW_PARAMETERS_H
#define ED_LAW_PARAMETERS_H

#include "edcore.h"

#include <math.h>

typedef struct {
  const char *name;
  double lower, upper;
  int lower_allowed, upper_allowed; /* the bound itself */
} ed_parameter;

/* n parameters, then n_branch of each of 1 to most_branches branches, whose number follows their names. */
typedef struct {
  int n, n_branch, most_branches;
  ed_parameter parameter[12];
  ed_parameter branch[3];
} ed_parameters;

static const ed_parameters ed_law_parameters[] = {
    [ED_LAW_KELVIN_VOIGT] =
        {.n = 2,
         .parameter = {{"k", 0.0, INFINITY, 1, 1},
                       {"c", 0.0, INFINITY, 1, 1}}},
    [ED_LAW_ZENER] =
        {.n = 3,
         .parameter = {{"k0", 0.0, INFINITY, 1, 1},
                       {"k1", 0.0, INFINITY, 0, 1},
                       {"c1", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_GENERALISED_MAXWELL] =
        {.n = 1,
         .parameter = {{"k0", 0.0, INFINITY, 1, 1}},
         .n_branch = 2,
         .most_branches = 16,
         .branch = {{"k", 0.0, INFINITY, 0, 1},
                    {"c", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_FRACTIONAL_KELVIN] =
        {.n = 3,
         .parameter = {{"k0", 0.0, INFINITY, 0, 1},
                       {"c", 0.0, INFINITY, 0, 1},
                       {"alpha", 0.0, 1.0, 0, 0}}},
    [ED_LAW_FRACTIONAL_ZENER] =
        {.n = 4,
         .parameter = {{"k0", 0.0, INFINITY, 0, 1},
                       {"a", 0.0, INFINITY, 0, 1},
                       {"b", 0.0, INFINITY, 0, 1},
                       {"alpha", 0.0, 1.0, 0, 0}}},
    [ED_LAW_VISCOUS] =
        {.n = 1,
         .parameter = {{"c", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_VISCOUS_POWER] =
        {.n = 2,
         .parameter = {{"c", 0.0, INFINITY, 0, 1},
                       {"alpha", 0.0, 2.0, 0, 1}}},
    [ED_LAW_ASYMMETRIC_VISCOUS] =
        {.n = 3,
         .parameter = {{"c_plus", 0.0, INFINITY, 0, 1},
                       {"c_minus", 0.0, INFINITY, 0, 1},
                       {"alpha", 0.0, 2.0, 0, 1}}},
    [ED_LAW_BILINEAR_OIL] =
        {.n = 3,
         .parameter = {{"c", 0.0, INFINITY, 0, 1},
                       {"F_r", 0.0, INFINITY, 0, 1},
                       {"p", 0.0, 1.0, 1, 1}}},
    [ED_LAW_MAXWELL] =
        {.n = 2,
         .parameter = {{"c0", 0.0, INFINITY, 0, 1},
                       {"lambda", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_MAXWELL_POWER] =
        {.n = 3,
         .parameter = {{"c", 0.0, INFINITY, 0, 1},
                       {"alpha", 0.0, 2.0, 0, 1},
                       {"k", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_FRACTIONAL_MAXWELL] =
        {.n = 3,
         .parameter = {{"c0", 0.0, INFINITY, 0, 1},
                       {"lambda", 0.0, INFINITY, 0, 1},
                       {"nu", 0.0, 1.0, 0, 0}}},
    [ED_LAW_FRICTION] =
        {.n = 3,
         .parameter = {{"mu", 0.0, INFINITY, 0, 1},
                       {"N", 0.0, INFINITY, 0, 1},
                       {"k", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_ELASTIC_PLASTIC] =
        {.n = 3,
         .parameter = {{"k", 0.0, INFINITY, 0, 1},
                       {"Fy", 0.0, INFINITY, 0, 1},
                       {"b", 0.0, 1.0, 1, 0}}},
    [ED_LAW_LEAD_RUBBER] =
        {.n = 3,
         .parameter = {{"Q", 0.0, INFINITY, 0, 1},
                       {"K_d", 0.0, INFINITY, 0, 1},
                       {"Y", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_FRICTION_PENDULUM] =
        {.n = 6,
         .parameter = {{"W", 0.0, INFINITY, 0, 1},
                       {"R", 0.0, INFINITY, 0, 1},
                       {"f_slow", 0.0, INFINITY, 0, 1},
                       {"f_fast", 0.0, INFINITY, 0, 1},
                       {"a", 0.0, INFINITY, 1, 1},
                       {"Y", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_SELF_CENTRING] =
        {.n = 4,
         .parameter = {{"k", 0.0, INFINITY, 0, 1},
                       {"Fy", 0.0, INFINITY, 0, 1},
                       {"b", 0.0, 1.0, 1, 0},
                       {"beta", 0.0, 1.0, 1, 1}}},
    [ED_LAW_BUCKLING_RESTRAINED] =
        {.n = 8,
         .parameter = {{"A_sc", 0.0, INFINITY, 0, 1},
                       {"F_ysc", 0.0, INFINITY, 0, 1},
                       {"E", 0.0, INFINITY, 0, 1},
                       {"L_wp", 0.0, INFINITY, 0, 1},
                       {"L_y", 0.0, INFINITY, 0, 1},
                       {"KF", 1.0, INFINITY, 1, 1},
                       {"alpha", 0.0, 1.0, 1, 0},
                       {"R_y", 1.0, INFINITY, 1, 1}},
         .n_branch = 3,
         .most_branches = 16,
         .branch = {{"strain", 0.0, 1.0, 0, 0},
                    {"omega", 1.0, INFINITY, 1, 1},
                    {"beta", 1.0, INFINITY, 1, 1}}},
    [ED_LAW_GAP] =
        {.n = 4,
         .parameter = {{"k", 0.0, INFINITY, 0, 1},
                       {"gap", 0.0, INFINITY, 1, 1},
                       {"d", 0.0, INFINITY, 1, 1},
                       {"side", -1.0, 1.0, 1, 1}}},
    [ED_LAW_RAMBERG_OSGOOD] =
        {.n = 4,
         .parameter = {{"k", 0.0, INFINITY, 0, 1},
                       {"Fy", 0.0, INFINITY, 0, 1},
                       {"a", 0.0, INFINITY, 0, 1},
                       {"n", 1.0, INFINITY, 0, 1}}},
    [ED_LAW_BOUC_WEN] =
        {.n = 7,
         .parameter = {{"Fy", 0.0, INFINITY, 0, 1},
                       {"Y", 0.0, INFINITY, 0, 1},
                       {"alpha", 0.0, 1.0, 1, 0},
                       {"A", 0.0, INFINITY, 0, 1},
                       {"beta", -INFINITY, INFINITY, 0, 1},
                       {"gamma", 0.0, INFINITY, 0, 1},
                       {"n", 1.0, 100.0, 1, 1}}},
    [ED_LAW_MODIFIED_BOUC_WEN] =
        {.n = 11,
         .parameter = {{"k1", 0.0, INFINITY, 1, 1},
                       {"k2", 0.0, INFINITY, 0, 1},
                       {"u_ref", 0.0, INFINITY, 0, 1},
                       {"Y", 0.0, INFINITY, 0, 1},
                       {"alpha", 0.0, 1.0, 1, 0},
                       {"A", 0.0, INFINITY, 0, 1},
                       {"beta", -INFINITY, INFINITY, 0, 1},
                       {"gamma", 0.0, INFINITY, 0, 1},
                       {"n", 1.0, 100.0, 1, 1},
                       {"C", 0.0, INFINITY, 1, 1},
                       {"alpha_d", 0.0, 2.0, 0, 1}}},
    [ED_LAW_ASYMPTOTE] =
        {.n = 7,
         .parameter = {{"f0", 0.0, INFINITY, 0, 1},
                       {"k1", -INFINITY, INFINITY, 0, 1},
                       {"k2", -INFINITY, INFINITY, 0, 1},
                       {"k3", -INFINITY, INFINITY, 0, 1},
                       {"kappa", 0.0, INFINITY, 0, 1},
                       {"n", 1.0, INFINITY, 1, 1},
                       {"c", 0.0, INFINITY, 1, 1}}},
    [ED_LAW_LINEARISED] =
        {.n = 3,
         .parameter = {{"k_eff", 0.0, INFINITY, 0, 1},
                       {"zeta_eff", 0.0, INFINITY, 1, 1},
                       {"omega", 0.0, INFINITY, 0, 1}}},
    [ED_LAW_MGMM] =
        {.n = 12,
         .parameter = {{"k1", 0.0, INFINITY, 0, 1},
                       {"c1", 0.0, INFINITY, 0, 1},
                       {"k0", 0.0, INFINITY, 1, 1},
                       {"c_NL", 0.0, INFINITY, 1, 1},
                       {"alpha", 0.0, 2.0, 0, 1},
                       {"k_a", 0.0, INFINITY, 1, 1},
                       {"k_b", 0.0, INFINITY, 1, 1},
                       {"u_ref", 0.0, INFINITY, 0, 1},
                       {"c_a", 0.0, INFINITY, 1, 1},
                       {"c_b", 0.0, INFINITY, 1, 1},
                       {"v_ref", 0.0, INFINITY, 0, 1},
                       {"consistent", 0.0, 1.0, 1, 1}}},
};

#endif
