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

/* What a plane of the member bends and shears by. */
typedef struct {
  double EI, shear; /* shear: 1 / (G A_s L), 0: no shear deformation */
} ed_space_plane;

ed_space_plane ed_member_plane_y(const ed_space_member *member);
ed_space_plane ed_member_plane_z(const ed_space_member *member);
/* Rotations of the end sections from the chord under unit moments there, 11 12 22, by bending and shear (Timoshenko). */
void ed_member_flexibility(double length, ed_space_plane plane, double *flexibility);

/* Stiffness from length, properties and springs. */
void ed_member_stiffness(ed_space_member *member);
/* Adds end forces of moments about y and z at both ends. */
void ed_member_add_end_moments(double length, double y1, double y2, double z1, double z2, double *force);
/* Global matrix, 12 x 12, of which the lower triangle is set. */
void ed_member_matrix(const ed_space_member *member, const ed_space_stiffness *k, double *matrix);
/* Adds the end forces under displacements of both nodes (6 each, global). */
void ed_member_add_forces(const ed_space_member *member, const double *start, const double *end, double *force);
/* Adds the end forces of the member between fixed nodes, under a force a length, and under a force at a fraction of its length, both in
 * global components. */
void ed_member_add_uniform(const ed_space_member *member, const double *load, double *force);
void ed_member_add_point(const ed_space_member *member, double position, const double *load, double *force);
/* Three components along the local axes, and from them back, added. */
void ed_member_to_local(const ed_space_member *member, const double *global, double *local);
void ed_member_add_global(const ed_space_member *member, const double *local, double *global);

#endif
