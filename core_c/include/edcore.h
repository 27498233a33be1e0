/* edcore: the numerical core of edesign. Plane frames of force-based fibre beam-columns under static loads,
 * prescribed displacements and ground acceleration; linear elastic space frames; response spectra of ground acceleration.
 *
 * Conventions
 *   Units      any consistent set (edesign uses m, N, kg, s). No tolerance depends on it; of the
 *              dampers, fractional laws resolve 1e-4 to 2e3 s, and viscous power laws are linear below 1e-9 m/s.
 *   Degrees    three a node: 0 ux, 1 uy, 2 rz (anticlockwise). y points upwards. Space frames have their own, below.
 *   Elements   local x runs from end i to end j, local y 90 degrees anticlockwise of it.
 *   Sections   strain at depth y is e0 - y*kappa; axial force and strain are positive in tension.
 *   Ids        non-negative integers in the order of creation; a negative return is an ed_status.
 *   Handles    made by *_new, freed by *_free. A model is read-only once an analysis has been made of it; analyses of one
 *              model share nothing that changes and may run in parallel threads. The library has no global state, never
 *              prints and never exits.
 */
#ifndef EDCORE_H
#define EDCORE_H

#include "edcompensator.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One list yields the enum and the texts: name, value, text. Below zero: error. */
#define ED_STATUS_LIST(X) \
  X(ED_OK, 0, "ok") \
  X(ED_LIMIT, 1, "a limit of a channel was exceeded") \
  X(ED_E_MEMORY, -1, "out of memory") \
  X(ED_E_ARGUMENT, -2, "invalid argument") \
  X(ED_E_ID, -3, "no object with this id") \
  X(ED_E_EMPTY, -4, "the model has no free degree of freedom") \
  X(ED_E_DISCONNECTED, -5, "a node is not connected to any support") \
  X(ED_E_MECHANISM, -6, "the structure is a mechanism") \
  X(ED_E_SINGULAR, -7, "the tangent matrix is singular") \
  X(ED_E_NOT_CONVERGED, -8, "equilibrium was not found") \
  X(ED_E_ELEMENT, -9, "an element state was not found") \
  X(ED_E_NOT_FINITE, -10, "a result is not a finite number") \
  X(ED_E_STATE, -11, "this call is not allowed in the present state") \
  X(ED_E_UNSTABLE, -12, "the structure is unstable under its loads") \
  X(ED_E_DAMPER, -13, "a damper state was not found") \
  X(ED_E_STOPPED, -14, "the call was asked to stop")

#define ED_STATUS_ENUM(name, value, text) name = value,
typedef enum { ED_STATUS_LIST(ED_STATUS_ENUM) ED_STATUS_END = 99 } ed_status;

const char *ed_status_name(int status);
const char *ed_status_text(int status);
const char *ed_version(void);

/* Whether a long call shall end. `asked` is called with `data` in the thread of the call, about five times a second, and never by
 * calls that last less than that. Another answer than 0 ends the call with ED_E_STOPPED. It must not use the object that is busy. */
typedef struct {
  int (*asked)(void *data);
  void *data;
} ed_stop;

typedef struct ed_model ed_model;
typedef struct ed_analysis ed_analysis;

/* ---- model ------------------------------------------------------------------------------------------------------ */

ed_model *ed_model_new(void); /* NULL: out of memory */
void ed_model_free(ed_model *model);
const char *ed_model_message(const ed_model *model); /* the last error, for people */

/* Uniaxial laws. Parameters: ELASTIC E; BILINEAR E, fy, b (kinematic hardening ratio, 0 <= b < 1);
 * MENEGOTTO_PINTO E, fy, b, R0, cR1, cR2. */
enum { ED_ELASTIC = 0, ED_BILINEAR = 1, ED_MENEGOTTO_PINTO = 2 };
int ed_model_material(ed_model *model, int law, int n_parameters, const double *parameters);

int ed_model_elastic_section(ed_model *model, double EA, double EI);
/* n fibres at depths y with areas and materials; those of one depth and material are merged into one layer. */
int ed_model_fibre_section(ed_model *model, int n, const double *y, const double *area, const int *material);
int ed_model_section_layers(const ed_model *model, int section); /* layers after merging */

int ed_model_node(ed_model *model, const char *name, double x, double y);
int ed_model_fix(ed_model *model, int node, int ux, int uy, int rz);
int ed_model_tie(ed_model *model, int node, int master, int ux, int uy, int rz); /* the node shares the master's degrees */
int ed_model_mass(ed_model *model, int node, double mx, double my, double mrz);  /* added to what is there */

enum { ED_LINEAR = 0, ED_P_DELTA = 1, ED_COROTATIONAL = 2 };
/* Force-based fibre beam-column; sections: one id a Gauss-Lobatto point (2..10). release_*: moment-free end. Two points integrate
 * the square of a linear moment wrongly (far too flexible); from three on an elastic prismatic member is exact.
 * A point load inside leaves a kink in the moment that quadrature meets only approximately; put a node there to be exact. */
int ed_model_beam_column(ed_model *model, const char *name, int i, int j, int points, const int *sections, int geometry,
                         int release_i, int release_j);
int ed_model_elastic_beam(ed_model *model, const char *name, int i, int j, int section, int geometry, int release_i,
                          int release_j);
int ed_model_truss(ed_model *model, const char *name, int i, int j, int material, double area, int geometry);
/* Elastic link with stiffnesses along local x, y and in rotation. Two nodes apart: local x runs along the link and shear
 * acts at mid-length; at one place: local x is at `angle` (rad) from global x. */
int ed_model_link(ed_model *model, const char *name, int i, int j, double kx, double ky, double krz, double angle);

/* A damper (laws: below) whose deformation is the sum of coefficient * displacement of n_terms degrees (0 ux, 1 uy, 2 rz) of nodes,
 * F = force_scale * law(deformation_scale * u); brace: stiffness in series at the size of the device, 0: rigid. It carries nothing
 * before ed_install_dampers. Give its degrees mass: velocities of others are left to ring by the trapezoidal rule. Up to 12 terms. */
int ed_model_damper(ed_model *model, const char *name, int law, int n_parameters, const double *parameters, double brace,
                    double force_scale, double deformation_scale, int n_terms, const int *node, const int *degree,
                    const double *coefficient);
/* Adds an amendment (below) to a damper of the model, in the units of its law. */
int ed_model_amend_damper(ed_model *model, int damper, int kind, int inside, int n_parameters, const double *parameters);

int ed_model_pattern(ed_model *model);
int ed_model_nodal_load(ed_model *model, int pattern, int node, double fx, double fy, double mz);
/* Loads on beam-columns, force a length in local axes, or a force at position (0..1) of the length. */
int ed_model_uniform_load(ed_model *model, int pattern, int element, double axial, double transverse);
int ed_model_point_load(ed_model *model, int pattern, int element, double position, double axial, double transverse);

/* ---- analysis --------------------------------------------------------------------------------------------------- */

/* Numbers the degrees, analyses the matrix symbolically and checks the structure. On failure *status and `message`
 * (size bytes) say why and NULL is returned. The model must outlive the analysis. */
ed_analysis *ed_analysis_new(const ed_model *model, int *status, char *message, int size);
void ed_analysis_free(ed_analysis *analysis);
const char *ed_analysis_message(const ed_analysis *analysis);
/* Whom runs of this analysis ask whether to stop; NULL, or before this call: nobody. */
void ed_analysis_ask(ed_analysis *analysis, const ed_stop *stop);

int ed_n_equations(const ed_analysis *analysis);
int ed_n_nonzeros(const ed_analysis *analysis);
void ed_equations(const ed_analysis *analysis, int *equation); /* 3 n_nodes; -1 where fixed */
/* Tangent stiffness at the present state, compressed columns: column_start n+1, row nnz, value nnz. */
int ed_stiffness(ed_analysis *analysis, int *column_start, int *row, double *value);
void ed_mass(const ed_analysis *analysis, double *mass); /* n */
/* Directions in which the present state is unstable: negative pivots of the tangent; -1 where it is singular or pivots off the
 * diagonal leave the count without meaning. */
int ed_unstable_directions(ed_analysis *analysis);

/* Settings; each has a default. */
enum {
  ED_TOLERANCE = 0,          /* unbalanced force / largest force on a member's end so far; default 1e-7 */
  ED_MAX_ITERATIONS = 1,     /* a solution attempt; default 25 */
  ED_ELEMENT_TOLERANCE = 2,  /* energy of the section unbalance / largest section energy so far; default 1e-16 */
  ED_HALVINGS = 3,           /* how often a step may be halved; default 8 (1/256) */
  ED_FAST_ELASTIC = 4,       /* shortcut for sections that stay elastic; default 1 */
  ED_REUSE_FACTORS = 5,      /* keep the factors while they converge well; default 1 */
  ED_ENERGY = 6              /* energy balance; default 1 */
};
int ed_set(ed_analysis *analysis, int setting, double value);

enum { ED_STIFFNESS_INITIAL = 0, ED_STIFFNESS_COMMITTED = 1, ED_STIFFNESS_CURRENT = 2 };
int ed_rayleigh(ed_analysis *analysis, double mass_factor, double stiffness_factor, int stiffness);
/* n modes over the equations (n x n_equations, row by row, any scale), circular frequencies, ratios of critical. */
int ed_modal_damping(ed_analysis *analysis, int n, const double *shape, const double *omega, const double *ratio);

/* From now on the dampers act; their deformation counts from here. Before runs, e.g. after gravity. */
int ed_install_dampers(ed_analysis *analysis);

/* Recorded quantities: weighted sums of terms. Components in brackets. */
enum {
  ED_DISPLACEMENT = 0,       /* node (0..2), relative to the ground */
  ED_VELOCITY = 1,
  ED_ACCELERATION = 2,
  ED_TOTAL_ACCELERATION = 3,
  ED_REACTION = 4,           /* node (0..2): resisting force of the elements at the degree, without inertia and damping */
  ED_GROUND_ACCELERATION = 5,/* 0 (0 x, 1 y) */
  ED_LOAD_FACTOR = 6,        /* pattern */
  ED_END_FORCE = 7,          /* element (0..5: N V M at i, N V M at j), on the element, axes of the undeformed member */
  ED_GLOBAL_FORCE = 8,       /* element (0..5), the same in global axes; both with second-order terms */
  ED_AXIAL_FORCE = 9,        /* element */
  ED_DEFORMATION = 10,       /* element (0 elongation, 1 2 end rotations from the chord) */
  ED_PLASTIC_ROTATION = 11,  /* element (0 i, 1 j): chord rotation less its elastic part */
  ED_SECTION_FORCE = 12,     /* element (2 point + 0 N, + 1 M) */
  ED_SECTION_DEFORMATION = 13,
  ED_FIBRE_STRESS = 14,      /* element (point * layers of the first section + layer) */
  ED_FIBRE_STRAIN = 15,
  ED_DAMPER_FORCE = 16,      /* damper */
  ED_DAMPER_DEFORMATION = 17,/* damper (0 with its brace, 1 without) */
  ED_DAMPER_WORK = 18,       /* damper: work done on it so far */
  ED_GIVEN_FORCE = 19,       /* force of a history: these three as of the damper that exerts it; 0 while there is none */
  ED_GIVEN_DEFORMATION = 20, /* since the force was made */
  ED_GIVEN_WORK = 21
};
int ed_channel(ed_analysis *analysis, int n_terms, const double *coefficient, const int *kind, const int *object,
               const int *component, int keep_history);
/* A run ends with ED_LIMIT at the end of the step in which the magnitude of a channel exceeds its limit (> 0). */
int ed_channel_limit(ed_analysis *analysis, int channel, double limit);
void ed_clear_channels(ed_analysis *analysis); /* and their limits */
/* Extremes since the run began: n_channels each. */
void ed_extremes(const ed_analysis *analysis, double *maximum, double *time_of_maximum, double *minimum,
                 double *time_of_minimum, double *last);

enum { ED_INPUT = 0, ED_KINETIC = 1, ED_DAMPING = 2, ED_STORED = 3, ED_HYSTERETIC = 4, ED_GEOMETRIC = 5, ED_DAMPERS = 6,
       ED_BALANCE = 7, ED_N_ENERGY = 8 };

/* A run is begun once, advanced in pieces (so that the caller can show progress or stop between them) and ends by itself.
 * Buffers belong to the caller, hold every `every`-th step and the start: abscissa n_rows, values n_rows x n_history,
 * energy n_rows x ED_N_ENERGY; any may be NULL. */
int ed_static_begin(ed_analysis *analysis, int pattern, double factor, int steps);
int ed_pushover_begin(ed_analysis *analysis, int pattern, int node, int degree, double target, int steps);
enum { ED_NEWMARK = 0, ED_GENERALISED_ALPHA = 1 };
/* ground_*: n+1 samples dt apart, relative motion starts at sample 0; y may be NULL. parameters: NEWMARK gamma, beta;
 * GENERALISED_ALPHA alpha_m, alpha_f, gamma, beta (HHT: alpha_m = 0). */
int ed_history_begin(ed_analysis *analysis, int n, double dt, const double *ground_x, const double *ground_y, int method,
                     const double *parameters);
/* Forces that the caller gives from step to step of a history, such as that of a damper in a laboratory. A force acts along coefficient *
 * degree (0 ux, 1 uy, 2 rz) of up to 12 degrees of nodes; several may act at once. Between ed_history_begin and ed_run_end. Returns its
 * number; at first it is 0. */
#define ED_HISTORY_FORCES 8
int ed_history_force(ed_analysis *analysis, int n_terms, const int *node, const int *degree, const double *coefficient);
/* Over the next step the force is linear from `start` to `end`, and after it stays at `end` until another call. Halved steps see what it
 * is between both. A start that is not the last end is a jump, with which accelerations jump. Its work counts as input. On supports it
 * goes into the reactions. */
int ed_history_set_force(ed_analysis *analysis, int force, double start, double end);
void ed_run_buffers(ed_analysis *analysis, int every, double *abscissa, double *values, double *energy);
/* Returns ED_OK while all went well, ED_LIMIT when a channel has exceeded its limit (the step stands, it is the last), an error when
 * the run cannot go on (the last good state stands). After ED_E_STOPPED it can: the step that was left is done anew. With ED_E_NOT_FINITE
 * a channel or an energy may be what is not finite, of the step that was done last. */
int ed_run_advance(ed_analysis *analysis, int max_steps);
int ed_run_steps_done(const ed_analysis *analysis);
int ed_run_rows(const ed_analysis *analysis);
/* The channel whose limit has ended the run (of several the one furthest beyond its own), -1: none; its value, and the time. */
int ed_run_limit(const ed_analysis *analysis, double *value, double *time);
void ed_run_end(ed_analysis *analysis);
/* Free vibration: initial velocities of the equations (n), before ed_history_begin. */
int ed_initial_velocity(ed_analysis *analysis, const double *velocity);

typedef struct {
  long steps;            /* finished, as asked for */
  long substeps;         /* finished, after halving */
  long iterations;       /* linear solutions for equilibrium */
  long factorisations;   /* numerical, with pivoting */
  long refactorisations; /* numerical, with known pivots */
  long state_updates;    /* element state determinations */
  long element_iterations;
  long elastic_updates;  /* element states found by the elastic shortcut */
  long fallbacks;        /* rungs of the ladder that were tried */
  double worst_unbalance;/* of an accepted step, relative */
  double energy_error;   /* |balance| / largest input so far */
} ed_statistics;
void ed_get_statistics(const ed_analysis *analysis, ed_statistics *statistics);

/* The failure ladder: every rung that was tried. */
enum {
  ED_RUNG_FULL_NEWTON = 1,    /* new factors in each iteration */
  ED_RUNG_FROZEN_DAMPING = 2, /* the same, with the damping stiffness of the step's start instead of the current one */
  ED_RUNG_LINE_SEARCH = 3,    /* the same, and steps are shortened */
  ED_RUNG_HALVE = 4
};
typedef struct {
  double time;   /* of the step that was attempted; load factor in static runs */
  int step;      /* number of the whole step, from 1 */
  int rung;
  int level;     /* halvings */
  int success;
  int iterations;
} ed_event;
int ed_n_events(const ed_analysis *analysis); /* kept: the first 10 000 */
void ed_get_event(const ed_analysis *analysis, int index, ed_event *event);

/* State of the present commit, for tests and restarts. What is set must come from an analysis of the same model; ED_E_NOT_FINITE,
 * ED_E_ARGUMENT: it cannot, and nothing has changed. */
int ed_state_size(const ed_analysis *analysis); /* doubles */
void ed_state_get(const ed_analysis *analysis, double *state);
int ed_state_set(ed_analysis *analysis, const double *state);
/* One attempt at a fraction of the next step of the run, and a return to where it began, as after a failure. */
int ed_try_and_revert(ed_analysis *analysis, double fraction);

/* ---- dampers ---------------------------------------------------------------------------------------------------- */

/* Laws of dampers; parameters in this order (docs/laws explains them). Any consistent units. */
enum {
  ED_LAW_KELVIN_VOIGT = 0,       /* k c */
  ED_LAW_ZENER = 1,              /* k0 k1 c1 */
  ED_LAW_GENERALISED_MAXWELL = 2,/* k0, then k_i c_i of each branch (1..16) */
  ED_LAW_FRACTIONAL_KELVIN = 3,  /* k0 c alpha: F = k0 (u + c D^alpha u) */
  ED_LAW_FRACTIONAL_ZENER = 4,   /* k0 a b alpha: F + a D^alpha F = k0 (u + b D^alpha u) */
  ED_LAW_VISCOUS = 5,            /* c */
  ED_LAW_VISCOUS_POWER = 6,      /* c alpha: F = c |v|^alpha sgn v */
  ED_LAW_MAXWELL = 7,            /* c0 lambda: F + lambda F' = c0 v */
  ED_LAW_MAXWELL_POWER = 8,      /* c alpha k: c |v|^alpha sgn v in series with the spring k */
  ED_LAW_FRACTIONAL_MAXWELL = 9, /* c0 lambda nu: F + lambda D^nu F = c0 v */
  ED_LAW_FRICTION = 10,          /* mu N k: slip at mu N, stiffness k of the connection before */
  ED_LAW_ELASTIC_PLASTIC = 11,   /* k Fy b: kinematic hardening ratio 0 <= b < 1 */
  ED_LAW_RAMBERG_OSGOOD = 12,    /* k Fy a n: u = F/k (1 + a |F/Fy|^(n-1)), Masing */
  ED_LAW_BOUC_WEN = 13,          /* Fy Y alpha A beta gamma n */
  ED_LAW_MODIFIED_BOUC_WEN = 14, /* k1 k2 u_ref Y alpha A beta gamma n C alpha_d */
  ED_LAW_ASYMPTOTE = 15,         /* f0 k1 k2 k3 kappa n c: rate-dependent asymptote law of Sause and Lee */
  ED_LAW_LINEARISED = 16,        /* k_eff zeta_eff omega: F = k_eff u + 2 zeta_eff k_eff / omega v */
  ED_LAW_MGMM = 17               /* k1 c1 k0 c_NL alpha k_a k_b u_ref c_a c_b v_ref consistent(0, 1) */
};

typedef struct ed_damper ed_damper;

/* A damper: a law with its parameters, and the stiffness of a brace in series with it (0: rigid). On failure *status and `message`
 * (size bytes) say why and NULL is returned. */
ed_damper *ed_damper_new(int law, int n_parameters, const double *parameters, double brace, int *status, char *message,
                         int size);
void ed_damper_free(ed_damper *damper);

/* Amendments: effects that a law has not. F = phi F_law + parallel forces, phi the product of the factors. Their drivers are those of
 * the ends of steps, all zero at rest: envelope a1 = max(|u1|, a exp(-h/tau_a)), largest deformation M, path s += |u1 - u0|, work E of
 * F by the trapezoidal rule, heat q1 = q exp(-h/tau_h) + beta dE. E and q act from the next step on; g = (a/a0)^m / (1 + (a/a0)^m). */
enum {
  ED_AMEND_CONSTANT = 0,                  /* factor: phi = factor */
  ED_AMEND_PAYNE_WHOLE = 1,               /* d a0 m tau_a: phi = 1 - d g(a) */
  ED_AMEND_PAYNE_ELASTIC = 2,             /* k a0 m tau_a: -k g(a) u */
  ED_AMEND_MULLINS_PATH = 3,              /* m s0: phi = 1 + m exp(-s/s0) */
  ED_AMEND_MULLINS_MAXIMUM = 4,           /* m r: phi = 1 - m erf((M - |u|)/r) */
  ED_AMEND_MULLINS_ELASTIC = 5,           /* k s0: k exp(-s/s0) u */
  ED_AMEND_DEGRADATION_ENERGY = 6,        /* d E0: phi = 1 - d (1 - exp(-max(E, 0)/E0)) */
  ED_AMEND_SELF_HEATING_RATE = 7,         /* beta tau_h: phi = exp(-q) */
  ED_AMEND_HARDENING_POWER = 8,           /* k p r: k u (|u|/r)^(p-1) */
  ED_AMEND_HARDENING_THRESHOLD = 9,       /* k u0: k max(|u| - u0, 0) sgn u */
  ED_AMEND_ONE_SIDED_FACTOR = 10,         /* b side(1, -1): phi = 1 + b where side u > 0; with a brace rising over 1e-5 m */
  ED_AMEND_ONE_SIDED_SPRING = 11,         /* k u0 side(1, -1): k max(side u - u0, 0) side */
  ED_AMEND_RELAXATION_BRANCH_MAXWELL = 12,/* k tau: Q' + Q/tau = k v, v linear over the step */
  ED_AMEND_VELOCITY_EXPONENT_DASHPOT = 13,/* c alpha: c |v|^alpha sgn v */
  ED_AMEND_PAYNE_NETWORK = 14,            /* d s0 tau: phi = 1 - d x, x' = (1 - x) |v|/s0 - x/tau, |v| constant over the step */
  ED_AMEND_MULLINS_DAMAGE = 15,           /* m r p: phi = 1 - m (1 - exp(-(M/r)^p)) */
  ED_AMEND_VELOCITY_EXPONENT_FLOW = 16,   /* f v0: f asinh(v/v0) */
  ED_AMEND_DEGRADATION_PATH = 17,         /* d p S: phi = 1 - d (s/S)^p */
  ED_AMEND_ONE_SIDED_CONTACT = 18,        /* k u0 n side(1, -1) r: k x (x/r)^(n-1) side, x = max(side u - u0, 0) */
  ED_AMEND_ONE_SIDED_EVEN = 19            /* k n r: k |u| (|u|/r)^(n-1) */
};
/* Adds one to a damper, before its first state is made; several act together. inside: not beside the law but inside one that relaxes all
 * of its forces, F_law + tau F_law' = everything: it adds Q to the force, Q + tau Q' = force, or (phi - 1)(F_law + tau F_law') for a
 * factor; force, phi and F_law linear over the step. Refused unless the law is ED_LAW_MGMM (tau = c1/k1). A brace stands in series with
 * the amended damper; laws without exact step refuse amendments with a brace. `message` (size bytes) says why it is refused, and then
 * nothing has changed. */
int ed_damper_amend(ed_damper *damper, int kind, int inside, int n_parameters, const double *parameters, char *message, int size);
/* What a damper went through before it starts, for laws that extremes soften (ED_LAW_MGMM; others do not mind): largest deformation
 * and velocity (>= 0), smallest ones (<= 0), in the order largest u, smallest u, largest v, smallest v. ED_E_ARGUMENT: they are not so. */
int ed_damper_been(ed_damper *damper, const double extremes[4]);
/* Whom calls with this damper ask whether to stop; NULL, or before this call: nobody. */
void ed_damper_ask(ed_damper *damper, const ed_stop *stop);
int ed_damper_state_size(const ed_damper *damper);            /* doubles */
void ed_damper_start(const ed_damper *damper, double *state); /* at rest */

/* ED_DAMPER_BEST: the exact step where the law has one, else SUNDIALS; ED_DAMPER_ODE: SUNDIALS. */
enum { ED_DAMPER_BEST = 0, ED_DAMPER_ODE = 1 };
/* One step of duration h from `committed`, along the cubic through deformation and velocity at both ends. Writes the state at its
 * end, the force there, and its derivatives to u1 and v1 (slope). tolerance: relative, of SUNDIALS. Repeated calls give the same. */
int ed_damper_step(const ed_damper *damper, int method, double tolerance, const double *committed, double h, double u0, double v0,
                   double u1, double v1, double *trial, double *force, double *slope);
/* Force under n samples of deformation u and velocity v at ascending times, from rest; held at u[0] for long before. force: n.
 * *done: samples that were reached when it fails. */
int ed_damper_history(const ed_damper *damper, int method, double tolerance, int n, const double *time, const double *u,
                      const double *v, double *force, int *done);
/* Of the terms that relax in the MGMM (ED_E_STATE: not of an MGMM alone), with g = k_mod u (spring), c_mod v (dashpot) and |v|^alpha sgn v (power)
 * along the same cubics, the moments 1/h integral of g(s) T_k(2 s/h - 1) ds over each step, T_k Chebyshev's polynomials: with
 * exp(-(h - s)/t) in a series of T_k they give what any relaxation time t leaves of g. Places and weights of the quadrature suit those of
 * the damper's tau or longer. Each (n - 1) x ED_MOMENTS, row by row, or NULL: not wanted.
 * *held: k_mod u at the first deformation. */
enum { ED_MOMENTS = 6 };
int ed_mgmm_moments(const ed_damper *damper, int n, const double *time, const double *u, const double *v, double *spring,
                    double *dashpot, double *power, double *held, int *done);
/* What stands in series with a damper. It carries within (e - z) + stiffness * side * z (1 + bend z^2) at a stretch e, z: e beyond play/2,
 * either way; side: 1, or `back` where e < 0. With another power than 1 (at least that) it is stiffness * side * z |sqrt(bend) z|^(power
 * - 1) beyond the play, bend > 0, play = 0. Beside all of it damping e'. stiffness, back > 0; bend, within, play, damping >= 0, play from
 * end to end. */
typedef struct {
  double stiffness, back, bend, power, within, play, damping;
} ed_rig;
/* The same as ed_damper_history in series with a rig: u = u_d + e, and factor F(u_d) + added + spring u_d is what the rig carries.
 * factor (>= 0), added, spring (>= 0): n, or NULL for 1, 0 and 0. force: n, through rig and damper; own: n, deformation u_d of the
 * damper. e is a parabola between samples, and linear over parts of a step in which it comes to an end of the play. */
int ed_damper_history_in_series(const ed_damper *damper, int n, const double *time, const double *u, const double *v,
                                const double *factor, const double *added, const double *spring, const ed_rig *rig, double *force,
                                double *own, int *done);

/* q_0 = before, q_i = decay_(i-1) q_(i-1) + made_(i-1). q: n >= 1; decay, made: n - 1. What is not finite is passed on to all that
 * follows, and ED_E_NOT_FINITE says that there is some. */
int ed_fading(int n, const double *decay, const double *made, double before, double *q);
/* The same of complex numbers, real and imaginary part side by side. */
int ed_swinging(int n, const double *decay, const double *made, const double *before, double *q);

/* ---- real-time substructure tests ------------------------------------------------------------------------------- */

/* A virtual test: numerical part, compensator, rig, specimen and sensors in a loop. A main step begins with what is measured then; the
 * numerical part gives the target at its end, the compensator the command, which rises in a ramp over the step; the rig follows in
 * sub-steps and moves the specimen. Everything begins at rest. One thread at a time may use an object. */
typedef struct ed_substructure ed_substructure;

enum { ED_RIG_LINEAR = 0, ED_RIG_SERVO_HYDRAULIC = 1 };
#define ED_RIG_STATES 12
/* Whoever moves the specimen. w: command, `delay` seconds late. */
typedef struct {
  int kind;
  double delay;          /* s, >= 0 */
  /* LINEAR: r_1 = A r_0 + b0 w_0 + b1 w_1 over a sub-step (w linear), position = c r + d w, velocity = c_v r + d_v w. Without states
   * the position is d w, and the velocity its slope. */
  int n;
  double A[ED_RIG_STATES * ED_RIG_STATES], b0[ED_RIG_STATES], b1[ED_RIG_STATES], c[ED_RIG_STATES], c_v[ED_RIG_STATES], d, d_v; /* A row by row */
  /* SERVO_HYDRAULIC: valve_lag q' + q = gain (w - x), q: velocity of the piston without load, |q| <= velocity sqrt(1 -+ F / force);
   * x = integral of q less F / oil. */
  double gain, valve_lag, oil;
  double flexibility;    /* stiffness between actuator and specimen, N/m; 0: rigid */
  int corrected;         /* the difference of both displacements is added to the command */
  double stroke, velocity, force; /* limits, infinite: none; a motion beyond the first two is held there */
} ed_rig_model;

/* Readings: normal noise, then rounding to whole quanta (0: none) within a range (infinite: none). */
typedef struct {
  double displacement_noise, displacement_quantum, displacement_range;
  double force_noise, force_quantum, force_range;
  double force_delay;    /* s */
} ed_sensors;

/* A frame as the numerical part, in the state in which tests begin: loaded, its dampers installed. It is integrated as by
 * ed_history_begin, with so many steps in a main step. The specimen's force at the end of a main step is not known then; it is
 * extrapolated from the last two, or held. So however the frame is integrated, the loop is stable only for steps that are short against
 * the period of the interface's mass on the specimen. The analysis must outlive the test, and only one of both runs at a time. */
typedef struct {
  ed_analysis *analysis;
  int divisions;         /* 1 to 1000 */
  int method;
  double parameters[4];
  int n_terms;           /* the specimen's deformation is the sum of coefficient * degree of node, and counts from that state */
  const int *node, *degree;
  const double *coefficient;
  int held;              /* 1: the force is held over a main step, 0: extrapolated */
} ed_frame_part;         /* records its channels: buffers that ed_run_buffers was given before a test are those of the test */

typedef struct {
  double step;           /* main step, s */
  int sub_steps;         /* of the rig in a main step */
  /* Numerical part: z' = A z + B w, y' = C z + D w with w = (F_k, F_(k-1), a_g,k, a_g,k+1); y': target displacement, velocity and
   * acceleration at the end of the step, then n_outputs more to be recorded. n_states = 0: the target is given. Row by row. */
  int n_states, n_outputs;
  const double *A, *B, *C, *D;
  const ed_frame_part *frame; /* or a frame in their place, without outputs; else NULL */
  const ed_compensator_parameters *compensator;
  int unseen_delay;      /* main steps that pass between the target and the compensator */
  const ed_rig_model *rig;
  const ed_sensors *sensors;
  /* F = force_scale * law(deformation_scale * u), both > 0. It has no brace, and must outlive the test. */
  ed_damper *specimen;
  double force_scale, deformation_scale;
  double abort_displacement; /* of the target or the specimen, m; infinite: none */
} ed_substructure_input;

/* Channels of the record. LIMITED: bits of the compensator. SATURATED: 1 stroke, 2 velocity, 4 force, 8 range of a sensor. */
enum {
  ED_RTS_TARGET = 0, ED_RTS_TARGET_VELOCITY = 1, ED_RTS_TARGET_ACCELERATION = 2,
  ED_RTS_COMMAND = 3,        /* of the compensator */
  ED_RTS_MEASURED = 4,       /* displacement of the specimen, as read */
  ED_RTS_ACTUATOR = 5,       /* displacement of the piston */
  ED_RTS_DEFORMATION = 6,    /* of the specimen, true */
  ED_RTS_FORCE = 7,          /* as read */
  ED_RTS_TRUE_FORCE = 8,
  ED_RTS_ALPHA = 9,          /* three, of ATS; of a live delay the first is the delay, s */
  ED_RTS_INDEPENDENCE = 12, ED_RTS_LIMITED = 13, ED_RTS_SATURATED = 14,
  ED_RTS_CHANNELS = 15       /* then n_outputs */
};

/* NULL: *status and `message` (size bytes) say why. */
ed_substructure *ed_substructure_new(const ed_substructure_input *input, int *status, char *message, int size);
void ed_substructure_free(ed_substructure *test);
void ed_substructure_ask(ed_substructure *test, const ed_stop *stop);
/* n main steps from rest. drive: n + 1 ground accelerations, or (n + 1) x 3 targets. record: (n + 1) x (ED_RTS_CHANNELS + n_outputs),
 * row by row. seed: of the noise. *done: rows that hold. ED_LIMIT: the abort displacement or the limit of a channel of the frame was
 * exceeded, in the last of them. */
int ed_substructure_run(ed_substructure *test, int n, const double *drive, unsigned long long seed, double *record, int *done);
const char *ed_substructure_message(const ed_substructure *test); /* of the last run that failed: what did, for people */
/* A compensator on its own: commands of n steps. target: n x 3. */
int ed_compensator_run(const ed_compensator_parameters *parameters, int n, const double *target, const double *measured, double *command);

/* ---- linear elastic space frames -------------------------------------------------------------------------------- */

/* Degrees of a node: 0 ux, 1 uy, 2 uz, 3 rx, 4 ry, 5 rz, right-handed, z upwards. Local x of a member runs from its start to its end,
 * local z along `web`, local y completes a right-handed system. Forces on the ends of a member: N V_y V_z T M_y M_z at its start, then
 * at its end, as components along local x, y, z of what acts on the member. One thread at a time may use an object. */
typedef struct ed_space ed_space;

/* Section and material of a member: E, G, A, A_y, A_z, I_t, I_y, I_z. A_y, A_z: shear areas for V_y and V_z, 0: no shear deformation. */
#define ED_SPACE_PROPERTIES 8

/* What a frame is made of; read only by ed_space_new. ux, uy and rz of the nodes of a floor follow the floor's master, at its place in
 * plan, as a rigid body. A node of a floor may be held in rz, and then, or where it lies on the axis of the master, in ux and uy. */
typedef struct {
  int n_nodes, n_floors, n_members;
  const char *const *node_name, *const *member_name; /* for messages */
  const double *coordinates; /* n_nodes x 3 */
  const int *node_floor;     /* n_nodes: 0 .. n_floors - 1, -1: none */
  const double *masters;     /* n_floors x 2: x, y */
  const int *fixed;          /* n_nodes x 6: held */
  const double *springs;     /* n_nodes x 6: to the ground, >= 0 */
  const int *start, *end;    /* n_members: nodes */
  const double *web;         /* n_members x 3, of length 1 and at right angles to the member */
  const double *properties;  /* n_members x ED_SPACE_PROPERTIES */
  const double *ends;        /* n_members x 4: rotational springs y at start, z at start, y at end, z at end; 0: pin, infinite: rigid */
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
/* Equation of each degree of the nodes (6 n_nodes), then of Ux, Uy, Rz of each master (3 n_floors); -1: held, or follows a master. */
void ed_space_equations(const ed_space *space, int *equation);

/* New properties (n x ED_SPACE_PROPERTIES) of n members, and new factors without a new symbolic analysis. After an error nothing has
 * changed, but after ED_E_MEMORY. */
int ed_space_change(ed_space *space, int n, const int *member, const double *properties);

/* Loads on members: force a length of the member, and forces at a fraction of its length, in global components. */
typedef struct {
  const double *uniform; /* n_cases x n_members x 3, or NULL */
  int n_points;
  const int *point_case, *point_member; /* n_points */
  const double *point_position;         /* n_points: 0 .. 1 */
  const double *point_force;            /* n_points x 3 */
} ed_space_loads;

/* Static cases. nodal: n_cases x n_nodes x 6, or NULL. Results, each may be NULL but end_forces: displacements and reactions n_cases x
 * n_nodes x 6, end_forces n_cases x n_members x 12. Reactions are those of supports and springs; of a floor that is held, at the node that
 * holds it. */
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

/* The least factor > 0 of the axial forces (n_members, tension > 0) at which the frame buckles by bending, *factor infinite if none does. */
int ed_space_critical(ed_space *space, const double *axial, double *factor);

/* Combination of modal values: result_q = sqrt(r_q^T rho r_q). values: n_modes x n, one mode after the other; rho: n_modes x n_modes,
 * symmetric. result: n. */
int ed_combine(int n, int n_modes, const double *values, const double *rho, double *result);
/* The same of N V_y V_z T M_y M_z at stations of members without loads between their ends. end_forces: n_modes x n_members x 12;
 * result: n_members x n_stations x 6. M is linear in between, so that three forms of its ends serve all stations. */
int ed_combine_stations(int n_members, int n_modes, const double *end_forces, const double *rho, int n_stations, const double *stations,
                        double *result);

/* ---- oscillators under ground acceleration ---------------------------------------------------------------------- */

/* Largest magnitudes of relative displacement, relative velocity and absolute acceleration of oscillators that start at rest,
 * during the motion and in the free vibration after it. The acceleration (n >= 1 samples dt apart) is linear between samples and
 * falls to zero within one step after the last. Between samples the peak is that of a harmonic of the oscillator's frequency
 * through three of them. period (time), damping (ratio of critical), sd, sv, sa: n_oscillators each; sv and sa may both be NULL.
 * Periods are at least ED_MIN_PERIOD_STEPS dt; 0 <= damping < 1. The result of an oscillator is the same bit for bit whatever the
 * others are. stop: may be NULL. ED_E_ARGUMENT: one of these is out of range, and nothing is written; ED_E_NOT_FINITE: a sample or a
 * result is not finite, and what is written is of no use, as after ED_E_STOPPED. */
#define ED_MIN_PERIOD_STEPS 4
int ed_response_spectrum(int n, double dt, const double *acceleration, int n_oscillators, const double *period,
                         const double *damping, double *sd, double *sv, double *sa, const ed_stop *stop);
/* Largest displacements under two components at right angles, in the directions k pi / n_angles from the first towards the
 * second, k = 0 .. n_angles - 1 (1 <= n_angles <= ED_MAX_ANGLES). first, second: n samples each. sd: n_oscillators x n_angles,
 * the angles of an oscillator side by side. Otherwise as above; also ED_E_MEMORY. */
#define ED_MAX_ANGLES 360
int ed_rotated_spectrum(int n, double dt, const double *first, const double *second, int n_oscillators,
                        const double *period, const double *damping, int n_angles, double *sd, const ed_stop *stop);

/* Local maxima of |y|, largest first, of recursions y_i = b0 x_i + b1 x_(i-1) + b2 x_(i-2) - a1 y_(i-1) - a2 y_(i-2) from rest.
 * samples: x, n >= 3. numerator: b0 b1 b2, denominator: a1 a2 of each recursion. Those from `share` (0..1) of the largest sample on
 * are kept, at most `most` (>= 1) of each. count: n_recursions; place (in samples from the first, between them by a parabola) and
 * value (signed): n_recursions x most, of which the first `count` are set. Also ED_E_MEMORY, ED_E_NOT_FINITE, ED_E_STOPPED. */
int ed_recursion_peaks(int n, const double *samples, int n_recursions, const double *numerator, const double *denominator,
                       double share, int most, int *count, double *place, double *value, const ed_stop *stop);

/* ---- checks of steel members ------------------------------------------------------------------------------------ */

/* Forces at stations along members, in the order N (tension positive), V_y, V_z, T, M_y, M_z: statics n_cases x n_members x
 * n_stations x 6; spectral n_directions x ..., magnitudes of responses without sign. static_factors: n_combinations x n_cases,
 * spectral_factors: n_combinations x n_directions (magnitudes count). In each combination N takes both signs of the spectral part,
 * moments and shears the one that adds. T is not checked.
 * set: n_combinations, number of the set of checks of a combination; masks: n_members x n_sets, the checks of a member under it, 1 <<
 * ED_CHECK_...; gravity: n_cases, whether a case counts in V_Ed,G. constants: n_members x ED_N_CONSTANTS; kind: n_members, shape,
 * | ED_CLASS_3, | ED_NO_TWIST, | ED_ANNEX_A where 6_61 and 6_62 follow Annex A and not B. Member checks (N_B, M_B, 6_61, 6_62) count
 * with the largest compression and moments along the member; their station is that of the compression, of M_y elsewhere.
 * M_b: n_members x n_combinations, what M_y meets under a combination in the place of ED_M_B, and not less than it; combinations with
 * the same factors have the same. May be NULL.
 * Of each member and check: the largest utilisation (1 is the limit), the first combination and station that give it, or 0, -1, -1
 * where none applies: n_members x ED_N_CHECKS each. every: 1 evaluates all combinations, 0 leaves out those that cannot govern; the
 * results are the same. ED_E_ARGUMENT: a number or constant is out of range, ED_E_NOT_FINITE, ED_E_MEMORY; nothing is written then. */
#define ED_MAX_LOADS 256 /* cases and directions together */
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
  ED_PER_N_CR_Y = 20,        /* 1 / N_cr, 0 where the member is held */
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
                     const int *kind, const int *masks, const double *M_b, int every, double *utilisation, int *combination,
                     int *station);

#ifdef __cplusplus
}
#endif
#endif
