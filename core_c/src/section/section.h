/* Sections: elastic, or fibres merged into layers. */
#ifndef ED_SECTION_H
#define ED_SECTION_H

#include "material/steel.h"

enum { ED_LANES = 8 }; /* layer arrays are padded to a multiple of this */

/* Response of a section at a deformation (e0, kappa). */
typedef struct {
  double N, M;
  double k11, k12, k22; /* dN/de0, dN/dkappa = dM/de0, dM/dkappa */
  int elastic;          /* no layer yields: the tangent is the initial one */
} ed_section_response;

typedef struct {
  int elastic;          /* 1: EA and EI only, no layers */
  int n;                /* layers */
  int n_padded;
  int vector;           /* every law is bilinear or elastic: the vector kernel serves */
  int state_size;       /* doubles a section of this kind keeps */
  double k11, k12, k22; /* initial stiffness */
  double depth;         /* largest |y| */
  double yield_strain;  /* smallest of the layers */
  const ed_steel **steel; /* n */
  int *state_offset;    /* n, into the section's state */
  double *y, *area;     /* n_padded; padding has area 0 */
  double *E, *EH, *fy, *hardening, *flow; /* n_padded: E, E+H, fy, b, E/(E+H) */
  double *Ay, *EA, *EAy, *EAyy;
  void *block;          /* owns the arrays */
} ed_section;

/* Merges fibres of one depth and law (indices into `steels`); returns 0 when memory ran out. The laws must stay in place. */
int ed_section_from_fibres(ed_section *section, int n, const double *y, const double *area, const int *material,
                           const ed_steel *steels);
void ed_section_elastic(ed_section *section, double EA, double EI);
void ed_section_free(ed_section *section);

void ed_section_trial(const ed_section *section, const double *state, double e0, double kappa,
                      ed_section_response *response);
/* Moves the layers to (e0, kappa); the return is the energy a unit length dissipated. */
double ed_section_commit(const ed_section *section, double *state, double e0, double kappa);
/* Recoverable energy a unit length at (e0, kappa), where the state has been committed. */
double ed_section_stored(const ed_section *section, const double *state, double e0, double kappa);
void ed_section_layer(const ed_section *section, const double *state, int layer, double e0, double kappa,
                      double *stress, double *strain);

#endif
