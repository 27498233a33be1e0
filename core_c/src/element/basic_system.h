/* The basic system of beams that bend about one axis or two, and where its numbers lie in their blocks. */
#ifndef ED_BASIC_SYSTEM_H
#define ED_BASIC_SYSTEM_H

#include "base/lanes.h"
#include "base/symmetric.h"
#include "section/section.h"

enum { ED_MAX_BASIC = 5, ED_MAX_BASIC_TERMS = 15 };

/* Numbers of the basic system and of a section by how many axes they bend about. */
static inline int ed_basic(int axes)
{
  return 1 + 2 * axes;
}

static inline int ed_basic_terms(int axes)
{
  return ed_basic(axes) * (ed_basic(axes) + 1) / 2;
}

/* Offsets in the block of what bends in one plane, or not at all. */
enum { ED_BLOCK_V = 0, ED_BLOCK_Q = 3, ED_BLOCK_K = 6, ED_BLOCK_REFERENCE = 12, ED_BLOCK_INELASTIC = 13, ED_BLOCK_POINTS = 14 };
/* The same by axes. */
static inline int ed_block_q(int axes)
{
  return ed_basic(axes);
}

static inline int ed_block_k(int axes)
{
  return 2 * ed_basic(axes);
}

static inline int ed_block_reference(int axes)
{
  return ed_block_k(axes) + ed_basic_terms(axes);
}

static inline int ed_block_inelastic(int axes)
{
  return ed_block_reference(axes) + 1;
}

static inline int ed_block_twist(int axes) /* in space alone */
{
  return ed_block_inelastic(axes) + 1;
}

static inline int ed_block_points(int axes)
{
  return ed_block_inelastic(axes) + axes;
}

_Static_assert(ED_BLOCK_POINTS == 14 && ED_BLOCK_K == 6, "ed_block_points(ED_PLANE), ed_block_k(ED_PLANE)");

/* A point: deformations, forces, tangent, then elastic in this trial, some layer has yielded before, what is left of the reach of its
 * tangent. Offsets by axes; the deformations come first. */
static inline int ed_point_s(int axes)
{
  return 1 + axes;
}

static inline int ed_point_k(int axes)
{
  return 2 * (1 + axes);
}

static inline int ed_point_elastic(int axes)
{
  return ed_point_k(axes) + ed_section_terms(axes);
}

static inline int ed_point_inelastic(int axes)
{
  return ed_point_elastic(axes) + 1;
}

static inline int ed_point_reach(int axes)
{
  return ed_point_elastic(axes) + 2;
}

static inline int ed_point_size(int axes)
{
  return ed_point_elastic(axes) + 3;
}

static inline int ed_point_at(int axes, int point) /* in the block */
{
  return ed_block_points(axes) + point * ed_point_size(axes);
}


/* Term of b in the row of a moment: of the rotation at i (end 0) or at j. */
ED_INLINE double ed_share(double x, int end)
{
  return end ? x : x - 1.0;
}

/* b' f b of a section at x, times w, added to the flexibility of the basic system. */
ED_INLINE void ed_add_flexibility(double *F, const double *f, double x, double w, const int axes)
{
  const int rows = ed_basic(axes);
  for (int i = 0; i < rows; i++)
    for (int j = i; j < rows; j++) {
      double term = w * f[ed_sym_place(1 + axes, (i + 1) / 2, (j + 1) / 2)];
      if (i > 0)
        term *= ed_share(x, (i + 1) % 2);
      if (j > 0)
        term *= ed_share(x, (j + 1) % 2);
      F[ed_sym_place(rows, i, j)] += term;
    }
}

#endif
