/* Matrices over the equations, of one sparse pattern, and where the terms of elements and dampers go in them. */
#ifndef ED_ASSEMBLY_H
#define ED_ASSEMBLY_H

#include "edcore.h"
#include "system/model.h"

typedef struct {
  int n;                         /* columns: the equations */
  int nnz;
  int *column_start, *row, *diagonal;
  int *scatter;                  /* ed_tangent_size a member, into values; nnz is a bin for fixed degrees */
  int *device_scatter;           /* n_terms x n_terms a device, into values */
  double *tangent;               /* nnz + 1: K at the trial state */
  double *initial;               /* nnz + 1: K of the unloaded structure */
  double *initial_damping;       /* nnz + 1: the same with the damping factors of the elements */
  double *damped;                /* nnz + 1: the same of the tangent, without softening of struts; NULL: as the tangent */
  long stamp;                    /* of the trial state's tangent */
  long assembled_stamp, damped_stamp; /* of `tangent` and `damped` */
} ed_matrices;

static inline size_t ed_tangent_size(const ed_model *model) /* terms of a member */
{
  const size_t degrees = 2 * (size_t)ed_degrees(model);
  return degrees * degrees;
}

int ed_build_pattern(ed_analysis *a);
void ed_matrices_free(ed_matrices *matrix);
/* Tangent of a member over the equations of its degrees, its state in `block`. */
void ed_member_tangent(const ed_analysis *a, int member, const double *block, double *tangent);
void ed_assemble_tangent(ed_analysis *a);
const double *ed_damping_tangent(ed_analysis *a); /* K of stiffness-proportional damping at the trial state */
void ed_multiply(const ed_matrices *matrix, const double *value, const double *x, double *y); /* symmetric, y = A x */

#endif
