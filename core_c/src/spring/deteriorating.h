/* The modified Ibarra-Medina-Krawinkler law with bilinear hysteresis (Ibarra, Medina & Krawinkler 2005; Lignos & Krawinkler 2011).
 *
 * Forces are bounded on each side by a line of hardening, one after capping and a residual strength; between the bounds they follow
 * the unloading stiffness. Strength deteriorates where the force passes zero, on the side that is loaded next; the unloading stiffness
 * where the path leaves a bound. Once the ultimate deformation is reached or the energy is used up, nothing is carried from the next
 * step on; within a step the force stays continuous, so that iterations settle. */
#ifndef ED_DETERIORATING_H
#define ED_DETERIORATING_H

/* One side; deformations and forces are positive along it. */
typedef struct {
  double plastic;    /* deformation from yield to capping */
  double capping;    /* deformation from capping to no force */
  double ultimate;   /* deformation */
  double yield;      /* force */
  double capped;     /* force at capping / yield force, >= 1 */
  double residual;   /* force / yield force */
  double rate;       /* D, of deterioration */
} ed_deteriorating_side;

enum { ED_DETERIORATE_STRENGTH, ED_DETERIORATE_CAPPING, ED_DETERIORATE_UNLOADING, ED_DETERIORATIONS };

typedef struct {
  double stiffness;
  ed_deteriorating_side side[2];       /* for positive, for negative forces */
  double capacity[ED_DETERIORATIONS];  /* energy; HUGE_VAL: no deterioration */
  double exponent[ED_DETERIORATIONS];
} ed_deteriorating;

enum { ED_DETERIORATING_STATE = 17 };

void ed_deteriorating_initialise(const ed_deteriorating *law, double *state);
int ed_deteriorating_valid(const double *state);
/* Force and tangent at a deformation. */
void ed_deteriorating_trial(const ed_deteriorating *law, const double *state, double deformation, double *force, double *tangent);
/* Moves the state; the return is the energy dissipated on the way. Where the unloading stiffness falls, what is stored
 * rises, and the return may be negative. */
double ed_deteriorating_commit(const ed_deteriorating *law, double *state, double deformation);
double ed_deteriorating_stored(const double *state);
/* What is left of the yield force of the weaker side, 0..1. */
double ed_deteriorating_left(const ed_deteriorating *law, const double *state);

#endif
