#include "system/model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Whether the terms of a deformation can be those of a damper of this name: ED_OK, or what was refused. */
static int check_terms(ed_model *model, const char *shown, int n_terms, const int *node, const int *degree, const double *coefficient)
{
  if (n_terms < 1 || n_terms > ED_MAX_GIVEN_TERMS)
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: its deformation has %d terms, but 1 to %d are possible", shown, n_terms,
                           ED_MAX_GIVEN_TERMS);
  for (int i = 0; i < n_terms; i++) {
    if (node[i] < 0 || node[i] >= model->n_nodes || degree[i] < 0 || degree[i] >= ed_degrees(model))
      return ed_model_refuse(model, ED_E_ID, "damper %s: there is no degree %d of node %d", shown, degree[i], node[i]);
    if (!isfinite(coefficient[i]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: coefficient %d is not a finite number", shown, i + 1);
  }
  return ED_OK;
}

static void set_terms(const ed_model *model, ed_device *device, int n_terms, const int *node, const int *degree, const double *coefficient)
{
  for (int i = 0; i < n_terms; i++) {
    device->degree[i] = ed_degrees(model) * node[i] + degree[i];
    device->coefficient[i] = coefficient[i];
  }
  device->n_terms = ed_put_on_masters(model, n_terms, device->degree, device->coefficient);
}

int ed_model_damper(ed_model *model, const char *name, int law, int n_parameters, const double *parameters, double brace,
                    double play, double force_scale, double deformation_scale, int n_terms, const int *node, const int *degree,
                    const double *coefficient)
{
  const char *shown = name ? name : "";
  if (!(force_scale > 0.0 && deformation_scale > 0.0) || !isfinite(force_scale + deformation_scale))
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: scales %g and %g must be positive", shown, force_scale, deformation_scale);
  int status = check_terms(model, shown, n_terms, node, degree, coefficient);
  if (status != ED_OK)
    return status;
  char message[ED_DAMPER_MESSAGE];
  ed_damper damper;
  status = ed_damper_prepare(&damper, law, n_parameters, parameters, brace / (force_scale * deformation_scale),
                                       play * deformation_scale, message);
  if (status != ED_OK)
    return ed_model_refuse(model, status, "damper %s: %s", shown, status == ED_E_MEMORY ? "out of memory" : message);
  ed_device *devices = ed_model_grown(model->devices, model->n_devices, sizeof *devices);
  if (!devices) {
    ed_damper_clear(&damper);
    return ed_model_refuse(model, ED_E_MEMORY, "out of memory");
  }
  model->devices = devices;
  ed_device *device = &devices[model->n_devices];
  memset(device, 0, sizeof *device);
  ed_copy_name(device->name, name);
  device->damper = damper;
  device->force_scale = force_scale;
  device->deformation_scale = deformation_scale;
  device->axial_spring = device->other = -1;
  set_terms(model, device, n_terms, node, degree, coefficient);
  return model->n_devices++;
}

/* The directions of a bearing both get the degrees of both, in one order, so that the tangent of one has room for what the other does to
 * its force. 0: they are too many. */
static int share_terms(ed_device *one, ed_device *other)
{
  const ed_device given = *other;
  other->n_terms = one->n_terms;
  memcpy(other->degree, one->degree, sizeof one->degree);
  memset(other->coefficient, 0, sizeof other->coefficient);
  for (int i = 0; i < given.n_terms; i++) {
    int at = 0;
    while (at < one->n_terms && one->degree[at] != given.degree[i])
      at++;
    if (at == ED_MAX_TERMS)
      return 0;
    if (at == one->n_terms) {
      one->degree[at] = other->degree[at] = given.degree[i];
      one->coefficient[at] = 0.0;
      other->n_terms = ++one->n_terms;
    }
    other->coefficient[at] += given.coefficient[i];
  }
  return 1;
}

int ed_model_damper_across(ed_model *model, int damper, const char *name, int n_terms, const int *node, const int *degree,
                           const double *coefficient)
{
  const char *shown = name ? name : "";
  if (damper < 0 || damper >= model->n_devices)
    return ed_model_refuse(model, ED_E_ID, "there is no damper %d", damper);
  const ed_device *given = &model->devices[damper];
  if (given->other >= 0)
    return ed_model_refuse(model, ED_E_STATE, "damper %s acts in two directions already", given->name);
  if (!given->damper.law->step_pair)
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: the law %s acts in one direction alone", given->name, given->damper.law->name);
  if (given->damper.n_effects > 0 || given->damper.brace > 0.0 || given->damper.joint > 0.0)
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: what acts in two directions has neither effects nor a brace", given->name);
  const int status = check_terms(model, shown, n_terms, node, degree, coefficient);
  if (status != ED_OK)
    return status;
  ed_device one = *given, other = *given;
  ed_copy_name(other.name, name);
  set_terms(model, &other, n_terms, node, degree, coefficient);
  if (!share_terms(&one, &other))
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: its directions have more than %d degrees", one.name, (int)ED_MAX_TERMS);
  const size_t derived = (size_t)given->damper.n_derived * sizeof *given->damper.derived;
  other.damper.derived = derived > 0 ? malloc(derived) : NULL;
  ed_device *devices = ed_model_grown(model->devices, model->n_devices, sizeof *devices);
  if (devices)
    model->devices = devices;
  if (!devices || (derived > 0 && !other.damper.derived)) {
    free(other.damper.derived);
    return ed_model_refuse(model, ED_E_MEMORY, "out of memory");
  }
  if (derived > 0)
    memcpy(other.damper.derived, one.damper.derived, derived);
  one.other = model->n_devices;
  other.other = damper;
  devices[damper] = one;
  devices[model->n_devices] = other;
  return model->n_devices++;
}

int ed_model_damper_carries(ed_model *model, int damper)
{
  if (damper < 0 || damper >= model->n_devices)
    return ed_model_refuse(model, ED_E_ID, "there is no damper %d", damper);
  ed_device *device = &model->devices[damper];
  device->carries = 1;
  if (device->other >= 0)
    model->devices[device->other].carries = 1;
  return ED_OK;
}

int ed_model_damper_weighs(ed_model *model, int damper, int element, double weight)
{
  if (damper < 0 || damper >= model->n_devices)
    return ed_model_refuse(model, ED_E_ID, "there is no damper %d", damper);
  ed_device *device = &model->devices[damper];
  if (element < 0 || element >= model->n_members || model->members[element].kind != ED_SPRING)
    return ed_model_refuse(model, ED_E_ID, "damper %s: element %d is no spring", device->name, element);
  if (!(weight > 0.0) || !isfinite(weight))
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: the weight %g must be positive", device->name, weight);
  for (ed_device *of = device;; of = &model->devices[device->other]) { /* of a bearing in both directions */
    of->axial_spring = element;
    of->weight = weight;
    if (of != device || device->other < 0)
      return ED_OK;
  }
}

int ed_model_add_damper_effect(ed_model *model, int damper, int form, int placement, int n_parameters, const double *parameters)
{
  if (damper < 0 || damper >= model->n_devices)
    return ed_model_refuse(model, ED_E_ID, "there is no damper %d", damper);
  ed_device *device = &model->devices[damper];
  if (device->other >= 0)
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: what acts in two directions has no effects", device->name);
  char message[ED_DAMPER_MESSAGE];
  const int status = ed_effect_add(&device->damper, form, placement, n_parameters, parameters, message);
  return status == ED_OK ? ED_OK : ed_model_refuse(model, status, "damper %s: %s", device->name, message);
}
