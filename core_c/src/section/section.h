/* Sections: elastic, or fibres merged into layers. */
#ifndef ED_SECTION_H
#define ED_SECTION_H

#include "base/symmetric.h"
#include "material/menegotto_pinto.h"
#include "material/steel.h"

enum { ED_LANES = 8 }; /* layer arrays are padded to a multiple of this */

/* A section bends in one plane or in two. Its deformations are e0, kappa_z and, in two, kappa_y: the strain at (y, z) is e0 - kappa_z y +
 * kappa_y z. Its forces are N, M_z and M_y, work conjugate. */
enum { ED_PLANE = 1, ED_SPACE = 2, ED_MAX_RESULTANTS = 1 + ED_SPACE, ED_MAX_SECTION_TERMS = 6 };

static inline int ed_section_terms(int axes) /* of a symmetric matrix of forces */
{
  return (1 + axes) * (2 + axes) / 2;
}

/* Response of a section at a deformation. */
typedef struct {
  double force[ED_MAX_RESULTANTS];
  double k[ED_MAX_SECTION_TERMS]; /* tangent, symmetric: 00 01 11 in one plane, 00 01 02 11 12 22 in two */
  int elastic;          /* no layer yields: the tangent is the initial one */
  double reach;         /* change of strain of any layer up to which no stress leaves its tangent by more than 1e-12 of yield */
} ed_section_response;

/* Each kind of law is evaluated over all layers, where those of another law have no area. */
typedef struct {
  int axes;             /* ED_PLANE, ED_SPACE */
  int elastic;          /* 1: EA and EI only, no layers */
  int n;                /* layers */
  int n_padded;
  int straight;         /* some laws are bilinear or elastic */
  int curved;           /* some laws are Menegotto-Pinto's */
  int fatigue;          /* layers may break: where the state keeps their intact areas and their damage; 0: they do not */
  int state_size;       /* doubles a section of this kind keeps */
  int record_size;      /* doubles of a trial that its commit can use; 0: none */
  double k[ED_MAX_SECTION_TERMS]; /* initial stiffness */
  double torsion;       /* GJ, in two planes */
  double depth, width;  /* largest |y|, |z| */
  double stiffest;      /* largest E of the layers */
  double yield_strain;  /* smallest of the layers; 0 where a law is never straight */
  const ed_steel **steel; /* n */
  double *plastic;      /* n plastic strains before any deformation; NULL: none */
  double locked;        /* energy a unit length that their stresses store */
  double *y, *z, *area; /* n_padded; padding has area 0; z is NULL in one plane */
  double *E, *EH, *fy, *hardening, *flow; /* straight laws: E, E+H, fy, b, E/(E+H) */
  double *A, *Ay, *EA, *EAy, *EAyy;       /* of straight layers */
  double *Az, *EAz, *EAyz, *EAzz;         /* in two planes */
  double *curved_area;
  ed_menegotto_pinto menegotto_pinto;
  void *block;          /* owns the arrays */
} ed_section;

/* Merges fibres of one place, law (indices into `steels`) and initial stress; z is NULL for a section in one plane, stress without any.
 * Returns 0 when memory ran out. The laws must stay in place. */
int ed_section_from_fibres(ed_section *section, int n, const double *y, const double *z, const double *area, const int *material,
                           const double *stress, const ed_steel *steels);
/* stiffness: EA, EI_z and in two planes EI_y */
void ed_section_elastic(ed_section *section, int axes, const double *stiffness);
void ed_section_free(ed_section *section);
/* Whether it has bending stiffness: relative, the determinant of its stiffness. */
int ed_section_bends(const ed_section *section);

/* The state before any deformation. */
void ed_section_initialise(const ed_section *section, double *state);
/* Whether the layers may be in this state of finite numbers. */
int ed_section_state_valid(const ed_section *section, const double *state);

/* `record`: what a commit can use, or NULL. */
void ed_section_trial(const ed_section *section, const double *state, const double *deformation, double *record,
                      ed_section_response *response);
/* Moves the layers to a deformation; the return is the energy a unit length dissipated. `record`: of a trial from this state within whose
 * reach the deformation is, or NULL. */
double ed_section_commit(const ed_section *section, double *state, const double *deformation, const double *record);
/* Recoverable energy a unit length at a deformation, to which the state has been committed, less that of the initial stresses. */
double ed_section_stored(const ed_section *section, const double *state, const double *deformation);
/* Largest damage of a layer, 1 where one has broken, and the share of the area that has broken; both 0 where layers do not break. */
double ed_section_damage(const ed_section *section, const double *state);
double ed_section_broken_share(const ed_section *section, const double *state);
void ed_section_layer(const ed_section *section, const double *state, int layer, const double *deformation, double *stress, double *strain);

#endif
