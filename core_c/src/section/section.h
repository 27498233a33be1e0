/* Sections: elastic, or fibres merged into layers. */
#ifndef ED_SECTION_H
#define ED_SECTION_H

#include "material/menegotto_pinto.h"
#include "material/steel.h"

enum { ED_LANES = 8 }; /* layer arrays are padded to a multiple of this */

/* Response of a section at a deformation (e0, kappa). */
typedef struct {
  double N, M;
  double k11, k12, k22; /* dN/de0, dN/dkappa = dM/de0, dM/dkappa */
  int elastic;          /* no layer yields: the tangent is the initial one */
  double reach;         /* change of strain of any layer up to which no stress leaves its tangent by more than 1e-12 of yield */
} ed_section_response;

/* Each kind of law is evaluated over all layers, where those of another law have no area. */
typedef struct {
  int elastic;          /* 1: EA and EI only, no layers */
  int n;                /* layers */
  int n_padded;
  int straight;         /* some laws are bilinear or elastic */
  int curved;           /* some laws are Menegotto-Pinto's */
  int fatigue;          /* layers may break: where the state keeps their intact areas and their damage; 0: they do not */
  int state_size;       /* doubles a section of this kind keeps */
  int record_size;      /* doubles of a trial that its commit can use; 0: none */
  double k11, k12, k22; /* initial stiffness */
  double depth;         /* largest |y| */
  double stiffest;      /* largest E of the layers */
  double yield_strain;  /* smallest of the layers; 0 where a law is never straight */
  const ed_steel **steel; /* n */
  double *y, *area;     /* n_padded; padding has area 0 */
  double *E, *EH, *fy, *hardening, *flow; /* straight laws: E, E+H, fy, b, E/(E+H) */
  double *A, *Ay, *EA, *EAy, *EAyy;       /* of straight layers */
  double *curved_area;
  ed_menegotto_pinto menegotto_pinto;
  void *block;          /* owns the arrays */
} ed_section;

/* Merges fibres of one depth and law (indices into `steels`); returns 0 when memory ran out. The laws must stay in place. */
int ed_section_from_fibres(ed_section *section, int n, const double *y, const double *area, const int *material,
                           const ed_steel *steels);
void ed_section_elastic(ed_section *section, double EA, double EI);
void ed_section_free(ed_section *section);

/* The state before any deformation. */
void ed_section_initialise(const ed_section *section, double *state);
/* Whether the layers may be in this state of finite numbers. */
int ed_section_state_valid(const ed_section *section, const double *state);

/* `record`: what a commit can use, or NULL. */
void ed_section_trial(const ed_section *section, const double *state, double e0, double kappa, double *record,
                      ed_section_response *response);
/* Moves the layers to (e0, kappa); the return is the energy a unit length dissipated. `record`: of a trial from this state within whose
 * reach (e0, kappa) is, or NULL. */
double ed_section_commit(const ed_section *section, double *state, double e0, double kappa, const double *record);
/* Recoverable energy a unit length at (e0, kappa), to which the state has been committed. */
double ed_section_stored(const ed_section *section, const double *state, double e0, double kappa);
/* Largest damage of a layer, 1 where one has broken, and the share of the area that has broken; both 0 where layers do not break. */
double ed_section_damage(const ed_section *section, const double *state);
double ed_section_broken_share(const ed_section *section, const double *state);
void ed_section_layer(const ed_section *section, const double *state, int layer, double e0, double kappa,
                      double *stress, double *strain);

#endif
