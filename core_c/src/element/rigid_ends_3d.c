/* Rigid ends of members in space: arms of any direction from the nodes to the ends between which the member bends.
 *
 * Such a face moves by u + R(t) r - r, with the arm r and the rotation vector t of the node: exactly with corotational geometry, else to the
 * first order, u + t x r. A force F at the face then acts on the node along the slope of F R(t) r by t. P-Delta adds the second order of
 * this: with R r = r + t x r + t x (t x r) / 2 the moment (F (t r) + r (F t)) / 2 - (F r) t, which for a turn about an axis across F and r is
 * the moment N a t of rigid_ends.c. Of R = 1 + a [t] + b [t]^2 (Rodrigues), a and b by s = t t,
 *     F R(t) r = (1 - b s) (F r) + a t (r x F) + b (F t) (r t).
 */
#include "element/element.h"

#include <math.h>
#include <string.h>

static double dot(const double *a, const double *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *c)
{
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Slope of F R(t) r by t. */
static void slope_of_arm(const double *r, const double *F, const double *t, double *slope)
{
  double a[3], b[3], moment[3];
  const double s = dot(t, t), Ft = dot(F, t), rt = dot(r, t);
  ed_rotation_factors(s, a, b);
  cross(r, F, moment);
  const double by_t = -2.0 * dot(F, r) * (b[0] + b[1] * s) + 2.0 * a[1] * dot(t, moment) + 2.0 * b[1] * Ft * rt;
  for (int i = 0; i < 3; i++)
    slope[i] = by_t * t[i] + a[0] * moment[i] + b[0] * (F[i] * rt + r[i] * Ft);
}

/* Second slope of F R(t) r. */
static void bend_of_arm(const double *r, const double *F, const double *t, double bend[3][3])
{
  double a[3], b[3], moment[3], product[3];
  const double s = dot(t, t), Ft = dot(F, t), rt = dot(r, t), Fr = dot(F, r);
  ed_rotation_factors(s, a, b);
  cross(r, F, moment);
  const double tm = dot(t, moment), h = Ft * rt;
  const double of_unit = -2.0 * Fr * (b[0] + b[1] * s) + 2.0 * a[1] * tm + 2.0 * b[1] * h;
  const double of_t = 4.0 * (-Fr * (2.0 * b[1] + b[2] * s) + a[2] * tm + b[2] * h);
  for (int i = 0; i < 3; i++)
    product[i] = F[i] * rt + r[i] * Ft;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      bend[i][j] = (i == j ? of_unit : 0.0) + of_t * t[i] * t[j] + 2.0 * a[1] * (t[i] * moment[j] + moment[i] * t[j]) +
                   b[0] * (F[i] * r[j] + r[i] * F[j]) + 2.0 * b[1] * (t[i] * product[j] + product[i] * t[j]);
}

static const double NO_TURN[3] = {0.0, 0.0, 0.0};

/* The turn about which arms are linear: none but of corotational geometry. */
static const double *turn_of(const ed_element *e, const double *d, int end)
{
  return e->geometry == ED_COROTATIONAL ? d + 6 * end + 3 : NO_TURN;
}

void ed_rigid_faces_3d(const ed_element *e, const double *d, double *face)
{
  memcpy(face, d, ED_MAX_DEGREES * sizeof *face);
  for (int end = 0; end < 2; end++) {
    const double *t = d + 6 * end + 3, *r = e->offset[end];
    double turned[3], again[3], a[3] = {1.0}, b[3] = {0.0};
    if (e->geometry == ED_COROTATIONAL)
      ed_rotation_factors(dot(t, t), a, b);
    cross(t, r, turned);
    cross(t, turned, again);
    for (int i = 0; i < 3; i++)
      face[6 * end + i] += a[0] * turned[i] + b[0] * again[i];
  }
}

void ed_tip_force(const ed_element *e, int end, const double *arm_moment, double tip[3])
{
  for (int i = 0; i < 3; i++)
    tip[i] = e->arm[end] != 0.0 ? arm_moment[i] / e->arm[end] : 0.0;
}

/* Local components in global axes. */
static void to_global(const ed_element *e, const double *local, double *global)
{
  for (int i = 0; i < 3; i++)
    global[i] = e->axis[0][i] * local[0] + e->axis[1][i] * local[1] + e->axis[2][i] * local[2];
}

/* Force of what bends on the tip of an arm, less that of the loads on the arm. */
static void force_on_arm(const ed_element *e, int end, const double *force, double *on_arm)
{
  double tip[3], load[3];
  ed_tip_force(e, end, e->arm_moment[end], tip);
  to_global(e, tip, load);
  for (int i = 0; i < 3; i++)
    on_arm[i] = force[6 * end + i] - load[i];
}

void ed_rigid_second_order_3d(const ed_element *e, const double *d, const double *block, double moment[6], double rotation[6])
{
  double face[ED_MAX_DEGREES], force[ED_MAX_DEGREES];
  memset(moment, 0, 6 * sizeof *moment);
  for (int i = 0; i < 6; i++)
    rotation[i] = d[i < 3 ? 3 + i : 6 + i];
  if (e->geometry != ED_P_DELTA)
    return;
  ed_rigid_faces_3d(e, d, face);
  ed_face_forces_3d(e, face, block, force);
  for (int end = 0; end < 2; end++) {
    double F[3], bend[3][3];
    force_on_arm(e, end, force, F);
    bend_of_arm(e->offset[end], F, NO_TURN, bend);
    for (int i = 0; i < 3; i++)
      moment[3 * end + i] = dot(bend[i], rotation + 3 * end);
  }
}

void ed_rigid_forces_3d(const ed_element *e, const double *d, const double *block, double *force)
{
  double face[ED_MAX_DEGREES];
  ed_rigid_faces_3d(e, d, face);
  ed_face_forces_3d(e, face, block, force);
  for (int end = 0; end < 2; end++) {
    double F[3], load[3], slope[3], bend[3][3], *f = force + 6 * end;
    force_on_arm(e, end, force, F);
    slope_of_arm(e->offset[end], F, turn_of(e, d, end), slope);
    if (e->geometry == ED_P_DELTA)
      bend_of_arm(e->offset[end], F, NO_TURN, bend);
    to_global(e, e->arm_force[end], load);
    for (int i = 0; i < 3; i++) {
      f[3 + i] += slope[i] + (e->geometry == ED_P_DELTA ? dot(bend[i], d + 6 * end + 3) : 0.0);
      f[i] -= load[i];
    }
  }
}

void ed_rigid_tangent_3d(const ed_element *e, const double *d, const double *block, double *k)
{
  enum { N = ED_MAX_DEGREES };
  double face[N], force[N];
  ed_rigid_faces_3d(e, d, face);
  ed_face_forces_3d(e, face, block, force);
  ed_face_tangent_3d(e, face, block, k);
  /* K B, then B' K B; B adds to the columns of the rotations what the faces move by */
  for (int end = 0; end < 2; end++) {
    const int at = 6 * end;
    double by[3][3], F[3], bend[3][3]; /* by[i][j]: how face displacement i changes with rotation j */
    for (int i = 0; i < 3; i++)
      slope_of_arm(e->offset[end], (double[3]){i == 0, i == 1, i == 2}, turn_of(e, d, end), by[i]);
    for (int row = 0; row < N; row++)
      for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
          k[N * row + at + 3 + j] += k[N * row + at + i] * by[i][j];
    for (int column = 0; column < N; column++)
      for (int j = 0; j < 3; j++)
        for (int i = 0; i < 3; i++)
          k[N * (at + 3 + j) + column] += k[N * (at + i) + column] * by[i][j];
    if (e->geometry == ED_LINEAR)
      continue;
    force_on_arm(e, end, force, F);
    bend_of_arm(e->offset[end], F, turn_of(e, d, end), bend);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++)
        k[N * (at + 3 + i) + at + 3 + j] += bend[i][j];
  }
}
