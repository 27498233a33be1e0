/* Deformation of a damper over one step: a cubic in time. Laws see nothing else of the outside. */
#ifndef ED_PATH_H
#define ED_PATH_H

/* u(s) = c[0] + c[1] s + c[2] s^2 + c[3] s^3, 0 <= s <= h. A direction (derivative of a path to some unknown) has the same form. */
typedef struct {
  double h;
  double c[4];
} ed_path;

/* Cubic through deformation and velocity at both ends (Hermite). */
void ed_path_hermite(ed_path *path, double h, double u0, double v0, double u1, double v1);
/* Its derivatives to u1 and v1. */
void ed_path_hermite_directions(ed_path direction[2], double h);

static inline double ed_path_u(const ed_path *path, double s)
{
  const double *c = path->c;
  return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
}

static inline double ed_path_v(const ed_path *path, double s)
{
  const double *c = path->c;
  return c[1] + s * (2.0 * c[2] + s * 3.0 * c[3]);
}

/* Whether a path moves with the unknowns at all; histories ask for no derivatives. */
static inline int ed_path_moves(const ed_path direction[2])
{
  for (int j = 0; j < 2; j++)
    for (int i = 0; i < 4; i++)
      if (direction[j].c[i] != 0.0)
        return 1;
  return 0;
}

/* The piece from s0 to s1, in its own time 0..s1-s0. */
void ed_path_piece(const ed_path *path, double s0, double s1, ed_path *piece);

/* Places in the open interval (0, h) where v changes sign, ascending; returns how many. Touching zero does not count. */
int ed_path_reversals(const ed_path *path, double at[2]);
/* Where u(s) is at a level, between two places from one to the other of which it is monotone and passes the level. */
double ed_path_crossing(const ed_path *path, double u, double from, double to);

#endif
