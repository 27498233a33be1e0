#include "in_series.h"

int history_in_series(const ed_damper *damper, int method, double fineness, int n, const double *time, const double *u, const double *v,
                      const double *factor, const double *added, const double *spring, const ed_rig *rig, double *force, double *own,
                      int *done)
{
  const ed_test test = {.n = n, .time = time, .u = u, .v = v, .factor = factor, .added = added, .spring = spring, .rig = rig};
  ed_campaign_end end;
  const int status = ed_damper_campaign(1, &damper, 1, &test, method, fineness, ED_CARRY_NOTHING, force, own, &end);
  *done = end.status == ED_OK ? n : end.sample;
  return status == ED_OK ? end.status : status;
}
