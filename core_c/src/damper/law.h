/* A damper law: the force of a device whose deformation follows a path over one step.
 *
 * A law offers an exact step along a path (`step`), or its differential equations (`rate`), or both; the SUNDIALS system
 * (ode_system.h) integrates the equations of all devices that have no exact step as one. Laws never change the committed state:
 * they write the state at the end of the path into `trial`, so every trial starts from the committed state again.
 *
 * State of a device: n_ode variables of the differential equations, then n_memory doubles of memory (running extremes, last
 * reversal ...), constant between events. All zero is not necessarily the state at rest: `start` writes that one. */
#ifndef ED_LAW_H
#define ED_LAW_H

#include "base/watch.h"
#include "damper/law_parameters.h"
#include "damper/path.h"
#include "edcore.h"

#include <stddef.h>

enum { ED_MAX_ODE = 64 };

typedef struct {
  double force;
  double slope[2]; /* d force / d unknown, for the two directions of the path */
  /* What comes to the slopes when powers of the velocity take the chord from rest instead of the tangent: an iteration that oscillates
   * about rest, where Newton's method for a power below 1 does not settle, settles with it. Laws without powers leave it alone; who
   * calls has set it to zero. */
  double chord[2];
} ed_damper_force;

/* Of a bearing in two directions: derivatives [of the force along][to the motion along][to the two unknowns of its path]. */
typedef struct {
  double force[2];
  double slope[2][2][2];
} ed_pair_force;

/* Right-hand side at one instant with all its partial derivatives. */
typedef struct {
  double force, force_u, force_v;
  double force_y[ED_MAX_ODE];
  double y[ED_MAX_ODE];                       /* dy/dt */
  double y_u[ED_MAX_ODE], y_v[ED_MAX_ODE];
  double y_y[ED_MAX_ODE * ED_MAX_ODE];        /* row by row, n_ode wide; only the diagonal, n_ode values, when diagonal_ode is set */
} ed_damper_rate;

typedef struct ed_law ed_law;
typedef struct ed_effect ed_effect;

/* A law with its parameters; read-only once prepared (ed_damper in eddamper.h). */
struct ed_damper {
  const ed_law *law;
  int n_parameters;
  double parameter[ED_MOST_LAW_PARAMETERS];
  int n_derived;
  double *derived;      /* constants that `prepare` makes of the parameters; owned */
  int n_ode, n_memory;
  int diagonal_ode;
  int without_step;     /* the exact step of its law does not hold for what it has beside: set by `prepare` */
  double brace;         /* stiffness in series; 0: none (rigid), or its pins have play */
  double joint, play;   /* stiffness in series whose pins have play, from end to end; 0: none */
  int rate_independent; /* as its law, unless `prepare` finds that its parameters make it so, or effects that they do not */
  ed_stop stop;   /* whom histories ask whether to stop */
  double prior_extremes[4]; /* largest and smallest deformation, largest and smallest velocity that it went through before it starts */
  int n_effects, n_effect_state;
  ed_effect *effects; /* effects that the law has not (effect.h), with n_effect_state doubles of state behind the law's; owned */
  ed_damper *springs; /* the same law without its dashpots, where effects act on springs or dashpots alone (effect_sides.c); owned */
  int at_sides;       /* where its state, and what belongs to it, stands among the effects' */
};

struct ed_law {
  const char *name;
  int rate_independent;  /* the force depends on the order of deformations alone, not on their speed */
  int softens;           /* the force may fall while the deformation grows */
  int takes_brace;       /* `rate` itself puts brace > 0 in series */
  int plastic_path;      /* where in its state the sum of the sizes of its plastic deformations stands, from 1; 0: it keeps none */
  int in_parts;          /* the exact step integrates in parts that an estimate of the error chooses */
  int step_takes_brace;  /* so does the exact step; else brace.c puts it there */
  /* Turns a damper with a brace into one of the law that both are together, and that takes the brace itself. NULL: there is none. */
  void (*with_brace)(ed_damper *damper);
  /* Checks how parameters go together, each of which is within its bounds (law_parameters.c); sets n_ode, n_memory, diagonal_ode
   * and `derived`. On ED_E_ARGUMENT `message` says parameter, value seen, what is allowed. Also ED_E_MEMORY. NULL: nothing to do. */
  int (*prepare)(ed_damper *damper, char message[ED_DAMPER_MESSAGE]);
  void (*start)(const ed_damper *damper, double *state);
  /* Exact step along the path from `committed`; NULL where the law has none. Returns ED_OK, ED_E_NOT_FINITE, ED_E_NOT_CONVERGED.
   * direction: derivatives of the path to the two unknowns; `out` gets the force at the end and its derivatives to them. The
   * path begins where the last one ended in u; its velocity there may differ. */
  int (*step)(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
              ed_damper_force *out);
  /* The same of a bearing whose forces in two directions depend on each other, alike in all directions of the plane, and in each single
   * one are those of `step`: committed and trial are the state of each direction. NULL: the law is of one direction. */
  int (*step_pair)(const ed_damper *damper, const double *const committed[2], const ed_path path[2], const ed_path direction[2],
                   double *const trial[2], ed_pair_force *out);
  /* Differential equations at deformation u, velocity v, y (n_ode), memory (n_memory): smooth between events. NULL where the
   * law has none. Running extremes: memory holds those of the segment's start; inside a segment the law takes the larger of the
   * memory and the present value. */
  void (*rate)(const ed_damper *damper, double u, double v, const double *y, const double *memory, ed_damper_rate *out);
  /* Moves the memory from the start of a segment without event inside to its end at (u, v, y). NULL: nothing to do. */
  void (*remember)(const ed_damper *damper, double u, double v, const double *y, double *memory);
  /* Events other than reversals of the path, which always end a segment. Ascending places in (0, h) of the path where the
   * equations are not smooth, given the memory at its start; at most 8. NULL: none. */
  int (*events)(const ed_damper *damper, const ed_path *path, const double *memory, double at[8]);
  /* Writes into a state at rest what the specimen keeps of `before`, the state at the end of a test. NULL: nothing. */
  void (*keep)(const ed_damper *damper, const double *before, double *state);
  /* tau of a law that relaxes all of its forces, F + tau F' = everything, so that effects may stand inside it. NULL: it does not. */
  double (*relaxation_time)(const ed_damper *damper);
  /* Takes the dashpots out of a damper that is still to be prepared: law and parameters of what its springs carry, which has an exact step
   * and adds to what the dashpots carry. NULL: the force is no such sum. */
  void (*without_dashpots)(ed_damper *damper);
};

/* The laws by their id in eddamper.h (ED_LAW_*). NULL: no such law. */
const ed_law *ed_law_of(int id);

/* Prepares `damper` for a law; on failure `message` says why and nothing is to be freed. */
int ed_damper_prepare(ed_damper *damper, int law, int n_parameters, const double *parameters, double brace, double play,
                      char message[ED_DAMPER_MESSAGE]);
void ed_damper_clear(ed_damper *damper);

/* One step of a damper by the method that suits it; out may not be NULL. system: for laws without exact step. */
struct ed_ode_system;
int ed_damper_advance(const ed_damper *damper, struct ed_ode_system *system, const double *committed, const ed_path *path,
                      const ed_path direction[2], double *trial, ed_damper_force *out);
/* The same of one with an exact step. rough: another trial from `committed` is to follow, so that the balance with a brace need only be
 * near enough for the slopes to hold; what is missing the force has to first order. */
int ed_damper_try(const ed_damper *damper, int rough, const double *committed, const ed_path *path, const ed_path direction[2],
                  double *trial, ed_damper_force *out);

static inline int ed_damper_has_exact_step(const ed_damper *damper)
{
  return damper->law->step != NULL && !damper->without_step;
}

/* Whether brace.c puts a brace, or a joint with play, in series with its exact step. */
static inline int ed_damper_is_braced(const ed_damper *damper)
{
  return damper->joint > 0.0 ||
         (damper->brace > 0.0 && ed_damper_has_exact_step(damper) && !damper->law->step_takes_brace);
}

/* Effects (effect.h). */
int ed_effect_add(ed_damper *damper, int id, int placement, int n_parameters, const double *parameters,
                            char message[ED_DAMPER_MESSAGE]);
/* Of a state at rest: whether the deformation of the next step counts as way and work, or only leads to the first one. */
void ed_effects_start(const ed_damper *damper, double *state, int begun);
/* Gives a state that is held at rest the drivers of `before`, the state at the end of a test; the next step is no way and no work. */
void ed_effects_keep(const ed_damper *damper, const double *before, double *state);
/* What `keep` of the law does, for what effects have of that law themselves. */
void ed_effects_keep_law(const ed_damper *damper, const double *before, double *state);
/* After a jump of the velocity from `state`, in no time, to `after`: the next step begins with the force there. */
void ed_effects_jump(const ed_damper *damper, double *state, const double *after);
/* Turns the force of the law at the end of a path, and its derivatives, into those with the effects; the law's part of `trial` is
 * left alone. ED_OK, ED_E_NOT_FINITE. */
int ed_effects_apply(const ed_damper *damper, const double *committed, const ed_path *path, const ed_path direction[2], double *trial,
             ed_damper_force *out);

/* Doubles of the state of a damper without its brace. */
static inline int ed_damper_own_size(const ed_damper *damper)
{
  return damper->n_ode + damper->n_memory + damper->n_effect_state;
}

/* The exact step of a damper without its brace. */
static inline int ed_damper_own_step(const ed_damper *damper, const double *committed, const ed_path *path,
                                     const ed_path direction[2], double *trial, ed_damper_force *out)
{
  const int status = damper->law->step(damper, committed, path, direction, trial, out);
  return damper->n_effects == 0 || status != ED_OK ? status : ed_effects_apply(damper, committed, path, direction, trial, out);
}

#endif
