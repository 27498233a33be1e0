/* What a test rig in series with a damper carries at a stretch (ed_rig in eddamper.h, series.c). */
#ifndef ED_RIG_H
#define ED_RIG_H

#include "eddamper.h"

double ed_rig_carries(const ed_rig *rig, double stretch);
/* Where a force that falls by `slope` (>= 0) from `force` at a stretch meets that of the rig, straight from this stretch on. */
double ed_rig_meets(const ed_rig *rig, double stretch, double force, double slope);

#endif
