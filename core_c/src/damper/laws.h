/* All damper laws; one file each, families in one. */
#ifndef ED_LAWS_H
#define ED_LAWS_H

#include "damper/law.h"

/* viscoelastic.c, fractional.c */
extern const ed_law ed_kelvin_voigt, ed_zener, ed_generalised_maxwell, ed_viscous, ed_maxwell, ed_linearised;
extern const ed_law ed_fractional_kelvin, ed_fractional_zener, ed_fractional_maxwell;
extern const ed_law ed_viscous_power, ed_asymmetric_viscous; /* viscous_power.c */
extern const ed_law ed_bilinear_oil;       /* bilinear_oil.c */
extern const ed_law ed_maxwell_power;      /* maxwell_power.c */
extern const ed_law ed_friction, ed_elastic_plastic, ed_lead_rubber; /* elastic_plastic.c */
extern const ed_law ed_ramberg_osgood;     /* ramberg_osgood.c */
extern const ed_law ed_bouc_wen;           /* bouc_wen.c */
extern const ed_law ed_modified_bouc_wen;  /* modified_bouc_wen.c */
extern const ed_law ed_asymptote;          /* asymptote.c */
extern const ed_law ed_friction_pendulum;  /* friction_pendulum.c */
extern const ed_law ed_self_centring;      /* self_centring.c */
extern const ed_law ed_buckling_restrained; /* buckling_restrained.c */
extern const ed_law ed_chaboche;           /* chaboche.c */
extern const ed_law ed_gap;                /* gap.c */
extern const ed_law ed_mgmm;               /* mgmm.c */

#endif
