/* Factors of the effective matrix k K + m M + c C, and those of earlier states that can be had again. */
#ifndef ED_FACTORS_H
#define ED_FACTORS_H

#include "edcore.h"
#include "system/solver.h"

/* What it takes to have factors again. */
typedef struct {
  int valid;
  double *matrix;                /* nnz */
  double *device_slope;          /* n_devices, and as many of bearings to what they do across */
  double k, m, c;
} ed_kept_factors;

typedef struct {
  ed_solver *solver;
  double *effective;             /* nnz + 1: what the factors are of */
  long stamp;                    /* of the tangent in them, -1: none */
  double k, m, c;
  double *device_slope;          /* slope of each device that is in them */
  ed_kept_factors kept;          /* of the last commit, once others have replaced them */
  ed_kept_factors backed;        /* of ed_backup */
  double price;                  /* of a factorisation, in iterations */
} ed_factors;

int ed_factors_allocate(ed_analysis *a);
void ed_factors_free(ed_factors *factors);
int ed_factor_effective(ed_analysis *a, double k, double m, double c);
int ed_solve_effective(ed_analysis *a, int count, double *x); /* count x n right sides, solved together */
void ed_note_factors(const ed_analysis *a, ed_kept_factors *to);
void ed_keep_factors(ed_analysis *a); /* before others replace those of the last commit */
void ed_restore_factors(ed_analysis *a);

#endif
