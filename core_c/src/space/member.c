#include "space/member.h"

#include <math.h>
#include <string.h>

ed_space_plane ed_member_plane_y(const ed_space_member *m)
{
  const double GA = m->property[ED_G] * m->property[ED_A_Z];
  return (ed_space_plane){m->property[ED_E] * m->property[ED_I_Y], GA > 0.0 ? 1.0 / (GA * m->length) : 0.0};
}

ed_space_plane ed_member_plane_z(const ed_space_member *m)
{
  const double GA = m->property[ED_G] * m->property[ED_A_Y];
  return (ed_space_plane){m->property[ED_E] * m->property[ED_I_Z], GA > 0.0 ? 1.0 / (GA * m->length) : 0.0};
}

void ed_member_flexibility(double length, ed_space_plane p, double *f)
{
  f[0] = f[2] = length / (3.0 * p.EI) + p.shear;
  f[1] = -length / (6.0 * p.EI) + p.shear;
}

/* Moments under rotations of the nodes from the chord, springs in series with the ends. */
static void with_springs(double length, ed_space_plane p, double start, double end, double *k)
{
  double f[3];
  ed_member_flexibility(length, p, f);
  k[0] = k[1] = k[2] = 0.0;
  if (start > 0.0 && end > 0.0) {
    const double f11 = f[0] + 1.0 / start, f22 = f[2] + 1.0 / end, determinant = f11 * f22 - f[1] * f[1];
    k[0] = f22 / determinant;
    k[1] = -f[1] / determinant;
    k[2] = f11 / determinant;
  } else if (start > 0.0)
    k[0] = 1.0 / (f[0] + 1.0 / start);
  else if (end > 0.0)
    k[2] = 1.0 / (f[2] + 1.0 / end);
}

void ed_member_stiffness(ed_space_member *m)
{
  ed_space_stiffness *k = &m->stiffness;
  memset(k, 0, sizeof *k);
  k->axial = m->property[ED_E] * m->property[ED_A] / m->length;
  if (m->axial_only)
    return;
  k->torsion = m->property[ED_G] * m->property[ED_I_T] / m->length;
  with_springs(m->length, ed_member_plane_y(m), m->end[0], m->end[2], k->y);
  with_springs(m->length, ed_member_plane_z(m), m->end[1], m->end[3], k->z);
}

/* a[i] b[j] of local axes, added to a 3 x 3 block. */
static void add_product(double factor, const double *a, const double *b, double block[3][3])
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      block[i][j] += factor * a[i] * b[j];
}

static void add_diagonal(const ed_space_member *m, double x, double y, double z, double block[3][3])
{
  add_product(x, m->axis[0], m->axis[0], block);
  add_product(y, m->axis[1], m->axis[1], block);
  add_product(z, m->axis[2], m->axis[2], block);
}

static void put(const double block[3][3], double sign, int row, int column, double *matrix)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      matrix[12 * (row + i) + column + j] = sign * block[i][j];
}

static void put_turned(const double block[3][3], double sign, int row, int column, double *matrix)
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      matrix[12 * (row + i) + column + j] = sign * block[j][i];
}

/* D: displacement of the end less that of the start. Force across under D and moments under D follow from the moments' equilibrium. */
void ed_member_matrix(const ed_space_member *m, const ed_space_stiffness *k, double *matrix)
{
  const double L = m->length;
  double D[3][3] = {{0.0}}, D1[3][3] = {{0.0}}, D2[3][3] = {{0.0}}, r11[3][3] = {{0.0}}, r12[3][3] = {{0.0}}, r22[3][3] = {{0.0}};
  add_diagonal(m, k->axial, (k->z[0] + 2.0 * k->z[1] + k->z[2]) / (L * L) + k->across,
               (k->y[0] + 2.0 * k->y[1] + k->y[2]) / (L * L) + k->across, D);
  add_product(-(k->z[0] + k->z[1]) / L, m->axis[1], m->axis[2], D1);
  add_product((k->y[0] + k->y[1]) / L, m->axis[2], m->axis[1], D1);
  add_product(-(k->z[1] + k->z[2]) / L, m->axis[1], m->axis[2], D2);
  add_product((k->y[1] + k->y[2]) / L, m->axis[2], m->axis[1], D2);
  add_diagonal(m, k->torsion, k->y[0], k->z[0], r11);
  add_diagonal(m, -k->torsion, k->y[1], k->z[1], r12);
  add_diagonal(m, k->torsion, k->y[2], k->z[2], r22);
  put(D, 1.0, 0, 0, matrix);
  put_turned(D1, -1.0, 3, 0, matrix);
  put(r11, 1.0, 3, 3, matrix);
  put(D, -1.0, 6, 0, matrix);
  put(D1, 1.0, 6, 3, matrix);
  put(D, 1.0, 6, 6, matrix);
  put_turned(D2, -1.0, 9, 0, matrix);
  put_turned(r12, 1.0, 9, 3, matrix);
  put_turned(D2, 1.0, 9, 6, matrix);
  put(r22, 1.0, 9, 9, matrix);
}

void ed_member_to_local(const ed_space_member *m, const double *global, double *local)
{
  for (int i = 0; i < 3; i++)
    local[i] = m->axis[i][0] * global[0] + m->axis[i][1] * global[1] + m->axis[i][2] * global[2];
}

void ed_member_add_global(const ed_space_member *m, const double *local, double *global)
{
  for (int i = 0; i < 3; i++)
    global[i] += m->axis[0][i] * local[0] + m->axis[1][i] * local[1] + m->axis[2][i] * local[2];
}

void ed_member_add_end_moments(double length, double y1, double y2, double z1, double z2, double *force)
{
  const double V_y = -(z1 + z2) / length, V_z = (y1 + y2) / length;
  force[1] -= V_y;
  force[2] -= V_z;
  force[4] += y1;
  force[5] += z1;
  force[7] += V_y;
  force[8] += V_z;
  force[10] += y2;
  force[11] += z2;
}

void ed_member_add_forces(const ed_space_member *m, const double *start, const double *end, double *force)
{
  const ed_space_stiffness *k = &m->stiffness;
  const double apart[3] = {end[0] - start[0], end[1] - start[1], end[2] - start[2]};
  double D[3], r1[3], r2[3];
  ed_member_to_local(m, apart, D);
  const double N = k->axial * D[0];
  force[0] -= N;
  force[6] += N;
  if (m->axial_only)
    return;
  ed_member_to_local(m, start + 3, r1);
  ed_member_to_local(m, end + 3, r2);
  const double T = k->torsion * (r2[0] - r1[0]);
  force[3] -= T;
  force[9] += T;
  const double y1 = r1[1] + D[2] / m->length, y2 = r2[1] + D[2] / m->length;
  const double z1 = r1[2] - D[1] / m->length, z2 = r2[2] - D[1] / m->length;
  ed_member_add_end_moments(m->length, k->y[0] * y1 + k->y[1] * y2, k->y[1] * y1 + k->y[2] * y2, k->z[0] * z1 + k->z[1] * z2,
                  k->z[1] * z1 + k->z[2] * z2, force);
}

/* The member on hinges turns by t1, t2 at its ends under the load (about z for a load along y; about y the other way round); moments
 * that turn them back do so through the springs. Shear turns no end section of a member on hinges. */
static void add_fixed_end_forces(const ed_space_member *m, const double *load, double share, double t1, double t2, double *force)
{
  const ed_space_stiffness *k = &m->stiffness;
  for (int i = 0; i < 3; i++) {
    force[i] -= (1.0 - share) * load[i];
    force[6 + i] -= share * load[i];
  }
  if (m->axial_only)
    return;
  const double E = m->property[ED_E], z = load[1] / (E * m->property[ED_I_Z]), y = -load[2] / (E * m->property[ED_I_Y]);
  ed_member_add_end_moments(m->length, -y * (k->y[0] * t1 + k->y[1] * t2), -y * (k->y[1] * t1 + k->y[2] * t2), -z * (k->z[0] * t1 + k->z[1] * t2),
                  -z * (k->z[1] * t1 + k->z[2] * t2), force);
}

void ed_member_add_uniform(const ed_space_member *m, const double *load, double *force)
{
  const double L = m->length, whole[3] = {load[0] * L, load[1] * L, load[2] * L};
  double local[3];
  ed_member_to_local(m, whole, local);
  add_fixed_end_forces(m, local, 0.5, L * L / 24.0, -L * L / 24.0, force);
}

void ed_member_add_point(const ed_space_member *m, double position, const double *load, double *force)
{
  const double L = m->length, a = position * L, b = L - a;
  double local[3];
  ed_member_to_local(m, load, local);
  add_fixed_end_forces(m, local, position, b * (L + b) * a / (6.0 * L), -a * (L + a) * b / (6.0 * L), force);
}
