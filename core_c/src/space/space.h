/* Linear elastic space frames: what the files of this directory share. */
#ifndef ED_SPACE_H
#define ED_SPACE_H

#include "edcore.h"
#include "space/cholesky.h"
#include "space/member.h"

#include <stddef.h>

enum { ED_SPACE_NAME = 48, ED_SPACE_MESSAGE = 1024 };
enum { ED_SPACE_PLACES = 144 }; /* of a member's matrix, row by row */

typedef struct {
  char name[ED_SPACE_NAME];
  double x[3];
  int floor;        /* -1: none */
  double dx, dy;    /* from the floor's master */
  int fixed[6];
  int left_out[6];  /* nothing resists it and nothing needs it */
  double spring[6];
  int equation[6];  /* of what the degree is, or of what it follows: ux of a node of a floor has that of the master */
} ed_space_node;

typedef struct {
  double x, y;
  int first;       /* its first node, which it is named by */
  int equation[3]; /* Ux, Uy, Rz; -1: restrained */
  int support[3];   /* node that restrains it, -1: none */
} ed_space_floor;

struct ed_space {
  int n_nodes, n_floors, n_members;
  int n; /* equations */
  ed_space_node *node;
  ed_space_floor *floor;
  ed_space_member *member;
  char (*member_name)[ED_SPACE_NAME];
  int *name;                    /* n: degree (6 node + direction, then 6 n_nodes + 3 floor + direction) of each equation */
  int *column_start, *row, *diagonal; /* compressed columns */
  int nnz;
  int *place;                   /* ED_SPACE_PLACES a member, in `matrix`; nnz: nowhere */
  int n_springs;                /* terms of springs in the matrix */
  int *spring_place;
  double *spring_value;
  double *matrix;               /* nnz + 1 */
  ed_space_stiffness *stiffness; /* n_members: what is being assembled */
  double *saved;                /* properties before a change */
  double length;                /* mean of the members */
  double *scale;                /* n: 1 of displacements, 1 / length of rotations */
  double *work;                 /* n */
  ed_cholesky *factors;
  char message[ED_SPACE_MESSAGE];
};

int ed_space_fail(ed_space *space, int status, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* numbering.c */
int ed_space_number(ed_space *space);
int ed_space_check_connected(ed_space *space);
const char *ed_space_degree_name(const ed_space *space, int equation, char *buffer, int size);
/* assembly.c */
int ed_space_build_pattern(ed_space *space);
void ed_space_assemble(ed_space *space, int springs, double *matrix); /* of what is in `stiffness` */
int ed_space_factor(ed_space *space);
/* Forces at nodes (n_nodes x 6) over the equations (n), and back: displacements of nodes. */
void ed_space_reduce(const ed_space *space, const double *nodal, double *right_side);
void ed_space_spread(const ed_space *space, const double *solution, double *displacements);

#endif
