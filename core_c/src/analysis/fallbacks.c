/* Fallbacks of a step that does not converge. It is tried with ever safer iterations, then halved, a bounded
 * number of times; each one that was used is recorded, and when all fail the state is exactly what it was before the step. */
#include "system/analysis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void record(ed_analysis *a, int fallback, int level, int status)
{
  a->statistics.fallbacks++;
  if (a->fallbacks.n_events == ED_MAX_EVENTS)
    return;
  a->fallbacks.events[a->fallbacks.n_events++] = (ed_event){.time = a->committed.head->time,
                                        .step = a->run.done + 1,
                                        .fallback = fallback,
                                        .level = level,
                                        .success = status == ED_OK,
                                        .iterations = ed_last_iterations(&a->iteration)};
}

/* What the committed state shows of the cause: how far yielding has spread, or a member that has turned over (returns 1). */
static int describe_state(const ed_analysis *a, char *buffer, int size)
{
  int sections = 0, members = 0, furthest = -1;
  double turned = 0.2; /* rad: far beyond what a frame survives */
  for (int m = 0; m < a->model->n_members; m++) {
    const ed_element *e = &a->members.element[m];
    const double *block = a->committed.elements + e->state;
    const int before = sections;
    double d[ED_MAX_DEGREES];
    for (int p = 0; p < e->points; p++)
      sections += block[ed_point_at(e->axes, p) + ed_point_elastic(e->axes)] == 0.0;
    members += sections > before;
    for (int i = 0; i < e->degrees; i++)
      d[i] = ed_displacement(&a->numbering, &a->committed, e->dof[i]);
    ed_kinematics k;
    ed_kinematics_of(e, d, &k);
    const double drift = e->degrees == 6 ? fabs(k.drift[0]) : hypot(k.drift[0], k.drift[1]);
    if (e->length > 0.0 && e->geometry != ED_COROTATIONAL && drift / e->length > turned) {
      turned = drift / e->length;
      furthest = m;
    }
  }
  if (furthest >= 0)
    snprintf(buffer, (size_t)size, "; %s has turned by %.2g rad: the structure has collapsed",
             a->members.element[furthest].member->name, turned);
  else if (sections)
    snprintf(buffer, (size_t)size, "; before it %d sections of %d members were yielding", sections, members);
  return furthest >= 0;
}

/* Says what happened, where and how, from the last attempt. */
static void explain(ed_analysis *a, int status)
{
  char degree[ED_NAME + 8], where[2 * ED_NAME] = "", path[200] = "", cause[420] = "", state[200] = "";
  const ed_element *e = NULL;
  if (status == ED_E_ELEMENT)
    e = &a->members.element[a->members.failed];
  /* else one at the worst degree's node that has yielded */
  for (int m = 0; !e && m < a->model->n_members; m++)
    for (int i = 0; i < a->members.element[m].degrees; i++)
      if (a->numbering.equation[a->members.element[m].dof[i]] == a->iteration.worst &&
          (a->trial.elements[a->members.element[m].state + ed_block_inelastic(a->members.element[m].axes)] != 0.0))
        e = &a->members.element[m];
  if (e) {
    int section = 0;
    for (int p = 0; p < e->points; p++)
      if (a->trial.elements[e->state + ed_point_at(e->axes, p) + ed_point_elastic(e->axes)] == 0.0)
        section = p + 1;
    snprintf(where, sizeof where, section ? ", element %s section %d" : ", element %s", e->member->name, section);
  }
  if (a->iteration.n_residuals == 0)
    snprintf(path, sizeof path, "none: the elements failed first");
  for (int i = 0; i < a->iteration.n_residuals; i++) {
    const size_t used = strlen(path);
    if (i < 4 || i >= a->iteration.n_residuals - 4)
      snprintf(path + used, sizeof path - used, "%s%.2g", i ? " " : "", a->iteration.residuals[i]);
    else if (i == 4)
      snprintf(path + used, sizeof path - used, " ...");
  }
  if (status == ED_E_SINGULAR || status == ED_E_UNSTABLE) {
    char names[300];
    ed_assemble_tangent(a);
    ed_name_mechanism(a, names, sizeof names);
    snprintf(cause, sizeof cause, "; softest at %s: the limit load or the critical load is reached", names);
  }
  const char *advice = ". Try a smaller step";
  if (describe_state(a, state, sizeof state))
    advice = "";
  else if (a->run.kind == ED_RUN_STATIC)
    advice = ". Try a smaller step, or a pushover if the load exceeds the capacity";
  const char *abscissa = a->run.kind == ED_RUN_HISTORY ? "time" : a->run.kind == ED_RUN_STATIC ? "load factor" : "displacement";
  if (status == ED_E_DAMPER) {
    memcpy(where, ", ", 3);
    ed_name_damper(a->model, &a->devices, where + 2, (int)sizeof where - 2);
  }
  ed_fail(a, status,
          "%s: step %d, %s %.6g, after %d halvings of the step; largest unbalance at %s%s; relative residuals %s%s%s%s",
          ed_status_text(status), a->run.done + 1, abscissa, a->committed.head->time, a->settings.halvings,
          ed_equation_name(a->model, &a->numbering, a->iteration.worst, degree, sizeof degree), where, path, cause, state, advice);
}

/* Fallbacks that make a difference. Where damping follows the current stiffness, that is nearly always what kept the step from
 * converging: it jumps as fibres yield and unload. */
static int useful(const ed_analysis *a, int fallback)
{
  const ed_damping *damping = &a->damping;
  const int jumping = a->run.kind == ED_RUN_HISTORY && damping->rayleigh_kind == ED_STIFFNESS_CURRENT && damping->rayleigh_stiffness != 0.0;
  switch (fallback) {
    case ED_FALLBACK_FULL_NEWTON:
      return !jumping && a->settings.reuse;
    case ED_FALLBACK_FROZEN_DAMPING:
      return jumping;
    default:
      return 1;
  }
}

static int accept(ed_analysis *a)
{
  ed_commit(a);
  a->statistics.substeps++;
  return ED_OK;
}

static int solve_part(ed_analysis *a, ed_attempt attempt, double fraction, int level, int first_fallback)
{
  int status = ED_E_NOT_CONVERGED;
  for (int fallback = first_fallback; fallback <= ED_FALLBACK_LINE_SEARCH; fallback++) {
    if (!useful(a, fallback))
      continue;
    status = attempt(a, fraction, fallback);
    if (status == ED_E_STOPPED) {
      ed_revert(a);
      return status;
    }
    if (fallback > 0)
      record(a, fallback, level, status);
    if (status == ED_OK)
      return accept(a);
    if (level == a->settings.halvings && fallback == ED_FALLBACK_LINE_SEARCH)
      explain(a, status); /* while the failed state is still there */
    ed_revert(a);
  }
  if (level == a->settings.halvings)
    return status;
  record(a, ED_FALLBACK_HALVE, level + 1, ED_OK);
  for (int half = 0; half < 2; half++)
    if ((status = solve_part(a, attempt, 0.5 * fraction, level + 1, 0)) != ED_OK)
      return status;
  return ED_OK;
}

int ed_solve_step(ed_analysis *a, ed_attempt attempt)
{
  int status = attempt(a, 1.0, 0);
  if (status == ED_OK)
    return accept(a);
  ed_revert(a);
  if (status == ED_E_STOPPED)
    return status;
  ed_backup(a); /* only now: an attempt changes no layer, a commit of half a step does */
  status = solve_part(a, attempt, 1.0, 0, ED_FALLBACK_FULL_NEWTON);
  if (status != ED_OK)
    ed_restore(a);
  return status;
}
