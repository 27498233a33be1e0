/* The description of a structure: what the caller declared, checked, in growing arrays. */
#ifndef ED_MODEL_H
#define ED_MODEL_H

#include "base/quadrature.h"
#include "damper/law.h"
#include "edcore.h"
#include "material/steel.h"
#include "section/section.h"
#include "spring/spring.h"

#include <stddef.h>
#include <string.h>

enum { ED_NAME = 48, ED_MESSAGE = 1024 };
/* Points of integration along a member, all its pieces together. */
enum { ED_MAX_POINTS = 64 };

typedef enum { ED_FIBRE_BEAM, ED_ELASTIC_BEAM, ED_TRUSS, ED_LINK, ED_STRUT, ED_SPRING } ed_element_kind;

enum { ED_MOST_DEGREES = 6 }; /* of a node */

typedef struct {
  char name[ED_NAME];
  double x, y, z;
  double mass[ED_MOST_DEGREES];
  int fixed[ED_MOST_DEGREES];
  int master[ED_MOST_DEGREES]; /* node whose degree this one shares, or -1 */
  int diaphragm;               /* it moves in plan with its masters as a rigid body */
  int is_master;               /* of a diaphragm */
  int is_followed;             /* others are tied to it in plan */
} ed_node;

typedef struct {
  char name[ED_NAME];
  ed_element_kind kind;
  int node[2];
  int geometry;
  int release[4];               /* beams: rotations of the basic system, in their order */
  double web[3];                /* beams in space: direction of local z, of length 1 */
  int points;                   /* fibre beam, of each piece; strut */
  int section[ED_MAX_RULE];     /* beams; ids */
  int breaks;                   /* fibre beam: it is integrated piece by piece between these places */
  double break_at[ED_MAX_POINTS]; /* 0..1, rising */
  int material;                 /* truss, strut */
  double area;                  /* truss, strut */
  int elements;                 /* strut: beams over its buckling length */
  double camber, buckling_length; /* strut: camber / buckling length, buckling length / length */
  double end_stiffness;         /* strut: rotational, of its ends; HUGE_VAL: fixed */
  double rigid[2];              /* beams in a plane: lengths of their rigid ends */
  double offset[2][3];          /* beams in space: from the nodes to what bends */
  double stiffness[3], angle;   /* link */
  int spring;                   /* spring; index */
  double coefficient[2 * ED_MOST_DEGREES]; /* spring */
  double without[4];            /* elastic beam: flexibility that its ends leave out, of rotations of the basic system */
  double damping_factor;        /* of stiffness-proportional damping */
  int loaded;
} ed_member;

typedef struct {
  int pattern, node;
  double force[ED_MOST_DEGREES];
} ed_nodal_load;

typedef struct {
  int pattern, element;
  double position; /* of a point load or where a partial one begins, 0..1; -1: uniform */
  double axial, transverse[2]; /* along x; along y, in space along z too */
  double end, transverse_end[2]; /* partial load, linear from `transverse` to this; end > position */
} ed_member_load;

/* A damper in the frame: its deformation is the sum of coefficient * displacement of the degrees, and its force acts on them. */
enum { ED_MAX_GIVEN_TERMS = 12, ED_MAX_TERMS = 2 * ED_MAX_GIVEN_TERMS }; /* as given, and put on masters of diaphragms */
typedef struct {
  char name[ED_NAME];
  ed_damper damper;             /* its brace is in the law's units, as if the device had the size of the law */
  double force_scale, deformation_scale; /* F = force_scale * law(deformation_scale * u) */
  int axial_spring;             /* spring by whose axial force its own goes in histories; -1: none */
  double weight;                /* compression of that spring at which it has the force of its law */
  int other;                    /* damper that is the same bearing across it, whose force depends on both; -1: none */
  int carries;                  /* it acts from the beginning, under loads that come before ed_install_dampers too */
  int n_terms;
  int degree[ED_MAX_TERMS];     /* over all degrees of all nodes; of a bearing those of both its directions, in one order */
  double coefficient[ED_MAX_TERMS];
} ed_device;

struct ed_model {
  int dimension;                /* 2 or 3 */
  ed_steel *materials;
  ed_section *sections;
  ed_spring *springs;
  ed_node *nodes;
  ed_member *members;
  ed_nodal_load *nodal_loads;
  ed_member_load *member_loads;
  ed_device *devices;
  int n_devices;
  int uneven_damping;           /* some damping factor is not 1 */
  int n_materials, n_sections, n_springs, n_nodes, n_members, n_nodal_loads, n_member_loads, n_patterns;
  char message[ED_MESSAGE];
};

/* Degrees of a node: displacements, then rotations. */
static inline int ed_degrees(const ed_model *model)
{
  return model->dimension == 3 ? 6 : 3;
}

static inline int ed_is_rotation(const ed_model *model, int degree) /* of a node, or over all degrees */
{
  return degree % ed_degrees(model) >= model->dimension;
}

static inline const char *ed_degree_name(const ed_model *model, int degree) /* of a node, or over all degrees */
{
  static const char *const in_plane[] = {"ux", "uy", "rz"}, *const in_space[] = {"ux", "uy", "uz", "rx", "ry", "rz"};
  return model->dimension == 3 ? in_space[degree % 6] : in_plane[degree % 3];
}

/* From one node to another; returns the distance. */
double ed_between(const ed_model *model, int from, int to, double between[3]);
/* The same between the ends of what bends of a member; in a plane its rigid ends are not taken off `between`. */
double ed_between_faces(const ed_model *model, const ed_member *member, double between[3]);
/* What a displacement in plan of a node of a diaphragm is of its master's: 0 or 1, itself, and lever times the master's turn. */
typedef struct {
  int degree, turn; /* over all degrees; turn -1: none */
  double lever;
} ed_in_plan;
ed_in_plan ed_of_master(const ed_model *model, int degree);
/* Terms over degrees of nodes, of diaphragms put on their masters: replaces them, and returns how many there are then (at most twice as
 * many). */
int ed_put_on_masters(const ed_model *model, int n, int *degree, double *coefficient);

/* For all files that add to a model (model*.c). */
int ed_model_refuse(ed_model *model, int status, const char *format, ...); /* notes the message and returns the status */
/* 1 and a message if there is no such node or element, else 0. */
int ed_model_lacks_node(ed_model *model, int node);
int ed_model_lacks_element(ed_model *model, int element);
/* Room for one item more than `count`: where the items lie now, or NULL when out of memory. */
void *ed_model_grown(void *array, int count, size_t size);
void ed_copy_name(char *to, const char *from); /* ED_NAME characters, cut short if need be */

/* Appends a cleared item to an array of the model; returns from its caller when out of memory. */
#define ED_MODEL_APPEND(model, array, count)                                             \
  do {                                                                                   \
    void *room = ed_model_grown((model)->array, (model)->count, sizeof *(model)->array); \
    if (!room)                                                                           \
      return ed_model_refuse(model, ED_E_MEMORY, "out of memory");                       \
    (model)->array = room;                                                               \
    memset(&(model)->array[(model)->count], 0, sizeof *(model)->array);                  \
    (model)->count++;                                                                    \
  } while (0)

#endif
