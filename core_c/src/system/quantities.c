/* Quantities that channels record, at the committed state: which there are, and their values. */
#include "element/strut.h"
#include "system/analysis.h"

int ed_is_quantity(const ed_analysis *a, int kind, int object, int component)
{
  const ed_model *model = a->model;
  if (kind <= ED_REACTION)
    return kind >= 0 && object >= 0 && object < model->n_nodes && component >= 0 && component < ed_degrees(model);
  if (kind == ED_GROUND_ACCELERATION)
    return component >= 0 && component < model->dimension;
  if (kind == ED_LOAD_FACTOR)
    return object >= 0 && object < model->n_patterns;
  if (kind >= ED_DEFLECTION && kind <= ED_BROKEN_SHARE)
    return object >= 0 && object < model->n_members && component == 0 && a->members.element[object].kind == ED_STRUT;
  if (kind >= ED_GIVEN_FORCE && kind != ED_STRENGTH_LEFT)
    return kind <= ED_GIVEN_WORK && object >= 0 && object < ED_HISTORY_FORCES && component == 0;
  if (kind >= ED_DAMPER_FORCE && kind != ED_STRENGTH_LEFT) {
    if (object < 0 || object >= model->n_devices || component < 0)
      return 0;
    return kind != ED_DAMPER_DEFORMATION ? component == 0 : component < (model->devices[object].damper.law->plastic_path ? 3 : 2);
  }
  if (object < 0 || object >= model->n_members || component < 0)
    return 0;
  const ed_element *e = &a->members.element[object];
  const int fibres = e->kind == ED_FIBRE_BEAM;
  switch (kind) {
    case ED_END_FORCE:
    case ED_GLOBAL_FORCE:
      return component < e->degrees && !(kind == ED_END_FORCE && e->degrees == ED_MAX_DEGREES && e->kind == ED_SPRING);
    case ED_AXIAL_FORCE:
      return component == 0 && e->kind != ED_LINK;
    case ED_DEFORMATION:
      return component < (e->kind == ED_SPRING ? 1 : ed_basic(e->axes)) && e->kind != ED_LINK;
    case ED_PLASTIC_ROTATION:
      return fibres ? component < 2 * e->axes : e->kind == ED_SPRING && component == 0;
    case ED_STRENGTH_LEFT:
      return e->kind == ED_SPRING && component == 0;
    case ED_SECTION_FORCE:
    case ED_SECTION_DEFORMATION:
      return fibres && component < (1 + e->axes) * e->points;
    default: {
      if (!fibres || e->section[0]->elastic)
        return 0;
      const int n = e->section[0]->n, p = component / n;
      return p < e->points && !e->section[p]->elastic && component % n < e->section[p]->n;
    }
  }
}

static double node_value(const ed_analysis *a, const ed_term *term)
{
  const int degree = ed_degrees(a->model) * term->object + term->component, equation = a->numbering.equation[degree];
  if (term->kind == ED_REACTION)
    return a->members.resisting[degree] - (equation < 0 ? ed_history_force_on(&a->run, degree) : 0.0);
  double ground = 0.0;
  if (term->kind == ED_TOTAL_ACCELERATION && term->component < a->model->dimension && a->run.kind == ED_RUN_HISTORY)
    ground = a->run.ground_now[term->component];
  const ed_state *s = &a->committed;
  const double *of_equations = term->kind == ED_DISPLACEMENT ? s->u : term->kind == ED_VELOCITY ? s->v : s->a;
  const double *of_supports = term->kind == ED_DISPLACEMENT ? s->support_u : term->kind == ED_VELOCITY ? s->support_v : s->support_a;
  return ed_at_degree(&a->numbering, of_equations, of_supports, degree) + ground;
}

/* Forces where the member begins to bend. */
static void face_forces(const ed_analysis *a, const ed_element *e, double *force)
{
  const double *block = a->committed.elements + e->state;
  double d[ED_MAX_DEGREES], arm[2][2], face[ED_MAX_DEGREES];
  for (int i = 0; i < e->degrees; i++)
    d[i] = ed_displacement(&a->numbering, &a->committed, e->dof[i]);
  if (e->degrees == ED_MAX_DEGREES) {
    ed_rigid_faces_3d(e, d, face);
    ed_face_forces_3d(e, face, block, force);
    return;
  }
  ed_rigid_faces(e, d, arm, face);
  ed_face_forces(e, face, block, force);
}

static double element_value(const ed_analysis *a, const ed_term *term)
{
  const ed_element *e = &a->members.element[term->object];
  const double *block = a->committed.elements + e->state, *force = ed_member_force(&a->members, term->object);
  const int c = term->component;
  switch (term->kind) {
    case ED_GLOBAL_FORCE:
      return force[c];
    case ED_END_FORCE: {
      double of_faces[ED_MAX_DEGREES];
      if (e->rigid) {
        face_forces(a, e, of_faces);
        force = of_faces;
      }
      if (e->degrees == ED_MAX_DEGREES) {
        const double *axis = e->axis[c % 3], *of = force + c / 3 * 3;
        return axis[0] * of[0] + axis[1] * of[1] + axis[2] * of[2];
      }
      const double *f = force + 3 * (c / 3);
      if (c % 3 == 0)
        return e->c * f[0] + e->s * f[1];
      return c % 3 == 1 ? -e->s * f[0] + e->c * f[1] : f[2];
    }
    case ED_AXIAL_FORCE:
      return block[ed_block_q(e->axes)];
    case ED_DEFORMATION:
      return block[ED_BLOCK_V + c];
    case ED_PLASTIC_ROTATION:
      return ed_element_plastic_rotation(e, block, c);
    case ED_STRENGTH_LEFT:
      return ed_spring_strength_left(e->spring, a->storage.layers + e->layers);
    case ED_SECTION_FORCE:
      return block[ed_point_at(e->axes, c / (1 + e->axes)) + ed_point_s(e->axes) + c % (1 + e->axes)];
    case ED_SECTION_DEFORMATION:
      return block[ed_point_at(e->axes, c / (1 + e->axes)) + c % (1 + e->axes)];
    default: {
      const ed_section *section = e->section[0];
      const int p = c / section->n;
      const double *point = block + ed_point_at(e->axes, p);
      double stress, strain;
      ed_section_layer(e->section[p], a->storage.layers + e->layers + e->layer_offset[p], c % section->n, point, &stress, &strain);
      return term->kind == ED_FIBRE_STRESS ? stress : strain;
    }
  }
}

static double strut_value(const ed_analysis *a, const ed_term *term)
{
  const ed_element *e = &a->members.element[term->object];
  if (term->kind == ED_DEFLECTION)
    return ed_strut_deflection(e->strut, a->committed.elements + e->state);
  const double *layers = a->storage.layers + e->layers;
  return term->kind == ED_DAMAGE ? ed_strut_damage(e->strut, layers) : ed_strut_broken_share(e->strut, layers);
}

double ed_channel_sum(const ed_analysis *a, const ed_channel_head *head)
{
  double value = 0.0;
  for (int i = 0; i < head->n_terms; i++) {
    const ed_term *term = &a->channels.terms[head->first + i];
    double part;
    if (term->kind <= ED_REACTION)
      part = node_value(a, term);
    else if (term->kind == ED_GROUND_ACCELERATION)
      part = a->run.kind == ED_RUN_HISTORY ? a->run.ground_now[term->component] : 0.0;
    else if (term->kind == ED_LOAD_FACTOR)
      part = a->loading.factors_committed[term->object];
    else if (term->kind == ED_STRENGTH_LEFT)
      part = element_value(a, term);
    else if (term->kind >= ED_DEFLECTION)
      part = strut_value(a, term);
    else if (term->kind >= ED_GIVEN_FORCE)
      part = ed_history_force_value(a, term->kind, term->object);
    else if (term->kind >= ED_DAMPER_FORCE)
      part = ed_device_value(a, term->kind, term->object, term->component);
    else
      part = element_value(a, term);
    value += term->coefficient * part;
  }
  return value;
}
