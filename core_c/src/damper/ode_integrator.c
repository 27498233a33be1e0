#include "damper/ode_integrator.h"

#include "edcore.h"

#include <arkode/arkode_arkstep.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdlib.h>
#include <string.h>

#if SUNDIALS_VERSION_MAJOR < 7
typedef booleantype ed_sun_boolean;
#else
typedef sunbooleantype ed_sun_boolean;
#endif

/* Order 3, stiffly accurate and L-stable, stage order 2. At the tolerances in use higher orders cost the same, and their embedded
 * errors guide them worse past the kinks of these laws. */
static const ARKODE_DIRKTableID method = ARKODE_ESDIRK325L2SA_5_2_3;
enum { MOST_STEPS = 20000, FALLING = -1 };
static const double newton_share = 1e-2; /* of the tolerance, in the last change of Newton's method */

static const double sensitivity_share = 1000.0; /* of the tolerance: a tangent needs no more */

static double instant(const ed_ode_integrator *integrator, double tau)
{
  return integrator->origin + integrator->scale * tau;
}

/* ---- functions that ARKODE calls ---- */

static int right_hand_side(double tau, N_Vector y, N_Vector derivative, void *data)
{
  ed_ode_integrator *integrator = data;
  const double *values = N_VGetArrayPointer_Serial(y);
  double *result = N_VGetArrayPointer_Serial(derivative);
  for (int i = 0; i < integrator->n_blocks; i++) {
    const ed_ode_block *block = &integrator->block[i];
    if (!ed_ode_derivatives(block, integrator->work, instant(integrator, tau), integrator->scale, values + block->first,
                            integrator->n, result + block->first))
      return 1;
  }
  memcpy(integrator->slope, result, (size_t)integrator->n * sizeof *result);
  return 0;
}

/* Weights of errors: relative to the size of a variable and to its change in the segment. */
static int weights(N_Vector y, N_Vector weight, void *data)
{
  const ed_ode_integrator *integrator = data;
  const double *values = N_VGetArrayPointer_Serial(y);
  double *result = N_VGetArrayPointer_Serial(weight);
  for (int i = 0; i < integrator->n * integrator->copies; i++) {
    const double tolerance = integrator->tolerance * (i < integrator->n ? 1.0 : sensitivity_share);
    const double size = tolerance * (fabs(values[i]) + integrator->change[i]);
    result[i] = size > 0.0 && isfinite(1.0 / size) ? 1.0 / size : 0.0; /* nothing there and nothing to come */
  }
  for (int i = 0; i < integrator->n; i++)
    integrator->weight[i] = result[i] / newton_share;
  return 0;
}

/* An error, over its tolerance, with which a step fails: in the place of one that is not finite, which would compare with nothing. */
static const double HOPELESS = 1e10;

/* The largest error counts: what one damper may err does not depend on how many there are. */
static double largest(N_Vector x, N_Vector weight)
{
  const double *values = N_VGetArrayPointer_Serial(x), *w = N_VGetArrayPointer_Serial(weight);
  const long n = (long)N_VGetLength_Serial(x);
  double result = 0.0;
  for (long i = 0; i < n; i++) {
    const double value = fabs(values[i]) * w[i];
    if (!(value <= result))
      result = isfinite(value) ? value : HOPELESS;
  }
  return result;
}

/* Speeds of blocks that turn themselves, in the direction in which they go; a little more than nothing at the start, so that a turn
 * just passed is not seen again. */
static int turns(double tau, N_Vector y, double *result, void *data)
{
  const ed_ode_integrator *integrator = data;
  const double *values = N_VGetArrayPointer_Serial(y);
  for (int i = 0, k = 0; i < integrator->n_blocks; i++) {
    const ed_ode_block *block = &integrator->block[i];
    if (!ed_ode_turns_itself(block->damper))
      continue;
    double velocity;
    if (!ed_ode_own_velocity(block, integrator->work, instant(integrator, tau), values + block->first, &velocity))
      return 1;
    result[k++] = block->turn * velocity + block->turn_level;
  }
  return 0;
}

#if SUNDIALS_VERSION_MAJOR < 7
static void silent(int code, const char *module, const char *function, char *message, void *data)
{
  (void)code, (void)module, (void)function, (void)message, (void)data;
}
#endif

/* ---- stages ---- */

static SUNNonlinearSolver_Type stage_type(SUNNonlinearSolver stages)
{
  (void)stages;
  return SUNNONLINEARSOLVER_ROOTFIND;
}

static int stage_system(SUNNonlinearSolver stages, SUNNonlinSolSysFn function)
{
  (void)stages, (void)function;
  return 0;
}

/* Stage equation z = prediction + data + gamma f(z), all blocks one after the other; `correction` is z - prediction. */
static int stage_solve(SUNNonlinearSolver stages, N_Vector start, N_Vector correction, N_Vector weight, double tolerance,
                       ed_sun_boolean setup, void *memory)
{
  ed_ode_integrator *integrator = stages->content;
  double tau, gamma;
  N_Vector prediction, stage, rate, data;
  void *user;
  (void)start, (void)weight, (void)tolerance, (void)setup, (void)memory;
  if (ARKStepGetNonlinearSystemData(integrator->arkode, &tau, &prediction, &stage, &rate, &gamma, &data, &user))
    return -1;
  const int n = integrator->n, all = n * integrator->copies;
  const double *from = N_VGetArrayPointer_Serial(prediction), *known = N_VGetArrayPointer_Serial(data);
  double *z = N_VGetArrayPointer_Serial(stage), *a = N_VGetArrayPointer_Serial(correction);
  if (integrator->watch && ed_watch_step(integrator->watch))
    return -1;
  for (int i = 0; i < all; i++)
    a[i] = from[i] + known[i];
  for (int i = 0; i < n; i++)
    z[i] = a[i] + gamma * integrator->slope[i];
  for (int i = 0; i < integrator->n_blocks; i++) {
    const ed_ode_block *block = &integrator->block[i];
    const int first = block->first;
    if (!ed_ode_stage(block, integrator->work, instant(integrator, tau), gamma * integrator->scale, a + first,
                      integrator->weight + first, n, z + first))
      return SUN_NLS_CONV_RECVR;
  }
  for (int i = 0; i < n; i++)
    integrator->slope[i] = (z[i] - a[i]) / gamma;
  for (int i = 0; i < all; i++)
    a[i] = z[i] - from[i];
  return 0;
}

/* ---- the integrator ---- */

int ed_ode_integrator_new(ed_ode_integrator *integrator, SUNContext context, int n_blocks, ed_ode_block *block, ed_ode_work *work,
                          int copies, double tolerance)
{
  int n = 0, turning = 0;
  for (int i = 0; i < n_blocks; i++) {
    n += block[i].damper->n_ode;
    turning += ed_ode_turns_itself(block[i].damper);
  }
  *integrator = (ed_ode_integrator){.n_blocks = n_blocks, .n = n, .copies = copies, .tolerance = tolerance,
                                    .block = block, .work = work, .scale = 1.0, .context = context};
  integrator->change = calloc((size_t)n * (size_t)copies + 1, sizeof(double));
  integrator->weight = calloc((size_t)n + 1, sizeof(double));
  integrator->slope = calloc((size_t)n + 1, sizeof(double));
  integrator->found = calloc((size_t)n_blocks + 1, sizeof(int));
  integrator->y = N_VNew_Serial(n > 0 ? (sunindextype)n * copies : 1, context); /* never none, so that there is a place to point to */
  integrator->stages = SUNNonlinSolNewEmpty(context);
  if (!integrator->change || !integrator->weight || !integrator->slope || !integrator->found || !integrator->y ||
      !integrator->stages)
    return ED_E_MEMORY;
  integrator->y->ops->nvwrmsnorm = largest;
  integrator->stages->content = integrator;
  integrator->stages->ops->gettype = stage_type;
  integrator->stages->ops->setsysfn = stage_system;
  integrator->stages->ops->solve = stage_solve;
  N_VConst(0.0, integrator->y);
  integrator->arkode = ARKStepCreate(NULL, right_hand_side, 0.0, integrator->y, context);
  void *arkode = integrator->arkode;
  if (!arkode)
    return ED_E_MEMORY;
  int refused = N_VEnableFusedOps_Serial(integrator->y, 1);
#if SUNDIALS_VERSION_MAJOR < 7
  refused |= ARKStepSetErrHandlerFn(arkode, silent, NULL);
#endif
  refused |= ARKStepSetUserData(arkode, integrator);
  refused |= ARKStepWFtolerances(arkode, weights);
  refused |= ARKStepSetTableNum(arkode, method, ARKODE_ERK_NONE);
  refused |= ARKStepSetNonlinearSolver(arkode, integrator->stages);
  refused |= ARKStepSetPredictorMethod(arkode, 0);
  refused |= ARKStepSetDeduceImplicitRhs(arkode, 1);
  refused |= ARKStepSetMaxNumSteps(arkode, MOST_STEPS);
  if (turning > 0) {
    refused |= ARKStepRootInit(arkode, turning, turns);
    for (int i = 0; i < turning; i++) /* room for a moment: SUNDIALS keeps a copy */
      integrator->found[i] = FALLING;
    refused |= ARKStepSetRootDirection(arkode, integrator->found);
    refused |= ARKStepSetNoInactiveRootWarn(arkode);
  }
  return refused ? ED_E_STATE : ED_OK;
}

void ed_ode_integrator_clear(ed_ode_integrator *integrator)
{
  if (integrator->arkode)
    ARKStepFree(&integrator->arkode);
  if (integrator->stages)
    SUNNonlinSolFreeEmpty(integrator->stages);
  if (integrator->y)
    N_VDestroy(integrator->y);
  free(integrator->found);
  free(integrator->change);
  free(integrator->weight);
  free(integrator->slope);
}

double *ed_ode_variables(const ed_ode_integrator *integrator)
{
  return N_VGetArrayPointer_Serial(integrator->y);
}

/* First step, as share of the segment: so small that the error of an order 3 method, estimated from how fast the equations forget
 * and how much there is to forget, is about the tolerance. Too large costs a failed step, too small some steps more. */
static double first_step(double tolerance, double forgets, double part)
{
  if (!(forgets > 0.0) || !(part > 0.0))
    return 1.0;
  return fmin(1.0, sqrt(sqrt(30.0 * tolerance / part)) / forgets);
}

int ed_ode_integrator_begin(ed_ode_integrator *integrator, double t0, double t1)
{
  const double *y = ed_ode_variables(integrator);
  double first = 1.0;
  integrator->origin = t0;
  integrator->scale = t1 - t0;
  memset(integrator->slope, 0, (size_t)integrator->n * sizeof *integrator->slope);
  for (int i = 0; i < integrator->n_blocks; i++) {
    ed_ode_block *block = &integrator->block[i];
    const double *own = y + block->first;
    double *change = integrator->change + block->first, rate, part = 0.0;
    if (!ed_ode_estimate(block, integrator->work, t0, t1, own, integrator->n, change, &rate))
      return ED_E_NOT_FINITE;
    for (int j = 0; j < block->damper->n_ode; j++)
      if (change[j] > 0.0)
        part = fmax(part, change[j] / (fabs(own[j]) + change[j]));
    first = fmin(first, first_step(integrator->tolerance, rate * integrator->scale, part));
  }
  if (integrator->n == 0)
    return ED_OK;
  /* anew altogether: nothing may be left of what was computed before */
  int refused = ARKStepReInit(integrator->arkode, NULL, right_hand_side, 0.0, integrator->y);
  refused |= ARKStepSetInitStep(integrator->arkode, first);
  return refused ? ED_E_STATE : ED_OK;
}

int ed_ode_integrator_advance(ed_ode_integrator *integrator, double t, double *reached)
{
  double tau = 0.0;
  const double goal = (t - integrator->origin) / integrator->scale;
  *reached = t;
  if (integrator->n == 0)
    return ED_OK;
  if (ARKStepSetStopTime(integrator->arkode, fmin(goal, 1.0)))
    return ED_E_STATE;
  const int status = ARKStepEvolve(integrator->arkode, fmin(goal, 1.0), integrator->y, &tau, ARK_NORMAL);
  if (status < 0 && integrator->watch && integrator->watch->stopped)
    return ED_E_STOPPED;
  if (status < 0)
    return status == ARK_FIRST_RHSFUNC_ERR || status == ARK_RHSFUNC_FAIL ? ED_E_NOT_FINITE : ED_E_NOT_CONVERGED;
  if (status == ARK_ROOT_RETURN) {
    *reached = instant(integrator, tau);
    if (ARKStepGetRootInfo(integrator->arkode, integrator->found))
      return ED_E_STATE;
    for (int i = 0, k = 0; i < integrator->n_blocks; i++)
      if (ed_ode_turns_itself(integrator->block[i].damper) && integrator->found[k++])
        integrator->block[i].turned = 1;
  }
  return ED_OK;
}
