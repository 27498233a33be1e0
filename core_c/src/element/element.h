/* Elements at run time. Each keeps a block of doubles in the state: basic deformations v, basic forces q, tangent kb, and
 * what its kind needs; the layers' committed state lies elsewhere. Basic system: simply supported, axially fixed at i;
 * v = (elongation, rotation i, rotation j from the chord), q conjugate. */
#ifndef ED_ELEMENT_H
#define ED_ELEMENT_H

#include "system/model.h"

typedef struct ed_strut ed_strut;

/* symmetric 3x3: 00 01 02 11 12 22 */
typedef struct {
  const ed_member *member;
  ed_element_kind kind;
  int geometry;
  int dof[6];            /* into vectors over all degrees, 3 a node */
  int release[2];
  double length, c, s;
  int points;
  const ed_section *section[ED_MAX_POINTS];
  double x[ED_MAX_POINTS];       /* 0..1 */
  double weight[ED_MAX_POINTS];  /* times length */
  double inverse[ED_MAX_POINTS][3]; /* initial section flexibility 11 12 22 */
  double flexibility[6];         /* elastic, of the whole basic system */
  double stiffness[6];           /* elastic basic stiffness with releases */
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
  double section_load[ED_MAX_POINTS][2]; /* N, M */
  double end_load[3];            /* reactions: axial i, transverse i, transverse j */
  double free_deformation[3];    /* elastic deformation under the loads with q = 0 */
  double mean_axial;             /* mean of N under the loads with q = 0: acts over the drift, as q[0] does */
  /* rigid ends; length, points and loads above are those of the part between */
  int rigid;
  double arm[2];                 /* from the node to where it begins to bend, along the axis: > 0 at i, < 0 at j */
  double arm_force[2][2];        /* of loads on them: along, across */
  double arm_moment[2][2];       /* sum of arm times these */
} ed_element;

typedef struct {
  double tolerance;
  int fast_elastic;
  int no_softening;      /* tangents of struts that lose force count as 0: past a snap there is no other way */
  long updates, iterations, elastic;
} ed_element_control;

/* Offsets in the block. */
enum { ED_BLOCK_V = 0, ED_BLOCK_Q = 3, ED_BLOCK_K = 6, ED_BLOCK_REFERENCE = 12, ED_BLOCK_INELASTIC = 13, ED_BLOCK_POINTS = 14 };
/* a point: e0 kappa, N M, k11 k12 k22, elastic in this trial, some layer has yielded before, what is left of the reach of its tangent */
enum { ED_POINT_E = 0, ED_POINT_S = 2, ED_POINT_K = 4, ED_POINT_ELASTIC = 7, ED_POINT_INELASTIC = 8, ED_POINT_REACH = 9, ED_POINT_SIZE = 10 };

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
/* Finds q and kb for the displacements of the six degrees. */
int ed_element_update(const ed_element *element, const double *displacement, const double *layers, double *block,
                      ed_element_control *control);
/* Resisting forces at the six degrees in global axes. */
void ed_element_forces(const ed_element *element, const double *displacement, const double *block, double *force);
/* Tangent 6x6 in global axes. */
void ed_element_tangent(const ed_element *element, const double *displacement, const double *block, double *tangent);
/* Whether the layers may be in this state of finite numbers. */
int ed_element_layers_valid(const ed_element *element, const double *layers);
/* Advances the layers to the block's deformations; the return is the energy dissipated on the way. */
double ed_element_commit(const ed_element *element, double *block, double *layers);
double ed_element_stored(const ed_element *element, const double *block, const double *layers);
/* Lateral second-order force N D / L and drift D across a P-Delta element; 0 for others. */
void ed_element_p_delta(const ed_element *element, const double *displacement, const double *block, double *force,
                        double *drift);
double ed_element_plastic_rotation(const ed_element *element, const double *block, int end);

/* Geometry (geometry.c). */
typedef struct {
  double c, s, l;        /* chord */
  double v[3];
  double drift;          /* transverse, from i to j, along the original axes */
} ed_kinematics;
void ed_kinematics_of(const ed_element *element, const double *displacement, ed_kinematics *k);
/* The same between the ends of what bends: displacements of these. */
void ed_face_forces(const ed_element *element, const double *face, const double *block, double *force);
void ed_face_tangent(const ed_element *element, const double *face, const double *block, double *tangent);

/* Rigid ends (rigid_ends.c): arms as they stand, and displacements of where it begins to bend, for those of the nodes. */
void ed_rigid_faces(const ed_element *element, const double *displacement, double arm[2][2], double *face);
void ed_rigid_forces(const ed_element *element, const double *displacement, const double *block, double *force);
void ed_rigid_tangent(const ed_element *element, const double *displacement, const double *block, double *tangent);
/* P-Delta: second-order moments on the nodes and their rotations, at i, j; 0 for other geometries. */
void ed_rigid_second_order(const ed_element *element, const double *displacement, const double *block, double moment[2],
                           double rotation[2]);
/* Moment on a node of the loads on its rigid end, from their arm_moment. */
double ed_arm_load_moment(const ed_element *element, const double *arm_moment, double rotation);
/* What a rigid member keeps at the end of its block: the four of ed_rigid_second_order at the last count of energy. */
enum { ED_RIGID_SIZE = 4 };

/* Force-based beam (fibre_beam.c). */
int ed_fibre_beam_update(const ed_element *element, const double *v, const double *layers, double *block,
                         ed_element_control *control);

#endif
