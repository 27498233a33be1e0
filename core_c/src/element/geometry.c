/* Small rotations (linear and P-Delta) and exact corotational kinematics of a plane member (Crisfield 1991, 7.3).
 *
 * Loads inside keep their direction while the chord turns. Their work on a straight member is that of their mean on the mean of both ends,
 * and the basic system, which holds axial loads at i, lacks mean_axial times what the ends come together along the first direction. So
 * mean_axial pulls along the chord as q[0] does, and against it along the first direction: forces with the potential mean_axial (l - along),
 * about each end the moment of the loads. */
#include "element/element.h"

#include <math.h>

static void face_kinematics(const ed_element *e, const double *d, ed_kinematics *k)
{
  const double dx = d[3] - d[0], dy = d[4] - d[1];
  k->drift[0] = -e->s * dx + e->c * dy;
  if (e->geometry != ED_COROTATIONAL) {
    const double chord = k->drift[0] / e->length;
    k->c = e->c;
    k->s = e->s;
    k->l = e->length;
    k->v[0] = e->c * dx + e->s * dy;
    k->v[1] = d[2] - chord;
    k->v[2] = d[5] - chord;
    return;
  }
  const double along = e->length + e->c * dx + e->s * dy;
  k->l = hypot(along, k->drift[0]);
  const double cb = along / k->l, sb = k->drift[0] / k->l; /* chord from its first direction */
  k->c = e->c * cb - e->s * sb;
  k->s = e->s * cb + e->c * sb;
  /* l - L without cancellation */
  k->v[0] = (2.0 * e->length * (e->c * dx + e->s * dy) + dx * dx + dy * dy) / (k->l + e->length);
  /* of the angles of the chord, whole turns apart, the one nearest to the mean rotation of the ends */
  const double turn = 6.283185307179586476925286766559;
  const double mean = 0.5 * (d[2] + d[5]);
  const double chord = mean - remainder(mean - atan2(sb, cb), turn);
  k->v[1] = d[2] - chord;
  k->v[2] = d[5] - chord;
}

void ed_kinematics_of(const ed_element *e, const double *d, ed_kinematics *k)
{
  if (e->degrees == ED_MAX_DEGREES) {
    double face[ED_MAX_DEGREES];
    if (e->rigid)
      ed_rigid_faces_3d(e, d, face);
    ed_face_kinematics_3d(e, e->rigid ? face : d, k);
    return;
  }
  if (e->rigid) {
    double arm[2][2], face[6];
    ed_rigid_faces(e, d, arm, face);
    face_kinematics(e, face, k);
    return;
  }
  face_kinematics(e, d, k);
}

void ed_face_forces(const ed_element *e, const double *d, const double *block, double *force)
{
  if (e->kind == ED_LINK) {
    for (int i = 0; i < 6; i++) {
      double sum = 0.0;
      for (int j = 0; j < 6; j++)
        sum += e->link[6 * i + j] * d[j];
      force[i] = sum;
    }
    return;
  }
  if (e->kind == ED_SPRING) {
    for (int i = 0; i < 6; i++)
      force[i] = e->member->coefficient[i] * block[ED_BLOCK_Q];
    return;
  }
  ed_kinematics k;
  face_kinematics(e, d, &k);
  const double *q = block + ED_BLOCK_Q;
  const double shear = (q[1] + q[2]) / k.l;
  const double second = e->geometry == ED_P_DELTA ? (q[0] + e->mean_axial) * k.drift[0] / e->length : 0.0;
  const double fy_i = shear - second, fy_j = -shear + second;
  force[0] = -k.c * q[0] - k.s * fy_i;
  force[1] = -k.s * q[0] + k.c * fy_i;
  force[2] = q[1];
  force[3] = k.c * q[0] - k.s * fy_j;
  force[4] = k.s * q[0] + k.c * fy_j;
  force[5] = q[2];
  /* element loads keep their direction */
  force[0] += e->c * e->end_load[0] - e->s * e->end_load[1];
  force[1] += e->s * e->end_load[0] + e->c * e->end_load[1];
  force[3] += -e->s * e->end_load[2];
  force[4] += e->c * e->end_load[2];
  if (e->geometry != ED_COROTATIONAL || e->mean_axial == 0.0)
    return;
  const double x = e->mean_axial * (k.c - e->c), y = e->mean_axial * (k.s - e->s);
  force[0] -= x;
  force[1] -= y;
  force[3] += x;
  force[4] += y;
}

void ed_element_forces(const ed_element *e, const double *d, const double *block, double *force)
{
  if (e->degrees == ED_MAX_DEGREES)
    (e->rigid ? ed_rigid_forces_3d : ed_face_forces_3d)(e, d, block, force);
  else if (e->rigid)
    ed_rigid_forces(e, d, block, force);
  else
    ed_face_forces(e, d, block, force);
}

/* Without the term of P-Delta that is not symmetric, the change of the axial force times the drift. */
void ed_face_tangent(const ed_element *e, const double *d, const double *block, double *t)
{
  if (e->kind == ED_LINK) {
    for (int i = 0; i < 36; i++)
      t[i] = e->link[i];
    return;
  }
  if (e->kind == ED_SPRING) {
    const double *b = e->member->coefficient;
    for (int i = 0; i < 36; i++)
      t[i] = block[ED_BLOCK_K] * b[i / 6] * b[i % 6];
    return;
  }
  ed_kinematics k;
  face_kinematics(e, d, &k);
  const double *q = block + ED_BLOCK_Q, *kb = block + ED_BLOCK_K;
  const double l = k.l, ax = k.c, ay = k.s, tx = -k.s, ty = k.c;
  /* along the chord a, across it t: translations D = A aa' + B (at' + ta') + G tt' */
  const double A = kb[0];
  double B = -(kb[1] + kb[2]) / l;
  double G = (kb[3] + 2.0 * kb[4] + kb[5]) / (l * l);
  if (e->geometry != ED_LINEAR)
    G += (q[0] + e->mean_axial) / l;
  if (e->geometry == ED_COROTATIONAL)
    B += (q[1] + q[2]) / (l * l);
  const double xx = A * ax * ax + 2.0 * B * ax * tx + G * tx * tx;
  const double xy = A * ax * ay + B * (ax * ty + ay * tx) + G * tx * ty;
  const double yy = A * ay * ay + 2.0 * B * ay * ty + G * ty * ty;
  const double gi = (kb[3] + kb[4]) / l, gj = (kb[4] + kb[5]) / l;
  const double ix = kb[1] * ax - gi * tx, iy = kb[1] * ay - gi * ty;
  const double jx = kb[2] * ax - gj * tx, jy = kb[2] * ay - gj * ty;
  const double full[36] = {
      xx,  xy,  -ix, -xx, -xy, -jx,   /* ux i */
      xy,  yy,  -iy, -xy, -yy, -jy,   /* uy i */
      -ix, -iy, kb[3], ix, iy, kb[4], /* rz i */
      -xx, -xy, ix,  xx,  xy,  jx,    /* ux j */
      -xy, -yy, iy,  xy,  yy,  jy,    /* uy j */
      -jx, -jy, kb[4], jx, jy, kb[5], /* rz j */
  };
  for (int i = 0; i < 36; i++)
    t[i] = full[i];
}

void ed_element_tangent(const ed_element *e, const double *d, const double *block, double *t)
{
  if (e->degrees == ED_MAX_DEGREES)
    (e->rigid ? ed_rigid_tangent_3d : ed_face_tangent_3d)(e, d, block, t);
  else if (e->rigid)
    ed_rigid_tangent(e, d, block, t);
  else
    ed_face_tangent(e, d, block, t);
}

void ed_element_p_delta(const ed_element *e, const double *d, const double *block, double *force, double *drift)
{
  const int directions = e->degrees == ED_MAX_DEGREES ? 2 : 1;
  for (int i = 0; i < directions; i++)
    force[i] = drift[i] = 0.0;
  if (e->geometry != ED_P_DELTA || e->kind == ED_LINK)
    return;
  ed_kinematics k;
  ed_kinematics_of(e, d, &k);
  for (int i = 0; i < directions; i++) {
    drift[i] = k.drift[i];
    force[i] = (block[ed_block_q(e->axes)] + e->mean_axial) * k.drift[i] / e->length;
  }
}
