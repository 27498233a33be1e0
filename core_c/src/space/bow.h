/* How a member bows between its nodes, which stand still, and what an axial force does to it. */
#ifndef ED_SPACE_BOW_H
#define ED_SPACE_BOW_H

#include "space/member.h"

enum { ED_BOWS = 4 }; /* shapes in each plane */

/* Geometric stiffness of one plane over the rotations of the nodes from the chord (11 12 22) and the amplitudes of the bows. A bow of
 * amplitude 1 has the strain energy 1/2, and none in common with other bows or with displacements of the nodes. */
typedef struct {
  double turns[3], coupling[ED_BOWS][2], bows[ED_BOWS][ED_BOWS];
} ed_space_bow;

/* Of a member under an axial force (tension > 0): force across under both ends moving apart, and both planes. */
typedef struct {
  int member;
  double across;
  ed_space_bow y, z;
} ed_space_bowed;

/* Geometric stiffness of an axial force. A bar is a string: it does not bow. */
void ed_member_bow(const ed_space_member *member, double axial, ed_space_bowed *bowed);
/* Adds to `force` (12, local) and `image` (2 ED_BOWS: y, then z) what the geometric stiffness gives under displacements of both nodes
 * (6 each, global) and amplitudes of the bows. */
void ed_member_add_geometric(const ed_space_member *member, const ed_space_bowed *bowed, const double *start, const double *end,
                             const double *amplitude, double *force, double *image);
/* Stiffness under `factor` times the axial force, bows in equilibrium. 0: the member buckles between fixed nodes. */
int ed_member_pressed(const ed_space_member *member, const ed_space_bowed *bowed, double factor, ed_space_stiffness *stiffness);

#endif
