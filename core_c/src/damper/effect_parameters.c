/* Names, order and bounds of the parameters of all effects: made by tools/law_parameters.py from
 * edesign/damper/effect_forms.py, where they are changed. */
#include "damper/effect_parameters.h"

#include "edcore.h"

#include <math.h>
#include <stddef.h>

const ed_parameters ed_effect_parameters[] = {
    [ED_EFFECT_CONSTANT] =
        {.n = 1,
         .parameter = (const ed_parameter[]){{"factor", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_PAYNE_WHOLE] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"d", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"a0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"m", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"tau_a", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_PAYNE_ELASTIC] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"a0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"m", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"tau_a", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_PAYNE_NETWORK] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"d", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"s0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"tau", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_PAYNE_EXPONENTIAL] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"d", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"a0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"m", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"tau_a", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_MULLINS_PATH] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"m", -1.0, INFINITY, 0, 1, 0, NULL},
                                             {"s0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"q", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"recovery", 0.0, 1.0, 1, 1, 0, NULL}}},
    [ED_EFFECT_MULLINS_MAXIMUM] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"m", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"r", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"beta", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"recovery", 0.0, 1.0, 1, 1, 0, NULL}}},
    [ED_EFFECT_MULLINS_DAMAGE] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"m", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"r", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"p", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"recovery", 0.0, 1.0, 1, 1, 0, NULL}}},
    [ED_EFFECT_MULLINS_ELASTIC] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"s0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"q", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"recovery", 0.0, 1.0, 1, 1, 0, NULL}}},
    [ED_EFFECT_DEGRADATION_ENERGY] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"d", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"E0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"q", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_DEGRADATION_PATH] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"d", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"s0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"q", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_SELF_HEATING_RATE] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"beta", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"tau_h", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_HARDENING_POWER] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"p", 1.0, INFINITY, 1, 1, 0, NULL},
                                             {"r", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_HARDENING_EXPONENTIAL] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"u0", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_HARDENING_SATURATING] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"u0", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_HARDENING_THRESHOLD] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"u0", 0.0, INFINITY, 1, 1, 0, NULL}}},
    [ED_EFFECT_ONE_SIDED_FACTOR] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"b", -1.0, INFINITY, 0, 1, 0, NULL},
                                             {"side", -1.0, 1.0, 1, 1, 2, (const double[]){1.0, -1.0}}}},
    [ED_EFFECT_ONE_SIDED_VALVE] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"b", -1.0, INFINITY, 0, 1, 0, NULL},
                                             {"v0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"side", -1.0, 1.0, 1, 1, 2, (const double[]){1.0, -1.0}}}},
    [ED_EFFECT_ONE_SIDED_FORCE] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"b", -1.0, INFINITY, 0, 1, 0, NULL},
                                             {"side", -1.0, 1.0, 1, 1, 2, (const double[]){1.0, -1.0}}}},
    [ED_EFFECT_ONE_SIDED_SPRING] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"u0", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"side", -1.0, 1.0, 1, 1, 2, (const double[]){1.0, -1.0}}}},
    [ED_EFFECT_ONE_SIDED_CONTACT] =
        {.n = 5,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"u0", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"n", 1.0, INFINITY, 1, 1, 0, NULL},
                                             {"side", -1.0, 1.0, 1, 1, 2, (const double[]){1.0, -1.0}},
                                             {"r", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_ONE_SIDED_EVEN] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"n", 1.0, INFINITY, 1, 1, 0, NULL},
                                             {"r", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_GAS_SPRING_POLYTROPIC] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"P", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"c", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"n", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_RELAXATION_BRANCH_MAXWELL] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"k", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"tau", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_VELOCITY_EXPONENT_DASHPOT] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"c", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_VELOCITY_EXPONENT_FLOW] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"f", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"v0", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_VELOCITY_EXPONENT_POSITION] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"c", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"alpha", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"q", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"r", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_HYSTERESIS_STRETCH] =
        {.n = 4,
         .parameter = (const ed_parameter[]){{"F_y", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"Y", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"n", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"r", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_HYSTERESIS_BOUC_WEN] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"k", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"beta", -INFINITY, INFINITY, 0, 1, 0, NULL},
                                             {"gamma", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_PINCHING_SLIP] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"d", -INFINITY, 1.0, 0, 1, 0, NULL},
                                             {"w", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_LIMIT_FORCE] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"s", 0.0, 1.0, 1, 1, 0, NULL},
                                             {"F_l", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"side", -1.0, 1.0, 1, 1, 3, (const double[]){1.0, -1.0, 0.0}}}},
    [ED_EFFECT_FRICTION_COULOMB] =
        {.n = 2,
         .parameter = (const ed_parameter[]){{"F_c", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"v0", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_FRICTION_PRESLIDING] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"F_c", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"x0", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"n", 1.0, 100.0, 1, 1, 0, NULL}}},
    [ED_EFFECT_FRICTION_STRIBECK] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"F_c", 0.0, INFINITY, 0, 1, 0, NULL},
                                             {"s", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"v_s", 0.0, INFINITY, 0, 1, 0, NULL}}},
    [ED_EFFECT_FRICTION_LOADED] =
        {.n = 3,
         .parameter = (const ed_parameter[]){{"mu", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"F_c", 0.0, INFINITY, 1, 1, 0, NULL},
                                             {"v0", 0.0, INFINITY, 0, 1, 0, NULL}}},
};
