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
  double *p_delta;               /* per element: force and drift, 2 n_members */
  double *elements;
  double *devices;               /* the blocks of the dampers */
} ed_state;

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

/* Of any degree, supported ones too. */
static inline double ed_displacement(const ed_numbering *numbering, const ed_state *state, int degree)
{
  const int equation = numbering->equation[degree];
  return equation >= 0 ? state->u[equation] : state->support_u[numbering->support[degree]];
}

#endif
