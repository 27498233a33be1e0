/* Members in space: small rotations, linear and P-Delta; of finite ones (corotational_3d.c) what loads add at the ends. Rows of the basic system over the
 * displacements u and rotations r of its ends, with the local axes x, y, z and the length L:
 *     elongation         x (u_j - u_i)
 *     rotation about z   z r - y (u_j - u_i) / L     at i, at j
 *     rotation about y   y r + z (u_j - u_i) / L     at i, at j
 *     twist              x (r_j - r_i)
 * P-Delta adds N / L times the drift along y and along z. */
#include "element/element.h"

#include <string.h>

enum { U_I = 0, R_I = 3, U_J = 6, R_J = 9 };

static double dot(const double *a, const double *b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void ed_face_kinematics_3d(const ed_element *e, const double *d, ed_kinematics *k)
{
  const double apart[3] = {d[U_J] - d[U_I], d[U_J + 1] - d[U_I + 1], d[U_J + 2] - d[U_I + 2]};
  k->drift[0] = dot(e->axis[1], apart);
  k->drift[1] = dot(e->axis[2], apart);
  if (e->geometry == ED_COROTATIONAL) {
    ed_corotational_kinematics_3d(e, d, k);
    return;
  }
  k->l = e->length;
  k->v[0] = dot(e->axis[0], apart);
  const double chord_z = k->drift[0] / e->length, chord_y = -k->drift[1] / e->length;
  for (int end = 0; end < 2; end++) {
    const double *r = d + (end ? R_J : R_I);
    k->v[1 + end] = dot(e->axis[2], r) - chord_z;
    k->v[3 + end] = dot(e->axis[1], r) - chord_y;
  }
  k->twist = dot(e->axis[0], d + R_J) - dot(e->axis[0], d + R_I);
}

/* Adds local components, times a factor, along the global axes. */
static void add_global(const ed_element *e, const double *local, double factor, double *global)
{
  for (int i = 0; i < 3; i++)
    global[i] += factor * (e->axis[0][i] * local[0] + e->axis[1][i] * local[1] + e->axis[2][i] * local[2]);
}

void ed_face_forces_3d(const ed_element *e, const double *d, const double *block, double *force)
{
  if (e->kind == ED_SPRING) {
    for (int i = 0; i < e->degrees; i++)
      force[i] = e->member->coefficient[i] * block[ED_BLOCK_Q];
    return;
  }
  memset(force, 0, ED_MAX_DEGREES * sizeof *force);
  /* loads keep their direction; the mean of axial ones along the turned chord is that of geometry.c */
  const double turned = e->geometry == ED_COROTATIONAL ? e->mean_axial : 0.0;
  add_global(e, (double[3]){e->end_load[0] + turned, e->end_load[1], e->end_load[3]}, 1.0, force + U_I);
  add_global(e, (double[3]){-turned, e->end_load[2], e->end_load[4]}, 1.0, force + U_J);
  if (e->geometry == ED_COROTATIONAL) {
    ed_corotational_forces_3d(e, d, block, force);
    return;
  }
  ed_kinematics k;
  ed_face_kinematics_3d(e, d, &k);
  const double *q = block + ed_block_q(e->axes), L = e->length;
  const double second = e->geometry == ED_P_DELTA ? (q[0] + e->mean_axial) / L : 0.0;
  double at_j[3] = {q[0], second * k.drift[0], second * k.drift[1]};
  if (e->axes == ED_SPACE) {
    const double twist = e->twist_stiffness * k.twist;
    at_j[1] -= (q[1] + q[2]) / L;
    at_j[2] += (q[3] + q[4]) / L;
    add_global(e, (double[3]){-twist, q[3], q[1]}, 1.0, force + R_I);
    add_global(e, (double[3]){twist, q[4], q[2]}, 1.0, force + R_J);
  }
  add_global(e, at_j, -1.0, force + U_I);
  add_global(e, at_j, 1.0, force + U_J);
}

/* A matrix of local components at a place of the tangent, and its transpose at the mirrored one. */
static void set_block(const ed_element *e, const double local[3][3], int row, int column, double *t)
{
  double half[3][3];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      half[i][j] = local[i][0] * e->axis[0][j] + local[i][1] * e->axis[1][j] + local[i][2] * e->axis[2][j];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      const double term = e->axis[0][i] * half[0][j] + e->axis[1][i] * half[1][j] + e->axis[2][i] * half[2][j];
      t[ED_MAX_DEGREES * (row + i) + column + j] = term;
      t[ED_MAX_DEGREES * (column + j) + row + i] = term;
    }
}

/* The opposite of a block at another place, and its transpose at the mirrored one. */
static void negate_block(int from_row, int from_column, int row, int column, double *t)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      t[ED_MAX_DEGREES * (row + i) + column + j] = t[ED_MAX_DEGREES * (column + j) + row + i] =
          -t[ED_MAX_DEGREES * (from_row + i) + from_column + j];
}

/* Without the term of P-Delta that is not symmetric, the change of the axial force times the drift. */
void ed_face_tangent_3d(const ed_element *e, const double *d, const double *block, double *t)
{
  if (e->kind == ED_SPRING) {
    const double *b = e->member->coefficient;
    for (int i = 0; i < e->degrees * e->degrees; i++)
      t[i] = block[ED_BLOCK_K] * b[i / e->degrees] * b[i % e->degrees];
    return;
  }
  if (e->geometry == ED_COROTATIONAL) {
    memset(t, 0, ED_MAX_DEGREES * ED_MAX_DEGREES * sizeof *t);
    ed_corotational_tangent_3d(e, d, block, t);
    return;
  }
  const double *q = block + ed_block_q(e->axes), *K = block + ed_block_k(e->axes), L = e->length;
  const double second = e->geometry == ED_P_DELTA ? (q[0] + e->mean_axial) / L : 0.0;
  double apart[3][3] = {{K[0], 0.0, 0.0}, {0.0, second, 0.0}, {0.0, 0.0, second}};
  if (e->axes == ED_PLANE) { /* a bar */
    memset(t, 0, ED_MAX_DEGREES * ED_MAX_DEGREES * sizeof *t);
    set_block(e, apart, U_I, U_I, t);
    set_block(e, apart, U_J, U_J, t);
    negate_block(U_I, U_I, U_I, U_J, t);
    return;
  }
  /* K of the basic system as k[a][b] over elongation, both rotations about z, both about y */
  double k[ED_MAX_BASIC][ED_MAX_BASIC];
  for (int a = 0, at = 0; a < ED_MAX_BASIC; a++)
    for (int b = a; b < ED_MAX_BASIC; b++)
      k[a][b] = k[b][a] = K[at++];
  /* Moments at both ends together make the shears: along y -(z_i + z_j) / L, along z (y_i + y_j) / L. */
  double by[3][ED_MAX_BASIC]; /* forces along x, y, z of end j under basic deformations */
  for (int b = 0; b < ED_MAX_BASIC; b++) {
    by[0][b] = k[0][b];
    by[1][b] = -(k[1][b] + k[2][b]) / L;
    by[2][b] = (k[3][b] + k[4][b]) / L;
  }
  for (int a = 0; a < 3; a++) {
    apart[a][0] += a == 0 ? 0.0 : by[a][0];
    apart[a][1] += -(by[a][1] + by[a][2]) / L;
    apart[a][2] += (by[a][3] + by[a][4]) / L;
  }
  set_block(e, apart, U_I, U_I, t);
  set_block(e, apart, U_J, U_J, t);
  negate_block(U_I, U_I, U_I, U_J, t);
  for (int end = 0; end < 2; end++) { /* forces of end j under the rotations of this end */
    const double turned[3][3] = {{0.0, by[0][3 + end], by[0][1 + end]},
                                 {0.0, by[1][3 + end], by[1][1 + end]},
                                 {0.0, by[2][3 + end], by[2][1 + end]}};
    const int at = end ? R_J : R_I;
    set_block(e, turned, U_J, at, t);
    negate_block(U_J, at, U_I, at, t);
  }
  const double twist = e->twist_stiffness;
  for (int end = 0; end < 2; end++)
    for (int other = end; other < 2; other++) {
      const double turns[3][3] = {{end == other ? twist : -twist, 0.0, 0.0},
                                  {0.0, k[3 + end][3 + other], k[3 + end][1 + other]},
                                  {0.0, k[1 + end][3 + other], k[1 + end][1 + other]}};
      set_block(e, turns, end ? R_J : R_I, other ? R_J : R_I, t);
    }
}
