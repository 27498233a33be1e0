/* What the files of the strut share: what it is made of, and its block. */
#ifndef ED_STRUT_PARTS_H
#define ED_STRUT_PARTS_H

#include "element/strut.h"

struct ed_strut {
  int parts;                     /* the bar, if there is one, then the beams */
  int unknowns;
  int finite;                    /* whether its sizes and stiffnesses are numbers */
  int driven;                    /* number of the driven degree: behind the unknowns */
  int end_rotation;              /* unknown, or -1: fixed */
  int middle;                    /* unknown: deflection of the middle */
  double end_stiffness;          /* rotational, of each end */
  double camber;
  double stiffness;              /* of the brace before any load */
  double nudge[ED_STRUT_MAX_UNKNOWNS]; /* a hundredth of the camber */
  double scale[ED_STRUT_MAX_UNKNOWNS]; /* makes moments forces */
  ed_element part[ED_STRUT_MAX_PARTS];
  int degree[ED_STRUT_MAX_PARTS][6]; /* unknown, driven, or negative: fixed */
};

/* In the block behind its head: elongation, force and stored energy of the last commit; whether the trial snapped through, and whether the
 * brace has broken; the shapes of the last commit and of the trial; the parts' blocks. */
enum {
  ELONGATION = ED_BLOCK_POINTS,
  FORCE,
  STORED,
  SNAPPED,
  BROKEN,    /* sum over the sections of the shares of their areas that had broken at the last commit */
  BREAKING,  /* some broke there */
  FRACTURED, /* a section has broken through */
  COMMITTED
};

static inline double *ed_strut_shape(const ed_strut *s, double *block)
{
  return block + COMMITTED + s->unknowns;
}

static inline int ed_strut_parts_at(const ed_strut *s)
{
  return COMMITTED + 2 * s->unknowns;
}

/* The tangent of the brace before any load condensed to its elongation, 0 where it has none. */
double ed_strut_initial_stiffness(const ed_strut *strut, double *block);
/* One equilibrium at an elongation, from the shape in the block. Returns a status. */
int ed_strut_equilibrate(const ed_strut *strut, double elongation, const double *layers, double *block, ed_element_control *control);

#endif
