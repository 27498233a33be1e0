/* Committed and trial state, each one block copied whole. */
#ifndef ED_STATE_H
#define ED_STATE_H

#include "edcore.h"
#include "system/numbering.h"

/* Start of the state block; the vectors u v a, resisting and damping forces, mean velocities and the elements' blocks follow. */
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
  double *mean_velocity, *mean_velocity_before; /* n: displacement / time of the last two steps */
  double *support_u, *support_v, *support_a; /* n_supports: where supported degrees are, and how they move */
  double *support_force;         /* n_supports: resisting force of elements and dampers there */
  double *p_delta;               /* per element: second-order forces and drifts, ed_p_delta_size */
  double *elements;
  double *devices;               /* the blocks of the dampers */
} ed_state;

static inline int ed_p_delta_size(const ed_model *model) /* of an element: both across, in each direction */
{
  return 2 * (model->dimension - 1);
}

/* What states share: the layers of sections, and copies to go back to. */
typedef struct {
  int size;                      /* of a state's block */
  int element_blocks;            /* size of all elements' blocks */
  double *layers;
  int layer_size;
  double *layers_backup, *block_backup;
  double *records;               /* of the trials of sections, for their commits */
} ed_storage;

int ed_state_allocate(ed_analysis *a);
void ed_storage_free(ed_storage *storage);
void ed_commit(ed_analysis *a);
void ed_revert(ed_analysis *a);
void ed_backup(ed_analysis *a);
void ed_restore(ed_analysis *a);
/* Whether every number of a state and of the layers is finite. */
int ed_state_finite(const ed_storage *storage, const ed_state *state);

/* Of equations or supports, at any degree. */
static inline double ed_at_degree(const ed_numbering *numbering, const double *of_equations, const double *of_supports, int degree)
{
  const int equation = numbering->equation[degree];
  const double value = equation >= 0 ? of_equations[equation] : of_supports[numbering->support[degree]];
  if (!numbering->plan || numbering->plan[degree].turn < 0)
    return value;
  const int turn = numbering->plan[degree].turn, turns = numbering->equation[turn];
  return value + numbering->plan[degree].lever * (turns >= 0 ? of_equations[turns] : of_supports[numbering->support[turn]]);
}

static inline double ed_displacement(const ed_numbering *numbering, const ed_state *state, int degree)
{
  return ed_at_degree(numbering, state->u, state->support_u, degree);
}

#endif
