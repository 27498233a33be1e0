/* Rigid ends of beam-columns: arms from the nodes to the faces between which the member bends.
 *
 * A face moves as the node and the turn of the arm r make it: u + R(theta) r - r, exactly with corotational geometry, else its
 * first order theta x r. A face's force F adds the moment r x F to the node; with P-Delta, as with the chord, r is where the arm
 * stands after its turn, and an axial force N so adds N a theta. */
#include "element/element.h"

#include <math.h>
#include <string.h>

void ed_rigid_faces(const ed_element *e, const double *d, double arm[2][2], double *face)
{
  for (int end = 0; end < 2; end++) {
    const double x = e->arm[end] * e->c, y = e->arm[end] * e->s, turn = d[3 * end + 2];
    double dx = -turn * y, dy = turn * x;
    if (e->geometry == ED_COROTATIONAL) {
      const double half = sin(0.5 * turn), less = 2.0 * half * half, s = sin(turn); /* 1 - cos without cancellation */
      dx = -less * x - s * y;
      dy = s * x - less * y;
    }
    const double moved = e->geometry == ED_LINEAR ? 0.0 : 1.0;
    arm[end][0] = x + moved * dx;
    arm[end][1] = y + moved * dy;
    face[3 * end] = d[3 * end] + dx;
    face[3 * end + 1] = d[3 * end + 1] + dy;
    face[3 * end + 2] = turn;
  }
}

double ed_arm_load_moment(const ed_element *e, const double *arm_moment, double turn)
{
  const double along = arm_moment[0], across = arm_moment[1];
  if (e->geometry == ED_COROTATIONAL)
    return across * cos(turn) - along * sin(turn);
  return e->geometry == ED_P_DELTA ? across - along * turn : across;
}

void ed_rigid_forces(const ed_element *e, const double *d, const double *block, double *force)
{
  double arm[2][2], face[6];
  ed_rigid_faces(e, d, arm, face);
  ed_face_forces(e, face, block, force);
  for (int end = 0; end < 2; end++) {
    double *f = force + 3 * end;
    f[2] += arm[end][0] * f[1] - arm[end][1] * f[0] - ed_arm_load_moment(e, e->arm_moment[end], d[3 * end + 2]);
    f[0] -= e->c * e->arm_force[end][0] - e->s * e->arm_force[end][1];
    f[1] -= e->s * e->arm_force[end][0] + e->c * e->arm_force[end][1];
  }
}

/* How the moment of the face's force and of the loads about the node changes as the arm turns. */
static double turning(const ed_element *e, int end, const double *arm, const double *force, double turn)
{
  const double along = e->arm_moment[end][0], across = e->arm_moment[end][1];
  if (e->geometry == ED_LINEAR)
    return 0.0;
  if (e->geometry == ED_P_DELTA)
    return along - e->arm[end] * (e->c * force[0] + e->s * force[1]);
  return across * sin(turn) + along * cos(turn) - arm[0] * force[0] - arm[1] * force[1];
}

void ed_rigid_tangent(const ed_element *e, const double *d, const double *block, double *t)
{
  double arm[2][2], face[6], force[6], k[36];
  ed_rigid_faces(e, d, arm, face);
  ed_face_forces(e, face, block, force);
  ed_face_tangent(e, face, block, k);
  /* K B, then B' K B; B adds to the columns of the rotations what the faces move by */
  for (int end = 0; end < 2; end++) {
    const int at = 3 * end;
    const int exact = e->geometry == ED_COROTATIONAL;
    const double x = exact ? arm[end][0] : e->arm[end] * e->c, y = exact ? arm[end][1] : e->arm[end] * e->s;
    for (int i = 0; i < 6; i++)
      k[6 * i + at + 2] += x * k[6 * i + at + 1] - y * k[6 * i + at];
    for (int j = 0; j < 6; j++)
      k[6 * (at + 2) + j] += x * k[6 * (at + 1) + j] - y * k[6 * at + j];
    k[7 * (at + 2)] += turning(e, end, arm[end], force + at, d[at + 2]);
  }
  memcpy(t, k, sizeof k);
}

void ed_rigid_second_order(const ed_element *e, const double *d, const double *block, double *moment, double *rotation)
{
  if (e->axes == ED_SPACE) {
    ed_rigid_second_order_3d(e, d, block, moment, rotation);
    return;
  }
  double arm[2][2], face[6], force[6];
  ed_rigid_faces(e, d, arm, face);
  ed_face_forces(e, face, block, force);
  for (int end = 0; end < 2; end++) {
    rotation[end] = d[3 * end + 2];
    moment[end] = e->geometry == ED_P_DELTA ? rotation[end] * turning(e, end, arm[end], force + 3 * end, rotation[end]) : 0.0;
  }
}

/* A linear load across from x0 to x1 of the arm, lengths from the node along the axis (negative at j). */
static void load_arm(ed_element *e, int end, double x0, double x1, const double at0[3], const double at1[3])
{
  const double part = fabs(x1 - x0);
  for (int d = 0; d <= e->axes; d++) {
    e->arm_force[end][d] += 0.5 * (at0[d] + at1[d]) * part;
    e->arm_moment[end][d] += part * (at0[d] * (2.0 * x0 + x1) + at1[d] * (x0 + 2.0 * x1)) / 6.0;
  }
}

void ed_rigid_add_load(ed_element *e, const ed_member_load *load, double factor)
{
  const double whole = e->length + e->arm[0] - e->arm[1], first = e->arm[0], last = whole + e->arm[1];
  const int uniform = load->position < 0.0, partial = !uniform && load->end > load->position;
  ed_member_load inside = *load;
  if (!uniform && !partial) {
    const double x = load->position * whole;
    if (x >= first && x <= last) {
      inside.position = fmin(fmax((x - first) / e->length, 0.0), 1.0);
      ed_element_add_load(e, &inside, factor);
      return;
    }
    const int end = x > last;
    const double at = end ? x - whole : x;
    const double force[3] = {factor * load->axial, factor * load->transverse[0], factor * load->transverse[1]};
    for (int d = 0; d <= e->axes; d++) {
      e->arm_force[end][d] += force[d];
      e->arm_moment[end][d] += at * force[d];
    }
    return;
  }
  const double start = uniform ? 0.0 : load->position * whole, stop = uniform ? whole : load->end * whole;
  double slope[2] = {0.0, 0.0};
  for (int a = 0; !uniform && a < e->axes; a++)
    slope[a] = (load->transverse_end[a] - load->transverse[a]) / (stop - start);
  const double bounds[4] = {0.0, first, last, whole};
  for (int piece = 0; piece < 3; piece++) {
    const double x0 = fmax(start, bounds[piece]), x1 = fmin(stop, bounds[piece + 1]);
    if (x0 >= x1)
      continue;
    double w0[2], w1[2];
    for (int a = 0; a < 2; a++) {
      w0[a] = load->transverse[a] + slope[a] * (x0 - start);
      w1[a] = load->transverse[a] + slope[a] * (x1 - start);
    }
    if (piece != 1) {
      const int end = piece / 2;
      const double at0[3] = {factor * load->axial, factor * w0[0], factor * w0[1]};
      const double at1[3] = {factor * load->axial, factor * w1[0], factor * w1[1]};
      load_arm(e, end, end ? x0 - whole : x0, end ? x1 - whole : x1, at0, at1);
    } else if (uniform) {
      ed_element_add_load(e, load, factor);
    } else {
      inside.position = fmax((x0 - first) / e->length, 0.0);
      inside.end = fmin((x1 - first) / e->length, 1.0);
      memcpy(inside.transverse, w0, sizeof w0);
      memcpy(inside.transverse_end, w1, sizeof w1);
      ed_element_add_load(e, &inside, factor);
    }
  }
}
