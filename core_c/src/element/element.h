/* Elements at run time. Each keeps a block of doubles in the state: basic deformations v, basic forces q, tangent kb, and
 * what its kind needs; the layers' committed state lies elsewhere. Basic system: simply supported, axially fixed at i;
 * v = (elongation, rotation i, rotation j from the chord), q conjugate. Beams in space have rotations about local z, then about local y;
 * their twist is elastic and beside this (basic_system.h). */
#ifndef ED_ELEMENT_H
#define ED_ELEMENT_H

#include "element/basic_system.h"
#include "system/model.h"

typedef struct ed_strut ed_strut;

enum { ED_MAX_DEGREES = 12 };

/* Symmetric matrices as rows of their upper triangles. */
typedef struct {
  const ed_member *member;
  ed_element_kind kind;
  int geometry;
  int axes;              /* ED_SPACE: a beam that bends about two axes; else ED_PLANE */
  int degrees;           /* of both ends: 6 or 12 */
  int dof[ED_MAX_DEGREES]; /* into vectors over all degrees */
  int release[4];        /* of the rotations of the basic system, in their order */
  double length, c, s;
  double axis[3][3];     /* in space: local x, y, z in global components */
  int points;
  const ed_section *section[ED_MAX_POINTS];
  double x[ED_MAX_POINTS];       /* 0..1 */
  double weight[ED_MAX_POINTS];  /* times length */
  double inverse[ED_MAX_POINTS][ED_MAX_SECTION_TERMS]; /* initial section flexibility */
  double flexibility[ED_MAX_BASIC_TERMS]; /* elastic, of the whole basic system */
  double stiffness[ED_MAX_BASIC_TERMS];   /* elastic basic stiffness with releases */
  double twist_stiffness;        /* in space: GJ / L */
  const ed_steel *steel;         /* truss */
  double area;
  ed_strut *strut;               /* owns */
  double link[36];               /* link: stiffness, global */
  const ed_spring *spring;
  double link_axis[2];
  int state;                     /* offset of the block */
  int layers;                    /* offset of the layers' state */
  int layer_offset[ED_MAX_POINTS];
  double *record[ED_MAX_POINTS]; /* of the last trial of a section, for its commit; NULL: none kept */
  /* loads at the present factors */
  double section_load[ED_MAX_POINTS][ED_MAX_RESULTANTS];
  double end_load[ED_MAX_BASIC]; /* reactions: axial i, transverse i, transverse j along y, then along z */
  double free_deformation[ED_MAX_BASIC]; /* elastic deformation under the loads with q = 0 */
  double mean_axial;             /* mean of N under the loads with q = 0: acts over the drift, as q[0] does */
  /* rigid ends; length, points and loads above are those of the part between */
  int rigid;
  double arm[2];                 /* from the node to where it begins to bend, along the axis: > 0 at i, < 0 at j */
  double offset[2][3];           /* in space: the whole way, in global components */
  double arm_force[2][3];        /* of loads on them: along the local axes */
  double arm_moment[2][3];       /* sum of arm times these */
} ed_element;

typedef struct {
  double tolerance;
  int fast_elastic;
  int no_softening;      /* tangents of struts that lose force count as 0: past a snap there is no other way */
  long updates, iterations, elastic;
} ed_element_control;

/* ED_OK; ED_E_NOT_FINITE: its length or stiffness is not a finite number; ED_E_MEMORY. */
int ed_element_setup(ed_element *element, const ed_model *model, int index);
void ed_element_clear(ed_element *element); /* frees what setup made */
int ed_element_block_size(const ed_element *element);
int ed_element_layer_size(const ed_element *element);
int ed_element_record_size(const ed_element *element);
void ed_element_place_records(ed_element *element, double *records);
void ed_element_initialise(const ed_element *element, double *block, double *layers);

void ed_element_clear_loads(ed_element *element);
void ed_element_add_load(ed_element *element, const ed_member_load *load, double factor);
void ed_element_finish_loads(ed_element *element);

/* Adds a load of the whole length, rigid ends included. */
void ed_rigid_add_load(ed_element *element, const ed_member_load *load, double factor);
/* Finds q and kb for the displacements of its degrees. */
int ed_element_update(const ed_element *element, const double *displacement, const double *layers, double *block,
                      ed_element_control *control);
/* Resisting forces at its degrees in global axes. */
void ed_element_forces(const ed_element *element, const double *displacement, const double *block, double *force);
/* Tangent, degrees x degrees, in global axes. */
void ed_element_tangent(const ed_element *element, const double *displacement, const double *block, double *tangent);
/* Whether the layers may be in this state of finite numbers. */
int ed_element_layers_valid(const ed_element *element, const double *layers);
/* Advances the layers to the block's deformations; the return is the energy dissipated on the way. */
double ed_element_commit(const ed_element *element, double *block, double *layers);
double ed_element_stored(const ed_element *element, const double *block, const double *layers);
/* Lateral second-order force N D / L and drift D across a P-Delta element, in space along y, then along z; 0 for others. */
void ed_element_p_delta(const ed_element *element, const double *displacement, const double *block, double *force,
                        double *drift);
/* which: rotation of the basic system, from 0 */
double ed_element_plastic_rotation(const ed_element *element, const double *block, int which);

/* Geometry (geometry.c, geometry_3d.c, corotational_3d.c). */
typedef struct {
  double c, s, l;        /* chord */
  double v[ED_MAX_BASIC];
  double drift[ED_SPACE]; /* transverse, from i to j, along the original axes */
  double twist;
} ed_kinematics;
/* Of finite rotations (corotational_3d.c); forces and tangent are added, without those of loads. */
void ed_corotational_kinematics_3d(const ed_element *element, const double *displacement, ed_kinematics *k);
void ed_corotational_forces_3d(const ed_element *element, const double *displacement, const double *block, double *force);
void ed_corotational_tangent_3d(const ed_element *element, const double *displacement, const double *block, double *tangent);
void ed_kinematics_of(const ed_element *element, const double *displacement, ed_kinematics *k);
/* The same between the ends of what bends: displacements of these. */
void ed_face_forces(const ed_element *element, const double *face, const double *block, double *force);
void ed_face_tangent(const ed_element *element, const double *face, const double *block, double *tangent);
void ed_face_kinematics_3d(const ed_element *element, const double *face, ed_kinematics *k);
void ed_face_forces_3d(const ed_element *element, const double *face, const double *block, double *force);
void ed_face_tangent_3d(const ed_element *element, const double *face, const double *block, double *tangent);
/* sin(t) / t and (1 - cos t) / t^2 as functions of s = t^2, with their first two derivatives. */
void ed_rotation_factors(double s, double a[3], double b[3]);

/* Rigid ends (rigid_ends.c): arms as they stand, and displacements of where it begins to bend, for those of the nodes. */
void ed_rigid_faces(const ed_element *element, const double *displacement, double arm[2][2], double *face);
void ed_rigid_forces(const ed_element *element, const double *displacement, const double *block, double *force);
void ed_rigid_tangent(const ed_element *element, const double *displacement, const double *block, double *tangent);
/* P-Delta: second-order moments on the nodes and their rotations, at i, j, in space about x, y, z each; 0 for other geometries. */
void ed_rigid_second_order(const ed_element *element, const double *displacement, const double *block, double *moment, double *rotation);
/* Moment on a node of the loads on its rigid end, from their arm_moment. */
double ed_arm_load_moment(const ed_element *element, const double *arm_moment, double rotation);
/* The same in space (rigid_ends_3d.c). */
void ed_rigid_faces_3d(const ed_element *element, const double *displacement, double *face);
void ed_rigid_forces_3d(const ed_element *element, const double *displacement, const double *block, double *force);
void ed_rigid_tangent_3d(const ed_element *element, const double *displacement, const double *block, double *tangent);
void ed_rigid_second_order_3d(const ed_element *element, const double *displacement, const double *block, double moment[6],
                              double rotation[6]);
/* Loads on a rigid end as a force at its tip: what its moment about the node is that of, in local components. */
void ed_tip_force(const ed_element *element, int end, const double *arm_moment, double tip[3]);

/* How many moments ed_rigid_second_order gives. A rigid member keeps these and the rotations of the last count of energy at the end of its
 * block. */
static inline int ed_rigid_moments(const ed_element *element)
{
  return element->axes == ED_SPACE ? 6 : 2;
}

/* Force-based beam (fibre_beam.c). */
int ed_fibre_beam_update(const ed_element *element, const double *v, const double *layers, double *block,
                         ed_element_control *control);

#endif
