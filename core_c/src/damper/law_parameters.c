/* Names, order and bounds of the parameters of all laws: made by tools/law_parameters.py from
 * edesign/damper/laws.py, where they are changed. */
#include "damper/law_parameters.h"

#include "edcore.h"

#include <math.h>
#include <stddef.h>

const ed_parameters ed_law_parameters[] = {
    [ED_LAW_KELVIN_VOIGT] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"k", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"c", 0.0, INFINITY, 1, 1, 0, NULL}}},
    [ED_LAW_ZENER] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k0", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"k1", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"c1", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_GENERALISED_MAXWELL] =
        {.n = 1,
         .parameter = (const ed_parameter[]){{"k0", 0.0, INFINITY, 1, 1, 0, NULL}},
         .n_branch = 2,
         .most_branches = 16,
         .branch = (const ed_parameter[]){{"k", 0.0, INFINITY, 0, 1, 0, NULL},
                                          {"c", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_FRACTIONAL_KELVIN] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"c", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, 1.0, 0, 0, 0, NULL}}},
    [ED_LAW_FRACTIONAL_ZENER] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"k0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"a", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"b", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, 1.0, 0, 0, 0, NULL}}},
    [ED_LAW_VISCOUS] =
        {.n = 1,
         .parameter = (const ed_parameter[]){{"c", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_VISCOUS_POWER] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"c", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, 2.0, 0, 1, 0, NULL}}},
    [ED_LAW_ASYMMETRIC_VISCOUS] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"c_plus", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"c_minus", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, 2.0, 0, 1, 0, NULL}}},
    [ED_LAW_BILINEAR_OIL] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"c", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"F_r", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"p", 0.0, 1.0, 1, 1, 0, NULL}}},
    [ED_LAW_MAXWELL] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"c0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"lambda", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_MAXWELL_POWER] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"c", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, 2.0, 0, 1, 0, NULL},
                                             {"k", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_FRACTIONAL_MAXWELL] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"c0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"lambda", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"nu", 0.0, 1.0, 0, 0, 0, NULL}}},
    [ED_LAW_FRICTION] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"mu", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"N", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"k", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_ELASTIC_PLASTIC] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Fy", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"b", 0.0, 1.0, 1, 0, 0, NULL}}},
    [ED_LAW_LEAD_RUBBER] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"Q", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"K_d", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Y", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_FRICTION_PENDULUM] =
        {.n = 6,
         .parameter = (const ed_parameter[]){{"W", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"R", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"f_slow", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"f_fast", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"a", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"Y", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_SELF_CENTRING] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"k", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Fy", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"b", 0.0, 1.0, 1, 0, 0, NULL},
                                             {"beta", 0.0, 1.0, 1, 1, 0, NULL}}},
    [ED_LAW_BUCKLING_RESTRAINED] =
        {.n = 8,
         .parameter = (const ed_parameter[]){{"A_sc", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"F_ysc", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"E", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"L_wp", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"L_y", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"KF", 1.0, INFINITY, 1, 1, 0, NULL},
                                             {"alpha", 0.0, 1.0, 1, 0, 0, NULL},
                                             {"R_y", 1.0, INFINITY, 1, 1, 0, NULL}},
         .n_branch = 3,
         .most_branches = 16,
         .branch = (const ed_parameter[]){{"strain", 0.0, 1.0, 0, 0, 0, NULL},
                                          {"omega", 1.0, INFINITY, 1, 1, 0, NULL},
                                          {"beta", 1.0, INFINITY, 1, 1, 0, NULL}}},
    [ED_LAW_GAP] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"k", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"gap", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"d", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"side", -1.0, 1.0, 1, 1, 3, (const double[]){-1.0, 0.0, 1.0}}}},
    [ED_LAW_RAMBERG_OSGOOD] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"k", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Fy", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"a", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"n", 1.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_CHABOCHE] =
        {.n = 8,
         .parameter = (const ed_parameter[]){{"k", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Fy", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"C1", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"gamma1", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"C2", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"gamma2", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"Q", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"b", 0.0, INFINITY, 1, 1, 0, NULL}}},
    [ED_LAW_BOUC_WEN] =
        {.n = 7,
         .parameter = (const ed_parameter[]){{"Fy", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Y", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, 1.0, 1, 0, 0, NULL},
                                             {"A", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"beta", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"gamma", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"n", 1.0, 100.0, 1, 1, 0, NULL}}},
    [ED_LAW_MODIFIED_BOUC_WEN] =
        {.n = 11,
         .parameter = (const ed_parameter[]){{"k1", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"k2", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"u_ref", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Y", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, 1.0, 1, 0, 0, NULL},
                                             {"A", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"beta", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"gamma", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"n", 1.0, 100.0, 1, 1, 0, NULL},
                                             {"C", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"alpha_d", 0.0, 2.0, 0, 1, 0, NULL}}},
    [ED_LAW_ASYMPTOTE] =
        {.n = 7,
         .parameter = (const ed_parameter[]){{"f0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"k1", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"k2", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"k3", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"kappa", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"n", 1.0, INFINITY, 1, 1, 0, NULL},
                                             {"c", 0.0, INFINITY, 1, 1, 0, NULL}}},
    [ED_LAW_LINEARISED] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k_eff", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"zeta_eff", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"omega", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_LAW_MGMM] =
        {.n = 12,
         .parameter = (const ed_parameter[]){{"k1", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"c1", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"k0", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"c_NL", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"alpha", 0.0, 2.0, 0, 1, 0, NULL},
                                             {"k_a", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"k_b", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"u_ref", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"c_a", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"c_b", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"v_ref", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"consistent", 0.0, 1.0, 1, 1, 2, (const double[]){0.0, 1.0}}}},
};
