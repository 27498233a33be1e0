/* Rayleigh damping on the initial, committed or current stiffness, and modal damping. */
#ifndef ED_DAMPING_H
#define ED_DAMPING_H

#include "edcore.h"

typedef struct {
  double rayleigh_mass, rayleigh_stiffness;
  int rayleigh_kind;
  double *reference;             /* nnz + 1: K that Rayleigh damping uses when it is not the current one */
  int frozen;                    /* this attempt damps with the committed stiffness */
  int n_modal;
  double *modal;                 /* n_modal x n: M phi scaled so that C = sum m m' */
  double *modal_solved;          /* n_modal x n: A^-1 m */
  double *modal_small;           /* n_modal x n_modal factors of 1/c + m' A^-1 m */
  int *modal_pivot;
} ed_damping;

void ed_damping_free(ed_damping *damping);
const double *ed_damping_stiffness(ed_analysis *a); /* that damping is proportional to in this attempt */
void ed_damping_force(ed_analysis *a, const double *v, double *force);
void ed_freeze_damping(ed_analysis *a, int fallback);
/* The part of modal damping in the factors of the effective matrix, and in solutions with them. */
int ed_factor_modal(ed_analysis *a, double c);
void ed_damp_solution(ed_damping *damping, int n, double *x, double *work);

#endif
