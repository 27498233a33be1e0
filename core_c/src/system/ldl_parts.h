/* What the files of the L D L^T solver share. */
#ifndef ED_LDL_PARTS_H
#define ED_LDL_PARTS_H

#include "system/ldl.h"

#include <stddef.h>

enum { ED_LDL_LANES = 8 }; /* right sides that are solved side by side */

/* Consecutive columns with one pattern below them. Its front has `rows` rows, the first `width` of them are its columns. */
typedef struct {
  int first, width, rows;
  int parent;              /* block, -1: none */
  int children;            /* how many of the last updates on the stack are of its children */
  size_t index;            /* of its first row in `row_of` and in `place` */
  size_t panel;            /* of its first value in `l` */
  int entries, n_entries;  /* of the matrix in its columns: range of `from`, `to` */
} ed_ldl_block;

struct ed_ldl {
  int n, n_blocks;
  int *order, *inverse;    /* order[k]: column that is eliminated as the k-th */
  ed_ldl_block *block;     /* children before their parents */
  int *row_of;             /* rows of each front, in the order of elimination */
  int *place;              /* where a row below a block stands in the front of its parent */
  int *from;               /* entry of the matrix ... */
  size_t *to;              /* ... and where it goes in `l` */
  size_t panel_size, stack_size;
  int most_rows;           /* of a front */
  double *l, *d;           /* columns of L with 1 on the diagonal, rows x width a block, and D */
  double *scale;           /* n: diagonal terms */
  double *stack;           /* updates that wait for their parents */
  double *left, *right;    /* packed operands of a product */
  double *lanes, *gathered; /* right sides side by side */
  int vanished, n_vanished, negative;
};

/* Orders, finds blocks and their fronts. 0: out of memory. */
int ed_ldl_analyse(ed_ldl *ldl, int last, const int *column_start, const int *row);
#endif
