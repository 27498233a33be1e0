/* In which order a sparse symmetric matrix is eliminated, and what of its factor is not zero. */
#ifndef ED_ELIMINATION_H
#define ED_ELIMINATION_H

#include <stddef.h>

/* Columns of the factor with (almost) the same rows follow one another and make a supernode, which is stored densely. A supernode is
 * preceded by all whose elimination changes it. */
typedef struct {
  int n, supernodes;
  int *order;        /* n: equation that is eliminated k-th */
  int *number;       /* n: place of each equation in `order` */
  int *first;        /* supernodes + 1: its columns, as numbers in `order` */
  int *parent;       /* supernodes: that of its first row below, -1: none */
  size_t *row_start; /* supernodes + 1: its rows below its own columns */
  int *row;          /* numbers in `order`, rising */
  int *in_parent;    /* of each row: its place among the parent's columns, or among the parent's rows below */
  int *shared;       /* supernodes: how many of its rows are columns of the parent */
} ed_elimination;

/* Pattern in compressed columns, both triangles. The last `n_last` equations come last of those that they depend on. NULL: out of
 * memory. */
ed_elimination *ed_elimination_new(int n, int n_last, const int *column_start, const int *row);
void ed_elimination_free(ed_elimination *elimination);

static inline int ed_width(const ed_elimination *e, int supernode)
{
  return e->first[supernode + 1] - e->first[supernode];
}

static inline int ed_height(const ed_elimination *e, int supernode) /* below its own columns */
{
  return (int)(e->row_start[supernode + 1] - e->row_start[supernode]);
}

#endif
