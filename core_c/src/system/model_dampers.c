#include "system/model.h"

#include <math.h>
#include <string.h>

int ed_model_damper(ed_model *model, const char *name, int law, int n_parameters, const double *parameters, double brace,
                    double play, double force_scale, double deformation_scale, int n_terms, const int *node, const int *degree,
                    const double *coefficient)
{
  const char *shown = name ? name : "";
  if (!(force_scale > 0.0 && deformation_scale > 0.0) || !isfinite(force_scale + deformation_scale))
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: scales %g and %g must be positive", shown, force_scale, deformation_scale);
  if (n_terms < 1 || n_terms > ED_MAX_GIVEN_TERMS)
    return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: its deformation has %d terms, but 1 to %d are possible", shown, n_terms,
                           ED_MAX_GIVEN_TERMS);
  for (int i = 0; i < n_terms; i++) {
    if (node[i] < 0 || node[i] >= model->n_nodes || degree[i] < 0 || degree[i] >= ed_degrees(model))
      return ed_model_refuse(model, ED_E_ID, "damper %s: there is no degree %d of node %d", shown, degree[i], node[i]);
    if (!isfinite(coefficient[i]))
      return ed_model_refuse(model, ED_E_ARGUMENT, "damper %s: coefficient %d is not a finite number", shown, i + 1);
  }
  char message[ED_DAMPER_MESSAGE];
  ed_damper damper;
  const int status = ed_damper_prepare(&damper, law, n_parameters, parameters, brace / (force_scale * deformation_scale),
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
  device->axial_spring = -1;
  for (int i = 0; i < n_terms; i++) {
    device->degree[i] = ed_degrees(model) * node[i] + degree[i];
    device->coefficient[i] = coefficient[i];
  }
  device->n_terms = ed_put_on_masters(model, n_terms, device->degree, device->coefficient);
  return model->n_devices++;
}

int ed_model_damper_carries(ed_model *model, int damper)
{
  if (damper < 0 || damper >= model->n_devices)
    return ed_model_refuse(model, ED_E_ID, "there is no damper %d", damper);
  model->devices[damper].carries = 1;
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
  device->axial_spring = element;
  device->weight = weight;
  return ED_OK;
}

int ed_model_add_damper_effect(ed_model *model, int damper, int form, int placement, int n_parameters, const double *parameters)
{
  if (damper < 0 || damper >= model->n_devices)
    return ed_model_refuse(model, ED_E_ID, "there is no damper %d", damper);
  ed_device *device = &model->devices[damper];
  char message[ED_DAMPER_MESSAGE];
  const int status = ed_effect_add(&device->damper, form, placement, n_parameters, parameters, message);
  return status == ED_OK ? ED_OK : ed_model_refuse(model, status, "damper %s: %s", device->name, message);
}
