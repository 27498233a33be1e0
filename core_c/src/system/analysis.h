/* An analysis at run time: numbering, state, matrices, settings, records. Private to the core. */
#ifndef ED_ANALYSIS_H
#define ED_ANALYSIS_H

#include "base/watch.h"
#include "damper/ode_system.h"
#include "edcore.h"
#include "element/element.h"
#include "system/model.h"
#include "system/solver.h"

enum { ED_MAX_EVENTS = 10000, ED_MAX_RESIDUALS = 64 };

/* Start of the state block; the vectors u v a, resisting and damping forces, paces and the elements' blocks follow. */
typedef struct {
  double time;
  double force_level;            /* largest force so far: scale of the unbalance */
  double energy[ED_N_ENERGY];
  double largest_input;
  double given_work[ED_HISTORY_FORCES]; /* of the forces of a history, so far */
  double position;               /* within the present whole step, 0..1 */
} ed_state_head;

typedef struct {
  double *block;                 /* owns */
  ed_state_head *head;
  double *u, *v, *a;             /* n */
  double *resisting, *damping;   /* n: at this state */
  double *pace, *pace_before;    /* n: displacement / time of the last two steps */
  double *support_u, *support_v, *support_a; /* n_supports: where held degrees are, and how they move */
  double *support_force;         /* n_supports: resisting force of elements and dampers there */
  double *p_delta;               /* per element: force and drift, 2 n_members */
  double *elements;
  double *devices;               /* the blocks of the dampers */
} ed_state;

/* What it takes to have factors again. */
typedef struct {
  int valid;
  double *matrix;                /* nnz */
  double *device_slope;          /* n_devices */
  double k, m, c;
} ed_factored;

typedef struct {
  double section_load[ED_MAX_POINTS][2], end_load[3], free_deformation[3];
  double arm_force[2][2], arm_moment[2][2];
} ed_loads;

typedef struct {
  int n_terms, first;            /* into terms */
  int history;                   /* column, or -1 */
  double limit;                  /* of its magnitude */
} ed_channel_head;

typedef struct {
  double coefficient;
  int kind, object, component;
} ed_term;

typedef enum { ED_RUN_NONE, ED_RUN_STATIC, ED_RUN_PUSHOVER, ED_RUN_HISTORY } ed_run_kind;

/* A force of a history, along its degrees. What acts on fixed ones goes into their reactions and does no work. */
typedef struct {
  int n_terms, equation[ED_MAX_TERMS];
  double coefficient[ED_MAX_TERMS];
  int n_fixed, fixed[ED_MAX_TERMS]; /* degrees 3 node + d */
  double fixed_coefficient[ED_MAX_TERMS];
  double origin;                 /* displacement along it when it was made */
  double last;                   /* at the end of the last whole step */
  double start, end;             /* of the present whole step; accelerations are those with `start` */
  double before, now;            /* of the present substep */
  double before_without_mass;    /* what degrees without mass are in balance with when it begins */
} ed_history_load;

/* A held degree that moves in a history. */
typedef struct {
  int support;
  double origin;                 /* where it was when the history began */
  double *displacement, *velocity, *acceleration; /* n+1 samples of the history, one block */
  double *shape;                 /* n: the structure that follows it slowly, by the tangent at the start */
} ed_support_motion;

typedef struct {
  ed_run_kind kind;
  int steps, done, row, every;
  int taken;                     /* rows that are no longer in the buffers */
  double *abscissa, *values, *energy;
  int failed;
  int limited;                   /* 1 + the channel that has exceeded its limit; 0: none */
  /* static */
  int pattern;
  double factor_start, factor_end;
  int control;                   /* equation */
  double control_start, control_end;
  /* history */
  double dt;
  double *ground[2];             /* copies, n+1 samples */
  double ground_now[2], ground_before[2]; /* of the present substep */
  double alpha_m, alpha_f, gamma, beta;
  int n_forces;
  ed_history_load force[ED_HISTORY_FORCES];
  int n_motions;
  ed_support_motion *motion;     /* of held degrees */
} ed_run;

struct ed_analysis {
  const ed_model *model;
  char message[ED_MESSAGE];

  /* numbering */
  int n;                         /* equations */
  int *equation;                 /* 3 n_nodes */
  int n_supports;                /* held degrees, tied ones counted once */
  int *support;                  /* 3 n_nodes: number of a held degree, -1 where free */
  double *mass;                  /* n */
  double *influence[2];          /* n: 1 where the equation moves with the ground along x, y */
  double length;                 /* mean element length: makes moments comparable with forces */
  int *rotational;               /* n */
  double *solver_scale;          /* n: 1, or 1 / length where rotational */
  int *name;                     /* n: degree (3 node + d) that names the equation */

  /* matrix */
  int nnz;
  int *column_start, *row, *diagonal;
  int n_struts;                  /* among the elements */
  int *scatter;                  /* 36 a member, into values; nnz is a bin for fixed degrees */
  double *tangent;               /* nnz + 1: K at the trial state */
  double *initial;               /* nnz + 1: K of the unloaded structure */
  double *initial_damping;       /* nnz + 1: the same with the damping factors of the elements */
  double *reference;             /* nnz + 1: K that Rayleigh damping uses when it is not the current one */
  double *damped;                /* nnz + 1: the tangent with the damping factors of the elements, without softening of struts; NULL: the same */
  double *effective;             /* nnz + 1: what the factors are of */
  ed_solver *solver;

  /* elements and state */
  ed_element *elements;
  ed_state trial, committed;
  int state_size;                /* of the block */
  int element_blocks;            /* size of all elements' blocks */
  double *layers;
  int layer_size;
  double *layers_backup, *block_backup;
  double *records;               /* of the trials of sections, for their commits */
  int *device_block;             /* per device: offset of its block */
  double *displacement;          /* over all degrees, at the trial state */
  double *resisting;             /* over all degrees, at the trial state */
  double *member_force;          /* 6 a member */
  double *factors;               /* of the load patterns, trial */
  double *factors_committed, *factors_backup;
  double *external;              /* n: loads at `factors` */
  double *external_committed;    /* n: loads at the last commit */
  ed_loads *loads_committed;     /* per member: element loads at the last commit */
  long tangent_stamp, assembled_stamp, damped_stamp, factored_stamp; /* of the tangent, of `tangent` and `damped`, of the factors (-1: none) */
  double factored_k, factored_m, factored_c; /* of the factors */
  ed_factored kept;              /* of the last commit, once others have replaced them */
  ed_factored backed;            /* of ed_backup */
  double factor_price;           /* of a factorisation, in iterations */

  /* dampers; arrays per device */
  ed_ode_system *ode_system;
  int n_by_ode, *device_by_ode;  /* which */
  int *device_scatter;           /* n_terms x n_terms a device, into values */
  ed_path *device_path, (*device_direction)[2]; /* of those by ODE */
  ed_path direction[2];
  ed_damper_force *device_out;   /* of those by ODE */
  double (*device_chord)[2];     /* what comes to dF/du and dF/dv where an iteration swings */
  int *device_swings;            /* its velocity fell or turned in the last iteration */
  int swinging;                  /* this attempt does not settle with tangents alone */
  const double **device_old;     /* of those by ODE */
  double **device_new;
  double duration;               /* of the present attempt */
  double velocity_factor;        /* dv/du of the present attempt */
  double damper_tolerance;
  int failed_device;             /* -1: one of those by ODE, which are solved together */
  int device_status;             /* why */
  double *device_factored;       /* slope of each that is in the factors */

  /* the frame condensed to the deformations of the dampers (condensation.c) */
  double *device_response;       /* n_devices x n: A^-1 b of the factors; NULL: condensation would cost more than it saves */
  double *flexibility;           /* n_devices x n_devices: b' A^-1 b */
  double *condensed;             /* n_devices x n_devices: factors of the balance at the dampers */
  int *condensed_pivot;
  double *condensed_work;        /* 7 n_devices */
  int flexibility_known;         /* of the present factors */

  /* damping */
  double rayleigh_mass, rayleigh_stiffness;
  int rayleigh_kind;
  int frozen;                    /* this attempt damps with the committed stiffness */
  int n_modal;
  double *modal;                 /* n_modal x n: M phi scaled so that C = sum m m' */
  double *modal_solved;          /* n_modal x n: A^-1 m */
  double *modal_small;           /* n_modal x n_modal factors of 1/c + m' A^-1 m */
  int *modal_pivot;

  /* work */
  double *r, *du, *work, *work2, *predicted;
  double *residuals;             /* history of the last attempt */
  int n_residuals;
  int worst;                     /* equation of the largest unbalance */
  int failed_member;

  /* settings */
  double tolerance;              /* the elements' settings are in `control` */
  int max_iterations, halvings, reuse, energy;

  /* channels */
  ed_channel_head *channels;
  ed_term *terms;
  int n_channels, n_terms, n_history;
  double *maximum, *minimum, *time_maximum, *time_minimum, *last;

  ed_run run;
  ed_stop stop;                  /* whom runs ask */
  ed_watch watch;                /* of the present call */
  ed_statistics statistics;
  ed_element_control control;
  ed_event *events;
  int n_events;
};

/* Of any degree, held ones too. */
static inline double ed_displacement(const ed_analysis *a, const ed_state *state, int degree)
{
  const int equation = a->equation[degree];
  return equation >= 0 ? state->u[equation] : state->support_u[a->support[degree]];
}

/* message for people; returns the status */
int ed_fail(ed_analysis *a, int status, const char *format, ...);

/* numbering.c */
int ed_number(ed_analysis *a);
const char *ed_equation_name(const ed_analysis *a, int equation, char *buffer, int size);

/* assembly.c */
int ed_build_pattern(ed_analysis *a);
void ed_set_factors(ed_analysis *a);              /* external and element loads from a->factors */
int ed_update_elements(ed_analysis *a);           /* trial u, v -> states of elements and dampers, resisting forces */
int ed_update_members(ed_analysis *a);            /* the same, dampers are there already */
void ed_collect_forces(ed_analysis *a);           /* element states -> resisting forces */
void ed_assemble_tangent(ed_analysis *a);
const double *ed_damping_tangent(ed_analysis *a); /* K of stiffness-proportional damping at the trial state */
void ed_multiply(const ed_analysis *a, const double *matrix, const double *x, double *y); /* symmetric, y = A x */

/* damping.c */
void ed_damping_force(ed_analysis *a, const double *v, double *force);
int ed_factor_effective(ed_analysis *a, double k, double m, double c);
int ed_solve_effective(ed_analysis *a, int count, double *x); /* count x n right sides, solved together */
void ed_note_factors(const ed_analysis *a, ed_factored *to);
void ed_keep_factors(ed_analysis *a);             /* before others replace those of the last commit */
void ed_restore_factors(ed_analysis *a);

/* state.c */
int ed_state_allocate(ed_analysis *a);
void ed_commit(ed_analysis *a);
void ed_revert(ed_analysis *a);
void ed_backup(ed_analysis *a);
void ed_restore(ed_analysis *a);
int ed_state_finite(const ed_analysis *a); /* whether every number of the committed state is finite */

/* devices.c */
int ed_device_block_size(const ed_device *device);
int ed_devices_allocate(ed_analysis *a);
void ed_devices_free(ed_analysis *a);
int ed_update_devices(ed_analysis *a, int rough); /* trial u, v -> states and forces; rough: as in ed_damper_try */
double ed_along_device(const ed_analysis *a, int device, const double *vector); /* sum of coefficient * vector over equations */
void ed_add_along_device(const ed_analysis *a, int device, double factor, double *vector);
double ed_device_force(const ed_analysis *a, const ed_state *state, int device);
double ed_expected_device_force(const ed_analysis *a, int device); /* from the committed state, on as in the last step */
double ed_device_slope(const ed_analysis *a, int device);  /* dF/du + (dv/du of the attempt) dF/dv at the trial state */
void ed_name_damper(const ed_analysis *a, char *buffer, int size); /* that failed, and why */
void ed_add_device_forces(ed_analysis *a);        /* into the resisting forces over all degrees */
void ed_add_device_tangent(const ed_analysis *a, double k, double *matrix);
int ed_installed(const ed_analysis *a);           /* whether some damper acts */
int ed_first_slopes(ed_analysis *a);              /* of the dampers that act, in a slow step from the committed state */
int ed_start_devices(ed_analysis *a);
double ed_count_device_work(ed_analysis *a);
double ed_device_value(const ed_analysis *a, int kind, int device, int component);

/* check.c */
int ed_check_structure(ed_analysis *a);
void ed_name_mechanism(ed_analysis *a, char *buffer, int size);

/* channels.c */
double ed_channel_value(const ed_analysis *a, int channel);
int ed_sample(ed_analysis *a, int keep_row);      /* ED_OK, ED_E_NOT_FINITE */
int ed_beyond_limit(const ed_analysis *a);        /* channel of the last sample that is furthest beyond its limit, -1: none */

/* energy.c */
void ed_count_energy(ed_analysis *a, double dissipated);
void ed_close_energy(ed_analysis *a);
void ed_restart_energy(ed_analysis *a);
void ed_remember_loads(ed_analysis *a);           /* those of the committed state, for the work of the next step */

/* equilibrium.c: iterates the trial state of one (sub)step to equilibrium */
typedef struct ed_step {
  double k, m, c;                /* effective matrix k K + m M + c C */
  double velocity, acceleration; /* dv / du, da / du */
  void (*residual)(ed_analysis *a, const struct ed_step *step, double *r);
  double ground[2], ground_before[2];
} ed_step;
int ed_equilibrate(ed_analysis *a, const ed_step *step, int rung);
void ed_move(ed_analysis *a, const ed_step *step, double factor, const double *du); /* trial u, v, a by factor du */
double ed_unbalance(ed_analysis *a, const double *r);  /* relative; notes the worst equation */
void ed_raise_force_level(ed_analysis *a);
double ed_rounding(ed_analysis *a);                    /* relative unbalance that rounding makes */
int ed_stalls(const ed_analysis *a, int iteration);
int ed_accept(ed_analysis *a, double unbalance);       /* notes it; ED_OK */
void ed_freeze_damping(ed_analysis *a, int rung);
int ed_last_iterations(const ed_analysis *a);

/* condensation.c */
int ed_condensation_allocate(ed_analysis *a);
int ed_condenses(const ed_analysis *a, int rung);   /* whether dampers are balanced with the condensed frame */
double ed_condensation_flops(const ed_analysis *a); /* that come to a factorisation */
double ed_iteration_flops(const ed_analysis *a);    /* of an iteration of the frame */
/* Moves the trial state by the solution in `du`, with the dampers in balance and at their new states. first: of the step. */
int ed_move_condensed(ed_analysis *a, const ed_step *step, int first);
void ed_follow_pace(const ed_analysis *a, double *du); /* from the committed state, on as in the last two steps */

/* support_motion.c: of a history that runs */
void ed_move_supports(ed_analysis *a, double position);  /* of the trial state, to a position in the whole step */
void ed_subtract_slow_motion(const ed_analysis *a, const double *of_supports, double *vector); /* what follows supports slowly */
double ed_support_work(const ed_analysis *a, double *damping); /* over the substep; *damping: what damping forces take of it */
void ed_free_support_motions(ed_run *run);

/* history_forces.c: of a history that runs, otherwise there are none */
void ed_move_history_forces(ed_analysis *a, double from, double to);  /* to a substep between two positions in the whole step */
void ed_finish_history_forces(ed_analysis *a);                        /* the whole step is done: they stay as they are at its end */
void ed_add_history_forces(const ed_analysis *a, double share_before, double *r); /* weighted between the ends of the substep */
double ed_history_force_work(ed_analysis *a);                         /* over the substep; adds it to that of each force */
void ed_largest_history_force(const ed_analysis *a, double *force, double *moment);
double ed_history_force_value(const ed_analysis *a, int kind, int force); /* as of a damper in its place; 0 of one that there is not */
double ed_history_force_on(const ed_analysis *a, int degree);             /* of all of them on a fixed degree */

/* ladder.c */
typedef int (*ed_attempt)(ed_analysis *a, double fraction, int rung);
int ed_climb(ed_analysis *a, ed_attempt attempt);

/* run.c */
void ed_start_run(ed_analysis *a, int kind, int steps, double abscissa);
void ed_slowly(ed_analysis *a);                   /* static steps last so long that dampers relax */

/* one attempt a kind of run: static.c, pushover.c, history.c */
int ed_static_attempt(ed_analysis *a, double fraction, int rung);
int ed_pushover_attempt(ed_analysis *a, double fraction, int rung);
int ed_history_attempt(ed_analysis *a, double fraction, int rung);

#endif
