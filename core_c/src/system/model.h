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

typedef struct {
  char name[ED_NAME];
  double x, y;
  double mass[3];
  int fixed[3];
  int master[3]; /* node whose degree this one shares, or -1 */
} ed_node;

typedef struct {
  char name[ED_NAME];
  ed_element_kind kind;
  int node[2];
  int geometry;
  int release[2];
  int points;                   /* fibre beam, of each piece; strut */
  int section[ED_MAX_RULE];     /* beams; ids */
  int breaks;                   /* fibre beam: it is integrated piece by piece between these places */
  double break_at[ED_MAX_POINTS]; /* 0..1, rising */
  int material;                 /* truss, strut */
  double area;                  /* truss, strut */
  int elements;                 /* strut: beams over its buckling length */
  double camber, buckling_length; /* strut: camber / buckling length, buckling length / length */
  double end_stiffness;         /* strut: rotational, of its ends; HUGE_VAL: fixed */
  double rigid[2];              /* beams: lengths of their rigid ends */
  double stiffness[3], angle;   /* link */
  int spring;                   /* spring; index */
  double coefficient[6];        /* spring */
  double without[2];            /* elastic beam: flexibility that its ends leave out */
  double damping_factor;        /* of stiffness-proportional damping */
  int loaded;
} ed_member;

typedef struct {
  int pattern, node;
  double force[3];
} ed_nodal_load;

typedef struct {
  int pattern, element;
  double position; /* of a point load or where a partial one begins, 0..1; -1: uniform */
  double axial, transverse;
  double end, transverse_end; /* partial load, linear from `transverse` to this; end > position */
} ed_member_load;

/* A damper in the frame: its deformation is the sum of coefficient * displacement of the degrees, and its force acts on them. */
enum { ED_MAX_TERMS = 12 };
typedef struct {
  char name[ED_NAME];
  ed_damper damper;             /* its brace is in the law's units, as if the device had the size of the law */
  double force_scale, deformation_scale; /* F = force_scale * law(deformation_scale * u) */
  int axial_spring;             /* spring by whose axial force its own goes in histories; -1: none */
  double weight;                /* compression of that spring at which it has the force of its law */
  int carries;                  /* it acts from the beginning, under loads that come before ed_install_dampers too */
  int n_terms;
  int degree[ED_MAX_TERMS];     /* 3 node + d */
  double coefficient[ED_MAX_TERMS];
} ed_device;

struct ed_model {
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
