/* Analyses of frames (edmodel.h): static loads, pushovers, time histories, and what they record. */
#ifndef EDANALYSIS_H
#define EDANALYSIS_H

#include "edmodel.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ed_analysis ed_analysis;

/* Numbers the degrees, analyses the matrix symbolically and checks the structure. On failure *status and `message`
 * (size bytes) say why and NULL is returned. The model must outlive the analysis. */
ed_analysis *ed_analysis_new(const ed_model *model, int *status, char *message, int size);
void ed_analysis_free(ed_analysis *analysis);
const char *ed_analysis_message(const ed_analysis *analysis);
/* Whom runs of this analysis ask whether to stop; NULL, or before this call: nobody. */
void ed_analysis_ask(ed_analysis *analysis, const ed_stop *stop);

int ed_n_equations(const ed_analysis *analysis);
int ed_n_nonzeros(const ed_analysis *analysis);
void ed_equations(const ed_analysis *analysis, int *equation); /* over the degrees of all nodes; -1 where fixed */
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
  ED_DISPLACEMENT = 0,       /* node (degree), relative to the ground */
  ED_VELOCITY = 1,
  ED_ACCELERATION = 2,
  ED_TOTAL_ACCELERATION = 3,
  ED_REACTION = 4,           /* node (degree): resisting force of the elements at the degree, without inertia and damping */
  ED_GROUND_ACCELERATION = 5,/* 0 (0 x, 1 y, 2 z) */
  ED_LOAD_FACTOR = 6,        /* pattern */
  ED_END_FORCE = 7,          /* element (0..5: N V M at i, N V M at j; in space 0..11: N V_y V_z T M_y M_z at i, at j), on the element, axes of
                                the undeformed member */
  ED_GLOBAL_FORCE = 8,       /* element (0..5; in space 0..11), on its nodes, in global axes; both with second-order terms */
  ED_AXIAL_FORCE = 9,        /* element; of a spring its force */
  ED_DEFORMATION = 10,       /* element (0 elongation, 1 2 end rotations from the chord, about z, 3 4 about y); of a spring 0 */
  ED_PLASTIC_ROTATION = 11,  /* element (0 i, 1 j about z, 2 i, 3 j about y): chord rotation less its elastic part; of a spring 0, the same of its deformation */
  ED_SECTION_FORCE = 12,     /* element (2 point + 0 N, + 1 M; in space 3 point + 0 N, + 1 M_z, + 2 M_y) */
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
/* The resultant of two channels that were made before, sqrt(first^2 + second^2). */
int ed_channel_root(ed_analysis *analysis, int first, int second, int keep_history);
/* A run ends with ED_LIMIT at the end of the step in which the magnitude of a channel exceeds its limit (> 0). */
int ed_channel_limit(ed_analysis *analysis, int channel, double limit);
void ed_clear_channels(ed_analysis *analysis); /* and their limits */
/* Extremes since the run began: n_channels each. */
void ed_extremes(const ed_analysis *analysis, double *maximum, double *time_of_maximum, double *minimum,
                 double *time_of_minimum, double *last);
/* Of a resultant the direction at its maximum, rad from the first channel towards the second, -pi to pi; 0 of other channels. n_channels. */
void ed_angles(const ed_analysis *analysis, double *angle);

enum { ED_INPUT = 0, ED_KINETIC = 1, ED_DAMPING = 2, ED_STORED = 3, ED_HYSTERETIC = 4, ED_GEOMETRIC = 5, ED_DAMPERS = 6,
       ED_BALANCE = 7, ED_N_ENERGY = 8 };

/* A run is begun once, advanced in pieces (so that the caller can show progress or stop between them) and ends by itself.
 * Buffers belong to the caller, hold every `every`-th step and the start: abscissa n_rows, values n_rows x n_history,
 * energy n_rows x ED_N_ENERGY; any may be NULL. */
int ed_static_begin(ed_analysis *analysis, int pattern, double factor, int steps);
int ed_pushover_begin(ed_analysis *analysis, int pattern, int node, int degree, double target, int steps);
enum { ED_NEWMARK = 0, ED_GENERALISED_ALPHA = 1 };
/* ground_*: n+1 samples dt apart, relative motion starts at sample 0; any may be NULL, z does nothing in a plane. parameters: NEWMARK gamma, beta;
 * GENERALISED_ALPHA alpha_m, alpha_f, gamma, beta (HHT: alpha_m = 0). */
int ed_history_begin(ed_analysis *analysis, int n, double dt, const double *ground_x, const double *ground_y, const double *ground_z,
                     int method, const double *parameters);
/* Forces that the caller gives from step to step of a history, such as that of a damper in a laboratory. A force acts along coefficient *
 * degree of up to 12 degrees of nodes; several may act at once. Between ed_history_begin and ed_run_end. Returns its
 * number; at first it is 0. */
#define ED_HISTORY_FORCES 8
int ed_history_force(ed_analysis *analysis, int n_terms, const int *node, const int *degree, const double *coefficient);
/* Over the next step the force is linear from `start` to `end`, and after it stays at `end` until another call. Halved steps see what it
 * is between both. A start that is not the last end is a jump, with which accelerations jump. Its work counts as input. On supports it
 * goes into the reactions. */
int ed_history_set_force(ed_analysis *analysis, int force, double start, double end);
/* A supported degree of a node, and those tied to it, move from rest relative to the ground: n+1 samples as many as
 * those of the ground, the first displacement and velocity 0. Within a step the displacement is the cubic through both ends. Between
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
  long fallbacks;        /* that were tried */
  double worst_unbalance;/* of an accepted step, relative */
  double energy_error;   /* |balance| / largest input so far */
} ed_statistics;
void ed_get_statistics(const ed_analysis *analysis, ed_statistics *statistics);

/* Fallbacks where a step does not converge, in this order: each one that was tried. */
enum {
  ED_FALLBACK_FULL_NEWTON = 1,    /* new factors in each iteration */
  ED_FALLBACK_FROZEN_DAMPING = 2, /* the same, with the damping stiffness of the step's start instead of the current one */
  ED_FALLBACK_LINE_SEARCH = 3,    /* the same, and steps are shortened; in pushovers tangents of struts do not soften */
  ED_FALLBACK_HALVE = 4
};
typedef struct {
  double time;   /* of the step that was attempted, s; load factor in static runs */
  int step;      /* number of the whole step, from 1 */
  int fallback;  /* ED_FALLBACK_... */
  int level;     /* how often the step had been halved */
  int success;   /* 1: equilibrium was found, 0: not */
  int iterations;/* linear solutions that it took */
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
