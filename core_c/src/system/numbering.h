/* Equations of the free degrees: which degree each belongs to, what moves with it. */
#ifndef ED_NUMBERING_H
#define ED_NUMBERING_H

#include "system/model.h"

typedef struct {
  int n;                         /* equations */
  int *equation;                 /* 3 n_nodes: -1 where supported */
  int n_supports;                /* supported degrees, tied ones counted once */
  int *support;                  /* 3 n_nodes: number of a supported degree, -1 where free */
  double *mass;                  /* n */
  double *influence[2];          /* n: 1 where the equation moves with the ground along x, y */
  double length;                 /* mean element length: makes moments comparable with forces */
  int *rotational;               /* n */
  double *scale;                 /* n: 1, or 1 / length where rotational */
  int *name;                     /* n: degree (3 node + d) that names the equation */
} ed_numbering;

int ed_number(ed_analysis *a);
int ed_set_length(ed_numbering *numbering, double length); /* ED_OK, ED_E_MEMORY */
void ed_numbering_free(ed_numbering *numbering);
/* node.ux, node.uy or node.rz; "?" where there is no such equation */
const char *ed_equation_name(const ed_model *model, const ed_numbering *numbering, int equation, char *buffer, int size);

#endif
