/* Linear elastic space frames, and checks of their steel members. */
#ifndef EDSPACE_H
#define EDSPACE_H

#include "edstatus.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- frames ----------------------------------------------------------------------------------------------------------- */

/* Degrees of a node: 0 ux, 1 uy, 2 uz, 3 rx, 4 ry, 5 rz, right-handed, z upwards. Local x of a member runs from its start to its end,
 * local z along `web`, local y completes a right-handed system. Forces on the ends of a member: N V_y V_z T M_y M_z at its start, then
 * at its end, as components along local x, y, z of what acts on the member. One thread at a time may use an object. */
typedef struct ed_space ed_space;

/* Section and material of a member: E, G (N/m^2), A, A_y, A_z (m^2), I_t, I_y, I_z (m^4). A_y, A_z: shear areas for V_y and V_z, 0: no shear deformation. */
#define ED_SPACE_PROPERTIES 8

/* What a frame is made of; read only by ed_space_new. ux, uy and rz of the nodes of a floor follow the floor's master, at its place in
 * plan, as a rigid body. A node of a floor may be restrained in rz, and then, or where it lies on the axis of the master, in ux and uy. */
typedef struct {
  int n_nodes, n_floors, n_members;
  const char *const *node_name, *const *member_name; /* for messages */
  const double *coordinates; /* n_nodes x 3, m */
  const int *node_floor;     /* n_nodes: 0 .. n_floors - 1, -1: none */
  const double *masters;     /* n_floors x 2: x, y, m */
  const int *fixed;          /* n_nodes x 6: restrained */
  const double *springs;     /* n_nodes x 6: to the ground, >= 0; N/m and N m/rad */
  const int *start, *end;    /* n_members: nodes */
  const double *web;         /* n_members x 3, of length 1 and at right angles to the member */
  const double *properties;  /* n_members x ED_SPACE_PROPERTIES */
  const double *ends;        /* n_members x 4: rotational springs y at start, z at start, y at end, z at end, N m/rad; 0: pin, infinite: rigid */
  const int *axial_only;     /* n_members: carries an axial force alone between its ends; of its properties E and A count */
} ed_space_input;

/* Checks, numbers, analyses the matrix symbolically and factors it. On failure *status and `message` (size bytes) say why and NULL is
 * returned: ED_E_ARGUMENT, ED_E_ID, ED_E_EMPTY, ED_E_DISCONNECTED, ED_E_MECHANISM (with the degrees that move), ED_E_NOT_FINITE,
 * ED_E_MEMORY. Rotations of a node that no member and no spring resists are no degrees, nor is uz of a node of a floor without members. */
ed_space *ed_space_new(const ed_space_input *input, int *status, char *message, int size);
void ed_space_free(ed_space *space);
const char *ed_space_message(const ed_space *space); /* the last error, for people */
int ed_space_n_equations(const ed_space *space);
int ed_space_n_nonzeros(const ed_space *space); /* of the stiffness */
/* Equation of each degree of the nodes (6 n_nodes), then of Ux, Uy, Rz of each master (3 n_floors); -1: restrained, or follows a master. */
void ed_space_equations(const ed_space *space, int *equation);

/* New properties (n x ED_SPACE_PROPERTIES) of n members, and new factors without a new symbolic analysis. After an error nothing has
 * changed, but after ED_E_MEMORY. */
int ed_space_change(ed_space *space, int n, const int *member, const double *properties);

/* Loads on members: force a length of the member, and forces at a fraction of its length, in global components. */
typedef struct {
  const double *uniform; /* n_cases x n_members x 3, N/m, or NULL */
  int n_points;
  const int *point_case, *point_member; /* n_points: case and member of each */
  const double *point_position;         /* n_points: 0 .. 1 */
  const double *point_force;            /* n_points x 3, N */
} ed_space_loads;

/* Static cases. nodal: n_cases x n_nodes x 6, or NULL. Results, each may be NULL but end_forces: displacements and reactions n_cases x
 * n_nodes x 6, end_forces n_cases x n_members x 12. Reactions are those of supports and springs; of a floor that is restrained, at the
 * node that restrains it. */
int ed_space_static(ed_space *space, int n_cases, const double *nodal, const ed_space_loads *loads, double *displacements,
                    double *end_forces, double *reactions);
/* N V_y V_z T M_y M_z on the face whose outward normal is +x at stations (fractions of the length), n_cases x n_members x n_stations x 6.
 * Of a force at a station what is just before it is given, at the end of the member what is behind it. loads: those of the end forces,
 * or NULL. */
int ed_space_internal(ed_space *space, int n_cases, const double *end_forces, const ed_space_loads *loads, int n_stations,
                      const double *stations, double *internal);

/* Displacements at n equations under a unit force at each of them: n x n. Quick where all are of masters, which are eliminated last. */
int ed_space_flexibility(ed_space *space, int n, const int *equation, double *flexibility);
/* n right sides over the equations (n x n_equations), solved in place. */
int ed_space_solve(ed_space *space, int n, double *right_sides);
/* Displacements of the nodes (n x n_nodes x 6) and end forces (n x n_members x 12; may be NULL) of n solutions over the equations. */
int ed_space_expand(ed_space *space, int n, const double *solution, double *displacements, double *end_forces);

/* Buckling by bending, K + factor K_G singular. Shapes are over the equations and, behind them, the amplitudes of how members with an axial
 * force bow between their nodes, in which K is the unit matrix and has no terms with the equations. axial: n_members, tension > 0. */
int ed_space_shape_length(const ed_space *space, const double *axial);
/* -K_G times n shapes: n x ed_space_shape_length. */
int ed_space_geometric(ed_space *space, const double *axial, int n, const double *shape, double *image);
/* The least factor > 0 of the axial forces, *factor infinite if none does. */
int ed_space_critical(ed_space *space, const double *axial, double *factor);

/* Combination of modal values: result_q = sqrt(r_q^T rho r_q). values: n_modes x n, one mode after the other; rho: n_modes x n_modes,
 * symmetric. result: n. */
int ed_combine(int n, int n_modes, const double *values, const double *rho, double *result);
/* The same of N V_y V_z T M_y M_z at stations of members without loads between their ends. end_forces: n_modes x n_members x 12;
 * result: n_members x n_stations x 6. M is linear in between, so that three forms of its ends serve all stations. */
int ed_combine_stations(int n_members, int n_modes, const double *end_forces, const double *rho, int n_stations, const double *stations,
                        double *result);

/* ---- checks of steel members ------------------------------------------------------------------------------------------ */

/* Forces at stations along members, in the order N (tension positive), V_y, V_z, T, M_y, M_z: statics n_cases x n_members x
 * n_stations x 6; spectral n_directions x ..., magnitudes of responses without sign. static_factors: n_combinations x n_cases,
 * spectral_factors: n_combinations x n_directions (magnitudes count). In each combination N takes both signs of the spectral part,
 * moments and shears the one that adds. T is not checked.
 * set: n_combinations, number of the set of checks of a combination; masks: n_members x n_sets, the checks of a member under it, 1 <<
 * ED_CHECK_...; gravity: n_cases, whether a case counts in V_Ed,G. constants: n_members x ED_N_CONSTANTS; kind: n_members, shape,
 * | ED_CLASS_3, | ED_NO_TWIST, | ED_ANNEX_A where 6_61 and 6_62 follow Annex A and not B. Member checks (N_B, M_B, 6_61, 6_62) count
 * with the largest compression and moments along the member; their station is that of the compression, of M_y elsewhere.
 * M_b: n_members x n_combinations, what M_y meets under a combination in the place of ED_M_B; combinations with the same factors have
 * the same. May be NULL.
 * Of each member and check: the largest utilisation (1 is the limit), the first combination and station that give it, or 0, -1, -1
 * where none applies: n_members x ED_N_CHECKS each. ED_E_ARGUMENT: a number or constant is out of range, ED_E_NOT_FINITE, ED_E_MEMORY;
 * nothing is written then. */
enum { ED_I = 0, ED_RHS = 1, ED_CHS = 2, ED_CLASS_3 = 4, ED_NO_TWIST = 8, ED_ANNEX_A = 16 };
enum {
  ED_N_RD = 0,       /* A f_y / gamma_M0 */
  ED_V_Y_RD = 1,
  ED_V_Z_RD = 2,
  ED_M_Y_RD = 3,     /* plastic, of class 3 elastic */
  ED_M_Z_RD = 4,
  ED_M_Y_SHEAR = 5,  /* the part of M_Y_RD that the shear area carries, Eq. 6.30 */
  ED_N_WEB = 6,      /* h_w t_w f_y / gamma_M0 of an I section, else 0 */
  ED_WEB_SHARE_Y = 7,        /* a, a_w of Eqs. 6.36, 6.39 */
  ED_WEB_SHARE_Z = 8,        /* a, a_f of Eqs. 6.38, 6.40 */
  ED_N_B_Y = 9,      /* chi_y N_Rk / gamma_M1 */
  ED_N_B_Z = 10,
  ED_M_B = 11,       /* chi_LT M_y,Rk / gamma_M1 */
  ED_M_Z_RK = 12,    /* M_z,Rk / gamma_M1 */
  ED_LAMBDA_Y = 13,
  ED_LAMBDA_Z = 14,
  ED_C_MY = 15,
  ED_C_MZ = 16,
  ED_C_MLT = 17,     /* above 0.25 */
  ED_V_M = 18,       /* V_Ed,M of EN 1998-1, 6.6.2(2) */
  /* of Annex A alone; its C_mi,0 is C_MY or C_MZ + C_M._N N_Ed / N_cr,i */
  ED_N_RK = 19,      /* N_Rk / gamma_M1 */
  ED_PER_N_CR_Y = 20,        /* 1 / N_cr, 0 where the member is restrained all along */
  ED_PER_N_CR_Z = 21,
  ED_PER_N_CR_T = 22,
  ED_CHI_Z = 23,     /* of flexural buckling */
  ED_ELASTIC_Y = 24, /* W_el / W_pl */
  ED_ELASTIC_Z = 25,
  ED_A_LT = 26,      /* 1 - I_t / I_y, 0 to 1 */
  ED_LAMBDA_0 = 27,  /* under uniform moment; 0 without lateral torsional buckling */
  ED_LT_LIMIT = 28,  /* 0.2 sqrt(C_1) */
  ED_AREA_BY_MODULUS = 29,   /* A / W_el,y */
  ED_C_MY_N = 30,
  ED_C_MZ_N = 31,
  ED_N_CONSTANTS = 32
};
enum {
  ED_CHECK_N = 0,         /* EN 1993-1-1, 6.2.3, 6.2.4 */
  ED_CHECK_V_Y = 1,       /* 6.2.6 */
  ED_CHECK_V_Z = 2,
  ED_CHECK_M_Y = 3,       /* 6.2.5, 6.2.8 */
  ED_CHECK_M_Z = 4,
  ED_CHECK_N_M = 5,       /* 6.2.9, 6.2.10 */
  ED_CHECK_N_B = 6,       /* 6.3.1 */
  ED_CHECK_M_B = 7,       /* 6.3.2 */
  ED_CHECK_6_61 = 8,      /* 6.3.3, Annex B */
  ED_CHECK_6_62 = 9,
  ED_CHECK_BEAM_M = 10,   /* EN 1998-1, 6.6.2(2), Eq. 6.2: M_Ed / M_pl,Rd */
  ED_CHECK_BEAM_N = 11,   /* Eq. 6.3: N_Ed / N_pl,Rd by 0.15 */
  ED_CHECK_BEAM_V = 12,   /* Eq. 6.4: (V_Ed,G + V_Ed,M) / V_pl,Rd by 0.5 */
  ED_CHECK_COLUMN_V = 13, /* 6.6.3(4), Eq. 6.7: V_Ed / V_pl,Rd by 0.5 */
  ED_N_CHECKS = 14
};
int ed_member_checks(int n_cases, int n_directions, int n_members, int n_stations, int n_combinations, int n_sets,
                     const double *statics, const double *spectral, const double *static_factors,
                     const double *spectral_factors, const int *set, const int *gravity, const double *constants,
                     const int *kind, const int *masks, const double *M_b, double *utilisation, int *combination, int *station);

#ifdef __cplusplus
}
#endif

#endif
