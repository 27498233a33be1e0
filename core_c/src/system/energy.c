/* Energy balance: input = kinetic + damping + stored + hysteretic + second-order + work on dampers + balance.
 *
 * Works of forces along a step use the trapezoidal rule, which is exact for inertia under the constant average acceleration
 * method; stored and hysteretic energy come from the fibres. What does not fit is the balance: unfinished iterations and the
 * error of the step. Motion is relative to the ground (Uang & Bertero 1990). What moves supports relative to it is input; damping
 * is of what moves beyond the structure that follows them slowly. */
#include "system/analysis.h"

#include <math.h>
#include <string.h>

static double mean_work(int n, const double *before, const double *after, const double *from, const double *to)
{
  double work = 0.0;
  for (int i = 0; i < n; i++)
    work += 0.5 * (before[i] + after[i]) * (to[i] - from[i]);
  return work;
}

/* Work of the loads on rigid ends; `moved` becomes what the faces have moved by. */
static double arm_load_work(const ed_analysis *a, const ed_element *e, const ed_member_loads *before, double *moved)
{
  double now[6], then[6], arm[2][2], face_now[6], face_then[6], work = 0.0;
  for (int i = 0; i < 6; i++) {
    now[i] = ed_displacement(&a->numbering, &a->trial, e->dof[i]);
    then[i] = ed_displacement(&a->numbering, &a->committed, e->dof[i]);
  }
  for (int end = 0; end < 2; end++) {
    const double *d = moved + 3 * end;
    const double along = e->c * d[0] + e->s * d[1], across = -e->s * d[0] + e->c * d[1];
    work += 0.5 * (e->arm_force[end][0] + before->arm_force[end][0]) * along;
    work += 0.5 * (e->arm_force[end][1] + before->arm_force[end][1]) * across;
    if (e->geometry == ED_COROTATIONAL) {
      const double moment = ed_arm_load_moment(e, e->arm_moment[end], now[3 * end + 2]);
      work += 0.5 * (moment + ed_arm_load_moment(e, before->arm_moment[end], then[3 * end + 2])) * d[2];
    } else /* the second order of P-Delta counts as such */
      work += 0.5 * (e->arm_moment[end][1] + before->arm_moment[end][1]) * d[2];
  }
  ed_rigid_faces(e, now, arm, face_now);
  ed_rigid_faces(e, then, arm, face_then);
  for (int i = 0; i < 6; i++)
    moved[i] = face_now[i] - face_then[i];
  return work;
}

static double along_local(const ed_element *e, const double local[3], const double *moved)
{
  double work = 0.0;
  for (int k = 0; k < 3; k++)
    work += local[k] * (e->axis[k][0] * moved[0] + e->axis[k][1] * moved[1] + e->axis[k][2] * moved[2]);
  return work;
}

/* The same in space. */
static double arm_load_work_3d(const ed_analysis *a, const ed_element *e, const ed_member_loads *before, double *moved)
{
  double now[ED_MAX_DEGREES], then[ED_MAX_DEGREES], face_now[ED_MAX_DEGREES], face_then[ED_MAX_DEGREES], work = 0.0;
  for (int i = 0; i < ED_MAX_DEGREES; i++) {
    now[i] = ed_displacement(&a->numbering, &a->trial, e->dof[i]);
    then[i] = ed_displacement(&a->numbering, &a->committed, e->dof[i]);
  }
  ed_rigid_faces_3d(e, now, face_now);
  ed_rigid_faces_3d(e, then, face_then);
  for (int end = 0; end < 2; end++) {
    double *d = moved + 6 * end, turned[3], tip[3], tip_before[3], mean[3], mean_tip[3];
    ed_tip_force(e, end, e->arm_moment[end], tip);
    ed_tip_force(e, end, before->arm_moment[end], tip_before);
    for (int i = 0; i < 3; i++) {
      mean[i] = 0.5 * (e->arm_force[end][i] + before->arm_force[end][i]);
      mean_tip[i] = 0.5 * (tip[i] + tip_before[i]);
      turned[i] = face_now[6 * end + i] - face_then[6 * end + i] - d[i];
    }
    work += along_local(e, mean, d) + along_local(e, mean_tip, turned);
    for (int i = 0; i < 3; i++)
      d[i] += turned[i];
  }
  return work;
}

/* Displacements of both ends along the reactions of the loads inside. */
ED_INLINE void along_end_loads(const ed_element *e, const double *moved, double *local, const int axes)
{
  if (axes == ED_PLANE) {
    local[0] = e->c * moved[0] + e->s * moved[1];
    local[1] = -e->s * moved[0] + e->c * moved[1];
    local[2] = -e->s * moved[3] + e->c * moved[4];
    return;
  }
  for (int i = 0; i < ED_MAX_BASIC; i++) { /* x and y at i, y at j, z at i and j */
    const double *axis = e->axis[(i + 1) / 2], *of = moved + (i == 2 || i == 4 ? 6 : 0);
    local[i] = axis[0] * of[0] + axis[1] * of[1] + axis[2] * of[2];
  }
}

/* Work of the element loads on the member's ends and inside it. */
ED_INLINE double load_work(const ed_analysis *a, int member, const int axes)
{
  const ed_element *e = &a->members.element[member];
  const ed_member_loads *before = &a->loading.member_committed[member];
  double moved[ED_MAX_DEGREES], local[ED_MAX_BASIC];
  for (int i = 0; i < (axes == ED_PLANE ? 6 : ED_MAX_DEGREES); i++)
    moved[i] = ed_displacement(&a->numbering, &a->trial, e->dof[i]) - ed_displacement(&a->numbering, &a->committed, e->dof[i]);
  double work = 0.0;
  if (e->rigid)
    work = axes == ED_PLANE ? arm_load_work(a, e, before, moved) : arm_load_work_3d(a, e, before, moved);
  along_end_loads(e, moved, local, axes);
  for (int i = 0; i < ed_basic(axes); i++)
    work -= 0.5 * (e->end_load[i] + before->end_load[i]) * local[i];
  const double *now = a->trial.elements + e->state, *then = a->committed.elements + e->state;
  if (e->geometry == ED_COROTATIONAL) { /* the potential of geometry.c */
    const double *j = moved + (axes == ED_PLANE ? 3 : 6);
    const double at_j = axes == ED_PLANE ? e->c * j[0] + e->s * j[1] : e->axis[0][0] * j[0] + e->axis[0][1] * j[1] + e->axis[0][2] * j[2];
    work -= 0.5 * (e->mean_axial + before->mean_axial) * (now[ED_BLOCK_V] - then[ED_BLOCK_V] - (at_j - local[0]));
  }
  const int size = ed_point_size(axes);
  for (int p = 0, k = ed_block_points(axes); p < e->points; p++, k += size) {
    const double *load = e->section_load[p], *was = before->section_load[p];
    work += 0.5 * e->weight[p] * (load[0] + was[0]) * (now[k] - then[k]);
    work += 0.5 * e->weight[p] * (load[1] + was[1]) * (now[k + 1] - then[k + 1]);
    if (axes == ED_SPACE)
      work += 0.5 * e->weight[p] * (load[2] + was[2]) * (now[k + 2] - then[k + 2]);
  }
  if (e->kind == ED_ELASTIC_BEAM)
    for (int i = 0; i < ed_basic(axes); i++)
      work += 0.5 * (e->free_deformation[i] + before->free_deformation[i]) *
              (now[ed_block_q(axes) + i] - then[ed_block_q(axes) + i]);
  return work;
}

/* Work of the second-order moments of rigid ends, whose present values are kept at the end of the member's block. */
static double rigid_second_order(ed_analysis *a, const ed_element *e, const double *d)
{
  const int moments = ed_rigid_moments(e), at = e->state + ed_element_block_size(e) - 2 * moments;
  double *now = a->trial.elements + at, work = 0.0;
  const double *then = a->committed.elements + at;
  ed_rigid_second_order(e, d, a->trial.elements + e->state, now, now + moments);
  for (int i = 0; i < moments; i++)
    work += 0.5 * (now[i] + then[i]) * (now[moments + i] - then[moments + i]);
  return work;
}

void ed_count_energy(ed_analysis *a, double dissipated)
{
  const int n = a->numbering.n, members = a->model->n_members, across = a->model->dimension - 1;
  ed_state_head *head = a->trial.head;
  double second_order = 0.0;
  double input = mean_work(n, a->loading.external_committed, a->loading.external, a->committed.u, a->trial.u);
  for (int m = 0; m < members; m++) {
    const ed_element *e = &a->members.element[m];
    if (e->member->loaded)
      input += e->axes == ED_PLANE ? load_work(a, m, ED_PLANE) : load_work(a, m, ED_SPACE);
    if (e->geometry != ED_P_DELTA || e->kind == ED_LINK)
      continue;
    double d[ED_MAX_DEGREES], *now = a->trial.p_delta + 2 * across * m;
    const double *then = a->committed.p_delta + 2 * across * m;
    ed_gather(&a->members, m, d);
    ed_element_p_delta(e, d, a->trial.elements + e->state, now, now + across);
    second_order += 0.5 * (now[0] + then[0]) * (now[across] - then[across]);
    if (across == 2)
      second_order += 0.5 * (now[1] + then[1]) * (now[3] - then[3]);
    if (e->rigid)
      second_order += rigid_second_order(a, e, d);
  }
  if (a->run.kind == ED_RUN_HISTORY) {
    for (int axis = 0; axis < a->model->dimension; axis++) {
      const double ground = 0.5 * (a->run.ground_now[axis] + a->run.ground_before[axis]);
      for (int i = 0; ground != 0.0 && i < n; i++)
        input -= a->numbering.mass[i] * a->numbering.influence[axis][i] * ground * (a->trial.u[i] - a->committed.u[i]);
    }
    double by_supports = 0.0;
    input += ed_history_force_work(a) + ed_support_work(a, &by_supports);
    head->energy[ED_DAMPING] += by_supports + mean_work(n, a->committed.damping, a->trial.damping, a->committed.u, a->trial.u);
  }
  head->energy[ED_INPUT] += input;
  head->energy[ED_DAMPERS] += ed_count_device_work(a);
  head->energy[ED_HYSTERETIC] += dissipated;
  head->energy[ED_GEOMETRIC] += second_order;
  head->largest_input = fmax(head->largest_input, fabs(head->energy[ED_INPUT]));
}

/* Counts from the committed state on: what is stored and moves is taken as put in. */
void ed_restart_energy(ed_analysis *a)
{
  double *energy = a->committed.head->energy;
  memset(energy, 0, ED_N_ENERGY * sizeof *energy);
  ed_close_energy(a);
  energy[ED_INPUT] = energy[ED_KINETIC] + energy[ED_STORED];
  a->committed.head->largest_input = fabs(energy[ED_INPUT]);
  ed_close_energy(a);
  for (int m = 0; m < a->model->n_members; m++) {
    const int across = a->model->dimension - 1;
    double d[ED_MAX_DEGREES], *kept_p_delta = a->committed.p_delta + 2 * across * m;
    const ed_element *e = &a->members.element[m];
    ed_gather(&a->members, m, d);
    ed_element_p_delta(e, d, a->committed.elements + e->state, kept_p_delta, kept_p_delta + across);
    if (e->rigid) {
      const int moments = ed_rigid_moments(e);
      double *kept = a->committed.elements + e->state + ed_element_block_size(e) - 2 * moments;
      ed_rigid_second_order(e, d, a->committed.elements + e->state, kept, kept + moments);
    }
  }
  ed_revert(a);
}

/* Completes the balance at the committed state. */
void ed_close_energy(ed_analysis *a)
{
  double *energy = a->committed.head->energy;
  double kinetic = 0.0, stored = 0.0;
  for (int i = 0; i < a->numbering.n; i++)
    kinetic += 0.5 * a->numbering.mass[i] * a->committed.v[i] * a->committed.v[i];
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->members.element[m];
    if (e->kind == ED_LINK) {
      double work = 0.0;
      for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
          work += 0.5 * ed_displacement(&a->numbering, &a->committed, e->dof[i]) * e->link[6 * i + j] *
                  ed_displacement(&a->numbering, &a->committed, e->dof[j]);
      stored += work;
    } else
      stored += ed_element_stored(e, a->committed.elements + e->state, a->storage.layers + e->layers);
  }
  energy[ED_KINETIC] = kinetic;
  energy[ED_STORED] = stored;
  energy[ED_BALANCE] = energy[ED_INPUT] - kinetic - energy[ED_DAMPING] - stored - energy[ED_HYSTERETIC] -
                       energy[ED_GEOMETRIC] - energy[ED_DAMPERS];
  memcpy(a->trial.head->energy, energy, ED_N_ENERGY * sizeof *energy);
  const double largest = a->committed.head->largest_input;
  a->statistics.energy_error = largest > 0.0 ? fabs(energy[ED_BALANCE]) / largest : 0.0;
}
