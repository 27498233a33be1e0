/* Plane frames of force-based fibre beam-columns: models, and analyses of them. */
#ifndef EDFRAME_H
#define EDFRAME_H

#include "edstatus.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ed_model ed_model;
typedef struct ed_analysis ed_analysis;

/* ---- model ------------------------------------------------------------------------------------------------------------ */

ed_model *ed_model_new(void); /* NULL: out of memory */
void ed_model_free(ed_model *model);
const char *ed_model_message(const ed_model *model); /* the last error, for people */

/* Uniaxial laws. Parameters: ELASTIC E; BILINEAR E, fy, b (kinematic hardening ratio, 0 <= b < 1);
 * MENEGOTTO_PINTO E, fy, b, R0, cR1, cR2. */
enum { ED_ELASTIC = 0, ED_BILINEAR = 1, ED_MENEGOTTO_PINTO = 2 };
int ed_model_material(ed_model *model, int law, int n_parameters, const double *parameters);

/* Fibres of a material break: a cycle of the strain range r does the damage (r / strain)^exponent, cycles counted by rainflow; at a sum
 * of 1 the fibre breaks as soon as it is in tension. Before any section. */
int ed_model_fatigue(ed_model *model, int material, double strain, double exponent);

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
 * A load that begins, ends or stands inside leaves a kink in the moment, which quadrature meets only with a break there. */
int ed_model_beam_column(ed_model *model, const char *name, int i, int j, int points, const int *sections, int geometry,
                         int release_i, int release_j);
/* A beam-column of one section is integrated piece by piece, by its points in each piece, between n positions (0..1, rising) of its length:
 * a kink of the moment at such a place is met exactly. A place between two pieces is one point, with the weight of both. */
int ed_model_breaks(ed_model *model, int element, int n, const double *position);
/* The first and the last part of a beam-column do not bend; lengths. End forces and deformations are then those where it begins to. */
int ed_model_rigid_ends(ed_model *model, int element, double start, double end);
int ed_model_elastic_beam(ed_model *model, const char *name, int i, int j, int section, int geometry, int release_i,
                          int release_j);
int ed_model_truss(ed_model *model, const char *name, int i, int j, int material, double area, int geometry);
/* A brace that buckles between its ends, which stay on its chord. Inside are `elements` (even, 2..16) corotational fibre beams of the
 * section with `points` integration points each (3..10), in a camber of the first mode: its height / buckling length, > 0. The part
 * that buckles is buckling_length (0..1] of the length; the rest is a straight bar of the material and area. end_stiffness: rotational,
 * of each end; 0 pinned, infinite fixed. */
int ed_model_strut(ed_model *model, const char *name, int i, int j, int section, int points, int elements, double camber,
                   double buckling_length, double end_stiffness, int material, double area, int geometry);
/* Elastic link with stiffnesses along local x, y and in rotation. Two nodes apart: local x runs along the link and shear
 * acts at mid-length; at one place: local x is at `angle` (rad) from global x. */
int ed_model_link(ed_model *model, const char *name, int i, int j, double kx, double ky, double krz, double angle);

/* A spring without length: its deformation is the sum of coefficient * displacement of the degrees of i, then of j (6), which may be at
 * one place. Laws and their parameters, of force and deformation (or moment and rotation):
 * MULTILINEAR  deformation and force of each corner (0..4), then the last slope: kinematic, Masing's rule; without corners it is linear.
 * CONTACT      stiffness and capacity: forces are negative, up to the capacity, at which it gives way (HUGE_VAL: never).
 * DETERIORATING stiffness; of the positive and the negative side each the deformation from yield to capping, from there to no force, the
 *              ultimate one, the force at yield, force at capping / at yield, residual force / force at yield, D; energies that may be
 *              dissipated until nothing is left of strength, of the line after capping and of the unloading stiffness (HUGE_VAL: no
 *              deterioration); their exponents c. The modified Ibarra-Medina-Krawinkler law with bilinear hysteresis. */
enum { ED_SPRING_MULTILINEAR = 0, ED_SPRING_CONTACT = 1, ED_SPRING_DETERIORATING = 2 };
int ed_model_spring(ed_model *model, const char *name, int i, int j, const double *coefficient, int law, int n_parameters,
                    const double *parameters);
/* An elastic beam's ends leave out these flexibilities (rad a moment), because springs beside them have them: with the springs it
 * is the plain member. Each must be below that of the simply supported member, L / 3EI. */
int ed_model_without_flexibility(ed_model *model, int element, double at_i, double at_j);
/* Damping that is proportional to stiffness takes this factor (default 1) times the stiffness of the element: 0 for springs that are
 * stiffer than what they stand for, and more than 1 for the members beside them (Zareian & Medina 2010). */
int ed_model_damping_factor(ed_model *model, int element, double factor);

/* A damper (laws: eddamper.h) whose deformation is the sum of coefficient * displacement of n_terms degrees (0 ux, 1 uy, 2 rz) of nodes,
 * F = force_scale * law(deformation_scale * u); brace: stiffness in series at the size of the device, 0: rigid; play: of its pins, from
 * end to end, 0: none. It carries nothing before ed_install_dampers. Give its degrees mass: velocities of others are left to ring by the trapezoidal rule. Up to 12 terms. */
int ed_model_damper(ed_model *model, const char *name, int law, int n_parameters, const double *parameters, double brace,
                    double play, double force_scale, double deformation_scale, int n_terms, const int *node, const int *degree,
                    const double *coefficient);
/* The damper acts from the beginning, under gravity too: a bearing that holds what stands on it. In static steps it answers slowly, and
 * with its slope there it counts in the check whether the structure stands. */
int ed_model_damper_carries(ed_model *model, int damper);
/* In histories the damper has N / weight times its force, N the compression of a spring at that moment, and none where it is pulled: a
 * slider that rubs by what presses on it. The tangent leaves out how N changes. */
int ed_model_damper_weighs(ed_model *model, int damper, int element, double weight);
/* Adds an amendment (eddamper.h) to a damper of the model, in the units of its law. */
int ed_model_amend_damper(ed_model *model, int damper, int kind, int inside, int n_parameters, const double *parameters);

int ed_model_pattern(ed_model *model);
int ed_model_nodal_load(ed_model *model, int pattern, int node, double fx, double fy, double mz);
/* Loads on beam-columns, force a length in local axes, or a force at position (0..1) of the length. */
int ed_model_uniform_load(ed_model *model, int pattern, int element, double axial, double transverse);
int ed_model_point_load(ed_model *model, int pattern, int element, double position, double axial, double transverse);
/* Across a beam-column from `start` to `end` (0..1) of its length, linear from at_start to at_end, force a length. */
int ed_model_partial_load(ed_model *model, int pattern, int element, double start, double end, double at_start, double at_end);

/* ---- analysis --------------------------------------------------------------------------------------------------------- */

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

/* From now on all dampers act; the deformation of those that did not counts from here. Before runs, e.g. after gravity. */
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
  ED_GLOBAL_FORCE = 8,       /* element (0..5), on its nodes, in global axes; both with second-order terms */
  ED_AXIAL_FORCE = 9,        /* element; of a spring its force */
  ED_DEFORMATION = 10,       /* element (0 elongation, 1 2 end rotations from the chord); of a spring 0 */
  ED_PLASTIC_ROTATION = 11,  /* element (0 i, 1 j): chord rotation less its elastic part; of a spring 0, the same of its deformation */
  ED_SECTION_FORCE = 12,     /* element (2 point + 0 N, + 1 M) */
  ED_SECTION_DEFORMATION = 13,
  ED_FIBRE_STRESS = 14,      /* element (point * layers of the first section + layer) */
  ED_FIBRE_STRAIN = 15,
  ED_DAMPER_FORCE = 16,      /* damper */
  ED_DAMPER_DEFORMATION = 17,/* damper (0 with its brace, 1 without; 2 sum of the sizes of its plastic deformations, of laws that keep it) */
  ED_DAMPER_WORK = 18,       /* damper: work done on it so far */
  ED_GIVEN_FORCE = 19,       /* force of a history: these three as of the damper that exerts it; 0 while there is none */
  ED_GIVEN_DEFORMATION = 20, /* since the force was made */
  ED_GIVEN_WORK = 21,
  ED_DEFLECTION = 22,        /* strut: of its middle from the chord, camber included */
  ED_DAMAGE = 23,            /* strut: of its fibre with most, 1 has broken */
  ED_BROKEN_SHARE = 24,      /* strut: of the area of its section of which most has broken */
  ED_STRENGTH_LEFT = 25      /* spring: what deterioration has left of its strength, 0..1 */
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
/* A held degree (0 ux, 1 uy, 2 rz) of a node, and those tied to it, move from rest relative to the ground: n+1 samples as many as those of
 * the ground, the first displacement and velocity 0. Within a step the displacement is the cubic through both ends. Between
 * ed_history_begin and the first step. Damping acts on what moves beyond the structure that follows supports slowly; what moves them
 * is input. The degree stays where it is in the end. */
int ed_history_support(ed_analysis *analysis, int node, int degree, const double *displacement, const double *velocity,
                       const double *acceleration);
void ed_run_buffers(ed_analysis *analysis, int every, double *abscissa, double *values, double *energy);
/* Returns ED_OK while all went well, ED_LIMIT when a channel has exceeded its limit (the step stands, it is the last), an error when
 * the run cannot go on (the last good state stands). After ED_E_STOPPED it can: the step that was left is done anew. With ED_E_NOT_FINITE
 * a channel or an energy may be what is not finite, of the step that was done last. */
int ed_run_advance(ed_analysis *analysis, int max_steps);
int ed_run_steps_done(const ed_analysis *analysis);
int ed_run_rows(const ed_analysis *analysis);
/* How many rows the buffers hold; the next one is written to their start again. So a long run needs no long buffers. */
int ed_run_take_rows(ed_analysis *analysis);
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
  long damper_updates;   /* damper state determinations */
  long fallbacks;        /* rungs of the ladder that were tried */
  double worst_unbalance;/* of an accepted step, relative */
  double energy_error;   /* |balance| / largest input so far */
} ed_statistics;
void ed_get_statistics(const ed_analysis *analysis, ed_statistics *statistics);

/* The failure ladder: every rung that was tried. */
enum {
  ED_RUNG_FULL_NEWTON = 1,    /* new factors in each iteration */
  ED_RUNG_FROZEN_DAMPING = 2, /* the same, with the damping stiffness of the step's start instead of the current one */
  ED_RUNG_LINE_SEARCH = 3,    /* the same, and steps are shortened; in pushovers tangents of struts do not soften */
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

#ifdef __cplusplus
}
#endif

#endif
