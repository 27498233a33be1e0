/* An analysis at run time, composed of its themes. Each has a header beside the source file that owns it, and functions that
 * need one theme alone take that one. Private to the core. */
#ifndef ED_ANALYSIS_H
#define ED_ANALYSIS_H

#include "analysis/condensation.h"
#include "analysis/equilibrium.h"
#include "analysis/fallbacks.h"
#include "analysis/run.h"
#include "base/watch.h"
#include "edcore.h"
#include "system/assembly.h"
#include "system/channels.h"
#include "system/check.h"
#include "system/damping.h"
#include "system/devices.h"
#include "system/energy.h"
#include "system/factors.h"
#include "system/loading.h"
#include "system/members.h"
#include "system/model.h"
#include "system/numbering.h"
#include "system/state.h"

/* Of the iterations of steps; those of elements are in their control. */
typedef struct {
  double tolerance;
  int max_iterations, halvings, reuse, energy;
} ed_settings;

struct ed_analysis {
  const ed_model *model;
  char message[ED_MESSAGE];
  ed_settings settings;

  ed_numbering numbering;
  ed_members members;
  ed_state trial, committed;
  ed_storage storage;
  ed_loading loading;
  ed_devices devices;
  ed_damping damping;
  ed_matrices matrix;
  ed_factors factors;

  ed_iteration iteration;
  ed_condensation condensation;
  ed_fallbacks fallbacks;
  ed_channels channels;
  ed_run run;
  ed_stop stop;                  /* whom runs ask */
  ed_watch watch;                /* of the present call */
  ed_statistics statistics;
};

/* Keeps a message for people; returns the status. */
int ed_fail(ed_analysis *a, int status, const char *format, ...);

#endif
