/* A frame that may yield as the numerical part: its time history, advanced by one main step at a time.
 *
 * The integration is implicit, and the specimen cannot be asked what its force will be at the end of the step. So that force is
 * extrapolated from the last two, or held: to first order in the specimen's force the loop is explicit, and stable only while the step
 * is short against the period of the interface's mass on the specimen. */
#include "substructure/numerical.h"
#include "system/analysis.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIVISIONS = 1000 };

typedef struct {
  ed_numerical part;
  ed_analysis *analysis;
  double dt, parameters[4];
  int divisions, method, held;
  int n_terms, equation[ED_MAX_TERMS];
  int node[ED_MAX_TERMS], degree[ED_MAX_TERMS];
  double coefficient[ED_MAX_TERMS], against[ED_MAX_TERMS]; /* of the deformation, and of the force on the frame */
  double *rest;              /* state in which tests begin */
  double at_rest;            /* sum of the displacements along the interface in it */
  int force, k, running;
  double earlier;            /* force of the specimen a step ago */
} frame;

const char *ed_wrong_frame(const ed_substructure_input *in)
{
  const ed_frame_part *f = in->frame;
  if (in->n_states != 0)
    return "the numerical part is either a recursion or a frame";
  if (!f->analysis || f->divisions < 1 || f->divisions > MOST_DIVISIONS)
    return "the frame needs an analysis, and 1 to 1000 steps in a main step";
  if (f->analysis->model->dimension != 2)
    return "the frame must be plane";
  if (in->n_outputs != 0)
    return "a frame has no outputs: its channels are recorded";
  if (f->n_terms < 1 || f->n_terms > ED_MAX_GIVEN_TERMS)
    return "the deformation of the specimen is that of 1 to 12 degrees of the frame";
  for (int i = 0; i < f->n_terms; i++)
    if (f->node[i] < 0 || f->node[i] >= f->analysis->model->n_nodes || f->degree[i] < 0 || f->degree[i] > 2 || !isfinite(f->coefficient[i]))
      return "the deformation of the specimen names a degree that the frame does not have, or a coefficient that is not finite";
  if (f->analysis->run.kind != ED_RUN_NONE)
    return "the frame is in the middle of a run";
  return NULL;
}

static double along(const frame *f, const double *vector)
{
  double sum = 0.0;
  for (int i = 0; i < f->n_terms; i++)
    if (f->equation[i] >= 0)
      sum += f->coefficient[i] * vector[f->equation[i]];
  return sum;
}

static int begin_history(frame *f, int n, const double *ground)
{
  ed_analysis *a = f->analysis;
  if (n > INT_MAX / f->divisions - 1)
    return ed_fail(a, ED_E_ARGUMENT, "%d main steps are too many", n);
  double *fine = malloc(sizeof *fine * ((size_t)n * (size_t)f->divisions + 1));
  if (!fine)
    return ed_fail(a, ED_E_MEMORY, "out of memory");
  for (int k = 0; k < n; k++)
    for (int j = 0; j < f->divisions; j++)
      fine[(size_t)k * (size_t)f->divisions + (size_t)j] = ground[k] + (ground[k + 1] - ground[k]) * ((double)j / f->divisions);
  fine[(size_t)n * (size_t)f->divisions] = ground[n];
  const ed_run given = a->run;
  const int status = ed_history_begin(a, n * f->divisions, f->dt, fine, NULL, NULL, f->method, f->parameters);
  free(fine);
  if (status == ED_OK)
    ed_run_buffers(a, given.every, given.abscissa, given.values, given.energy);
  f->running = status == ED_OK;
  return status;
}

static int start(ed_numerical *part, int n, const double *ground, double *outputs)
{
  frame *f = (frame *)part;
  ed_analysis *a = f->analysis;
  (void)outputs;
  f->k = f->running = 0;
  if (n == 0)
    return ED_OK;
  int status = ed_state_set(a, f->rest);
  if (status != ED_OK)
    return status;
  a->factors.stamp = -1; /* factors of the last run would lead to other iterations, and so to other rounding */
  a->factors.kept.valid = 0;
  if ((status = begin_history(f, n, ground)) != ED_OK)
    return status;
  f->force = ed_history_force(a, f->n_terms, f->node, f->degree, f->against);
  if (f->force < 0)
    return f->force;
  f->at_rest = along(f, a->committed.u);
  return ed_run_advance(a, 0);
}

static int step(ed_numerical *part, double force, double *y)
{
  frame *f = (frame *)part;
  ed_analysis *a = f->analysis;
  const double change = f->held || f->k == 0 ? 0.0 : force - f->earlier;
  int status = ED_OK;
  for (int j = 0; j < f->divisions && status == ED_OK; j++) {
    const double from = force + change * ((double)j / f->divisions), to = force + change * ((double)(j + 1) / f->divisions);
    status = ed_history_set_force(a, f->force, from, to);
    if (status == ED_OK)
      status = ed_run_advance(a, 1);
  }
  if (status < 0)
    return status;
  f->earlier = force;
  f->k++;
  y[0] = along(f, a->committed.u) - f->at_rest;
  y[1] = along(f, a->committed.v);
  y[2] = along(f, a->committed.a);
  return status;
}

static void end(ed_numerical *part)
{
  frame *f = (frame *)part;
  if (f->running)
    ed_run_end(f->analysis);
  f->running = 0;
}

static const char *message(const ed_numerical *part)
{
  return ed_analysis_message(((const frame *)part)->analysis);
}

static void discard(ed_numerical *part)
{
  frame *f = (frame *)part;
  free(f->rest);
  free(f);
}

ed_numerical *ed_frame_part_new(const ed_substructure_input *in)
{
  const ed_frame_part *given = in->frame;
  frame *f = calloc(1, sizeof *f);
  if (!f)
    return NULL;
  f->part = (ed_numerical){0, start, step, end, message, discard};
  f->analysis = given->analysis;
  f->divisions = given->divisions;
  f->dt = in->step / given->divisions;
  f->method = given->method;
  f->held = given->held;
  memcpy(f->parameters, given->parameters, sizeof f->parameters);
  f->n_terms = given->n_terms;
  for (int i = 0; i < f->n_terms; i++) {
    f->node[i] = given->node[i];
    f->degree[i] = given->degree[i];
    f->equation[i] = given->analysis->numbering.equation[3 * given->node[i] + given->degree[i]];
    f->coefficient[i] = given->coefficient[i];
    f->against[i] = -given->coefficient[i];
  }
  f->rest = malloc(sizeof *f->rest * (size_t)ed_state_size(given->analysis));
  if (!f->rest) {
    discard(&f->part);
    return NULL;
  }
  ed_state_get(given->analysis, f->rest);
  return &f->part;
}
