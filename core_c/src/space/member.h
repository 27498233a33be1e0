/* A straight prismatic member: Timoshenko beam-column with rotational springs at its ends, or a bar. */
#ifndef ED_SPACE_MEMBER_H
#define ED_SPACE_MEMBER_H

enum { ED_E, ED_G, ED_A, ED_A_Y, ED_A_Z, ED_I_T, ED_I_Y, ED_I_Z };

/* Resistance to what deforms a member: to elongation, to twist, to both ends moving apart across it, and of both planes the moments at
 * its ends (11 12 22) under rotations of its ends from the chord. y: moments about local y. */
typedef struct {
  double axial, torsion, across, y[3], z[3];
} ed_space_stiffness;

typedef struct {
  int node[2];
  int axial_only;
  double length;
  double axis[3][3];  /* local x, y, z in global components */
  double end[4];      /* springs: y at start, z at start, y at end, z at end */
  double property[8];
  ed_space_stiffness stiffness;
} ed_space_member;

/* Stiffness from length, properties and springs. */
void ed_member_stiffness(ed_space_member *member);
/* Geometric stiffness of an axial force (tension > 0): that of the bent member, consistent with its elastic shape between the springs. */
ed_space_stiffness ed_member_geometric(const ed_space_member *member, double axial);
/* Global matrix, 12 x 12, of which the lower triangle is set. */
void ed_member_matrix(const ed_space_member *member, const ed_space_stiffness *k, double *matrix);
/* Adds the end forces under displacements of both nodes (6 each, global). */
void ed_member_add_forces(const ed_space_member *member, const double *start, const double *end, double *force);
/* Adds the end forces of the member held at its nodes, under a force a length, and under a force at a fraction of its length, both in
 * global components. */
void ed_member_add_uniform(const ed_space_member *member, const double *load, double *force);
void ed_member_add_point(const ed_space_member *member, double position, const double *load, double *force);
/* Three components along the local axes, and from them back, added. */
void ed_member_to_local(const ed_space_member *member, const double *global, double *local);
void ed_member_add_global(const ed_space_member *member, const double *local, double *global);

#endif
