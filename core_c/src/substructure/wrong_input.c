/* Checks of everything that a substructure test is made of. */
#include "substructure/wrong_input.h"

#include "base/finite.h"
#include "damper/law.h"
#include "substructure/numerical.h"
#include "substructure/rig.h"

#include <math.h>

enum { MOST_UNSEEN = 1000, MOST_SAMPLES = 10000000 };

static int at_least_0(double value)
{
  return value >= 0.0 && isfinite(value);
}

static const char *wrong_terms(int n, const ed_compensator_term *term)
{
  if (n < 0 || n > ED_COMPENSATOR_TERMS)
    return "the compensator has too many terms";
  for (int i = 0; i < n; i++)
    if (term[i].of < 0 || term[i].of >= ED_OF_SIGNALS || term[i].lag < (term[i].of == ED_OF_COMMAND) ||
        term[i].lag >= ED_COMPENSATOR_MEMORY || !isfinite(term[i].coefficient))
      return "a term of the compensator names no signal, looks too far back, or has a coefficient that is not finite";
  return NULL;
}

static const char *wrong_adaptation(const ed_compensator_parameters *c)
{
  if (c->n_sections < 0 || c->n_sections > ED_COMPENSATOR_SECTIONS || !ed_all_finite(5 * ED_COMPENSATOR_SECTIONS, c->section[0]))
    return "the filter of the compensator is not usable";
  for (int i = 0; i < 3; i++)
    if (!(c->least[i] <= c->initial[i] && c->initial[i] <= c->largest[i]) || !isfinite(c->largest[i] - c->least[i]) || !(c->rate[i] >= 0.0))
      return "an initial alpha lies outside its limits, or a rate is below 0";
  if (c->kind == ED_COMPENSATE_MODIFIED_ATS && !(c->forgetting > 0.0 && c->forgetting <= 1.0))
    return "the forgetting factor must be above 0 and at most 1";
  /* a window holds its last step and each `every`th before it */
  if (c->kind == ED_COMPENSATE_ATS && (c->every < 1 || c->window < 1 || c->window > ED_COMPENSATOR_WINDOW || (c->window - 1) / c->every < 2))
    return "the window of ATS must hold three samples at least, and not too many steps";
  return NULL;
}

const char *ed_wrong_compensator(const ed_compensator_parameters *c)
{
  const char *text = wrong_terms(c->n_terms, c->term);
  text = text ? text : wrong_terms(c->n_force_terms, c->force_term);
  if (text)
    return text;
  if (!(c->step > 0.0) || !at_least_0(c->threshold))
    return "the compensator needs a step above 0 and a threshold of at least 0";
  switch (c->kind) {
  case ED_COMPENSATE_LINEAR:
    return NULL;
  case ED_COMPENSATE_LIVE_DELAY:
    if (c->order < 0 || c->order > ED_COMPENSATOR_ORDER || !(c->share >= 0.0 && c->share <= 1.0) || !at_least_0(c->least_delay) ||
        !(c->least_delay <= c->delay && c->delay <= c->largest_delay) ||
        !(c->order * c->largest_delay < (ED_COMPENSATOR_MEMORY - 2) * c->step))
      return "a live delay needs an order of 0 to 4, a share of 0 to 1, and a delay within limits that it can look back over";
    return NULL;
  case ED_COMPENSATE_ATS:
  case ED_COMPENSATE_MODIFIED_ATS:
    return wrong_adaptation(c);
  default:
    return "there is no such compensator";
  }
}

static const char *wrong_rig(const ed_rig_model *r, double h)
{
  if (!at_least_0(r->delay) || !(r->delay / h < MOST_SAMPLES))
    return "the delay of the rig must be finite and at least 0";
  if (!at_least_0(r->stiffness) || !(r->stroke > 0.0) || !(r->velocity > 0.0) || !(r->force > 0.0))
    return "limits of the rig must be above 0, its stiffness at least 0";
  if (r->kind == ED_RIG_SERVO_HYDRAULIC)
    return r->gain > 0.0 && isfinite(r->gain) && at_least_0(r->valve_lag) && r->oil > 0.0 && isfinite(r->oil)
               ? NULL : "a servo-hydraulic rig needs a gain and an oil stiffness above 0 and a lag of its valve of at least 0";
  if (r->kind != ED_RIG_LINEAR || r->n < 0 || r->n > ED_RIG_STATES)
    return "there is no such rig, or it has too many states";
  const size_t n = (size_t)r->n;
  if (!ed_all_finite(n * n, r->A) || !ed_all_finite(n, r->b0) || !ed_all_finite(n, r->b1) || !ed_all_finite(n, r->c) || !ed_all_finite(n, r->c_v) ||
      !isfinite(r->d) || !isfinite(r->d_v))
    return "a value of the rig is not finite";
  return NULL;
}

static int not_below_0(double value) /* NaN is below */
{
  return value >= 0.0;
}

static const char *wrong_sensors(const ed_sensors *s, double h)
{
  if (!at_least_0(s->displacement_noise) || !at_least_0(s->force_noise) || !at_least_0(s->displacement_quantisation) ||
      !at_least_0(s->force_quantisation) || !not_below_0(s->displacement_range) || !not_below_0(s->force_range) ||
      !at_least_0(s->force_delay) || !(s->force_delay / h < MOST_SAMPLES))
    return "noise, quantisation, ranges and the delay of sensors must be at least 0";
  return NULL;
}

const char *ed_wrong_substructure(const ed_substructure_input *in)
{
  if (!(in->step > 0.0) || !isfinite(in->step) || in->sub_steps < 1 || in->sub_steps > MOST_SAMPLES)
    return "the main step must be above 0, with at least one sub-step";
  if (in->n_states < 0 || (!in->frame && in->n_states == 0 && in->n_outputs))
    return "the numerical part has no states";
  if (in->unseen_delay < 0 || in->unseen_delay > MOST_UNSEEN)
    return "the unseen delay must be 0 to 1000 steps";
  if (!(in->abort_displacement > 0.0))
    return "the abort displacement must be above 0";
  const double h = in->step / in->sub_steps;
  const char *text = in->frame ? ed_wrong_frame(in) : in->n_states ? ed_wrong_recursion(in) : NULL;
  text = text ? text : ed_wrong_compensator(in->compensator);
  text = text ? text : wrong_rig(in->rig, h);
  text = text ? text : wrong_sensors(in->sensors, h);
  if (text)
    return text;
  if (in->compensator->step != in->step)
    return "the compensator has another step than the loop";
  if (!(in->force_scale > 0.0) || !isfinite(in->force_scale) || !(in->deformation_scale > 0.0) || !isfinite(in->deformation_scale))
    return "the scales of the specimen must be above 0";
  if (in->specimen->brace + in->specimen->joint > 0.0)
    return "the specimen has a brace; what gives way in the rig is its own stiffness";
  return NULL;
}
